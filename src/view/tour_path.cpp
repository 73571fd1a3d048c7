// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/Geometry>

#include "vantage/core/error.h"
#include "vantage/view/view_set.h"

#include "core/dense_algebra.h"
#include "core/unit_direction.h"
#include "view/sphere_angles.h"

namespace vantage {
namespace {

// The roll follows upright within about this much of the way at the equator, and the more slowly
// the nearer to a pole. [ours]: by eye; half of it shows the turn as a jerk, twice tilts the
// horizon.
constexpr double kRollLengthRad = 8.0 * kRadPerDeg;
// Weight of upright at a pole, where it means nothing; keeps the system definite.
constexpr double kLeastWeight = 1e-6;
// Stops nearer than this to opposite have no plane of their own, radians.
constexpr double kOpposite = 1e-9;
constexpr double kTwoPi = 2.0 * std::numbers::pi;

/// A great-circle arc: start, unit tangent there, and length.
struct Arc {
  Vec3 start;
  Vec3 tangent;
  double length;

  [[nodiscard]] Vec3 at(double angle) const {
    return (std::cos(angle) * start + std::sin(angle) * tangent).normalized();
  }
};

Arc arc_between(const Vec3& from, const Vec3& to, const Vec3& model_up) {
  const double length = angle_between(from, to);
  Vec3 tangent = to - to.dot(from) * from;
  if (length > std::numbers::pi - kOpposite) {
    tangent = model_up.cross(from);
  }
  if (!(tangent.norm() > kOpposite)) {
    tangent = from.unitOrthogonal();
  }
  return {from, tangent.normalized(), length};
}

std::vector<Vec3> equal_steps(std::span<const Vec3> stops, const Vec3& model_up,
                              std::size_t count) {
  std::vector<Arc> arcs;
  double length = 0.0;
  for (std::size_t i = 0; i < stops.size(); ++i) {
    arcs.push_back(arc_between(stops[i], stops[(i + 1) % stops.size()], model_up));
    length += arcs.back().length;
  }
  if (!(length > kOpposite)) {
    throw InvalidInput("a tour needs at least two different views");
  }
  std::vector<Vec3> directions;
  std::size_t arc = 0;
  double before = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    const double way = length * static_cast<double>(i) / static_cast<double>(count);
    while (arc + 1 < arcs.size() && way >= before + arcs[arc].length) {
      before += arcs[arc++].length;
    }
    directions.push_back(arcs[arc].at(way - before));
  }
  return directions;
}

/// Solves the cyclic system of `diagonal` with −coupling beside it and in both corners, by
/// elimination and one rank-one correction (Sherman & Morrison). \pre size ≥ 3.
std::vector<double> solve_cyclic(std::vector<double> diagonal, double coupling,
                                 const std::vector<double>& right) {
  const std::size_t n = diagonal.size();
  const double corner = -coupling;
  const double gamma = -diagonal[0];
  diagonal[0] -= gamma;
  diagonal[n - 1] -= corner * corner / gamma;
  const auto solve = [&](std::vector<double> x) {
    std::vector<double> ratio(n, 0.0);
    double pivot = diagonal[0];
    x[0] /= pivot;
    for (std::size_t i = 1; i < n; ++i) {
      ratio[i] = corner / pivot;
      pivot = diagonal[i] - corner * ratio[i];
      x[i] = (x[i] - corner * x[i - 1]) / pivot;
    }
    for (std::size_t i = n - 1; i > 0; --i) {
      x[i - 1] -= ratio[i] * x[i];
    }
    return x;
  };
  std::vector<double> x = solve(right);
  std::vector<double> u(n, 0.0);
  u[0] = gamma;
  u[n - 1] = corner;
  const std::vector<double> z = solve(u);
  const double share = corner / gamma;
  const double factor = (x[0] + share * x[n - 1]) / (1.0 + z[0] + share * z[n - 1]);
  for (std::size_t i = 0; i < n; ++i) {
    x[i] -= factor * z[i];
  }
  return x;
}

/// Angle of `up` around `direction`, counted from `zero`.
double roll_of(const Vec3& up, const Vec3& direction, const Vec3& zero) {
  return std::atan2(up.dot(direction.cross(zero)), up.dot(zero));
}

/// `angle` plus the whole turns that bring it nearest to `near`.
double unwrapped(double angle, double near) {
  return angle + kTwoPi * std::round((near - angle) / kTwoPi);
}

}  // namespace

std::vector<TourPose> tour_path(std::span<const Vec3> stops, const Vec3& model_up,
                                std::size_t count) {
  if (stops.size() < 2 || count < 3) {
    throw InvalidInput("a tour's path needs at least two stops and three poses");
  }
  const Vec3 unit_up = unit_direction(model_up);
  std::vector<Vec3> units(stops.begin(), stops.end());
  std::ranges::transform(units, units.begin(), unit_direction);
  const std::vector<Vec3> directions = equal_steps(units, unit_up, count);
  // A frame carried along without turning about the line of sight; upright is an angle in it.
  std::vector<Vec3> zero{directions[0].unitOrthogonal()};
  std::vector<double> upright{roll_of(unit_up, directions[0], zero[0])};
  std::vector<double> weights;
  double step = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3& here = directions[i];
    const Vec3& next = directions[(i + 1) % count];
    const Vec3 carried = shortest_rotation(here, next) * zero[i];
    zero.push_back((carried - carried.dot(next) * next).normalized());
    upright.push_back(unwrapped(roll_of(unit_up, next, zero[i + 1]), upright[i]));
    weights.push_back(std::max(kLeastWeight, 1.0 - std::pow(here.dot(unit_up), 2)));
    step += angle_between(here, next) / static_cast<double>(count);
  }
  // Least Σ w (θ − upright)² + coupling Σ (θ' − θ)², where the last θ' is the first θ, turned by as
  // much as the carried frame has turned against upright on the way round.
  const double round_turn = upright[count] - upright[0];
  const double coupling = std::pow(kRollLengthRad / step, 2);
  std::vector<double> diagonal(count, 0.0);
  std::vector<double> right(count, 0.0);
  for (std::size_t i = 0; i < count; ++i) {
    diagonal[i] = weights[i] + 2.0 * coupling;
    right[i] = weights[i] * upright[i];
  }
  right[0] -= coupling * round_turn;
  right[count - 1] += coupling * round_turn;
  const std::vector<double> roll = solve_cyclic(std::move(diagonal), coupling, right);
  std::vector<TourPose> poses;
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3 aside = directions[i].cross(zero[i]);
    const Vec3 up = std::cos(roll[i]) * zero[i] + std::sin(roll[i]) * aside;
    poses.push_back({directions[i], up.normalized()});
  }
  return poses;
}

}  // namespace vantage
