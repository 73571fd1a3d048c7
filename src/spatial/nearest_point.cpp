// SPDX-License-Identifier: MIT
#include "spatial/nearest_point.h"

#include <cmath>
#include <limits>
#include <span>
#include <utility>

namespace vantage {
namespace {

/// How much farther than the tree's nearest point another one is looked for, which its sums may round
/// to be farther than it is.
constexpr double kRoundedUp = 1.0 + 1e-9;
constexpr double kLeastReach = 1e-150;  // its square is above 0

}  // namespace

NearestPoint::NearestPoint(std::vector<Vec3> points)
    : points_(std::move(points)), tree_(std::make_unique<const PointTree>(points_)) {}

std::size_t NearestPoint::to(const Vec3& place) const {
  std::size_t best = 0;
  double squared = 0.0;
  tree_->nearest(place, std::span(&best, 1), std::span(&squared, 1));
  std::vector<PointTree::Match> near;
  tree_->within(place, kRoundedUp * std::sqrt(squared) + kLeastReach, near);
  double least = std::numeric_limits<double>::infinity();
  for (const auto& [i, ignored] : near) {
    const double distance = (points_[i] - place).squaredNorm();
    if (distance < least || (distance == least && i < best)) {
      least = distance;
      best = i;
    }
  }
  return best;
}

}  // namespace vantage
