// SPDX-License-Identifier: MIT
#include "view/rapid_search.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "view/loop_patch.h"
#include "view/sphere_angles.h"

namespace vantage {
namespace {

// With require_narrow_ring: a small gain stops the search only within this ring. [ours]
constexpr double kNarrowRingRad = 2.0 * kRadPerDeg;
// The search ends here in any case. [ours]
constexpr double kFinestRingRad = 0.001 * kRadPerDeg;

/// Largest angle between a direction and those of a ring.
double width_of(const Vec3& centre, const std::vector<Vec3>& ring) {
  double width = 0.0;
  for (const Vec3& direction : ring) {
    width = std::max(width, angle_between(centre, direction));
  }
  return width;
}

/// What epsilon as a fraction is one of.
double whole_of(const SearchTarget& target, const std::vector<double>& start) {
  if (target.objective().total && !target.is_preference()) {
    return *target.objective().total;
  }
  double largest = 0.0;
  for (const double value : start) {
    largest = std::isfinite(value) ? std::max(largest, std::abs(value)) : largest;
  }
  return largest;
}

}  // namespace

Candidate search_rapidly(const SearchTarget& target, const DirectionSet& set,
                         const std::vector<double>& start, const SearchOptions& options,
                         const RunContext& run) {
  const std::size_t first = index_of_largest(start);
  Candidate v0{set.directions[first], start[first]};
  const double epsilon =
      options.epsilon * (options.epsilon_is_fraction ? whole_of(target, start) : 1.0);
  LoopPatch patch(set, static_cast<std::uint32_t>(first));
  double width = std::numbers::pi;
  for (int level = 1; width > kFinestRingRad; ++level) {
    // Each level halves the ring, so that progress follows the logarithm of its width.
    run.advance("search",
                std::log(std::numbers::pi / width) / std::log(std::numbers::pi / kFinestRingRad));
    patch.refine();
    const std::vector<Vec3> ring = patch.ring();
    const std::vector<double> values = target.values(ring, level);
    const std::size_t best = index_of_largest(values);
    width = width_of(v0.direction, ring);
    const double gain = std::abs(v0.value - values[best]);
    if (values[best] >= v0.value) {
      v0 = {ring[best], values[best]};
      patch.move_to(best);
    }
    if (gain < epsilon && (!options.require_narrow_ring || width < kNarrowRingRad)) {
      break;
    }
  }
  return v0;
}

}  // namespace vantage
