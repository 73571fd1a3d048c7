// SPDX-License-Identifier: MIT
#include "mesh/place_order.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

namespace vantage {
namespace {

/// Moments below this share of what they could be are rounding [ours].
constexpr double kNothing = 1e-6;
/// Shares of the second and third axis in the direction: no simple ratio, so that what is alike along
/// one axis differs along the sum [ours].
constexpr double kSecond = 0.618;
constexpr double kThird = 0.382;
constexpr double kStepsPerSize = 1 << 24;
constexpr double kMostSteps = 4e9;

Vec3 mean_of(std::span<const Vec3> points) {
  Vec3 sum = Vec3::Zero();
  for (const Vec3& p : points) {
    sum += p;
  }
  return points.empty() ? sum : Vec3(sum / static_cast<double>(points.size()));
}

/// The vector over its length, or zero if that is next to nothing.
Vec3 unit_or_zero(const Vec3& v) {
  const double length = v.norm();
  return length > kNothing ? Vec3(v / length) : Vec3(Vec3::Zero());
}

std::uint32_t whole(double steps) {
  return static_cast<std::uint32_t>(std::clamp(steps, 0.0, kMostSteps));
}

double farthest_from(const Vec3& centre, std::span<const Vec3> points) {
  double squared = 0.0;
  for (const Vec3& p : points) {
    squared = std::max(squared, (p - centre).squaredNorm());
  }
  return std::sqrt(squared);
}

}  // namespace

Vec3 own_direction(std::span<const Vec3> points) {
  const Vec3 centre = mean_of(points);
  const double size = farthest_from(centre, points);
  if (!(size > 0.0)) {
    return Vec3::Zero();
  }
  // Odd moments: what of the points lies farther out on one side than on the other.
  Vec3 near = Vec3::Zero();
  Vec3 far = Vec3::Zero();
  double near_total = 0.0;
  double far_total = 0.0;
  for (const Vec3& p : points) {
    const Vec3 u = (p - centre) / size;
    const double squared = u.squaredNorm();
    const double length = std::sqrt(squared);
    near += length * u;
    near_total += squared;
    far += length * squared * u;
    far_total += squared * squared;
  }
  near /= near_total;
  far /= far_total;
  Vec3 first = unit_or_zero(near);
  if (first.isZero(0.0)) {
    first = unit_or_zero(far);
  }
  const Vec3 second = unit_or_zero(far - far.dot(first) * first);
  return (first + kSecond * second + kThird * first.cross(second)).stableNormalized();
}

PlaceOrder::PlaceOrder(std::span<const Vec3> points)
    : centre_(mean_of(points)), direction_(own_direction(points)) {
  const double size = farthest_from(centre_, points);
  steps_per_length_ = size > 0.0 ? kStepsPerSize / size : 0.0;
}

std::uint32_t PlaceOrder::steps(double length) const {
  return whole(length * steps_per_length_);
}

std::uint32_t PlaceOrder::place(const Vec3& a, const Vec3& b) const {
  const double along = direction_.dot(0.5 * (a + b) - centre_);
  return whole(2.0 * kStepsPerSize + along * steps_per_length_);
}

}  // namespace vantage
