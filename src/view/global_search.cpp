// SPDX-License-Identifier: MIT
#include "view/global_search.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

#include "view/sphere_angles.h"

namespace vantage {
namespace {

// All ours; docs/lab/2026-11-search-scores.md has what each trades, measured.
constexpr std::size_t kScored = 96;  // directions scored before the ascent, half of them peaks
// Of the first rings of the ascent, over small maxima; its starts are farther apart.
constexpr double kFirstReachRad = 5.0 * kRadPerDeg;
constexpr double kNotWorthARing = 3e-4;        // share of the range that is not worth a finer ring
constexpr std::size_t kAscendAgain = 2;        // of ends by a proxy, and of what is near an end
constexpr double kNearRad = 8.0 * kRadPerDeg;  // so far from a maximum a higher one is often
constexpr std::size_t kStartsPerLook = 4;      // one end is looked near for so many starts

// Of the progress bar: where the survey ends, and the ascent after it.
constexpr double kSurveyed = 0.5;
constexpr double kAscended = 0.8;

/// About half the angle between neighbours of an icosahedron level.
double half_spacing_rad(int level) {
  return 34.0 * kRadPerDeg / static_cast<double>(1 << level);
}

/// By how much the estimates that are finite differ: a view of nothing may be infinitely bad.
double range_of(const std::vector<double>& estimates) {
  double least = std::numeric_limits<double>::infinity();
  double largest = -least;
  for (const double estimate : estimates) {
    if (std::isfinite(estimate)) {
      least = std::min(least, estimate);
      largest = std::max(largest, estimate);
    }
  }
  return std::max(0.0, largest - least);
}

/// The directions of a triangular lattice around one and without it.
std::vector<Vec3> directions_around(const Vec3& centre, double reach_rad, double apart_rad) {
  const Vec3 right = centre.unitOrthogonal();
  const Vec3 up = centre.cross(right);
  const int rows = static_cast<int>(2.0 * reach_rad / (std::numbers::sqrt3 * apart_rad));
  const int columns = rows + static_cast<int>(reach_rad / apart_rad);
  std::vector<Vec3> directions;
  for (int i = -rows; i <= rows; ++i) {
    for (int k = -columns; k <= columns; ++k) {
      const double x = apart_rad * (k + 0.5 * i);
      const double y = 0.5 * std::numbers::sqrt3 * apart_rad * i;
      if ((i != 0 || k != 0) && std::hypot(x, y) <= reach_rad) {
        directions.push_back((centre + x * right + y * up).normalized());
      }
    }
  }
  return directions;
}

/// What to score: both ways along the axes, where things with flat sides have peaks and pits, the
/// highest peaks of the estimates, then the highest estimates, apart from each other.
std::vector<Vec3> promising(const DirectionSet& set, const std::vector<double>& estimates,
                            double apart_rad) {
  constexpr double kFirst = std::numeric_limits<double>::infinity();
  std::vector<Candidate> all;
  for (Eigen::Index k = 0; k < 3; ++k) {
    all.push_back({Vec3::Unit(k), kFirst});
    all.push_back({-Vec3::Unit(k), kFirst});
  }
  const std::vector<std::size_t> maxima = local_maxima(set, estimates);
  for (std::size_t i = 0; i < std::min(kScored / 2, maxima.size()); ++i) {
    all.push_back({set.directions[maxima[i]], std::numeric_limits<double>::max()});
  }
  for (std::size_t i = 0; i < estimates.size(); ++i) {
    all.push_back({set.directions[i], estimates[i]});
  }
  std::vector<Vec3> directions;
  for (const Candidate& one : largest_apart(std::move(all), kScored, apart_rad)) {
    directions.push_back(one.direction);
  }
  return directions;
}

/// The directions with their values.
std::vector<Candidate> valued(const std::vector<Vec3>& directions, const SearchTarget& target) {
  const std::vector<double> values = target.values(directions, 0);
  std::vector<Candidate> candidates;
  for (std::size_t i = 0; i < directions.size(); ++i) {
    candidates.push_back({directions[i], values[i]});
  }
  return candidates;
}

/// The best of the ends of ascents by the proxy, by their scores.
std::vector<Candidate> best_by_score(const std::vector<Candidate>& ends,
                                     const SearchTarget& target) {
  std::vector<Vec3> directions;
  directions.reserve(ends.size());
  for (const Candidate& end : ends) {
    directions.push_back(end.direction);
  }
  return largest_apart(valued(directions, target), kAscendAgain, 0.0);
}

/// Moves the candidates to where they end, the highest first.
std::vector<Candidate> ascended(std::vector<Candidate> candidates, const AscentRules& rules,
                                const SearchTarget& target, const RunContext& run) {
  ascend(candidates, rules, target, 1, run);
  const std::size_t count = candidates.size();
  return largest_apart(std::move(candidates), count, 0.0);
}

/// Those ends of ascents, highest first, near which a higher one may be: one for kStartsPerLook starts,
/// apart from each other, but none where the score is smooth.
std::vector<Candidate> worth_a_look_near(const std::vector<Candidate>& ends,
                                         const AscentRules& rules, std::size_t starts) {
  std::vector<Candidate> worth;
  const std::size_t most = std::max<std::size_t>(1, starts / kStartsPerLook);
  for (const Candidate& end : largest_apart(ends, most, kFirstReachRad)) {
    if (end.spread == 0.0 || end.spread >= rules.flat) {
      worth.push_back(end);
    }
  }
  return worth;
}

/// Scores directions within kNearRad of ends and ascends from the best of them, again while that gains
/// rules.flat at least: where the score is rough or goes in steps, a higher maximum is often near.
/// \return the highest. Does nothing where the survey is coarser than kNearRad.
Candidate highest_near(const std::vector<Candidate>& ends, AscentRules rules, double spacing_rad,
                       const SearchTarget& target, const RunContext& run) {
  Candidate best = ends[0];
  std::vector<Candidate> centres = worth_a_look_near(ends, rules, target.objective().starts);
  rules.first_rad = 0.5 * spacing_rad;
  while (!centres.empty() && spacing_rad <= kNearRad) {
    std::vector<Candidate> starts;
    for (const Candidate& centre : centres) {
      const std::vector<Vec3> around = directions_around(centre.direction, kNearRad, spacing_rad);
      for (const Candidate& start :
           largest_apart(valued(around, target), kAscendAgain, 1.5 * spacing_rad)) {
        starts.push_back(start);
      }
    }
    const Candidate end = ascended(std::move(starts), rules, target, run.quiet())[0];
    const double gain = end.value - best.value;
    if (gain > 0.0) {
      best = end;
    }
    centres = gain > 0.0 && gain >= rules.flat ? worth_a_look_near({best}, rules, 1)
                                               : std::vector<Candidate>{};
  }
  return best;
}

}  // namespace

Candidate search_globally(const SearchTarget& target, const RunContext& run) {
  const SearchTarget cheapest = target.has_proxy() ? target.by_proxy() : target;
  const double spacing_rad = half_spacing_rad(target.objective().survey_level);
  const DirectionSet set =
      direction_set(ViewSphereBase::Icosahedron, target.objective().survey_level);
  const std::vector<double> estimates =
      cheapest.estimates(set.directions, run.part(0.0, kSurveyed));
  const AscentRules rules{.first_rad = std::max(spacing_rad, kFirstReachRad),
                          .last_rad = target.finest_deg() * kRadPerDeg,
                          .flat = kNotWorthARing * range_of(estimates),
                          .drops_losers = true};
  std::vector<Candidate> ends =
      ascended(largest_apart(valued(promising(set, estimates, 1.5 * spacing_rad), cheapest),
                             target.objective().starts, kFirstReachRad),
               rules, cheapest, run.part(kSurveyed, kAscended));
  if (!target.is_smooth()) {
    ends[0] = highest_near(ends, rules, spacing_rad, cheapest, run);
  }
  if (target.has_proxy()) {
    if (!target.objective().surrogate) {  // the survey is of scores, unlike the proxy
      ends.push_back({set.directions[index_of_largest(estimates)], 0.0});
    }
    ends = ascended(best_by_score(ends, target), rules, target, run.part(kAscended, 1.0));
  }
  run.advance("search", 1.0);
  return ends[0];
}

}  // namespace vantage
