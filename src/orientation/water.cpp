// SPDX-License-Identifier: MIT
#include "orientation/water.h"

#include <algorithm>
#include <functional>
#include <utility>
#include <vector>

namespace vantage {

// Flooding from the drains in order of height (Barnes, Lehman, Mulla 2014).
double rain_held(const HeightField& field, bool from_high) {
  if (!(field.extent > 0.0)) {
    return 0.0;
  }
  using Entry = std::pair<double, std::size_t>;  // water level, cell
  std::vector<Entry> open(field.low.size());     // a heap, the lowest first: each cell comes once
  auto end = open.begin();
  const auto push = [&](double level, std::size_t cell) {
    *end++ = {level, cell};
    std::push_heap(open.begin(), end, std::greater<>());
  };
  std::vector<std::uint8_t> is_done(field.low.size(), 0);
  const auto ground = [&](std::size_t cell) {
    return field.is_filled(cell) ? field.extent - field.depth(cell, from_high) : 0.0;
  };
  for (std::size_t cell = 0; cell < is_done.size(); ++cell) {
    const std::size_t row = cell / field.columns;
    const std::size_t column = cell % field.columns;
    const bool is_border =
        row == 0 || column == 0 || row + 1 == field.rows || column + 1 == field.columns;
    if (is_border || !field.is_filled(cell)) {
      is_done[cell] = 1;
      push(ground(cell), cell);
    }
  }
  double held = 0.0;
  double filled = 0.0;
  while (end != open.begin()) {
    std::pop_heap(open.begin(), end, std::greater<>());
    const double level = (--end)->first;
    const std::size_t cell = end->second;
    if (field.is_filled(cell)) {
      held += level - ground(cell);
      filled += 1.0;
    }
    const std::size_t row = cell / field.columns;
    const std::size_t column = cell % field.columns;
    const auto reach = [&](std::size_t next) {
      if (is_done[next] == 0) {
        is_done[next] = 1;
        push(std::max(level, ground(next)), next);
      }
    };
    // Not across corners: a rim one cell thick is tight.
    if (row > 0) {
      reach(cell - field.columns);
    }
    if (row + 1 < field.rows) {
      reach(cell + field.columns);
    }
    if (column > 0) {
      reach(cell - 1);
    }
    if (column + 1 < field.columns) {
      reach(cell + 1);
    }
  }
  return filled > 0.0 ? held / filled / field.extent : 0.0;
}

}  // namespace vantage
