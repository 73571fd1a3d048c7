// SPDX-License-Identifier: MIT
#include "skeleton/curve_fitting.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <map>
#include <utility>
#include <vector>

#include "spatial/nearest_point.h"

namespace vantage {
namespace {

/// Rounds of assigning points to nodes and moving nodes [ours: more move nothing].
constexpr int kRounds = 6;
/// An end is led on by so many pieces at most.
constexpr double kFarthestEnd = 4.0;
constexpr double kMostPieces = 1000.0;  // of an edge
/// All edges have so many pieces at most, beside one for each: as many as the first, or the second for
/// each point. Needles as long as the model would have thousands of pieces a vertex [ours].
constexpr double kAlwaysAllowed = 100'000.0;
constexpr double kMostAPoint = 4.0;
/// A node of more candidates for its points is a hub, at which a tree pays.
constexpr std::size_t kHub = 32;

/// The length of pieces that are no shorter than `piece` and not too many.
double longest_piece(const CurveGraph& graph, double piece, std::size_t points) {
  double pieces = 0.0;
  for (const auto& [a, b] : graph.edges) {
    pieces += std::min((graph.nodes[b] - graph.nodes[a]).norm() / piece, kMostPieces);
  }
  const double most = std::max(kAlwaysAllowed, kMostAPoint * static_cast<double>(points));
  return pieces > most ? piece * (pieces / most) : piece;
}

/// A graph cut into pieces, and which of its nodes may stand for a point of a node of the first.
class FinerCurve {
 public:
  FinerCurve(const CurveGraph& graph, double piece)
      : curve_{graph.nodes, {}}, near_(graph.nodes.size()) {
    for (std::uint32_t i = 0; i < near_.size(); ++i) {
      near_[i].push_back(i);
    }
    for (const auto& [a, b] : graph.edges) {
      const double length = (graph.nodes[b] - graph.nodes[a]).norm();
      const auto pieces =
          static_cast<std::size_t>(std::clamp(std::ceil(length / piece), 1.0, kMostPieces));
      std::uint32_t previous = a;
      for (std::size_t k = 1; k < pieces; ++k) {
        const double share = static_cast<double>(k) / static_cast<double>(pieces);
        const auto node = static_cast<std::uint32_t>(curve_.nodes.size());
        curve_.nodes.emplace_back(graph.nodes[a] + share * (graph.nodes[b] - graph.nodes[a]));
        near_[a].push_back(node);
        near_[b].push_back(node);
        curve_.edges.push_back({previous, node});
        previous = node;
      }
      curve_.edges.push_back({std::min(previous, b), std::max(previous, b)});
    }
    std::sort(curve_.edges.begin(), curve_.edges.end());
    neighbours_ = node_neighbours(curve_);
    sort_at_hubs();
  }

  /// The node nearest to a point that belongs to `node` of the first graph.
  [[nodiscard]] std::uint32_t nearest(const Vec3& point, std::uint32_t node) const {
    if (near_[node].size() > kHub) {
      return near_[node][hubs_.at(node).to(point)];
    }
    std::uint32_t best = node;
    double least = std::numeric_limits<double>::infinity();
    for (const std::uint32_t candidate : near_[node]) {
      const double distance = (curve_.nodes[candidate] - point).squaredNorm();
      if (distance < least) {
        least = distance;
        best = candidate;
      }
    }
    return best;
  }

  /// Nodes go to the means of their points; those inside a chain are smoothed along it.
  void move(const std::vector<Vec3>& sum, const std::vector<double>& total) {
    std::vector<Vec3> mean = curve_.nodes;
    for (std::size_t i = 0; i < mean.size(); ++i) {
      if (total[i] > 0.0) {
        mean[i] += sum[i] / total[i];
      }
    }
    curve_.nodes = smoothed_along_chains(mean, neighbours_);
    sort_at_hubs();
  }

  /// Unit vector out of an end of the curve; zero at other nodes.
  [[nodiscard]] Vec3 outward(std::uint32_t node) const {
    if (neighbours_[node].size() != 1) {
      return Vec3::Zero();
    }
    const Vec3 along = curve_.nodes[node] - curve_.nodes[neighbours_[node].front()];
    return along.norm() > 0.0 ? Vec3(along / along.norm()) : Vec3::Zero();
  }

  [[nodiscard]] CurveGraph& curve() { return curve_; }

 private:
  void sort_at_hubs() {
    hubs_.clear();
    for (std::uint32_t node = 0; node < near_.size(); ++node) {
      if (near_[node].size() > kHub) {
        std::vector<Vec3> places;
        places.reserve(near_[node].size());
        for (const std::uint32_t candidate : near_[node]) {
          places.push_back(curve_.nodes[candidate]);
        }
        hubs_.emplace(node, NearestPoint(std::move(places)));
      }
    }
  }

  CurveGraph curve_;
  std::vector<std::vector<std::uint32_t>> near_;  // of nodes of the first graph
  std::map<std::uint32_t, NearestPoint> hubs_{};  // of these, by where they are now
  IndexLists neighbours_{};
};

}  // namespace

CurveGraph fit_curve(const CurveGraph& graph, std::span<const Vec3> contracted,
                     std::span<const double> weights, std::span<const std::uint32_t> node_of_vertex,
                     double piece) {
  FinerCurve finer(graph, longest_piece(graph, piece, contracted.size()));
  std::vector<Vec3>& nodes = finer.curve().nodes;
  const auto each_point = [&](const auto& visit) {
    for (std::size_t v = 0; v < contracted.size(); ++v) {
      if (node_of_vertex[v] < graph.nodes.size()) {
        visit(v, finer.nearest(contracted[v], node_of_vertex[v]));
      }
    }
  };
  for (int round = 0; round < kRounds; ++round) {
    std::vector<Vec3> sum(nodes.size(), Vec3::Zero());
    std::vector<double> total(nodes.size(), 0.0);
    each_point([&](std::size_t v, std::uint32_t node) {
      sum[node] += weights[v] * (contracted[v] - nodes[node]);
      total[node] += weights[v];
    });
    finer.move(sum, total);
  }
  std::vector<Vec3> outward;
  for (std::uint32_t i = 0; i < nodes.size(); ++i) {
    outward.push_back(finer.outward(i));
  }
  std::vector<double> reach(nodes.size(), 0.0);
  each_point([&](std::size_t v, std::uint32_t node) {
    reach[node] = std::max(reach[node], (contracted[v] - nodes[node]).dot(outward[node]));
  });
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    nodes[i] += std::min(reach[i], kFarthestEnd * piece) * outward[i];
  }
  return finer.curve();
}

}  // namespace vantage
