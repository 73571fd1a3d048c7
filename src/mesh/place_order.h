// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>

#include "vantage/core/vec3.h"

/// \file
/// An order among what is equally long that does not depend on how a model is numbered, turned, moved
/// or scaled. Symmetric models are full of ties; decided by index, another numbering would take
/// another of two equal ways.

namespace vantage {

/// A direction that points have by themselves: it turns with them and does not depend on their order.
/// Mirroring is no symmetry here, so a model that is its own mirror image has one too. Zero if the
/// points are alike around every axis, around an axis that has no two different ends, or if every
/// point has its opposite.
Vec3 own_direction(std::span<const Vec3> points);

/// Orders edges by length and, where rounding alone makes lengths differ, by place.
class PlaceOrder {
 public:
  explicit PlaceOrder(std::span<const Vec3> points);

  /// The length in steps of 2⁻²⁴ of the distance from the points' mean to the farthest of them.
  [[nodiscard]] std::uint32_t steps(double length) const;

  /// Where the middle of a and b lies along own_direction(), in like steps.
  [[nodiscard]] std::uint32_t place(const Vec3& a, const Vec3& b) const;

 private:
  Vec3 centre_ = Vec3::Zero();
  Vec3 direction_ = Vec3::Zero();
  double steps_per_length_ = 0.0;
};

}  // namespace vantage
