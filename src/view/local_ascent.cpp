// SPDX-License-Identifier: MIT
#include "view/local_ascent.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include <Eigen/Geometry>

#include "vantage/mesh/topology.h"

namespace vantage {
namespace {

bool is_larger(const Candidate& a, const Candidate& b) {
  return a.value > b.value;
}

/// The ring of six around a candidate, on its lattice, which begins here if there is none.
std::vector<Candidate> ring_around(Candidate& candidate, double width_rad) {
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

void ascend(std::vector<Candidate>& candidates, const RingWidths& rings, const SearchTarget& target,
            int level, const RunContext& run) {
  std::vector<double> width(candidates.size(), rings.first_rad);
  double done = 0.0;
  for (;; ++level) {
    std::vector<Candidate> around;
    std::vector<Vec3> directions;
    std::vector<std::size_t> active;
    for (std::size_t i = 0; i < candidates.size(); ++i) {
      if (width[i] >= rings.last_rad) {
        active.push_back(i);
        for (Candidate& one : ring_around(candidates[i], width[i])) {
          directions.push_back(one.direction);
          around.push_back(std::move(one));
        }
      }
    }
    if (active.empty()) {
      return;
    }
    const double widest = *std::max_element(width.begin(), width.end());
    // Each round halves a ring or moves it: progress follows the logarithm of the widest.
    done = std::max(done, std::log(rings.first_rad / widest) /
                              std::log(2.0 * rings.first_rad / rings.last_rad));
    run.advance("search", done);
    const std::vector<double> values = target.values(directions, level);
    const std::size_t ring_size = around.size() / active.size();
    for (std::size_t k = 0; k < active.size(); ++k) {
      std::size_t largest = k * ring_size;
      for (std::size_t i = k * ring_size; i < (k + 1) * ring_size; ++i) {
        around[i].value = values[i];
        largest = values[i] > values[largest] ? i : largest;
      }
      Candidate& here = candidates[active[k]];
      if (around[largest].value > here.value) {
        here = around[largest];
      } else {
        width[active[k]] *= 0.5;
      }
    }
  }
}

}  // namespace vantage
