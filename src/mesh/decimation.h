// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "vantage/core/run_context.h"
#include "vantage/mesh/tri_mesh.h"

/// \file
/// A coarser surface of the same topology by edge collapse under quadric errors: Garland, Heckbert,
/// "Surface Simplification Using Quadric Error Metrics", SIGGRAPH 1997, doi:10.1145/258734.258849.

namespace vantage {

/// A coarser surface and where each vertex of the fine one went.
struct Decimation {
  TriMesh mesh{};                          ///< Coarse; vertices by the lowest one merged in each.
  std::vector<std::uint32_t> of_vertex{};  ///< |V| coarse vertex that each fine vertex is part of.
};

/// Collapses edges, cheapest first, until at most `target` vertices are left or no edge may go.
/// An edge may go if its ends have no common neighbour but the apexes of its faces (so that genus,
/// borders and components stay) and no face turns over. Cost is the quadric error plus a share of
/// what keeps triangles even. Deterministic; of equal costs the place decides (mesh/place_order.h).
/// \param weights |V| factors > 0 of the cost, so that more is left where they are large; empty: 1.
/// \pre every vertex belongs to a face, no face names a vertex twice. \throw Cancelled
Decimation decimate(const TriMesh& fine, std::size_t target, const RunContext& run,
                    std::span<const double> weights = {});

/// A surface on the way to a coarser one.
struct TwoDecimations {
  Decimation between{};  ///< The first state between two passes of at most so many vertices.
  Decimation coarse{};   ///< At most `target` vertices, if edges may go.
};

/// decimate(), and what it was when at most `between` vertices were left, ≥ target.
TwoDecimations decimate_twice(const TriMesh& fine, std::size_t between, std::size_t target,
                              const RunContext& run, std::span<const double> weights = {});

/// Collapses edges shorter than `longest`, shortest first, under the same condition on neighbours;
/// faces may turn over. Merged vertices stand at their weighted mean.
/// \param weights |V| shares, > 0. Vertices without faces stay. \throw Cancelled
Decimation merge_short_edges(const TriMesh& fine, const std::vector<double>& weights,
                             double longest, const RunContext& run);

}  // namespace vantage
