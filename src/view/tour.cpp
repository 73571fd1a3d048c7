// SPDX-License-Identifier: MIT
#include <algorithm>
#include <limits>

#include "vantage/core/error.h"
#include "vantage/view/view_set.h"

#include "core/unit_direction.h"
#include "view/sphere_angles.h"

namespace vantage {
namespace {

// Up to here exactly: 2^11 · 11 · 11 steps. [ours]
constexpr std::size_t kExactCount = 12;
// A move must shorten the round by more than rounding, radians.
constexpr double kLeastSaving = 1e-12;
constexpr std::size_t kLongestRun = 3;

using Order = std::vector<std::size_t>;

class Distances {
 public:
  explicit Distances(std::span<const Vec3> directions)
      : count_(directions.size()), angles_(count_ * count_, 0.0) {
    std::vector<Vec3> units(directions.begin(), directions.end());
    std::ranges::transform(units, units.begin(), unit_direction);
    for (std::size_t i = 0; i < count_; ++i) {
      for (std::size_t j = 0; j < count_; ++j) {
        angles_[i * count_ + j] = angle_between(units[i], units[j]);
      }
    }
  }

  double operator()(std::size_t i, std::size_t j) const { return angles_[i * count_ + j]; }

  [[nodiscard]] std::size_t count() const { return count_; }

  [[nodiscard]] double length(const Order& order) const {
    double sum = 0.0;
    for (std::size_t i = 0; i < order.size(); ++i) {
      sum += (*this)(order[i], order[(i + 1) % order.size()]);
    }
    return sum;
  }

 private:
  std::size_t count_;
  std::vector<double> angles_;
};

/// Held and Karp: least way from 0 through each subset of 1 … n−1 to each of its members.
Order exact_round(const Distances& distance) {
  const std::size_t others = distance.count() - 1;
  const std::size_t subsets = std::size_t{1} << others;
  std::vector<double> way(subsets * others, std::numeric_limits<double>::infinity());
  std::vector<std::size_t> before(subsets * others, others);
  for (std::size_t last = 0; last < others; ++last) {
    way[(std::size_t{1} << last) * others + last] = distance(0, last + 1);
  }
  for (std::size_t subset = 1; subset < subsets; ++subset) {
    for (std::size_t last = 0; last < others; ++last) {
      const double here = way[subset * others + last];
      if (((subset >> last) & 1U) == 0) {
        continue;
      }
      for (std::size_t next = 0; next < others; ++next) {
        if (((subset >> next) & 1U) != 0) {
          continue;
        }
        const std::size_t at = (subset | (std::size_t{1} << next)) * others + next;
        const double there = here + distance(last + 1, next + 1);
        if (there < way[at]) {
          way[at] = there;
          before[at] = last;
        }
      }
    }
  }
  std::size_t subset = subsets - 1;
  std::size_t last = 0;
  for (std::size_t end = 1; end < others; ++end) {
    const double best = way[subset * others + last] + distance(last + 1, 0);
    if (way[subset * others + end] + distance(end + 1, 0) < best) {
      last = end;
    }
  }
  Order order;
  while (last != others) {
    order.push_back(last + 1);
    const std::size_t previous = before[subset * others + last];
    subset &= ~(std::size_t{1} << last);
    last = previous;
  }
  order.push_back(0);
  std::reverse(order.begin(), order.end());
  return order;
}

Order nearest_neighbour_round(const Distances& distance) {
  Order order{0};
  std::vector<bool> visited(distance.count(), false);
  visited[0] = true;
  while (order.size() < distance.count()) {
    std::size_t nearest = distance.count();
    for (std::size_t i = 0; i < distance.count(); ++i) {
      if (!visited[i] && (nearest == distance.count() ||
                          distance(order.back(), i) < distance(order.back(), nearest))) {
        nearest = i;
      }
    }
    visited[nearest] = true;
    order.push_back(nearest);
  }
  return order;
}

/// Reverses a run wherever that shortens the round; true if anything changed.
bool two_opt(Order& order, const Distances& distance) {
  bool changed = false;
  const std::size_t n = order.size();
  for (std::size_t i = 0; i + 2 < n; ++i) {
    for (std::size_t j = i + 2; j < n; ++j) {
      const std::size_t after = order[(j + 1) % n];
      const double saving = distance(order[i], order[i + 1]) + distance(order[j], after) -
                            distance(order[i], order[j]) - distance(order[i + 1], after);
      if (saving > kLeastSaving) {
        std::reverse(order.begin() + static_cast<std::ptrdiff_t>(i + 1),
                     order.begin() + static_cast<std::ptrdiff_t>(j + 1));
        changed = true;
      }
    }
  }
  return changed;
}

/// Moves one run of up to three to another place, either way round, if that shortens the round.
bool move_run(Order& order, const Distances& distance) {
  const std::size_t n = order.size();
  for (std::size_t length = 1; length <= kLongestRun && length + 2 <= n; ++length) {
    for (std::size_t first = 1; first + length <= n; ++first) {
      const std::size_t head = order[first];
      const std::size_t tail = order[first + length - 1];
      const std::size_t left = order[first - 1];
      const std::size_t right = order[(first + length) % n];
      const double freed = distance(left, head) + distance(tail, right) - distance(left, right);
      Order rest = order;
      const auto begin = rest.begin() + static_cast<std::ptrdiff_t>(first);
      const Order run(begin, begin + static_cast<std::ptrdiff_t>(length));
      rest.erase(begin, begin + static_cast<std::ptrdiff_t>(length));
      for (std::size_t at = 0; at < rest.size(); ++at) {
        const std::size_t a = rest[at];
        const std::size_t b = rest[(at + 1) % rest.size()];
        const double straight = distance(a, head) + distance(tail, b) - distance(a, b);
        const double turned = distance(a, tail) + distance(head, b) - distance(a, b);
        if (freed - std::min(straight, turned) > kLeastSaving) {
          Order piece = run;
          if (turned < straight) {
            std::reverse(piece.begin(), piece.end());
          }
          rest.insert(rest.begin() + static_cast<std::ptrdiff_t>(at + 1), piece.begin(),
                      piece.end());
          order = std::move(rest);
          return true;
        }
      }
    }
  }
  return false;
}

Order improved_round(const Distances& distance, const RunContext& run) {
  Order order = nearest_neighbour_round(distance);
  bool changed = true;
  while (changed) {
    run.check();
    changed = two_opt(order, distance);
    changed = changed || move_run(order, distance);
  }
  return order;
}

}  // namespace

Tour shortest_tour(std::span<const Vec3> directions, const RunContext& run) {
  if (directions.empty()) {
    throw InvalidInput("a tour needs at least one view");
  }
  const Distances distance(directions);
  Tour tour;
  tour.optimal = directions.size() <= kExactCount;
  if (directions.size() == 1) {
    tour.order = {0};
  } else {
    tour.order = tour.optimal ? exact_round(distance) : improved_round(distance, run);
  }
  const auto second = tour.order.begin() + 1;
  if (tour.order.size() > 2 && *second > tour.order.back()) {
    std::reverse(second, tour.order.end());
  }
  tour.length_rad = distance.length(tour.order);
  return tour;
}

}  // namespace vantage
