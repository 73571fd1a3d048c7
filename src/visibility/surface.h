// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "vantage/mesh/tri_mesh.h"
#include "vantage/visibility/vertex_visibility.h"

#include "spatial/ray_scene.h"

/// \file
/// A mesh made ready for visibility queries: in a UnitFrame, one vertex per position, without
/// faces of zero area, everything in an order in which neighbours in space are close in memory.

namespace vantage {

/// A vertex here is a *site*: a position that at least one face of positive area uses.
struct Surface {
  static constexpr std::uint32_t kNoSite = ~std::uint32_t{0};

  UnitFrame frame{};
  std::vector<Vec3> sites{};                    ///< In the frame, along a Morton curve.
  std::vector<std::uint32_t> site_of_vertex{};  ///< Of each vertex of the mesh, or kNoSite.
  std::vector<Triangle> faces{};                ///< Of sites, along a Morton curve.
  std::vector<Vec3> area_vectors{};             ///< Of each face, in the frame.
  std::vector<double> twice_areas{};            ///< Their lengths; > 0.
  std::vector<FaceSides> sides{};               ///< Of each face.
};

/// \param sides one per component of connected_components(mesh), or a single one for all.
/// \throw InvalidInput if there are neither.
Surface prepare_surface(const TriMesh& mesh, std::span<const FaceSides> sides);

/// The indices 0 … |points|−1 in the order of a Morton curve through their bounding box.
std::vector<std::uint32_t> morton_order(std::span<const Vec3> points);

}  // namespace vantage
