// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstdint>

#include "vantage/mesh/tri_mesh.h"

/// \file
/// Small questions about one triangle.

namespace vantage {

/// Whether two of the corners are the same vertex.
inline bool names_a_vertex_twice(const Triangle& t) {
  return t[0] == t[1] || t[1] == t[2] || t[2] == t[0];
}

/// Which corner, 0 to 2, vertex v is. \pre v is one of them.
inline std::uint32_t corner_at(const Triangle& t, std::uint32_t v) {
  return t[0] == v ? 0 : (t[1] == v ? 1 : 2);
}

/// Whether it runs through its side {a, b} from a to b. \pre a is one of its corners.
inline bool runs_from(const Triangle& t, std::uint32_t a, std::uint32_t b) {
  return t[(corner_at(t, a) + 1) % 3] == b;
}

/// Length of its longest edge.
inline double longest_edge(const TriMesh& mesh, const Triangle& t) {
  const auto& x = mesh.positions;
  return std::max(
      {(x[t[0]] - x[t[1]]).norm(), (x[t[1]] - x[t[2]]).norm(), (x[t[2]] - x[t[0]]).norm()});
}

}  // namespace vantage
