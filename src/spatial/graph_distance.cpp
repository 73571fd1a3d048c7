// SPDX-License-Identifier: MIT
#include "spatial/graph_distance.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace vantage {
namespace {

constexpr std::uint32_t kLeafSize = 4;
constexpr std::size_t kDeepest = 64;  // medians halve: a tree of 2^32 pieces is 32 deep
/// Graphs of so many segments are searched by parts of them, none longer than this share of the graph's
/// longest side: skeletons have shorter ones, only soups of faces do not. [ours]
constexpr std::size_t kCutFrom = 1000;
constexpr double kLongestPart = 1.0 / 16.0;
constexpr double kMostParts = 8.0;  // for each segment, in the mean. [ours]
constexpr double kCutMargin = 1e-12;

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
    const std::array<Vec3, 2> segment{graph.nodes[a], graph.nodes[b]};
    pieces_.push_back({segment, segment});
    has_edge[a] = true;
    has_edge[b] = true;
  }
  for (std::size_t i = 0; i < graph.nodes.size(); ++i) {
    if (!has_edge[i]) {
      const std::array<Vec3, 2> point{graph.nodes[i], graph.nodes[i]};
      pieces_.push_back({point, point});
    }
  }
  cut_long_segments();
  boxes_.emplace_back();
  build(0, 0, static_cast<std::uint32_t>(pieces_.size()));
}

void GraphDistance::cut_long_segments() {
  if (pieces_.size() < kCutFrom) {
    return;
  }
  Vec3 low = pieces_.front().part[0];
  Vec3 high = low;
  double length_of_all = 0.0;
  for (const Piece& piece : pieces_) {
    for (const Vec3& p : piece.part) {
      low = low.cwiseMin(p);
      high = high.cwiseMax(p);
    }
    length_of_all += (piece.part[1] - piece.part[0]).norm();
  }
  const double longest =
      std::max(kLongestPart * (high - low).maxCoeff(),
               length_of_all / (kMostParts * static_cast<double>(pieces_.size())));
  // Boxes must hold their part of the segment whatever rounding does to where it is cut.
  const Vec3 margin = Vec3::Constant(kCutMargin * (high - low).maxCoeff());
  const std::size_t count = pieces_.size();
  for (std::size_t i = 0; i < count; ++i) {
    const auto [a, b] = pieces_[i].segment;
    const double length = (b - a).norm();
    if (!(length > longest)) {
      continue;
    }
    const int parts = static_cast<int>(std::ceil(length / longest));
    for (int k = 0; k < parts; ++k) {
      const Vec3 from = a + (static_cast<double>(k) / parts) * (b - a);
      const Vec3 to = a + (static_cast<double>(k + 1) / parts) * (b - a);
      Piece piece{{from.cwiseMin(to) - margin, from.cwiseMax(to) + margin}, {a, b}};
      if (k == 0) {
        pieces_[i] = piece;
      } else {
        pieces_.push_back(piece);
      }
    }
  }
}

void GraphDistance::build(std::uint32_t box, std::uint32_t begin, std::uint32_t end) {
  Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity());
  Vec3 high = -low;
  for (std::uint32_t i = begin; i < end; ++i) {
    for (const Vec3& p : pieces_[i].part) {
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
  std::nth_element(pieces_.begin() + begin, pieces_.begin() + middle, pieces_.begin() + end,
                   [axis](const Piece& s, const Piece& t) {
                     return s.part[0][axis] + s.part[1][axis] < t.part[0][axis] + t.part[1][axis];
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
    const auto& [a, b] = pieces_[i].segment;
    nearest = std::min(nearest, segment_distance_squared(point, a, b));
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
