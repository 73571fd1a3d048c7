// SPDX-License-Identifier: MIT
#include "mesh/polygon.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

#include <Eigen/Geometry>

namespace vantage {
namespace {

using Vec2 = Eigen::Vector2d;

/// Sine of the turn at a corner below which its sides count as one straight line: coordinates of
/// seven digits carry about this much noise times their size over the length of a side.
constexpr double kStraightSine = 1e-9;

/// Twice the area vector of the polygon (Newell), whatever its shape.
Vec3 newell_normal(std::span<const std::uint32_t> corners, std::span<const Vec3> positions) {
  const Vec3& origin = positions[corners[0]];
  Vec3 normal = Vec3::Zero();
  Vec3 from = Vec3::Zero();
  for (std::size_t i = 1; i < corners.size(); ++i) {
    const Vec3 to = positions[corners[i]] - origin;
    normal += from.cross(to);
    from = to;
  }
  return normal;
}

void fan(std::span<const std::uint32_t> corners, std::vector<Triangle>& triangles) {
  for (std::size_t i = 2; i < corners.size(); ++i) {
    triangles.push_back({corners[0], corners[i - 1], corners[i]});
  }
}

/// A convex polygon, cut into halves over and over, so that few triangles meet in a corner and few are thin.
void halve(std::span<const std::uint32_t> corners, std::vector<Triangle>& triangles) {
  if (corners.size() < 3) {
    return;
  }
  const std::size_t middle = corners.size() / 2;
  triangles.push_back({corners.front(), corners[middle], corners.back()});
  halve(corners.first(middle + 1), triangles);
  halve(corners.subspan(middle), triangles);
}

/// Four corners: cut from 0 to 2, unless corner 1 or 3 is straight or points inwards.
void cut_quad(std::span<const std::uint32_t> corners, std::span<const Vec3> positions,
              std::vector<Triangle>& triangles) {
  const Vec3 normal = newell_normal(corners, positions).normalized();
  const auto points_outwards = [&](std::size_t i) {
    const Vec3 in = positions[corners[i]] - positions[corners[i - 1]];
    const Vec3 out = positions[corners[(i + 1) % 4]] - positions[corners[i]];
    return in.cross(out).dot(normal) > kStraightSine * in.norm() * out.norm();
  };
  if (points_outwards(1) && points_outwards(3)) {
    fan(corners, triangles);
  } else {
    triangles.push_back({corners[0], corners[1], corners[3]});
    triangles.push_back({corners[1], corners[2], corners[3]});
  }
}

double cross(const Vec2& a, const Vec2& b, const Vec2& c) {
  return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
}

/// Corners that may lie inside an ear, sorted into the cells of a grid, about one in each.
class CornerGrid {
 public:
  CornerGrid(const std::vector<Vec2>& points, const std::vector<std::uint32_t>& members)
      : members_(members.size()) {
    Vec2 high = Vec2::Zero();
    if (!members.empty()) {
      low_ = high = points[members.front()];
    }
    for (const std::uint32_t i : members) {
      low_ = low_.cwiseMin(points[i]);
      high = high.cwiseMax(points[i]);
    }
    const Vec2 size = high - low_;
    along_ = size.y() > size.x() ? 1 : 0;  // few rows: a triangle may cross them all
    choose_cells(size[along_], size[1 - along_], static_cast<double>(members.size()));
    offsets_.assign(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_) + 1, 0);
    for (const std::uint32_t i : members) {
      ++offsets_[cell_of(points[i]) + 1];
    }
    for (std::size_t c = 1; c < offsets_.size(); ++c) {
      offsets_[c] += offsets_[c - 1];
    }
    std::vector<std::uint32_t> cursor(offsets_.begin(), offsets_.end() - 1);
    for (const std::uint32_t i : members) {
      members_[cursor[cell_of(points[i])]++] = i;
    }
  }

  /// Whether `test` holds for a member in a cell that the triangle touches; `work` grows by the
  /// cells and members looked at.
  template <class Test>
  bool any_near(const std::array<Vec2, 3>& triangle, std::size_t& work, const Test& test) const {
    const auto [lowest, highest] =
        std::minmax({y_of(triangle[0]), y_of(triangle[1]), y_of(triangle[2])});
    const int last_row = row_of(highest);
    for (int row = row_of(lowest); row <= last_row; ++row) {
      ++work;
      const auto [first, last] = columns_in_row(triangle, row);
      if (first > last) {
        continue;  // the triangle lies beside the grid
      }
      const std::size_t start = static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_);
      const std::uint32_t begin = offsets_[start + static_cast<std::size_t>(first)];
      const std::uint32_t end = offsets_[start + static_cast<std::size_t>(last) + 1];
      work += end - begin;
      if (std::any_of(members_.begin() + begin, members_.begin() + end, test)) {
        return true;
      }
    }
    return false;
  }

 private:
  /// Square cells, as many as there are members; a single row or column if they lie on a line.
  void choose_cells(double length, double width, double count) {
    constexpr double kMostCellsAlong = 1 << 22;
    double columns = std::clamp(count, 1.0, kMostCellsAlong);
    double rows = 1.0;
    if (width > 0.0) {
      columns = std::clamp(std::sqrt(count * (length / width)), 1.0, columns);
      rows = std::clamp(count / columns, 1.0, kMostCellsAlong);
    }
    columns_ = static_cast<int>(columns);
    rows_ = static_cast<int>(rows);
    columns_per_unit_ = length > 0.0 ? columns_ / length : 0.0;
    rows_per_unit_ = width > 0.0 ? rows_ / width : columns_per_unit_;
    columns_per_unit_ = length > 0.0 ? columns_per_unit_ : rows_per_unit_;
  }

  static int clamped(double cell, int count) {
    return cell > 0.0 ? static_cast<int>(std::min(cell, count - 1.0)) : 0;
  }

  [[nodiscard]] double x_of(const Vec2& point) const { return point[along_] - low_[along_]; }

  [[nodiscard]] double y_of(const Vec2& point) const {
    return point[1 - along_] - low_[1 - along_];
  }

  [[nodiscard]] int row_of(double y) const { return clamped(y * rows_per_unit_, rows_); }

  [[nodiscard]] std::size_t cell_of(const Vec2& point) const {
    const int column = clamped(x_of(point) * columns_per_unit_, columns_);
    return static_cast<std::size_t>(row_of(y_of(point))) * static_cast<std::size_t>(columns_) +
           static_cast<std::size_t>(column);
  }

  /// First and last column that the triangle touches in a row, with a hair to spare on all
  /// sides; first > last if there are none.
  [[nodiscard]] std::pair<int, int> columns_in_row(const std::array<Vec2, 3>& triangle,
                                                   int row) const {
    constexpr double kHair = 1e-6;  // of a cell, for rounding
    const double below = row - kHair;
    const double above = row + 1.0 + kHair;
    double first = std::numeric_limits<double>::infinity();
    double last = -first;
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec2 from = in_cells(triangle[i]);
      const Vec2 to = in_cells(triangle[(i + 1) % 3]);
      if (std::max(from.y(), to.y()) < below || std::min(from.y(), to.y()) > above) {
        continue;
      }
      const double low = std::clamp(std::min(from.y(), to.y()), below, above);
      const double high = std::clamp(std::max(from.y(), to.y()), below, above);
      for (const double y : {low, high}) {
        const double height = to.y() - from.y();
        const double t = height != 0.0 ? std::clamp((y - from.y()) / height, 0.0, 1.0) : 0.0;
        const double x = from.x() + t * (to.x() - from.x());
        first = std::min(first, x);
        last = std::max(last, x);
      }
      if (from.y() == to.y()) {
        first = std::min(first, to.x());
        last = std::max(last, to.x());
      }
    }
    return first <= last
               ? std::pair(clamped(first - kHair, columns_), clamped(last + kHair, columns_))
               : std::pair(1, 0);
  }

  [[nodiscard]] Vec2 in_cells(const Vec2& point) const {
    return {x_of(point) * columns_per_unit_, y_of(point) * rows_per_unit_};
  }

  Vec2 low_ = Vec2::Zero();
  Eigen::Index along_ = 0;  ///< Axis of the longer side, along which columns are counted.
  double columns_per_unit_ = 0.0;
  double rows_per_unit_ = 0.0;
  int columns_ = 1;
  int rows_ = 1;
  std::vector<std::uint32_t> offsets_{};  ///< Of each cell, row by row, into members_.
  std::vector<std::uint32_t> members_;
};

/// Cuts ears off a ring of corners until a triangle is left.
class EarClipper {
 public:
  EarClipper(std::span<const std::uint32_t> corners, std::vector<Vec2> points, PolygonWork& work)
      : corners_(corners), points_(std::move(points)), work_(work) {
    const auto n = static_cast<std::uint32_t>(points_.size());
    next_.resize(n);
    previous_.resize(n);
    for (std::uint32_t i = 0; i < n; ++i) {
      next_[i] = i + 1 == n ? 0 : i + 1;
      previous_[next_[i]] = i;
    }
  }

  /// Every turn goes left and the ring goes round once.
  [[nodiscard]] bool is_strictly_convex() const {
    int turns_of_x = 0;
    for (std::uint32_t i = 0; i < points_.size(); ++i) {
      if (!points_outwards(i)) {
        return false;
      }
      const double in = points_[i].x() - points_[previous_[i]].x();
      const double out = points_[next_[i]].x() - points_[i].x();
      turns_of_x += (in > 0.0) != (out > 0.0) ? 1 : 0;
    }
    return turns_of_x <= 2;
  }

  void clip(std::vector<Triangle>& triangles) {
    std::vector<std::uint32_t> blockers;
    std::vector<std::uint32_t> candidates(points_.size());
    blocks_.resize(points_.size());
    for (std::uint32_t i = 0; i < points_.size(); ++i) {
      candidates[i] = i;
      blocks_[i] = !points_outwards(i);
      if (blocks_[i]) {
        blockers.push_back(i);
      }
    }
    const CornerGrid grid(points_, blockers);
    remaining_ = points_.size();
    waiting_.assign(points_.size(), true);
    gone_.assign(points_.size(), false);
    bool all_tried = true;  // the candidates are all corners of the ring
    while (remaining_ > 3 && !work_.is_spent()) {
      const std::size_t before = remaining_;
      std::vector<std::uint32_t> changed = clip_round(candidates, grid, triangles);
      if (changed.empty() && all_tried && remaining_ == before) {
        cut_off(flattest(), triangles, changed);  // the ring crosses itself: lose the least area
      }
      all_tried = changed.empty();
      candidates = all_tried ? ring() : std::move(changed);
    }
    fan_rest(triangles);  // of a hopeless one
  }

 private:
  [[nodiscard]] double corner_cross(std::uint32_t i) const {
    return cross(points_[previous_[i]], points_[i], points_[next_[i]]);
  }

  /// Neither straight nor pointing inwards.
  [[nodiscard]] bool points_outwards(std::uint32_t i) const {
    const Vec2 in = points_[i] - points_[previous_[i]];
    const Vec2 out = points_[next_[i]] - points_[i];
    return in.x() * out.y() - in.y() * out.x() > kStraightSine * in.norm() * out.norm();
  }

  [[nodiscard]] bool is_ear(std::uint32_t i, const CornerGrid& grid) const {
    if (!points_outwards(i)) {
      return false;
    }
    const Vec2& a = points_[previous_[i]];
    const Vec2& b = points_[i];
    const Vec2& c = points_[next_[i]];
    const auto lies_inside = [&](std::uint32_t other) {
      const Vec2& p = points_[other];
      // A corner at the place of an ear's corner (a bridge to a hole) does not block it.
      return blocks_[other] && cross(a, b, p) >= 0.0 && cross(b, c, p) >= 0.0 &&
             cross(c, a, p) >= 0.0 && p != a && p != b && p != c;
    };
    std::size_t steps = 0;
    const bool is_blocked = grid.any_near({a, b, c}, steps, lies_inside);
    work_.spend(steps);
    return !is_blocked;
  }

  void emit(std::uint32_t i, std::vector<Triangle>& triangles) const {
    triangles.push_back({corners_[previous_[i]], corners_[i], corners_[next_[i]]});
  }

  /// Cuts every candidate that is an ear. A corner whose neighbour was just cut waits for the next
  /// round, so that triangles do not fan out from one corner.
  /// \return corners to try next: those beside a cut.
  std::vector<std::uint32_t> clip_round(const std::vector<std::uint32_t>& candidates,
                                        const CornerGrid& grid, std::vector<Triangle>& triangles) {
    for (const std::uint32_t i : candidates) {
      waiting_[i] = false;
    }
    std::vector<std::uint32_t> changed;
    for (const std::uint32_t i : candidates) {
      work_.spend(1);
      // A cell may hold all corners, where few places repeat: a round alone can be too much.
      if (!work_.is_spent() && remaining_ > 3 && !gone_[i] && !waiting_[i] && is_ear(i, grid)) {
        cut_off(i, triangles, changed);
      }
    }
    return changed;
  }

  /// Takes the corner `i` away and puts its neighbours into `changed`.
  void cut_off(std::uint32_t i, std::vector<Triangle>& triangles,
               std::vector<std::uint32_t>& changed) {
    emit(i, triangles);
    const std::uint32_t before = previous_[i];
    const std::uint32_t after = next_[i];
    next_[before] = after;
    previous_[after] = before;
    blocks_[i] = false;
    gone_[i] = true;
    --remaining_;
    for (const std::uint32_t neighbour : {before, after}) {
      blocks_[neighbour] = blocks_[neighbour] && !points_outwards(neighbour);
      if (!waiting_[neighbour]) {
        waiting_[neighbour] = true;
        changed.push_back(neighbour);
      }
    }
  }

  /// The corners that are left, from the lowest on.
  [[nodiscard]] std::vector<std::uint32_t> ring() const {
    std::uint32_t corner = 0;
    while (gone_[corner]) {
      ++corner;
    }
    std::vector<std::uint32_t> corners;
    corners.reserve(remaining_);
    for (std::size_t i = 0; i < remaining_; ++i) {
      corners.push_back(corner);
      corner = next_[corner];
    }
    return corners;
  }

  [[nodiscard]] std::uint32_t flattest() const {
    const std::vector<std::uint32_t> corners = ring();
    return *std::min_element(corners.begin(), corners.end(), [&](std::uint32_t a, std::uint32_t b) {
      return std::abs(corner_cross(a)) < std::abs(corner_cross(b));
    });
  }

  void fan_rest(std::vector<Triangle>& triangles) const {
    const std::vector<std::uint32_t> rest = ring();
    for (std::size_t i = 2; i < rest.size(); ++i) {
      triangles.push_back({corners_[rest[0]], corners_[rest[i - 1]], corners_[rest[i]]});
    }
  }

  std::span<const std::uint32_t> corners_;
  std::vector<Vec2> points_;
  PolygonWork& work_;
  std::vector<std::uint32_t> next_{};
  std::vector<std::uint32_t> previous_{};
  std::vector<bool> blocks_{};   ///< Still in the ring, and not pointing outwards.
  std::vector<bool> waiting_{};  ///< To be tried in the next round.
  std::vector<bool> gone_{};     ///< No longer in the ring.
  std::size_t remaining_ = 0;    ///< Corners in the ring.
};

/// The corners in the plane across `normal`, counter-clockwise, around the first one.
std::vector<Vec2> flattened(std::span<const std::uint32_t> corners, std::span<const Vec3> positions,
                            const Vec3& normal) {
  const Vec3 u = normal.unitOrthogonal();
  const Vec3 v = normal.cross(u);
  const Vec3& origin = positions[corners[0]];
  std::vector<Vec2> points;
  points.reserve(corners.size());
  for (const std::uint32_t corner : corners) {
    const Vec3 offset = positions[corner] - origin;
    points.emplace_back(offset.dot(u), offset.dot(v));
  }
  return points;
}

}  // namespace

void PolygonWork::spend(std::size_t steps) {
  constexpr std::size_t kStepsPerCheck = 1 << 20;  // some hundredths of a second
  const std::size_t own = std::min(steps, left_);
  left_ -= own;
  reserve_ -= std::min(steps - own, reserve_);
  unchecked_ += steps;
  if (unchecked_ >= kStepsPerCheck) {
    unchecked_ = 0;
    run_.check();
  }
}

void triangulate_polygon(std::span<const std::uint32_t> corners, std::span<const Vec3> positions,
                         PolygonWork& work, std::vector<Triangle>& triangles) {
  work.begin(corners.size());
  work.spend(corners.size());
  if (corners.size() <= 3) {
    fan(corners, triangles);
    return;
  }
  const Vec3 normal = newell_normal(corners, positions);
  if (!(normal.norm() > 0.0)) {
    fan(corners, triangles);
  } else if (corners.size() == 4) {
    cut_quad(corners, positions, triangles);
  } else {
    EarClipper clipper(corners, flattened(corners, positions, normal.normalized()), work);
    clipper.is_strictly_convex() ? halve(corners, triangles) : clipper.clip(triangles);
  }
}

}  // namespace vantage
