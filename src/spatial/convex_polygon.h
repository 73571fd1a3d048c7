// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>

#include <Eigen/Core>

/// \file
/// Small convex polygons, and cutting them by lines.

namespace vantage {

/// A triangle cut by four planes or lines at most. Each cut adds one corner to a convex polygon; where
/// rounding has bent it, of 3, 4, 6 and 9 corners 4, 6, 9 and 13 may be made.
template <typename Point>
class ConvexPolygon {
 public:
  static constexpr std::size_t kMost = 13;

  [[nodiscard]] std::size_t size() const { return count_; }

  [[nodiscard]] const Point& operator[](std::size_t k) const { return points_[k]; }

  void clear() { count_ = 0; }

  void push_back(const Point& point) { points_[count_++] = point; }

 private:
  std::array<Point, kMost> points_;
  std::size_t count_ = 0;
};

/// The place on ab where a value that differs in sign at its ends is zero: the same for ba.
template <typename Point>
Point zero_between(const Point& a, double of_a, const Point& b, double of_b) {
  return of_a < 0.0 ? zero_between(b, of_b, a, of_a) : Point(a + of_a / (of_a - of_b) * (b - a));
}

/// Puts what has values of at least 0 of a convex polygon into `above`.
/// \param each_below takes the corners of the rest, one after the other.
template <typename Points, typename Value, typename Above, typename EachBelow>
void cut_polygon(const Points& polygon, const Value& value, Above& above,
                 const EachBelow& each_below) {
  above.clear();
  if (polygon.size() == 0) {
    return;
  }
  double of_a = value(polygon[0]);
  const double of_first = of_a;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const auto& a = polygon[k];
    const bool is_last = k + 1 == polygon.size();
    const auto& b = polygon[is_last ? 0 : k + 1];
    const double of_b = is_last ? of_first : value(b);
    if (of_a >= 0.0) {
      above.push_back(a);
    }
    if (of_a <= 0.0) {
      each_below(a);
    }
    if ((of_a < 0.0 && of_b > 0.0) || (of_a > 0.0 && of_b < 0.0)) {
      above.push_back(zero_between(a, of_a, b, of_b));
      each_below(above[above.size() - 1]);
    }
    of_a = of_b;
  }
}

}  // namespace vantage
