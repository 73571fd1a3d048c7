// SPDX-License-Identifier: MIT
#include "render/surface_materials.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "vantage/core/error.h"
#include "vantage/mesh/measures.h"

#include "mesh/texture_place.h"

namespace vantage {
namespace {

using Uv = std::array<double, 2>;

void check_fit(const Appearance& appearance, const TriMesh& mesh) {
  const std::size_t faces = mesh.triangles.size();
  const bool sizes =
      appearance.material_of_triangle.size() == faces &&
      (appearance.uv_of_triangle.empty() || appearance.uv_of_triangle.size() == faces);
  const auto is_material = [&](std::uint32_t m) {
    return m == Appearance::kNone || m < appearance.materials.size();
  };
  const auto are_uvs = [&](const Triangle& uvs) {
    return std::all_of(uvs.begin(), uvs.end(), [&](std::uint32_t uv) {
      return uv == Appearance::kNone || uv < appearance.uvs.size();
    });
  };
  const auto is_texture = [&](const std::optional<std::uint32_t>& texture) {
    return !texture || *texture < appearance.textures.size();
  };
  const auto has_textures = [&](const Material& material) {
    return is_texture(material.texture) && is_texture(material.emission_texture);
  };
  const auto has_pixels = [](const Texture& texture) {
    return texture.image.width > 0 && texture.image.height > 0 &&
           texture.image.rgba.size() == std::size_t{4} *
                                            static_cast<std::size_t>(texture.image.width) *
                                            static_cast<std::size_t>(texture.image.height);
  };
  const auto all = [](const auto& items, const auto& test) {
    return std::all_of(items.begin(), items.end(), test);
  };
  if (!sizes || !all(appearance.material_of_triangle, is_material) ||
      !all(appearance.uv_of_triangle, are_uvs) || !all(appearance.materials, has_textures) ||
      !all(appearance.textures, has_pixels)) {
    throw InvalidInput("the materials belong to another mesh: their indices do not fit");
  }
}

/// The opacity of its texture from which on a material is solid: 0 if it is everywhere, none if its
/// opacity is not cut.
std::optional<float> texture_cutoff(const Material& material) {
  if (material.alpha == AlphaMode::Blend) {
    return std::nullopt;
  }
  if (material.alpha == AlphaMode::Opaque || material.alpha_cutoff <= 0.0) {
    return 0.0F;
  }
  return static_cast<float>(material.alpha_cutoff / material.opacity);
}

/// So nearly solid or empty counts as it: more than what sums of texels are rounded by.
constexpr double kNearly = 1e-5;

}  // namespace

SurfaceMaterials::SurfaceMaterials(const Appearance& appearance, const TriMesh& mesh)
    : appearance_(&appearance), mesh_(&mesh) {
  check_fit(appearance, mesh);
  for (const Material& material : appearance.materials) {
    Places places;
    if (material.texture) {
      places.colour = share(*material.texture, texture_cutoff(material));
    }
    if (material.emission_texture) {
      places.emission = share(*material.emission_texture, 0.0F);
    }
    places_.push_back(places);
  }
  has_openings_ =
      std::any_of(appearance.materials.begin(), appearance.materials.end(),
                  [](const Material& material) { return material.alpha != AlphaMode::Opaque; });
}

std::size_t SurfaceMaterials::share(std::uint32_t texture, std::optional<float> cutoff) {
  const auto same = std::find_if(shared_.begin(), shared_.end(), [&](const Shared& shared) {
    return shared.texture == texture && shared.cutoff == cutoff;
  });
  const auto place = static_cast<std::size_t>(same - shared_.begin());
  if (same == shared_.end()) {
    shared_.push_back({texture, cutoff, TexturePyramid(appearance_->textures[texture], cutoff)});
  }
  return place;
}

Texel SurfaceMaterials::texel(const TexturePyramid& pyramid, const Material& material,
                              std::uint32_t face, float u, float v, double spacing) const {
  // Faces without coordinates show the mean of the picture: wood is still brown.
  constexpr float kCoarsest = 100.0F;
  if (appearance_->uv_of_triangle.empty()) {
    return pyramid.at(0.5F, 0.5F, kCoarsest);
  }
  const Triangle& corners = appearance_->uv_of_triangle[face];
  std::array<Uv, 3> uvs{};
  for (std::size_t c = 0; c < 3; ++c) {
    if (corners[c] == Appearance::kNone) {
      return pyramid.at(0.5F, 0.5F, kCoarsest);
    }
    uvs[c] = texture_place(material, appearance_->uvs[corners[c]]);
  }
  // Texels across a sample: the root of the texels that lie on the face's area.
  const double texels = std::abs((uvs[1][0] - uvs[0][0]) * (uvs[2][1] - uvs[0][1]) -
                                 (uvs[2][0] - uvs[0][0]) * (uvs[1][1] - uvs[0][1])) *
                        pyramid.width() * pyramid.height();
  const double area = area_vector(*mesh_, mesh_->triangles[face]).norm();
  const double covered = area > 0.0 ? spacing * std::sqrt(texels / area) : 0.0;
  const double w = 1.0 - static_cast<double>(u) - static_cast<double>(v);
  const auto mix = [&](std::size_t axis) {
    const double sum = w * uvs[0][axis] + static_cast<double>(u) * uvs[1][axis] +
                       static_cast<double>(v) * uvs[2][axis];
    return static_cast<float>(sum);
  };
  constexpr double kLeastCovered = 1e-6;
  return pyramid.at(mix(0), mix(1),
                    static_cast<float>(std::log2(std::max(covered, kLeastCovered))));
}

SurfaceMaterials::Shown SurfaceMaterials::at(std::uint32_t face, float u, float v,
                                             double spacing) const {
  Shown shown;
  const std::uint32_t index = appearance_->material_of_triangle[face];
  if (index == Appearance::kNone) {
    return shown;
  }
  const Material& material = appearance_->materials[index];
  shown.has_material = true;
  shown.unlit = material.unlit;
  shown.colour = {material.colour[0], material.colour[1], material.colour[2]};
  std::optional<double> of_texture;
  if (material.texture) {
    const TexturePyramid& pyramid = shared_[places_[index].colour].pyramid;
    const Texel texel = this->texel(pyramid, material, face, u, v, spacing);
    shown.colour = shown.colour.cwiseProduct(texel.colour.cast<double>());
    of_texture = static_cast<double>(texel.opacity);
  }
  shown.emission = {material.emission[0], material.emission[1], material.emission[2]};
  if (material.emission_texture) {
    const TexturePyramid& pyramid = shared_[places_[index].emission].pyramid;
    shown.emission = shown.emission.cwiseProduct(
        texel(pyramid, material, face, u, v, spacing).colour.cast<double>());
  }
  if (material.alpha == AlphaMode::Mask) {
    const double solid = of_texture.value_or(material.opacity >= material.alpha_cutoff ? 1.0 : 0.0);
    shown.opacity = solid < kNearly ? 0.0 : solid > 1.0 - kNearly ? 1.0 : solid;
  } else if (material.alpha == AlphaMode::Blend) {
    shown.opacity = material.opacity * of_texture.value_or(1.0);
  }
  return shown;
}

}  // namespace vantage
