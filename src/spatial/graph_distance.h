// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "vantage/core/vec3.h"
#include "vantage/mesh/curve_graph.h"

namespace vantage {

/// Exact distance in double precision from points to a curve graph: its edges, and its nodes where
/// they have none. Immutable; queries are safe from many threads.
class GraphDistance {
 public:
  /// \pre the graph has at least one node.
  explicit GraphDistance(const CurveGraph& graph);

  /// Distance from `point` to the nearest point of the graph.
  [[nodiscard]] double operator()(const Vec3& point) const;

 private:
  /// A box of the tree: inner nodes have two children, leaves a run of pieces.
  struct Box {
    Vec3 low;
    Vec3 high;
    std::uint32_t first;  ///< Leaf: first piece. Inner: index of the left child; right follows it.
    std::uint32_t count;  ///< Leaf: pieces. Inner: 0.
  };

  /// A segment, or a part of a long one: long segments have large boxes, that leave nothing out.
  struct Piece {
    std::array<Vec3, 2> part;
    std::array<Vec3, 2> segment;  ///< Whole, to which distances are measured.
  };

  void cut_long_segments();
  void build(std::uint32_t box, std::uint32_t begin, std::uint32_t end);
  [[nodiscard]] double leaf_distance_squared(const Box& box, const Vec3& point) const;

  std::vector<Piece> pieces_{};
  std::vector<Box> boxes_{};
};

}  // namespace vantage
