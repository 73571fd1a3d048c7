// SPDX-License-Identifier: MIT
#include "io/ply_textures.h"

#include <map>
#include <optional>
#include <string>
#include <utility>

#include "io/named_path.h"
#include "io/number_parsing.h"
#include "io/texture_loader.h"

namespace vantage {

PlyTextures::PlyTextures(const PlyHeader& header, const Surroundings& surroundings,
                         ModelBuilder& builder)
    : builder_(builder) {
  if (!surroundings.options.appearance || header.textures.empty()) {
    return;
  }
  const bool of_corners = has_role(header, PlyRole::CornerPlaces);
  if (!of_corners && !(has_role(header, PlyRole::U) && has_role(header, PlyRole::V))) {
    builder.note("the texture " + in_quotes(header.textures.front()) +
                 " was left out: the file does not say where it lies on the surface");
    return;
  }
  read(header, surroundings);
  if (!textures_.empty()) {
    places_ = of_corners ? Places::OfCorners : Places::OfVertices;
    builder.keep_appearance(!of_corners);
  }
}

void PlyTextures::read(const PlyHeader& header, const Surroundings& surroundings) {
  TextureLoader loader(surroundings, builder_);
  std::map<std::string, std::uint32_t> known;
  for (const std::string& name : header.textures) {
    const std::optional<std::string> path =
        place_of_picture(with_slashes(name), surroundings.has_side_file);
    const auto [at, is_new] = known.try_emplace(path.value_or(""), Appearance::kNone);
    std::optional<Image> image = path && is_new ? loader.beside(*path) : std::nullopt;
    if (image) {
      at->second = static_cast<std::uint32_t>(textures_.size());
      textures_.push_back({std::move(*image), TextureWrap::Repeat, TextureWrap::Repeat, false});
    }
    material_of_picture_.push_back(at->second);
  }
  loader.finish();
}

std::uint32_t PlyTextures::material(double number) const {
  const bool is_there = number >= 0.0 && number < static_cast<double>(material_of_picture_.size());
  return is_there ? material_of_picture_[static_cast<std::size_t>(number)] : Appearance::kNone;
}

void PlyTextures::finish() {
  std::vector<Material> materials(textures_.size());
  for (std::uint32_t k = 0; k < materials.size(); ++k) {
    materials[k].texture = k;
    // These coordinates begin at the bottom left, ours at the top left.
    materials[k].uv_transform = {1.0, 0.0, 0.0, 0.0, -1.0, 1.0};
  }
  if (!materials.empty()) {
    builder_.set_materials(std::move(materials), std::move(textures_));
  }
}

}  // namespace vantage
