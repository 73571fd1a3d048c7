// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "vantage/mesh/curve_graph.h"

#include "mesh/place_order.h"
#include "spatial/shell.h"

namespace vantage {

/// Moves nodes of a graph to middles of walls. About the axis of a bored part the walls all around are
/// equally near: of these a node takes one near to its neighbours, so that the curve follows one side.
class WallMiddles {
 public:
  WallMiddles(CurveGraph graph, const Shell& shell);

  /// Has a node moved to one of the middles at these vertices. \return false if there is none.
  bool add(std::uint32_t node, const std::vector<std::uint32_t>& vertices);

  /// From the nodes that stay outwards, edge by edge; then each again, beside all its neighbours.
  CurveGraph move();

 private:
  [[nodiscard]] bool has_settled_neighbour(std::uint32_t node) const;
  [[nodiscard]] double way_to(const Vec3& middle, std::uint32_t node) const;
  [[nodiscard]] const Vec3& best_middle(std::uint32_t node) const;
  [[nodiscard]] std::vector<std::uint32_t> nearest_first() const;
  std::vector<std::uint32_t> take_next(std::vector<std::uint32_t>& waiting) const;
  void settle(const std::vector<std::uint32_t>& nodes);

  CurveGraph graph_;
  const Shell& shell_;
  std::vector<Vec3> place_;  ///< Where each node should be.
  PlaceOrder order_;
  IndexLists neighbours_;
  std::vector<std::vector<Vec3>> middles_;  ///< That each node may go to; none: it stays.
  std::vector<bool> settled_;
};

}  // namespace vantage
