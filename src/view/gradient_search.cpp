// SPDX-License-Identifier: MIT
#include "view/gradient_search.h"

#include <cmath>
#include <numbers>

#include "core/random.h"
#include "view/sphere_angles.h"

namespace vantage {
namespace {

// The gradient is that over this angle to both sides: scores are sums over what is seen, with jumps
// too small to see at this width. [ours]
constexpr double kReachRad = 2.0 * kRadPerDeg;
// The first way that is tried along the gradient; halved where it does not help, until it is
// shorter than the last. [ours]
constexpr double kFirstWayRad = 8.0 * kRadPerDeg;
constexpr double kLastWayRad = 0.25 * kRadPerDeg;
// The climb from one start ends after this many steps in any case. [ours]
constexpr int kMostSteps = 200;

/// A direction on its way up.
struct Climber {
  Candidate here{};
  Vec3 uphill = Vec3::Zero();  // unit, across `here`; zero where the score is flat
  double way_rad = kFirstWayRad;
  bool is_moved = true;  // its gradient is not known

  [[nodiscard]] bool is_done() const { return way_rad < kLastWayRad; }
};

/// Uniform over the sphere, from a sequence of the start's own.
Vec3 random_direction(std::uint64_t seed, int start) {
  Pcg32 random(seed, static_cast<std::uint64_t>(start));
  const double z = 2.0 * random.uniform() - 1.0;
  const double azimuth = 2.0 * std::numbers::pi * random.uniform();
  const double across = std::sqrt(std::max(0.0, 1.0 - z * z));
  return Vec3(across * std::cos(azimuth), across * std::sin(azimuth), z).normalized();
}

Vec3 turned(const Vec3& from, const Vec3& aside, double angle_rad) {
  return (std::cos(angle_rad) * from + std::sin(angle_rad) * aside).normalized();
}

/// Central differences along two directions across each climber that has moved.
void find_gradients(std::vector<Climber>& climbers, const SearchTarget& target, int level) {
  std::vector<Vec3> probes;
  std::vector<std::size_t> owners;
  for (std::size_t i = 0; i < climbers.size(); ++i) {
    if (!climbers[i].is_done() && climbers[i].is_moved) {
      owners.push_back(i);
      const Vec3& d = climbers[i].here.direction;
      const Vec3 right = d.unitOrthogonal();
      const Vec3 up = d.cross(right);
      for (const Vec3& aside : {right, Vec3(-right), up, Vec3(-up)}) {
        probes.push_back(turned(d, aside, kReachRad));
      }
    }
  }
  const std::vector<double> scores = target.values(probes, level);
  for (std::size_t k = 0; k < owners.size(); ++k) {
    Climber& climber = climbers[owners[k]];
    const Vec3 right = climber.here.direction.unitOrthogonal();
    const Vec3 up = climber.here.direction.cross(right);
    const Vec3 slope =
        (scores[4 * k] - scores[4 * k + 1]) * right + (scores[4 * k + 2] - scores[4 * k + 3]) * up;
    const double length = slope.norm();
    climber.is_moved = false;
    if (!(length > 0.0) || !std::isfinite(length)) {
      climber.way_rad = 0.0;  // flat, or at the edge of where there is a score: nowhere to go
      continue;
    }
    climber.uphill = slope / length;
  }
}

/// One step of each climber along its gradient, taken only if it helps.
void advance(std::vector<Climber>& climbers, const SearchTarget& target, int level) {
  std::vector<Vec3> trials;
  std::vector<std::size_t> owners;
  for (std::size_t i = 0; i < climbers.size(); ++i) {
    if (!climbers[i].is_done()) {
      owners.push_back(i);
      trials.push_back(turned(climbers[i].here.direction, climbers[i].uphill, climbers[i].way_rad));
    }
  }
  const std::vector<double> scores = target.values(trials, level);
  for (std::size_t k = 0; k < owners.size(); ++k) {
    Climber& climber = climbers[owners[k]];
    if (scores[k] > climber.here.value) {
      climber.here = {trials[k], scores[k]};
      climber.is_moved = true;
    } else {
      climber.way_rad *= 0.5;
    }
  }
}

}  // namespace

Candidate search_by_gradient(const SearchTarget& target, const SearchOptions& options,
                             const RunContext& run) {
  std::vector<Vec3> starts;
  starts.reserve(static_cast<std::size_t>(options.starts));
  for (int i = 0; i < options.starts; ++i) {
    starts.push_back(random_direction(options.seed, i));
  }
  if (target.is_flat()) {
    starts.resize(1);
  }
  const std::vector<double> scores = target.values(starts, 0);
  std::vector<Climber> climbers;
  climbers.reserve(starts.size());
  std::vector<Candidate> ends;
  ends.reserve(starts.size());
  for (std::size_t i = 0; i < starts.size(); ++i) {
    climbers.push_back({.here = {starts[i], scores[i]}});
  }
  for (int level = 1; !target.is_flat() && level <= kMostSteps; ++level) {
    std::size_t active = 0;
    for (const Climber& climber : climbers) {
      active += climber.is_done() ? 0 : 1;
    }
    if (active == 0) {
      break;
    }
    run.advance("search", std::min(1.0, static_cast<double>(level) / kMostSteps));
    find_gradients(climbers, target, level);
    advance(climbers, target, level);
  }
  for (const Climber& climber : climbers) {
    ends.push_back(climber.here);
  }
  return largest_apart(std::move(ends), 1, 0.0).front();
}

}  // namespace vantage
