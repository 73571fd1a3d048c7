// SPDX-License-Identifier: MIT
#include "view/local_ascent.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>
#include <utility>

#include <Eigen/Geometry>

#include "vantage/mesh/topology.h"

#include "view/sphere_angles.h"

namespace vantage {
namespace {

bool is_larger(const Candidate& a, const Candidate& b) {
  return a.value > b.value;
}

/// The ring of six around a candidate, on its lattice, which begins here if there is none.
std::vector<Candidate> candidate_ring(Candidate& candidate, double width_rad) {
  constexpr std::array<std::array<double, 2>, 6> kSteps{
      {{1.0, 0.0}, {0.0, 1.0}, {-1.0, 1.0}, {-1.0, 0.0}, {0.0, -1.0}, {1.0, -1.0}}};
  LatticePlace& at = candidate.place;
  if (at.width_rad == 0.0) {
    at = {candidate.direction, width_rad, 0.0, 0.0};
  }
  const Vec3 right = at.start.unitOrthogonal();
  const Vec3 up = at.start.cross(right);
  const double step = width_rad / at.width_rad;
  std::vector<Candidate> ring;
  ring.reserve(kSteps.size());
  for (const auto& [along, aslant] : kSteps) {
    LatticePlace next = at;
    next.along += step * along;
    next.aslant += step * aslant;
    const double x = next.along + 0.5 * next.aslant;
    const double y = 0.5 * std::numbers::sqrt3 * next.aslant;
    const Vec3 direction = at.start + at.width_rad * (x * right + y * up);
    const bool is_start = next.along == 0.0 && next.aslant == 0.0;
    ring.push_back({is_start ? at.start : direction.normalized(), 0.0, next});
  }
  return ring;
}

/// One candidate on its way.
struct Climb {
  Candidate* at;
  double width_rad;  // of the next ring
  bool is_over = false;
};

/// Moves to the largest of the ring, or halves it.
void step(Climb& climb, std::span<const Candidate> ring, double flat) {
  const auto [least, largest] =
      std::minmax_element(ring.begin(), ring.end(),
                          [](const Candidate& a, const Candidate& b) { return a.value < b.value; });
  const double here = climb.at->value;
  const double spread = std::max(here, largest->value) - std::min(here, least->value);
  if (largest->value > here) {
    *climb.at = *std::find_if(ring.begin(), ring.end(), [top = largest->value](const Candidate& c) {
      return c.value == top;
    });
  } else {
    climb.width_rad *= 0.5;
    climb.is_over = spread < flat;
  }
  climb.at->spread = spread;
}

/// Whether another climb is as high, and so near that both would go on alike. Of equals the first goes on.
bool is_caught_up_by(const Climb& climb, const Climb& other) {
  const bool is_lesser =
      &other < &climb ? climb.at->value <= other.at->value : climb.at->value < other.at->value;
  return is_lesser && angle_between(climb.at->direction, other.at->direction) <
                          std::min(climb.width_rad, other.width_rad);
}

/// Ends what the rules end.
void end_some(std::vector<Climb>& climbs, const AscentRules& rules) {
  const Candidate& best = *std::max_element(climbs.begin(), climbs.end(), [](auto& a, auto& b) {
                             return a.at->value < b.at->value;
                           })->at;
  for (Climb& climb : climbs) {
    climb.is_over |= climb.width_rad < rules.last_rad;
    if (rules.drops_losers && climb.at != &best) {
      climb.is_over |= climb.at->value + climb.at->spread < best.value;
      climb.is_over |= std::any_of(climbs.begin(), climbs.end(), [&](const Climb& other) {
        return is_caught_up_by(climb, other);
      });
    }
  }
}

}  // namespace

std::size_t index_of_largest(const std::vector<double>& values) {
  return static_cast<std::size_t>(std::max_element(values.begin(), values.end()) - values.begin());
}

std::vector<std::size_t> local_maxima(const DirectionSet& set, const std::vector<double>& values) {
  const auto exceeds = [&](std::size_t a, std::size_t b) {
    return values[a] > values[b] || (values[a] == values[b] && a < b);
  };
  const IndexLists rings =
      vertex_neighbours({.positions = set.directions, .triangles = set.triangles});
  std::vector<std::size_t> maxima;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const auto ring = rings[i];
    if (std::all_of(ring.begin(), ring.end(), [&](std::uint32_t j) { return exceeds(i, j); })) {
      maxima.push_back(i);
    }
  }
  std::sort(maxima.begin(), maxima.end(), exceeds);
  return maxima;
}

std::vector<Candidate> largest_apart(std::vector<Candidate> candidates, std::size_t count,
                                     double apart_rad) {
  std::stable_sort(candidates.begin(), candidates.end(), is_larger);
  const double nearest = std::cos(apart_rad);
  std::vector<Candidate> chosen;
  for (const Candidate& one : candidates) {
    const bool is_near = std::any_of(chosen.begin(), chosen.end(), [&](const Candidate& other) {
      return other.direction.dot(one.direction) > nearest;
    });
    if (!is_near && chosen.size() < count) {
      chosen.push_back(one);
    }
  }
  return chosen;
}

void ascend(std::vector<Candidate>& candidates, const AscentRules& rules,
            const SearchTarget& target, int level, const RunContext& run) {
  std::vector<Climb> climbs;
  climbs.reserve(candidates.size());
  for (Candidate& one : candidates) {
    climbs.push_back({&one, rules.first_rad});
  }
  double done = 0.0;
  for (;; ++level) {
    end_some(climbs, rules);
    std::vector<Climb*> active;
    std::vector<Candidate> around;
    std::vector<Vec3> directions;
    double widest = 0.0;
    for (Climb& climb : climbs) {
      if (!climb.is_over) {
        active.push_back(&climb);
        widest = std::max(widest, climb.width_rad);
        for (Candidate& one : candidate_ring(*climb.at, climb.width_rad)) {
          directions.push_back(one.direction);
          around.push_back(std::move(one));
        }
      }
    }
    if (active.empty()) {
      return;
    }
    // Each round halves a ring or moves it: progress follows the logarithm of the widest.
    done = std::max(done, std::log(rules.first_rad / widest) /
                              std::log(2.0 * rules.first_rad / rules.last_rad));
    run.advance("search", done);
    const std::vector<double> values = target.values(directions, level);
    for (std::size_t i = 0; i < around.size(); ++i) {
      around[i].value = values[i];
    }
    const std::size_t ring_size = around.size() / active.size();
    for (std::size_t k = 0; k < active.size(); ++k) {
      step(*active[k], std::span(around).subspan(k * ring_size, ring_size), rules.flat);
    }
  }
}

}  // namespace vantage
