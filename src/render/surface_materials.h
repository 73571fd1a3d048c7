// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "vantage/core/vec3.h"
#include "vantage/mesh/appearance.h"
#include "vantage/mesh/tri_mesh.h"

#include "render/texture_pyramid.h"
#include "spatial/ray_scene.h"

namespace vantage {

/// What the materials of a mesh show at places of its surface.
class SurfaceMaterials {
 public:
  /// What is seen at a place.
  struct Shown {
    Vec3 colour = Vec3::Ones();    ///< Linear, to be multiplied by the vertices' colour.
    Vec3 emission = Vec3::Zero();  ///< Linear, to be added to what it reflects.
    double opacity = 1.0;          ///< In [0, 1]; exactly 0 in a hole; the solid share of several.
    bool unlit = false;            ///< No light falls on it.
    bool has_material = false;     ///< Else white.
  };

  /// All must outlive this. \throw InvalidInput if `appearance` does not fit the mesh.
  SurfaceMaterials(const Appearance& appearance, const TriMesh& mesh);

  /// \param spacing distance of samples on the surface, in the mesh's units.
  [[nodiscard]] Shown at(std::uint32_t face, float u, float v, double spacing) const;

  /// Whether any place may be seen through.
  [[nodiscard]] bool has_openings() const { return has_openings_; }

 private:
  /// A texture as some materials show it: those that share it may mean its opacity or not.
  struct Shared {
    std::uint32_t texture;
    std::optional<float> cutoff;
    TexturePyramid pyramid;
  };

  /// Places in `shared_` of a material's textures, if it has them.
  struct Places {
    std::size_t colour = 0;
    std::size_t emission = 0;
  };

  /// Place of a texture's pyramid, which is made if it is new.
  std::size_t share(std::uint32_t texture, std::optional<float> cutoff);
  /// Of a texture of the face's material.
  [[nodiscard]] Texel texel(const TexturePyramid& pyramid, const Material& material,
                            std::uint32_t face, float u, float v, double spacing) const;

  const Appearance* appearance_;
  const TriMesh* mesh_;
  bool has_openings_ = false;
  std::vector<Shared> shared_{};
  std::vector<Places> places_{};  ///< Of each material.
};

}  // namespace vantage
