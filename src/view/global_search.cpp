// SPDX-License-Identifier: MIT
#include "view/global_search.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "view/sphere_angles.h"

namespace vantage {
namespace {

// All ours; docs/search.md has what each trades, measured.
constexpr std::size_t kBatch = 16;   // directions scored at a time, a quarter of them peaks; at
                                     // first twice as many, half of them peaks, …
constexpr std::size_t kBatches = 2;  // … then so often, by what was learnt of the estimates
constexpr double kLikeRad = 12.0 * kRadPerDeg;  // estimates so far apart are off by like amounts
constexpr double kTrust = 0.3;  // weight of the mean error where nothing near was scored
constexpr double kStartsApartRad = 5.0 * kRadPerDeg;  // starts of the ascent: not by one maximum
constexpr double kFirstRingRad = 4.25 * kRadPerDeg;   // of their rings, at least: over small maxima
constexpr double kNotWorthARing = 3e-4;  // share of the range that is not worth a finer ring
constexpr std::size_t kProxyEnds = 2;    // of the ends by a proxy, ascend once more by the score

// Of the progress bar: where the survey ends, and the ascent after it.
constexpr double kSurveyed = 0.5;
constexpr double kAscended = 0.8;

/// About half the angle between neighbours of an icosahedron level.
double half_spacing_rad(int level) {
  return 34.0 * kRadPerDeg / static_cast<double>(1 << level);
}

/// What is known of the sphere, and what to score next.
class Survey {
 public:
  Survey(const SearchTarget& target, double apart_rad, const RunContext& run)
      : target_(target),
        apart_rad_(apart_rad),
        set_(direction_set(ViewSphereBase::Icosahedron, target.objective().survey_level)),
        estimates_(target.estimates(set_.directions, run)),
        corrected_(estimates_) {}

  /// Of the estimates that are finite: a view of nothing may be infinitely bad.
  [[nodiscard]] double range() const {
    double least = std::numeric_limits<double>::infinity();
    double largest = -least;
    for (const double estimate : estimates_) {
      if (std::isfinite(estimate)) {
        least = std::min(least, estimate);
        largest = std::max(largest, estimate);
      }
    }
    return std::max(0.0, largest - least);
  }

  /// All that was scored.
  [[nodiscard]] const std::vector<Candidate>& scored() const { return scored_; }

  /// Scores both ways along the axes: things with flat sides have peaks and pits there.
  void score_axes() {
    std::vector<Vec3> axes;
    for (Eigen::Index k = 0; k < 3; ++k) {
      axes.emplace_back(Vec3::Unit(k));
      axes.emplace_back(-Vec3::Unit(k));
    }
    score(axes);
  }

  /// Scores the highest peaks of the corrected estimates, then the highest of them, apart from each
  /// other and from all that was scored; corrects the estimates.
  void score_promising(std::size_t count, std::size_t peaks) {
    constexpr double kStays = std::numeric_limits<double>::infinity();
    std::vector<Candidate> all;
    for (const Candidate& one : scored_) {
      all.push_back({one.direction, kStays});
    }
    const std::vector<std::size_t> maxima = local_maxima(set_, corrected_);
    for (std::size_t i = 0; i < std::min(peaks, maxima.size()); ++i) {
      all.push_back({set_.directions[maxima[i]], std::numeric_limits<double>::max()});
    }
    for (std::size_t i = 0; i < corrected_.size(); ++i) {
      all.push_back({set_.directions[i], corrected_[i]});
    }
    std::vector<Vec3> directions;
    for (const Candidate& one : largest_apart(std::move(all), scored_.size() + count, apart_rad_)) {
      if (one.value < kStays) {
        directions.push_back(one.direction);
      }
    }
    score(directions);
    correct();
  }

 private:
  void score(const std::vector<Vec3>& directions) {
    const std::vector<double> values = target_.values(directions, 0);
    for (std::size_t i = 0; i < directions.size(); ++i) {
      scored_.push_back({directions[i], values[i]});
    }
  }

  /// Adds to each estimate what those near it that were scored are off by, in the mean.
  void correct() {
    std::vector<std::size_t> places;
    std::vector<double> errors;
    double mean = 0.0;
    for (const Candidate& one : scored_) {
      const auto at = std::find(set_.directions.begin(), set_.directions.end(), one.direction);
      const std::size_t place = static_cast<std::size_t>(at - set_.directions.begin());
      if (at != set_.directions.end() && std::isfinite(one.value - estimates_[place])) {
        places.push_back(place);
        errors.push_back(one.value - estimates_[place]);
        mean += errors.back();
      }
    }
    mean /= std::max(1.0, static_cast<double>(errors.size()));
    for (std::size_t i = 0; i < corrected_.size(); ++i) {
      double weights = kTrust;
      double sum = kTrust * mean;
      for (std::size_t k = 0; k < places.size(); ++k) {
        const double apart = (set_.directions[i] - set_.directions[places[k]]).norm() / kLikeRad;
        const double weight = std::exp(-0.5 * apart * apart);
        weights += weight;
        sum += weight * errors[k];
      }
      corrected_[i] = estimates_[i] + sum / weights;
    }
  }

  const SearchTarget& target_;
  double apart_rad_;
  DirectionSet set_;
  std::vector<double> estimates_, corrected_;
  std::vector<Candidate> scored_{};
};

/// The best of the ends of ascents by the proxy, by their scores.
std::vector<Candidate> best_by_score(const std::vector<Candidate>& ends,
                                     const SearchTarget& target) {
  std::vector<Vec3> directions;
  directions.reserve(ends.size());
  for (const Candidate& end : ends) {
    directions.push_back(end.direction);
  }
  const std::vector<double> values = target.values(directions, 0);
  std::vector<Candidate> scored;
  for (std::size_t i = 0; i < directions.size(); ++i) {
    scored.push_back({directions[i], values[i]});
  }
  return largest_apart(std::move(scored), kProxyEnds, 0.0);
}

/// Moves the candidates to where they end, the highest first.
std::vector<Candidate> ascended(std::vector<Candidate> candidates, const AscentRules& rules,
                                const SearchTarget& target, const RunContext& run) {
  ascend(candidates, rules, target, 1, run);
  const std::size_t count = candidates.size();
  return largest_apart(std::move(candidates), count, 0.0);
}

}  // namespace

Candidate search_globally(const SearchTarget& target, const RunContext& run) {
  const SearchTarget cheapest = target.has_proxy() ? target.by_proxy() : target;
  const double spacing_rad = half_spacing_rad(target.objective().survey_level);
  Survey survey(cheapest, 1.5 * spacing_rad, run.part(0.0, kSurveyed));
  survey.score_axes();
  survey.score_promising(2 * kBatch, kBatch);
  for (std::size_t batch = 0; batch < kBatches; ++batch) {
    survey.score_promising(kBatch, kBatch / 4);
  }
  AscentRules rules{.first_rad = std::max(spacing_rad, kFirstRingRad),
                    .last_rad = target.finest_deg() * kRadPerDeg,
                    .flat = kNotWorthARing * survey.range(),
                    .drops_losers = true};
  std::vector<Candidate> candidates =
      ascended(largest_apart(survey.scored(), target.objective().starts, kStartsApartRad), rules,
               cheapest, run.part(kSurveyed, kAscended));
  if (target.has_proxy()) {
    candidates =
        ascended(best_by_score(candidates, target), rules, target, run.part(kAscended, 1.0));
  }
  candidates.resize(1);
  // Where it is rough to the finest ring a second ascent, on another lattice, may gain.
  rules.first_rad = 0.5 * spacing_rad;
  for (double before = -std::numeric_limits<double>::infinity();
       candidates[0].value > before && candidates[0].spread >= rules.flat;) {
    before = candidates[0].value;
    candidates[0].place = {};
    ascend(candidates, rules, target, 1, run.quiet());
  }
  run.advance("search", 1.0);
  return candidates[0];
}

}  // namespace vantage
