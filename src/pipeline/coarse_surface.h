// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "vantage/core/run_context.h"
#include "vantage/mesh/tri_mesh.h"
#include "vantage/visibility/vertex_visibility.h"

namespace vantage {

/// A decimated copy of a surface.
struct CoarseSurface {
  static constexpr std::uint32_t kNone = ~std::uint32_t{0};

  TriMesh mesh{};
  std::vector<FaceSides> sides{};          ///< One per component of `mesh`.
  std::vector<std::uint32_t> of_vertex{};  ///< For each vertex of the fine surface its one in
                                           ///< `mesh`, or kNone where no face names it.

  /// Sums of a quantity over the vertices that each coarse one stands for.
  [[nodiscard]] std::vector<double> sums(std::span<const double> of_fine_vertex) const;
};

/// Decimates to at most `vertices` if the surface has more and its edges allow it.
/// \param sides one per component of `fine`. \throw Cancelled
CoarseSurface coarse_surface(const TriMesh& fine, const std::vector<FaceSides>& sides,
                             std::size_t vertices, const RunContext& run = {});

}  // namespace vantage
