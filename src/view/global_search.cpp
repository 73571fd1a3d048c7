// SPDX-License-Identifier: MIT
#include "view/global_search.h"

#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

#include "view/sphere_angles.h"

namespace vantage {
namespace {

// All ours; docs/search.md has what each trades, measured.
constexpr std::size_t kExactValues = 96;  // directions scored exactly; half of them peaks
constexpr std::size_t kStarts = 6;        // directions that the ascent starts from, …
constexpr double kStartsApartRad = 5.0 * kRadPerDeg;  // … so far apart: not all on one hill

constexpr double kSurveyShare = 0.5;  // of the progress bar

/// About half the angle between neighbours of an icosahedron level.
double half_spacing_rad(int level) {
  return 34.0 * kRadPerDeg / static_cast<double>(1 << level);
}

/// The directions to be scored exactly: the highest peaks of the estimates, then the highest
/// estimates, apart from each other.
std::vector<Vec3> promising(const DirectionSet& set, const std::vector<double>& estimates,
                            double apart_rad) {
  std::vector<Candidate> peaks;
  for (const std::size_t i : local_maxima(set, estimates)) {
    peaks.push_back({set.directions[i], estimates[i]});
  }
  peaks.resize(std::min(peaks.size(), kExactValues / 2));
  std::vector<Candidate> all = peaks;
  for (Candidate& peak : all) {
    peak.value = std::numeric_limits<double>::infinity();  // stays, whatever lies near it
  }
  for (std::size_t i = 0; i < set.directions.size(); ++i) {
    all.push_back({set.directions[i], estimates[i]});
  }
  std::vector<Vec3> directions;
  for (const Candidate& one : largest_apart(std::move(all), kExactValues, apart_rad)) {
    directions.push_back(one.direction);
  }
  return directions;
}

}  // namespace

Candidate search_globally(const SearchTarget& target, const RunContext& run) {
  const int level = target.objective().survey_level;
  const double first_rad = half_spacing_rad(level);
  const DirectionSet set = direction_set(ViewSphereBase::Icosahedron, level);
  const std::vector<Vec3> directions = promising(
      set, target.estimates(set.directions, run.part(0.0, kSurveyShare)), 1.5 * first_rad);
  const std::vector<double> values = target.values(directions, 0);
  std::vector<Candidate> candidates;
  for (std::size_t i = 0; i < directions.size(); ++i) {
    candidates.push_back({directions[i], values[i]});
  }
  // Each halving of the ring leaves one candidate fewer: a summit may be narrow.
  const RunContext ascent = run.part(kSurveyShare, 1.0);
  std::size_t count = kStarts;
  double ring_rad = first_rad;
  candidates = largest_apart(std::move(candidates), count, kStartsApartRad);
  for (int round = 1; ring_rad >= target.objective().finest_deg * kRadPerDeg; ++round) {
    candidates = largest_apart(std::move(candidates), count, ring_rad);
    ascend(candidates, {ring_rad, ring_rad}, target, round, ascent);
    count = std::max<std::size_t>(1, count - 1);
    ring_rad *= 0.5;
  }
  return largest_apart(std::move(candidates), 1, 0.0).front();
}

}  // namespace vantage
