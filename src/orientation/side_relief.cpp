// SPDX-License-Identifier: MIT
#include "orientation/side_relief.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <Eigen/Core>

#include "core/cross.h"
#include "orientation/planar_hull.h"
#include "orientation/water.h"

namespace vantage {
namespace {

using Vec2 = Eigen::Vector2d;

// What is this near to the side of the box touches it, over the longest side: soles and tyres are
// not planes. Of what is thinner than four times that, a quarter of it. [ours]
constexpr double kTouch = 0.012;
// Steps below this are flat, over the longest side. [ours]
constexpr double kFlatStep = 0.002;
// Steps and differences count up to this: a gap is a gap however deep. [ours]
constexpr double kLargestStep = 0.1;

double area_of(const std::vector<Vec2>& hull) {
  double twice = 0.0;
  for (std::size_t i = 1; i + 1 < hull.size(); ++i) {
    twice += twice_area(hull[0], hull[i], hull[i + 1]);
  }
  return 0.5 * twice;
}

/// Distance of the point from the hull's border, positive inside; -1 without a hull.
double depth_inside(const std::vector<Vec2>& hull, const Vec2& point) {
  double least = hull.size() >= 3 ? 1.0 : -1.0;
  for (std::size_t i = 0; i < hull.size() && hull.size() >= 3; ++i) {
    const Vec2& a = hull[i];
    const Vec2& b = hull[(i + 1) % hull.size()];
    least = std::min(least, twice_area(a, b, point) / (b - a).norm());
  }
  return least;
}

/// Share of all directions from a point at `height` above the polygon's plane that meet the polygon
/// (van Oosterom and Strackee 1983), none if the point is not above it.
double share_of_directions(const std::vector<Vec2>& hull, const Vec2& point, double height) {
  if (depth_inside(hull, point) < 0.0) {
    return 0.0;
  }
  double angle = 0.0;
  for (std::size_t i = 0; i < hull.size(); ++i) {
    const Vec2 a = hull[i] - point;
    const Vec2 b = hull[(i + 1) % hull.size()] - point;
    // The triangle of both corners and the foot of the perpendicular.
    const double one = std::sqrt(a.squaredNorm() + height * height);
    const double two = std::sqrt(b.squaredNorm() + height * height);
    const double triple = height * cross(a, b);
    const double others =
        one * two * height + (a.dot(b) + height * height) * height + height * height * (one + two);
    angle += triple == 0.0 && others == 0.0 ? 0.0 : 2.0 * std::atan2(triple, others);
  }
  constexpr double kWhole = 12.566370614359172;  // 4 pi
  return angle / kWhole;
}

/// Unmarks the patch that begins at a marked cell: those that it shares a side or a corner with, and so on.
/// \return the number of its cells.
std::size_t unmark_patch(std::vector<std::uint8_t>& marked, std::size_t columns, std::size_t rows,
                         std::size_t start) {
  std::vector<std::size_t> pending{start};
  marked[start] = 0;
  std::size_t size = 0;
  while (!pending.empty()) {
    const std::size_t row = pending.back() / columns;
    const std::size_t column = pending.back() % columns;
    pending.pop_back();
    ++size;
    for (std::size_t r = row > 0 ? row - 1 : 0; r < std::min(rows, row + 2); ++r) {
      for (std::size_t c = column > 0 ? column - 1 : 0; c < std::min(columns, column + 2); ++c) {
        if (marked[r * columns + c] != 0) {
          marked[r * columns + c] = 0;
          pending.push_back(r * columns + c);
        }
      }
    }
  }
  return size;
}

/// Sizes in cells of the patches of marked cells, which share no side or corner.
std::vector<std::size_t> patches(std::vector<std::uint8_t> marked, std::size_t columns,
                                 std::size_t rows) {
  std::vector<std::size_t> sizes;
  for (std::size_t start = 0; start < marked.size(); ++start) {
    if (marked[start] != 0) {
      sizes.push_back(unmark_patch(marked, columns, rows, start));
    }
  }
  return sizes;
}

/// Corners of the first and the last of some cells in each row, in units of the longest side: those of
/// cells between them lie inside their hull.
class RowEnds {
 public:
  RowEnds(const HeightField& field, const Vec2& cell_size)
      : columns_(field.columns), cell_size_(cell_size), ends_(field.rows, {field.columns, 0}) {}

  void add(std::size_t cell) {
    auto& [first, end] = ends_[cell / columns_];
    first = std::min(first, cell % columns_);
    end = std::max(end, cell % columns_ + 1);
  }

  [[nodiscard]] std::vector<Vec2> hull() const {
    std::vector<Vec2> points;
    for (std::size_t row = 0; row < ends_.size(); ++row) {
      const auto& [first, end] = ends_[row];
      for (const std::size_t column : {first, end}) {
        for (std::size_t side = 0; side < 2 && first < end; ++side) {
          points.emplace_back(static_cast<double>(column) * cell_size_.x(),
                              static_cast<double>(row + side) * cell_size_.y());
        }
      }
    }
    return planar_hull(std::move(points));
  }

 private:
  std::size_t columns_;
  Vec2 cell_size_;
  std::vector<std::pair<std::size_t, std::size_t>>
      ends_;  // first, and one after the last, of a row
};

/// Depths in the middle of the box, and along its border.
struct Zones {
  std::array<double, 2> sum{};
  std::array<double, 2> count{};

  [[nodiscard]] double mean(std::size_t zone, double extent) const {
    return count[zone] > 0.0 && extent > 0.0 ? sum[zone] / count[zone] / extent : 1.0;
  }
};

void add_to_zones(const HeightField& field, std::size_t cell, double depth, Zones& zones) {
  const double u =
      (static_cast<double>(cell % field.columns) + 0.5) / static_cast<double>(field.columns);
  const std::size_t row = cell / field.columns;
  const double v = (static_cast<double>(row) + 0.5) / static_cast<double>(field.rows);
  const double off = std::max(std::abs(u - 0.5), std::abs(v - 0.5));
  if (off < 1.0 / 6.0 || off > 1.0 / 3.0) {
    const std::size_t zone = off < 1.0 / 6.0 ? 0 : 1;
    zones.sum[zone] += depth;
    zones.count[zone] += 1.0;
  }
}

/// Adds up the steps between neighbouring filled cells.
void look_at_steps(const HeightField& field, bool from_high, SideRelief& look) {
  double steps = 0.0;
  double sum = 0.0;
  double flat = 0.0;
  const auto step = [&](std::size_t a, std::size_t b) {
    if (field.is_filled(a) && field.is_filled(b)) {
      const double size = std::abs(field.depth(a, from_high) - field.depth(b, from_high));
      steps += 1.0;
      sum += std::min(size, kLargestStep);
      flat += size < kFlatStep ? 1.0 : 0.0;
    }
  };
  for (std::size_t row = 0; row < field.rows; ++row) {
    for (std::size_t column = 0; column < field.columns; ++column) {
      const std::size_t cell = row * field.columns + column;
      if (column + 1 < field.columns) {
        step(cell, cell + 1);
      }
      if (row + 1 < field.rows) {
        step(cell, cell + field.columns);
      }
    }
  }
  look.detail = steps > 0.0 ? sum / steps : 0.0;
  look.flat = steps > 0.0 ? flat / steps : 0.0;
}

/// Differences of two values of cells: as they are, or from nothing.
class Differences {
 public:
  void add(double a, double b, bool a_filled, bool b_filled) {
    if (a_filled || b_filled) {
      count_ += 1.0;
      sum_ += a_filled && b_filled ? std::min(std::abs(a - b), kLargestStep) : kLargestStep;
    }
  }

  [[nodiscard]] double mean() const { return count_ > 0.0 ? sum_ / count_ / kLargestStep : 0.0; }

 private:
  double count_ = 0.0;
  double sum_ = 0.0;
};

/// Compares a field with the one made of it by sending each cell to another.
template <class Map>
void compare(const HeightField& field, bool is_reversed, Map&& image_of, Differences& found) {
  for (std::size_t row = 0; row < field.rows; ++row) {
    for (std::size_t column = 0; column < field.columns; ++column) {
      const std::size_t a = row * field.columns + column;
      const std::size_t b = image_of(row, column);
      const bool there = field.is_filled(b);
      found.add(field.depth(a, true), field.depth(b, !is_reversed), field.is_filled(a), there);
      found.add(field.depth(a, false), field.depth(b, is_reversed), field.is_filled(a), there);
    }
  }
}

}  // namespace

SideRelief side_relief(const HeightFields& fields, std::size_t axis, bool from_high) {
  const HeightField& field = fields.along[axis];
  const Vec2 cell_size(fields.extent[field.u_axis] / static_cast<double>(field.columns),
                       fields.extent[field.v_axis] / static_cast<double>(field.rows));
  const double reach = std::min(kTouch, 0.25 * field.extent);
  SideRelief look;
  std::vector<std::uint8_t> touching(field.low.size(), 0);
  RowEnds outline(field, cell_size);
  RowEnds base(field, cell_size);
  double filled = 0.0;
  double touched = 0.0;
  Zones zones;
  for (std::size_t cell = 0; cell < touching.size(); ++cell) {
    if (!field.is_filled(cell)) {
      continue;
    }
    filled += 1.0;
    const double depth = field.depth(cell, from_high);
    look.depth += depth;
    add_to_zones(field, cell, depth, zones);
    look.back += (from_high ? field.high_is_back : field.low_is_back)[cell] != 0 ? 1.0 : 0.0;
    outline.add(cell);
    if (depth <= reach) {
      touching[cell] = 1;
      touched += 1.0;
      base.add(cell);
    }
  }
  if (!(filled > 0.0)) {
    return look;
  }
  look.touch = touched / filled;
  look.centre_depth = zones.mean(0, field.extent);
  look.rim_depth = zones.mean(1, field.extent);
  look.depth /= filled;
  look.back /= filled;
  look.relative_depth = field.extent > 0.0 ? look.depth / field.extent : 0.0;
  const std::vector<Vec2> hull = base.hull();
  const double whole = area_of(outline.hull());
  look.touch_hull = whole > 0.0 ? area_of(hull) / whole : 0.0;
  const Vec2 centre(fields.area_mean[field.u_axis] * fields.extent[field.u_axis],
                    fields.area_mean[field.v_axis] * fields.extent[field.v_axis]);
  look.margin =
      whole > 0.0 ? std::clamp(depth_inside(hull, centre) / std::sqrt(whole), -0.5, 0.5) : 0.0;
  const std::vector<std::size_t> sizes = patches(std::move(touching), field.columns, field.rows);
  look.contacts = std::log2(1.0 + static_cast<double>(sizes.size()));
  look.patch = static_cast<double>(*std::max_element(sizes.begin(), sizes.end())) / touched;
  const double height = fields.area_mean[axis] * field.extent;
  look.rest = share_of_directions(hull, centre, from_high ? field.extent - height : height);
  look.water = rain_held(field, from_high);
  look_at_steps(field, from_high, look);
  return look;
}

double mirror_error(const HeightFields& fields, std::size_t axis) {
  Differences found;
  for (const HeightField& field : fields.along) {
    compare(
        field, field.axis == axis,
        [&](std::size_t row, std::size_t column) {
          const std::size_t r = field.v_axis == axis ? field.rows - 1 - row : row;
          const std::size_t c = field.u_axis == axis ? field.columns - 1 - column : column;
          return r * field.columns + c;
        },
        found);
  }
  return found.mean();
}

double half_turn_error(const HeightFields& fields, std::size_t axis) {
  Differences found;
  for (const HeightField& field : fields.along) {
    compare(
        field, field.axis != axis,
        [&](std::size_t row, std::size_t column) {
          const std::size_t r = field.v_axis != axis ? field.rows - 1 - row : row;
          const std::size_t c = field.u_axis != axis ? field.columns - 1 - column : column;
          return r * field.columns + c;
        },
        found);
  }
  return found.mean();
}

double quarter_turn_error(const HeightFields& fields, std::size_t axis) {
  const HeightField& field = fields.along[axis];
  if (field.columns != field.rows) {
    return 1.0;
  }
  Differences found;
  compare(
      field, false,
      [&](std::size_t row, std::size_t column) {
        return column * field.columns + (field.rows - 1 - row);
      },
      found);
  return found.mean();
}

}  // namespace vantage
