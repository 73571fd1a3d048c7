// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <Eigen/Core>

/// \file
/// What is left of a triangle when convex polygons are taken away.

namespace vantage {

/// Twice the areas below this share of a face are rounding.
inline constexpr double kNoArea = 1e-13;

inline double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

/// The place on ab where a value that differs in sign at its ends is zero: the same for ba.
template <typename Point>
Point zero_between(const Point& a, double of_a, const Point& b, double of_b) {
  return of_a < 0.0 ? zero_between(b, of_b, a, of_a) : Point(a + of_a / (of_a - of_b) * (b - a));
}

/// Puts what has values of at least 0 of a convex polygon into `above`.
/// \param each_below takes the corners of the rest, one after the other.
template <typename Points, typename Value, typename EachBelow>
void cut_polygon(const Points& polygon, const Value& value, Points& above,
                 const EachBelow& each_below) {
  above.clear();
  double of_a = value(polygon[0]);
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const auto& a = polygon[k];
    const auto& b = polygon[k + 1 < polygon.size() ? k + 1 : 0];
    const double of_b = value(b);
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

/// Convex polygons, counterclockwise, in the first two barycentric coordinates of a face.
class Polygons {
 public:
  using Points = std::span<const Eigen::Vector2d>;

  [[nodiscard]] std::size_t size() const { return ends_.size(); }

  [[nodiscard]] Points operator[](std::size_t i) const {
    const std::size_t begin = i == 0 ? 0 : ends_[i - 1];
    return std::span(points_).subspan(begin, ends_[i] - begin);
  }

  void add(Points polygon) {
    points_.insert(points_.end(), polygon.begin(), polygon.end());
    ends_.push_back(points_.size());
  }

  /// Leaves the first `count`.
  void shrink_to(std::size_t count) {
    ends_.resize(count);
    points_.resize(count == 0 ? 0 : ends_.back());
  }

 private:
  std::vector<Eigen::Vector2d> points_{};
  std::vector<std::size_t> ends_{};
};

/// A triangle less convex polygons, kept as convex parts.
class PolygonRest {
 public:
  /// All of the triangle again.
  PolygonRest() { reset(); }

  void reset();

  /// Takes a convex, counterclockwise polygon away.
  void subtract(Polygons::Points polygon);

  [[nodiscard]] const Polygons& parts() const { return parts_; }

 private:
  Polygons parts_{}, next_{};
  std::vector<Eigen::Vector2d> inside_{}, outside_{}, kept_{};  // of the part at hand
};

/// Positive if its corners go counterclockwise.
double twice_area(Polygons::Points polygon);

}  // namespace vantage
