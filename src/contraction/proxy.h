// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "vantage/contraction/contraction.h"
#include "vantage/core/run_context.h"
#include "vantage/mesh/tri_mesh.h"

#include "contraction/component_contraction.h"

namespace vantage {

/// A point of a coarse surface.
struct CoarsePlace {
  std::uint32_t face = 0;
  std::array<double, 3> weight{};  ///< Barycentric; ≥ 0, sum 1.
};

/// A coarse surface that is contracted in place of a fine one.
struct Proxy {
  TriMesh mesh{};
  std::vector<std::uint32_t> of_vertex{};  ///< |V| coarse vertex that each fine one was merged in.
  std::vector<CoarsePlace> place{};        ///< |V| nearest place around that vertex.
  EvenShares shares{};
  MergedSurface merged{};  ///< Between `fine` and `mesh`.
};

/// Decimates `fine` to about `target` vertices; `merged` has about `between`, or more where
/// nothing can be collapsed any more. \pre as decimate(). \throw Cancelled
Proxy make_proxy(const TriMesh& fine, std::size_t between, std::size_t target,
                 const RunContext& run);

/// Position of a place when the coarse vertices stand at `positions`.
Vec3 position_of(const CoarsePlace& place, const TriMesh& coarse,
                 const std::vector<Vec3>& positions);

/// Where the vertices of the fine surface are when the coarse ones stand at `positions`.
std::vector<Vec3> carried(const Proxy& proxy, const std::vector<Vec3>& positions,
                          const RunContext& run);

}  // namespace vantage
