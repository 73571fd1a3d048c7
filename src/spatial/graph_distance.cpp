// SPDX-License-Identifier: MIT
#include "spatial/graph_distance.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace vantage {
namespace {

constexpr std::uint32_t kLeafSize = 4;
constexpr std::size_t kDeepest = 64;  // medians halve: a tree of 2^32 segments is 32 deep

double segment_distance_squared(const Vec3& p, const Vec3& a, const Vec3& b) {
  const Vec3 ab = b - a;
  const double length_squared = ab.squaredNorm();
  const double s =
      length_squared > 0.0 ? std::clamp((p - a).dot(ab) / length_squared, 0.0, 1.0) : 0.0;
  return (p - (a + s * ab)).squaredNorm();
}

}  // namespace

GraphDistance::GraphDistance(const CurveGraph& graph) {
  std::vector<bool> has_edge(graph.nodes.size(), false);
  for (const auto& [a, b] : graph.edges) {
    segments_.push_back({graph.nodes[a], graph.nodes[b]});
    has_edge[a] = true;
    has_edge[b] = true;
  }
  for (std::size_t i = 0; i < graph.nodes.size(); ++i) {
    if (!has_edge[i]) {
      segments_.push_back({graph.nodes[i], graph.nodes[i]});
    }
  }
  boxes_.emplace_back();
  build(0, 0, static_cast<std::uint32_t>(segments_.size()));
}

void GraphDistance::build(std::uint32_t box, std::uint32_t begin, std::uint32_t end) {
  Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity());
  Vec3 high = -low;
  for (std::uint32_t i = begin; i < end; ++i) {
    for (const Vec3& p : segments_[i]) {
      low = low.cwiseMin(p);
      high = high.cwiseMax(p);
    }
  }
  boxes_[box] = {low, high, begin, end - begin};
  if (end - begin <= kLeafSize) {
    return;
  }
  Eigen::Index axis = 0;
  (high - low).maxCoeff(&axis);
  const std::uint32_t middle = begin + (end - begin) / 2;
  std::nth_element(segments_.begin() + begin, segments_.begin() + middle, segments_.begin() + end,
                   [axis](const auto& s, const auto& t) {
                     return s[0][axis] + s[1][axis] < t[0][axis] + t[1][axis];
                   });
  const auto left = static_cast<std::uint32_t>(boxes_.size());
  boxes_.resize(boxes_.size() + 2);
  boxes_[box].first = left;
  boxes_[box].count = 0;
  build(left, begin, middle);
  build(left + 1, middle, end);
}

double GraphDistance::leaf_distance_squared(const Box& box, const Vec3& point) const {
  double nearest = std::numeric_limits<double>::infinity();
  for (std::uint32_t i = box.first; i < box.first + box.count; ++i) {
    nearest = std::min(nearest, segment_distance_squared(point, segments_[i][0], segments_[i][1]));
  }
  return nearest;
}

double GraphDistance::operator()(const Vec3& point) const {
  const auto to_box = [&](std::uint32_t i) {
    const Box& box = boxes_[i];
    return (box.low - point).cwiseMax(point - box.high).cwiseMax(0.0).squaredNorm();
  };
  double nearest = std::numeric_limits<double>::infinity();
  std::array<std::uint32_t, kDeepest> stack{};
  std::size_t depth = 1;  // the root
  while (depth > 0) {
    const std::uint32_t i = stack[--depth];
    if (to_box(i) >= nearest) {
      continue;
    }
    const Box& box = boxes_[i];
    if (box.count > 0) {
      nearest = std::min(nearest, leaf_distance_squared(box, point));
      continue;
    }
    const bool left_first = to_box(box.first) <= to_box(box.first + 1);
    stack[depth++] = left_first ? box.first + 1 : box.first;
    stack[depth++] = left_first ? box.first : box.first + 1;
  }
  return std::sqrt(nearest);
}

}  // namespace vantage
