// SPDX-License-Identifier: MIT
#include "io/obj_materials.h"

#include <algorithm>
#include <utility>

#include "core/srgb.h"
#include "io/gltf_uri.h"
#include "io/number_parsing.h"
#include "io/text_cursor.h"

namespace vantage {
namespace {

/// Programs of Windows write backslashes.
std::string with_slashes(std::string_view name) {
  std::string path(name);
  std::replace(path.begin(), path.end(), '\\', '/');
  return path;
}

std::string folder_of(const std::string& path) {
  return path.substr(0, path.find_last_of('/') + 1);
}

/// A relative path as the file names it; nothing if it leaves the folder.
std::optional<std::string> inside_folder(const std::string& path) {
  // The rules are those of glTF; a percent sign is none of an OBJ's ways to write a character.
  std::string escaped;
  for (const char c : path) {
    escaped += c == '%' ? std::string("%25") : std::string(1, c);
  }
  return relative_path_of_uri(escaped);
}

}  // namespace

void ObjMaterials::add_library(std::string_view names) {
  if (!names.empty() && known_libraries_.emplace(names).second) {
    libraries_.emplace_back(names);
  }
}

void ObjMaterials::use(std::string_view name) {
  const auto next = static_cast<std::uint32_t>(index_of_name_.size());
  builder_.begin_material(index_of_name_.try_emplace(std::string(name), next).first->second);
}

bool ObjMaterials::read_library(std::string_view name) {
  const std::optional<std::string> path = inside_folder(with_slashes(name));
  if (!path || !surroundings_.side_files) {
    return false;
  }
  const auto known = library_is_read_.find(*path);
  if (known != library_is_read_.end()) {
    return known->second;
  }
  const bool is_read = read_materials(*path);
  library_is_read_[*path] = is_read;
  return is_read;
}

bool ObjMaterials::read_materials(const std::string& path) {
  const SideFile file = surroundings_.side_files(path);
  if (!file.bytes) {
    return false;
  }
  const std::string folder = folder_of(path);
  for (auto& [material, look] : parse_mtl(*file.bytes)) {
    look.picture = look.picture.empty() ? "" : folder + with_slashes(look.picture);
    look.mask = look.mask.empty() ? "" : folder + with_slashes(look.mask);
    materials_.try_emplace(material, look);
  }
  return true;
}

std::optional<std::uint32_t> ObjMaterials::texture(const MtlMaterial& source) {
  const std::string key = source.picture + (source.clamp ? " clamped" : "");
  if (const auto known = known_pictures_.find(key); known != known_pictures_.end()) {
    return known->second;
  }
  std::optional<std::uint32_t>& place = known_pictures_[key];
  // A path of the author's own disk: the picture has usually been put beside the model.
  std::optional<std::string> path = inside_folder(source.picture);
  if (!path || (surroundings_.side_files && !surroundings_.side_files(*path).bytes)) {
    path = inside_folder(source.picture.substr(source.picture.find_last_of('/') + 1));
  }
  std::optional<Image> image = path ? loader_.beside(*path) : std::nullopt;
  if (image) {
    const TextureWrap wrap = source.clamp ? TextureWrap::Clamp : TextureWrap::Repeat;
    place = static_cast<std::uint32_t>(textures_.size());
    textures_.push_back({std::move(*image), wrap, wrap, false});
  }
  return place;
}

Material ObjMaterials::material(const MtlMaterial& source) {
  Material result;
  for (std::size_t c = 0; c < 3; ++c) {
    result.colour[c] = linear_of_encoded(source.colour[c]);
  }
  // Programs that put the whole colour into the picture often leave Kd black.
  if (!source.picture.empty() && source.colour == std::array{0.0, 0.0, 0.0}) {
    result.colour = {1.0, 1.0, 1.0};
  }
  result.opacity = source.opacity;
  result.alpha = source.opacity < 1.0 ? AlphaMode::Blend : AlphaMode::Opaque;
  if (!source.picture.empty()) {
    result.texture = texture(source);
    if (source.mask == source.picture) {
      result.alpha = AlphaMode::Mask;
    }
  }
  // Wavefront's coordinates begin at the bottom left, ours at the top left.
  result.uv_transform = {source.scale[0],       0.0, source.offset[0], 0.0, -source.scale[1],
                         1.0 - source.offset[1]};
  return result;
}

void ObjMaterials::finish() {
  std::size_t left_out = 0;
  for (const std::string& names : libraries_) {
    bool found = read_library(names);  // one whose name has spaces, or else several
    std::string_view rest = found ? std::string_view() : std::string_view(names);
    for (std::string_view name = take_token(rest); !name.empty(); name = take_token(rest)) {
      found = read_library(name) || found;
    }
    if (!found && left_out++ < kMostTextureNotes) {
      builder_.note("the material library " + in_quotes(names) +
                    " was left out: it cannot be read in the model's folder");
    }
  }
  if (left_out > kMostTextureNotes) {
    builder_.note("more material libraries were left out: " +
                  std::to_string(left_out - kMostTextureNotes));
  }
  std::vector<Material> materials(index_of_name_.size());
  std::size_t unknown = 0;
  for (const auto& [name, index] : index_of_name_) {
    const auto found = materials_.find(name);
    unknown += found == materials_.end() ? 1 : 0;
    if (found != materials_.end()) {
      materials[index] = material(found->second);
    }
  }
  loader_.finish();
  if (unknown < materials.size()) {
    builder_.set_materials(std::move(materials), std::move(textures_));
  }
}

}  // namespace vantage
