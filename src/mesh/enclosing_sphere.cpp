// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "vantage/mesh/measures.h"

#include "core/dense_algebra.h"

namespace vantage {
namespace {

struct Ball {
  Vec3 centre = Vec3::Zero();
  double radius_squared = -1.0;
};

// Points this close outside, relative to the radius, count as inside: rounding of the solve.
constexpr double kSlack = 1e-12;
// More points than this are never on the active set of a 3-D ball for long.
constexpr int kMaxRounds = 1000;

/// Smallest ball with all of 0–4 points on its boundary; affinely dependent points give the
/// least-squares centre, which the caller then rejects or accepts by containment.
Ball circumscribed(const std::vector<Vec3>& boundary) {
  if (boundary.empty()) {
    return {};
  }
  const Vec3& origin = boundary.front();
  const auto k = static_cast<Eigen::Index>(boundary.size()) - 1;
  if (k == 0) {
    return {origin, 0.0};
  }
  // centre = origin + Q λ with 2 QᵀQ λ = |q|² (Gärtner 1999, eq. 5).
  Eigen::Matrix<double, 3, Eigen::Dynamic, 0, 3, 3> Q(3, k);
  Eigen::VectorXd b(k);
  for (Eigen::Index i = 0; i < k; ++i) {
    Q.col(i) = boundary[static_cast<std::size_t>(i) + 1] - origin;
    b(i) = Q.col(i).squaredNorm();
  }
  const Eigen::VectorXd lambda = least_squares(2.0 * Q.transpose() * Q, b);
  const Vec3 offset = Q * lambda;
  return {origin + offset, offset.squaredNorm()};
}

bool inside(const Ball& ball, const Vec3& p) {
  return (p - ball.centre).squaredNorm() <= ball.radius_squared * (1.0 + kSlack);
}

/// Welzl's recursion over the first `count` points, with `boundary` known to lie on the sphere.
Ball smallest_ball(const std::vector<Vec3>& points, std::size_t count,
                   std::vector<Vec3>& boundary) {
  Ball ball = circumscribed(boundary);
  if (boundary.size() == 4) {
    return ball;
  }
  for (std::size_t i = 0; i < count; ++i) {
    if (!inside(ball, points[i])) {
      boundary.push_back(points[i]);
      ball = smallest_ball(points, i, boundary);
      boundary.pop_back();
    }
  }
  return ball;
}

}  // namespace

Sphere enclosing_sphere(std::span<const Vec3> points) {
  if (points.empty()) {
    return {};
  }
  // Work on the unit box so that squares neither overflow nor vanish.
  const Box box = bounding_box(points);
  const double scale = box.longest_side();
  if (!(scale > 0.0)) {
    return {box.low, 0.0};
  }
  const Vec3 middle = box.low + 0.5 * box.size();
  std::vector<Vec3> active;
  std::vector<Vec3> boundary;
  Ball ball{Vec3::Zero(), -1.0};
  // Add the farthest outsider to a small active set until nobody is outside.
  for (int round = 0; round < kMaxRounds; ++round) {
    double farthest = -1.0;
    Vec3 candidate = Vec3::Zero();
    for (const Vec3& p : points) {
      const Vec3 q = (p - middle) / scale;
      const double distance = (q - ball.centre).squaredNorm();
      if (distance > farthest) {
        farthest = distance;
        candidate = q;
      }
    }
    if (farthest <= ball.radius_squared * (1.0 + 2.0 * kSlack)) {
      break;
    }
    active.push_back(candidate);
    ball = smallest_ball(active, active.size(), boundary);
    if (round + 1 == kMaxRounds) {
      for (const Vec3& p : points) {
        ball.radius_squared =
            std::max(ball.radius_squared, ((p - middle) / scale - ball.centre).squaredNorm());
      }
    }
  }
  return {middle + scale * ball.centre,
          2.0 * scale * std::sqrt(std::max(0.0, ball.radius_squared))};
}

}  // namespace vantage
