// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "vantage/mesh/appearance.h"

#include "io/model_builder.h"
#include "io/obj_libraries.h"
#include "io/readers.h"
#include "io/texture_loader.h"

namespace vantage {

/// What an OBJ says of materials. Libraries may be named after the faces that use them.
class ObjMaterials {
 public:
  /// Both must outlive this.
  ObjMaterials(const Surroundings& surroundings, ModelBuilder& builder)
      : builder_(builder),
        loader_(surroundings, builder),
        libraries_(surroundings.side_files, surroundings.has_side_file) {}

  /// The rest of a mtllib line: one name, which may hold spaces, or several without.
  void add_library(std::string_view names) { libraries_.add(names); }

  /// The rest of a usemtl line: what follows is of this material.
  void use(std::string_view name);

  /// Reads libraries and textures into the builder.
  void finish();

 private:
  Material material(const MtlMaterial& source);
  std::optional<std::uint32_t> texture(const MtlMaterial& source, bool clamp);
  [[nodiscard]] std::optional<std::string> path_of(const MtlMap& map) const;

  ModelBuilder& builder_;
  TextureLoader loader_;
  ObjLibraries libraries_;
  std::map<std::string, std::uint32_t, std::less<>> index_of_name_{};
  /// By paths of picture and mask, and whether it is clamped.
  std::map<std::tuple<std::optional<std::string>, std::optional<std::string>, bool>,
           std::optional<std::uint32_t>>
      known_textures_{};
  std::vector<Texture> textures_{};
  std::size_t masks_laid_otherwise_ = 0;
};

}  // namespace vantage
