// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "vantage/mesh/tri_mesh.h"

namespace vantage {

// cos of 10 degrees: a normal is along an axis.
inline constexpr double kParallel = 0.985;
// Of a side of the box, what its end is.
inline constexpr double kEnd = 0.1;

/// The lowest and the highest surface over each cell of a grid, along one axis of the box. Lengths
/// are over the box's longest side.
struct HeightField {
  std::size_t axis = 2;       ///< That heights are measured along.
  std::size_t u_axis = 0;     ///< Of the columns, (axis + 1) % 3.
  std::size_t v_axis = 1;     ///< Of the rows, (axis + 2) % 3.
  std::size_t columns = 1;    ///< Cells along u_axis.
  std::size_t rows = 1;       ///< Cells along v_axis.
  double extent = 0.0;        ///< Of the box along `axis`.
  std::vector<float> low{};   ///< rows × columns, from the box's lower side; kNothing: empty.
  std::vector<float> high{};  ///< The same of the highest.
  std::vector<std::uint8_t> low_is_back{};  ///< Whether the lowest surface turns its back there …
  std::vector<std::uint8_t> high_is_back{};  ///< … and the highest, seen from the box's sides.

  static constexpr float kNothing = -1.0F;

  [[nodiscard]] bool is_filled(std::size_t cell) const { return low[cell] >= 0.0F; }

  /// Depth of the first surface seen from the side of larger (or smaller) coordinates.
  [[nodiscard]] double depth(std::size_t cell, bool from_high) const {
    return from_high ? extent - static_cast<double>(high[cell]) : static_cast<double>(low[cell]);
  }
};

/// Height fields along the three axes of a surface's box, and its sides over the longest. They do
/// not depend on the order of faces or vertices, nor on the model's unit and place.
struct HeightFields {
  explicit HeightFields(const TriMesh& surface);

  std::array<HeightField, 3> along{};
  std::array<double, 3> extent{};       ///< Sides of the box over the longest, in [0, 1].
  std::array<double, 3> vertex_mean{};  ///< Mean of the referenced vertices, share of the side.
  std::array<double, 3> vertex_low{};  ///< Share of the vertices in the lowest tenth of the side …
  std::array<double, 3> vertex_high{};  ///< … and in the highest.
  std::array<double, 3> area_mean{};    ///< Centroid of the surface, share of the side.
  std::array<double, 3> parallel{};     ///< Share of the area whose normal is along the axis.
  std::array<double, 3> origin{};  ///< The coordinates' origin from the low side, over that side.
  std::array<double, 3> net{};     ///< Sum of area vectors over the area: what is left open.
  std::array<double, 3> perpendicular{};  ///< Share of the area whose normal is at right angles.
};

}  // namespace vantage
