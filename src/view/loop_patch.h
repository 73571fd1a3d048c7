// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "vantage/spatial/directions.h"

/// \file
/// The part of an ever finer triangulation of the view sphere that a search around one vertex
/// needs.

namespace vantage {

/// The triangles within two rings of a centre vertex. A subdivision of the whole triangulation
/// (four triangles for one, new vertices by Loop's edge rule, old ones kept) followed by a move of
/// the centre to a vertex of its new ring needs nothing outside them: a new vertex beside the new
/// centre's ring lies on an edge that touches the old centre or its ring, and both triangles at
/// such an edge touch it too.
class LoopPatch {
 public:
  /// The two rings around `centre` in a closed triangulation.
  LoopPatch(const DirectionSet& set, std::uint32_t centre);

  /// Subdivides once. Afterwards ring() is the new one-ring of the centre.
  void refine();

  /// Makes a vertex of the ring, by position in ring(), the centre.
  void move_to(std::size_t ring_index);

  /// Directions around the centre, in a fixed order.
  [[nodiscard]] std::vector<Vec3> ring() const;

 private:
  [[nodiscard]] std::vector<std::uint32_t> ring_indices() const;
  void trim();

  std::vector<Vec3> directions_{};
  std::vector<Triangle> triangles_{};
  std::uint32_t centre_ = 0;
};

}  // namespace vantage
