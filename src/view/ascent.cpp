// SPDX-License-Identifier: MIT
#include "view/ascent.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "view/sphere_angles.h"

namespace vantage {
namespace {

constexpr double kWidestRingRad = 1.0 * kRadPerDeg;  // of a climb; each climb halves it. [ours]
// Finer climbs go amid the ring before, and from so many on amid the same: the next disputes so few
// vertices that preparing it does not pay. [ours]
constexpr std::size_t kCircles = 2;

/// A place on a hill that is climbed.
struct Hill {
  Candidate top;
  Circles circles{};  ///< In whose midst nearby scores are asked for, once there are any.
};

/// Hills are rough: places climb by rings, and the fewer are left the finer.
class Ascent {
 public:
  Ascent(const Guides& guides, Goal goal, const std::vector<Candidate>& tops, double noise);

  Candidate climb_finely(const RunContext& run);

 private:
  void keep_apart(std::size_t count, double apart_rad);
  void climb_in_turn(const RingSteps& rings, const RunContext& run);
  void climb_exactly(const RingSteps& rings, int level, const RunContext& run);
  void climb_nearby(const RingSteps& rings, const RunContext& run);
  void approach(double ring_rad);

  const Guides& guides_;
  Goal goal_;
  const Pursuit& pursuit_;
  double hope_;                // of what a first climb gains
  std::vector<Hill> hills_{};  // best first
};

Ascent::Ascent(const Guides& guides, Goal goal, const std::vector<Candidate>& tops, double noise)
    : guides_(guides),
      goal_(goal),
      pursuit_(guides.effort.to(goal)),
      hope_(noise > 0.0 ? pursuit_.hope * noise : std::numeric_limits<double>::infinity()) {
  for (const Candidate& top : tops) {
    hills_.push_back({top});
  }
}

/// Two places within one ring have climbed to the same top, or would.
void Ascent::keep_apart(std::size_t count, double apart_rad) {
  const double limit = std::cos(apart_rad);
  std::vector<Hill> kept;
  for (Hill& hill : hills_) {
    const bool taken = std::any_of(kept.begin(), kept.end(), [&](const Hill& other) {
      return other.top.direction.dot(hill.top.direction) > limit;
    });
    if (!taken && kept.size() < count) {
      kept.push_back(std::move(hill));
    }
  }
  hills_ = std::move(kept);
}

/// One after the other, the best first, but for those too low to become the highest.
void Ascent::climb_in_turn(const RingSteps& rings, const RunContext& run) {
  const double sign = goal_ == Goal::Best ? 1.0 : -1.0;
  double highest = -std::numeric_limits<double>::infinity();
  std::vector<Hill> climbed;
  for (Hill& hill : hills_) {
    if (climbed.empty() || sign * hill.top.score + hope_ > highest) {
      std::vector<Candidate> top{hill.top};
      climb(top, goal_, rings, guides_.exact, 1, run);
      hill.top = top.front();
      highest = std::max(highest, sign * hill.top.score);
      climbed.push_back(std::move(hill));
    }
  }
  hills_ = std::move(climbed);
}

void Ascent::climb_exactly(const RingSteps& rings, int level, const RunContext& run) {
  std::vector<Candidate> tops;
  for (const Hill& hill : hills_) {
    tops.push_back(hill.top);
  }
  climb(tops, goal_, rings, guides_.exact, level, run);
  for (std::size_t i = 0; i < tops.size(); ++i) {
    hills_[i].top = tops[i];
  }
}

/// Makes each place and the ring around it, all of them scored by now, those in whose midst it climbs
/// on.
void Ascent::approach(double ring_rad) {
  std::vector<Circles> amid;
  for (Hill& hill : hills_) {
    if (hill.circles.size() < kCircles) {
      std::vector<Vec3> circle{hill.top.direction};
      for (const Candidate& place : ring_of(hill.top, ring_rad)) {
        circle.push_back(place.direction);
      }
      hill.circles.push_back(std::move(circle));
      amid.push_back(hill.circles);
    }
  }
  if (guides_.expect_nearby) {
    guides_.expect_nearby(amid);
  }
  for (Hill& hill : hills_) {
    hill.top.score = guides_.nearby(hill.circles, {hill.top.direction}).front();
  }
}

void Ascent::climb_nearby(const RingSteps& rings, const RunContext& run) {
  if (hills_.front().circles.size() < kCircles) {  // like all others
    approach(2.0 * rings.first_rad);
  }
  for (Hill& hill : hills_) {
    const ScoreBatch score = [&](const std::vector<Vec3>& directions) {
      return guides_.nearby(hill.circles, directions);
    };
    Evaluator evaluator(score);
    std::vector<Candidate> top{hill.top};
    climb(top, goal_, rings, evaluator, 0, run);
    hill.top = top.front();
  }
}

Candidate Ascent::climb_finely(const RunContext& run) {
  const std::size_t count = pursuit_.places.size();
  Candidate best_scored = hills_.front().top;
  double ring_rad = kWidestRingRad;
  for (std::size_t k = 0; k < count && pursuit_.places[k] > 0; ++k, ring_rad *= 0.5) {
    keep_apart(pursuit_.places[k], ring_rad);
    const bool is_last = k + 1 == count || pursuit_.places[k + 1] == 0;
    const RingSteps rings{ring_rad,
                          is_last ? std::min(ring_rad, guides_.effort.finest_rad) : ring_rad};
    const RunContext part = run.part(static_cast<double>(k) / static_cast<double>(count),
                                     static_cast<double>(k + 1) / static_cast<double>(count));
    if (k == 0) {
      climb_in_turn(rings, part);
    } else if (guides_.nearby) {
      climb_nearby(rings, part);
    } else {
      climb_exactly(rings, static_cast<int>(k) + 1, part);
    }
    std::stable_sort(hills_.begin(), hills_.end(), [&](const Hill& one, const Hill& other) {
      return is_better(goal_, one.top.score, other.top.score);
    });
    if (k == 0) {
      best_scored = hills_.front().top;
    }
  }
  Candidate found = hills_.front().top;
  found.score = guides_.exact.scores({found.direction}, static_cast<int>(count)).front();
  return is_better(goal_, best_scored.score, found.score) ? best_scored : found;
}

}  // namespace

Candidate climb_hills(const Guides& guides, Goal goal, const std::vector<Candidate>& tops,
                      double noise, const RunContext& run) {
  return Ascent(guides, goal, tops, noise).climb_finely(run);
}

}  // namespace vantage
