// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "vantage/mesh/appearance.h"

#include "io/model_builder.h"
#include "io/mtl.h"
#include "io/readers.h"
#include "io/texture_loader.h"

namespace vantage {

/// What an OBJ says of materials. Libraries may be named after the faces that use them.
class ObjMaterials {
 public:
  /// Both must outlive this.
  ObjMaterials(const Surroundings& surroundings, ModelBuilder& builder)
      : surroundings_(surroundings), builder_(builder), loader_(surroundings, builder) {}

  /// The rest of a mtllib line: one name, which may hold spaces, or several without.
  void add_library(std::string_view names);

  /// The rest of a usemtl line: what follows is of this material.
  void use(std::string_view name);

  /// Reads libraries and textures into the builder.
  void finish();

 private:
  [[nodiscard]] bool read_library(std::string_view name);
  [[nodiscard]] bool read_materials(const std::string& path);
  Material material(const MtlMaterial& source);
  std::optional<std::uint32_t> texture(const MtlMaterial& source);

  const Surroundings& surroundings_;
  ModelBuilder& builder_;
  TextureLoader loader_;
  std::vector<std::string> libraries_{};                  ///< As named, each once, in order.
  std::set<std::string, std::less<>> known_libraries_{};  ///< The same.
  std::map<std::string, bool> library_is_read_{};         ///< Of each path that was tried.
  std::map<std::string, MtlMaterial, std::less<>> materials_{};
  std::map<std::string, std::uint32_t, std::less<>> index_of_name_{};
  std::map<std::string, std::optional<std::uint32_t>> known_pictures_{};
  std::vector<Texture> textures_{};
};

}  // namespace vantage
