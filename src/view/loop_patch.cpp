// SPDX-License-Identifier: MIT
#include "view/loop_patch.h"

#include <algorithm>
#include <map>

namespace vantage {
namespace {

using Edge = std::pair<std::uint32_t, std::uint32_t>;

constexpr std::uint32_t kUnknown = ~std::uint32_t{0};

}  // namespace

LoopPatch::LoopPatch(const DirectionSet& set, std::uint32_t centre)
    : directions_(set.directions), triangles_(set.triangles), centre_(centre) {
  trim();
}

std::vector<std::uint32_t> LoopPatch::ring_indices() const {
  std::vector<std::uint32_t> ring;
  for (const Triangle& t : triangles_) {
    if (std::find(t.begin(), t.end(), centre_) != t.end()) {
      std::copy_if(t.begin(), t.end(), std::back_inserter(ring),
                   [&](std::uint32_t v) { return v != centre_; });
    }
  }
  std::sort(ring.begin(), ring.end());
  ring.erase(std::unique(ring.begin(), ring.end()), ring.end());
  return ring;
}

void LoopPatch::trim() {
  std::vector<std::uint32_t> core = ring_indices();
  core.push_back(centre_);
  std::vector<std::uint32_t> new_of_old(directions_.size(), kUnknown);
  std::vector<std::uint8_t> in_core(directions_.size(), 0);
  for (const std::uint32_t v : core) {
    in_core[v] = 1;
  }
  std::vector<Triangle> kept;
  for (const Triangle& t : triangles_) {
    if (in_core[t[0]] != 0 || in_core[t[1]] != 0 || in_core[t[2]] != 0) {
      kept.push_back(t);
      for (const std::uint32_t v : t) {
        new_of_old[v] = 0;
      }
    }
  }
  // Renumber in the old order, so that order among the survivors never changes.
  std::vector<Vec3> directions;
  for (std::uint32_t v = 0; v < directions_.size(); ++v) {
    if (new_of_old[v] != kUnknown) {
      new_of_old[v] = static_cast<std::uint32_t>(directions.size());
      directions.push_back(directions_[v]);
    }
  }
  for (Triangle& t : kept) {
    t = {new_of_old[t[0]], new_of_old[t[1]], new_of_old[t[2]]};
  }
  centre_ = new_of_old[centre_];
  directions_ = std::move(directions);
  triangles_ = std::move(kept);
}

void LoopPatch::refine() {
  trim();
  // The corners opposite to each edge; both are inside the patch unless the edge is on its rim.
  std::map<Edge, std::vector<std::uint32_t>> opposite;
  for (const Triangle& t : triangles_) {
    for (std::size_t i = 0; i < 3; ++i) {
      opposite[std::minmax(t[i], t[(i + 1) % 3])].push_back(t[(i + 2) % 3]);
    }
  }
  std::map<Edge, std::uint32_t> point_of_edge;
  for (const auto& [edge, corners] : opposite) {
    if (corners.size() == 2) {
      point_of_edge[edge] = static_cast<std::uint32_t>(directions_.size());
      directions_.push_back(loop_edge_direction(directions_[edge.first], directions_[edge.second],
                                                directions_[corners[0]], directions_[corners[1]]));
    }
  }
  const auto point = [&](std::uint32_t a, std::uint32_t b) {
    const auto found = point_of_edge.find(std::minmax(a, b));
    return found == point_of_edge.end() ? kUnknown : found->second;
  };
  std::vector<Triangle> finer;
  for (const auto& [a, b, c] : triangles_) {
    const std::uint32_t ab = point(a, b);
    const std::uint32_t bc = point(b, c);
    const std::uint32_t ca = point(c, a);
    for (const Triangle& t :
         {Triangle{a, ab, ca}, Triangle{b, bc, ab}, Triangle{c, ca, bc}, Triangle{ab, bc, ca}}) {
      if (std::find(t.begin(), t.end(), kUnknown) == t.end()) {
        finer.push_back(t);
      }
    }
  }
  triangles_ = std::move(finer);
}

std::vector<Vec3> LoopPatch::ring() const {
  std::vector<Vec3> ring;
  for (const std::uint32_t v : ring_indices()) {
    ring.push_back(directions_[v]);
  }
  return ring;
}

void LoopPatch::move_to(std::size_t ring_index) {
  centre_ = ring_indices()[ring_index];
  trim();
}

}  // namespace vantage
