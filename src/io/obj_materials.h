// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
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
  std::optional<std::uint32_t> texture(const MtlMaterial& source);
  std::optional<Image> picture(const std::string& name);

  ModelBuilder& builder_;
  TextureLoader loader_;
  ObjLibraries libraries_;
  std::map<std::string, std::uint32_t, std::less<>> index_of_name_{};
  std::map<std::string, std::optional<std::uint32_t>> known_pictures_{};
  std::vector<Texture> textures_{};
};

}  // namespace vantage
