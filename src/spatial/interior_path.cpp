// SPDX-License-Identifier: MIT
#include "spatial/interior_path.h"

#include <algorithm>
#include <array>
#include <functional>
#include <limits>
#include <queue>
#include <tuple>

namespace vantage {
namespace {

/// Depths of the points below a vertex, in parts of the wall [ours]: the middle, where a curve
/// skeleton belongs, and two that follow the surface ever more closely where middles do not see
/// each other.
constexpr std::array kDepths{0.5, 0.15, 0.03};
/// A step towards a point costs its length times this: leaving the middle must save a third of the
/// way, or three fifths [ours].
constexpr std::array kCosts{1.0, 1.5, 2.5};
constexpr std::uint32_t kLevels = kDepths.size();
constexpr std::uint32_t kNowhere = std::numeric_limits<std::uint32_t>::max();

/// One search: first what is on the shortest way if all is free from there on (A*). A step is only
/// looked at when it would be taken, since looking is what costs.
class Search {
 public:
  Search(const Shell& shell, const IndexLists& neighbours, std::uint32_t component)
      : shell_(shell), neighbours_(neighbours), component_(component) {}

  /// Adds the points below a vertex. \pre ascending.
  void add(std::uint32_t vertex, const Vec3& position, const Vec3& wall) {
    vertices_.push_back(vertex);
    for (const double depth : kDepths) {
      places_.push_back(position + depth * wall);
    }
  }

  /// \param looks steps that may be looked at; what is left of them is given back.
  std::optional<std::vector<Vec3>> run(const Vec3& a, const Vec3& b, std::size_t& looks) {
    start_ = static_cast<std::uint32_t>(places_.size());
    goal_ = start_ + 1;
    places_.push_back(a);
    places_.push_back(b);
    came_from_.assign(places_.size(), kNowhere);
    came_from_[start_] = start_;
    for (std::uint32_t point = 0; point < start_; ++point) {
      offer(0.0, start_, point);
    }
    while (!queue_.empty()) {
      const auto [promise, to, from, cost] = queue_.top();
      queue_.pop();
      if (came_from_[to] != kNowhere) {
        continue;
      }
      if (looks == 0) {
        return std::nullopt;
      }
      --looks;
      if (!shell_.inside(component_, places_[from], places_[to])) {
        continue;
      }
      came_from_[to] = from;
      if (to == goal_) {
        return pulled_tight();
      }
      leave(cost, to);
    }
    return std::nullopt;
  }

 private:
  /// Cost up to its end and the distance from there to the goal; to; from; cost up to its end.
  using Step = std::tuple<double, std::uint32_t, std::uint32_t, double>;

  void offer(double cost, std::uint32_t from, std::uint32_t to) {
    if (came_from_[to] == kNowhere) {
      const double factor = to < start_ ? kCosts.at(to % kLevels) : 1.0;
      const double there = cost + factor * (places_[to] - places_[from]).norm();
      queue_.emplace(there + (places_[goal_] - places_[to]).norm(), to, from, there);
    }
  }

  void leave(double cost, std::uint32_t point) {
    const std::uint32_t here = point / kLevels;
    const auto offer_all = [&](std::uint32_t local) {
      for (std::uint32_t level = 0; level < kLevels; ++level) {
        offer(cost, point, local * kLevels + level);
      }
    };
    offer_all(here);
    for (const std::uint32_t v : neighbours_[vertices_[here]]) {
      const auto found = std::lower_bound(vertices_.begin(), vertices_.end(), v);
      if (found != vertices_.end() && *found == v) {
        offer_all(static_cast<std::uint32_t>(found - vertices_.begin()));
      }
    }
    offer(cost, point, goal_);
  }

  /// The way found, less the points that it need not go through.
  [[nodiscard]] std::vector<Vec3> pulled_tight() const {
    std::vector<Vec3> way;
    for (std::uint32_t point = goal_; point != start_; point = came_from_[point]) {
      way.push_back(places_[point]);
    }
    way.push_back(places_[start_]);
    std::reverse(way.begin(), way.end());
    std::vector<Vec3> corners;
    for (std::size_t i = 0; i + 1 < way.size();) {
      std::size_t next = way.size() - 1;
      while (next > i + 1 && !shell_.inside(component_, way[i], way[next])) {
        --next;
      }
      if (next + 1 < way.size()) {
        corners.push_back(way[next]);
      }
      i = next;
    }
    return corners;
  }

  const Shell& shell_;
  const IndexLists& neighbours_;
  std::uint32_t component_;
  std::vector<std::uint32_t> vertices_{};  ///< Ascending.
  std::vector<Vec3> places_{};             ///< kLevels a vertex, then start and goal.
  std::vector<std::uint32_t> came_from_{};
  std::uint32_t start_ = 0;
  std::uint32_t goal_ = 0;
  std::priority_queue<Step, std::vector<Step>, std::greater<>> queue_{};
};

}  // namespace

InteriorPaths::InteriorPaths(const TriMesh& mesh, const Shell& shell)
    : mesh_(mesh),
      shell_(shell),
      neighbours_(shell.neighbours()),
      wall_is_(mesh.positions.size(), Wall::Unknown),
      wall_(mesh.positions.size(), Vec3::Zero()) {}

const Vec3* InteriorPaths::wall_at(std::uint32_t vertex) {
  if (wall_is_[vertex] == Wall::Unknown) {
    const std::optional<Vec3> wall = shell_.wall_at(vertex);
    wall_is_[vertex] = wall ? Wall::Known : Wall::None;
    wall_[vertex] = wall.value_or(Vec3::Zero());
  }
  return wall_is_[vertex] == Wall::Known ? &wall_[vertex] : nullptr;
}

std::optional<std::vector<Vec3>> InteriorPaths::find(std::uint32_t component, const Vec3& a,
                                                     const Vec3& b,
                                                     std::span<const std::uint32_t> vertices) {
  if (is_spent() || vertices.size() > vertices_left_) {
    return std::nullopt;
  }
  vertices_left_ -= vertices.size();
  std::vector<std::uint32_t> sorted(vertices.begin(), vertices.end());
  std::sort(sorted.begin(), sorted.end());
  const std::size_t allowed = std::min(kMostLooks, looks_left_);
  std::size_t left = allowed;
  Search search(shell_, neighbours_, component);
  for (const std::uint32_t v : sorted) {
    if (const Vec3* wall = wall_at(v)) {
      search.add(v, mesh_.positions[v], *wall);
    }
  }
  auto way = search.run(a, b, left);
  looks_left_ -= allowed - left;
  return way;
}

}  // namespace vantage
