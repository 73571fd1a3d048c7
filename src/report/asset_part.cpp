// SPDX-License-Identifier: MIT
#include "report/asset_part.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <tuple>
#include <utility>
#include <vector>

#include "vantage/io/write.h"

#include "mesh/texture_place.h"

namespace vantage {
namespace {

using Json = nlohmann::ordered_json;

/// Longest side of a texture in the page, px: its window shows no more of it. [ours]
constexpr int kTextureSide = 1024;
/// Textures of no more pixels are PNG: WebP shares its colours among four, which palettes and pixel
/// art show. [ours]
constexpr std::size_t kSmallTexture = std::size_t{256} * 256;

/// Coordinates, in radii of the enclosing sphere, are stored as 16 bits over [-1.25, 1.25]: a
/// contracted surface may reach a little beyond the sphere.
constexpr double kReach = 1.25;

/// Corners of the faces that are sent, each place with its texture coordinates once.
struct Rows {
  std::vector<std::uint32_t> positions{};
  std::vector<std::array<float, 2>> uvs{};
  std::vector<std::uint32_t> indices{};
};

std::array<float, 2> narrow(const std::array<double, 2>& place) {
  return {static_cast<float>(place[0]), static_cast<float>(place[1])};
}

/// Adds the faces of one material. \param material null for faces without one.
void add_faces(const Model& model, const std::vector<std::uint32_t>& faces,
               const Material* material, Rows& rows) {
  const Appearance& appearance = model.appearance;
  const bool is_textured = material != nullptr &&
                           (material->texture || material->emission_texture) &&
                           !appearance.uv_of_triangle.empty();
  std::vector<std::array<std::uint32_t, 2>> corners;
  for (const std::uint32_t face : faces) {
    for (std::size_t k = 0; k < 3; ++k) {
      corners.push_back({model.mesh.triangles[face][k],
                         is_textured ? appearance.uv_of_triangle[face][k] : Appearance::kNone});
    }
  }
  std::vector<std::array<std::uint32_t, 2>> own = corners;
  std::sort(own.begin(), own.end());
  own.erase(std::unique(own.begin(), own.end()), own.end());
  const auto first = static_cast<std::uint32_t>(rows.positions.size());
  for (const auto& [position, uv] : own) {
    rows.positions.push_back(position);
    rows.uvs.push_back(uv == Appearance::kNone
                           ? std::array<float, 2>{}
                           : narrow(texture_place(*material, appearance.uvs[uv])));
  }
  for (const auto& corner : corners) {
    rows.indices.push_back(
        first +
        static_cast<std::uint32_t>(std::lower_bound(own.begin(), own.end(), corner) - own.begin()));
  }
}

/// A texture as the page shows it.
struct SentTexture {
  std::uint32_t texture = 0;
  bool is_opaque = false;  ///< Its opacity means nothing.

  bool operator==(const SentTexture&) const = default;
};

SentTexture colours_of(const Material& material) {
  return {*material.texture, material.alpha == AlphaMode::Opaque};
}

SentTexture light_of(const Material& material) {
  return {*material.emission_texture, true};
}

/// What the materials show: of a texture up to two copies, with and without its opacity.
std::vector<SentTexture> sent_textures(const Appearance& appearance) {
  std::vector<std::array<bool, 2>> is_used(appearance.textures.size());
  const auto use = [&](const SentTexture& sent) {
    is_used[sent.texture][sent.is_opaque ? 1 : 0] = true;
  };
  for (const Material& material : appearance.materials) {
    if (material.texture) {
      use(colours_of(material));
    }
    if (material.emission_texture) {
      use(light_of(material));
    }
  }
  std::vector<SentTexture> sent;
  for (std::uint32_t texture = 0; texture < is_used.size(); ++texture) {
    for (const bool is_opaque : {false, true}) {
      if (is_used[texture][is_opaque ? 1 : 0]) {
        sent.push_back({texture, is_opaque});
      }
    }
  }
  return sent;
}

Json material_json(const Material& material, const std::vector<SentTexture>& sent) {
  const auto place_of = [&](const SentTexture& texture) {
    return std::find(sent.begin(), sent.end(), texture) - sent.begin();
  };
  Json json = {{"colour", material.colour}, {"unlit", material.unlit}};
  if (material.texture) {
    json["texture"] = place_of(colours_of(material));
  }
  if (material.emission != std::array<double, 3>{}) {
    json["emission"] = material.emission;
  }
  if (material.emission_texture) {
    json["emission_texture"] = place_of(light_of(material));
  }
  if (material.alpha == AlphaMode::Mask) {
    json["cutoff"] = material.alpha_cutoff;
  }
  if (material.alpha != AlphaMode::Opaque) {
    json["opacity"] = material.opacity;
  }
  return json;
}

/// Opacity that means nothing hides colours, from what makes pictures smaller and from WebP.
Image opaque(Image image) {
  for (std::size_t i = 3; i < image.rgba.size(); i += 4) {
    image.rgba[i] = 255;
  }
  return image;
}

Json texture_json(const Texture& texture, bool is_opaque, const RunContext& run) {
  constexpr std::array kWraps{"repeat", "mirror", "clamp"};
  const int longest = std::max(texture.image.width, texture.image.height);
  const double share = std::min(1.0, static_cast<double>(kTextureSide) / longest);
  const auto side = [share](int size) {
    return std::max(1, static_cast<int>(std::lround(share * size)));
  };
  Image image = is_opaque ? opaque(texture.image) : texture.image;
  if (share < 1.0) {
    image = smaller_picture(image, side(image.width), side(image.height), run);
  }
  const bool keeps_colours = texture.nearest || image.rgba.size() <= 4 * kSmallTexture;
  return {{"picture", keeps_colours ? "data:image/png;base64," + base64(png_bytes(image))
                                    : "data:image/webp;base64," + base64(webp_bytes(image))},
          {"wrap",
           {kWraps[static_cast<std::size_t>(texture.wrap_u)],
            kWraps[static_cast<std::size_t>(texture.wrap_v)]}},
          {"nearest", texture.nearest}};
}

}  // namespace

std::string packed_positions(const std::vector<Vec3>& positions,
                             const std::vector<std::uint32_t>& rows, const PageFrame& frame) {
  std::vector<std::uint16_t> packed;
  packed.reserve(3 * rows.size());
  for (const std::uint32_t v : rows) {
    const Vec3 p = frame.to(positions[v]);
    for (int axis = 0; axis < 3; ++axis) {
      const double share = std::clamp((p[axis] + kReach) / (2.0 * kReach), 0.0, 1.0);
      packed.push_back(static_cast<std::uint16_t>(std::lround(65535.0 * share)));
    }
  }
  return base64_of(packed);
}

bool has_look(const Model& model) {
  return !model.mesh.triangles.empty() &&
         (!model.vertex_colours.empty() || !model.appearance.materials.empty());
}

Json asset_part(const Model& model, std::size_t max_faces, const PageFrame& frame,
                const RunContext& run) {
  if (!has_look(model) || model.mesh.triangles.size() > max_faces) {
    return nullptr;
  }
  const Appearance& appearance = model.appearance;
  // Faces without a material come last.
  std::vector<std::vector<std::uint32_t>> faces(appearance.materials.size() + 1);
  for (std::uint32_t face = 0; face < model.mesh.triangles.size(); ++face) {
    const std::uint32_t material =
        appearance.materials.empty() ? Appearance::kNone : appearance.material_of_triangle[face];
    faces[std::min<std::size_t>(material, appearance.materials.size())].push_back(face);
  }
  const std::vector<SentTexture> sent = sent_textures(appearance);
  Rows rows;
  Json groups = Json::array();
  for (std::size_t m = 0; m < faces.size(); ++m) {
    if (faces[m].empty()) {
      continue;
    }
    const Material* material = m < appearance.materials.size() ? &appearance.materials[m] : nullptr;
    Json group = material != nullptr ? material_json(*material, sent) : Json::object();
    group["start"] = rows.indices.size();
    add_faces(model, faces[m], material, rows);
    group["count"] = rows.indices.size() - group["start"].get<std::size_t>();
    groups.push_back(std::move(group));
  }
  Json part = {{"positions", packed_positions(model.mesh.positions, rows.positions, frame)},
               {"indices", base64_of(rows.indices)},
               {"groups", std::move(groups)},
               {"textures", Json::array()}};
  for (const auto& [texture, is_opaque] : sent) {
    part["textures"].push_back(texture_json(appearance.textures[texture], is_opaque, run));
  }
  if (!appearance.textures.empty()) {
    part["uvs"] = base64_of(rows.uvs);
  }
  if (!model.vertex_colours.empty()) {
    std::vector<Rgb8> colours;
    for (const std::uint32_t v : rows.positions) {
      colours.push_back(model.vertex_colours[v]);
    }
    part["colours"] = base64_of(colours);
  }
  return part;
}

}  // namespace vantage
