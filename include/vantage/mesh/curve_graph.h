// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "vantage/core/vec3.h"

namespace vantage {

/// A graph of straight segments embedded in space.
struct CurveGraph {
  std::vector<Vec3> nodes{};  ///< |N| points, in model units.
  std::vector<std::array<std::uint32_t, 2>>
      edges{};  ///< |E| pairs a < b, lexicographically sorted.
};

/// Number of connected components; isolated nodes count.
std::size_t component_count(const CurveGraph& graph);

/// Number of independent cycles, |E| − |N| + components.
std::size_t cycle_count(const CurveGraph& graph);

/// Sum of the lengths of all edges.
double total_length(const CurveGraph& graph);

}  // namespace vantage
