// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "vantage/contraction/contraction.h"
#include "vantage/core/error.h"
#include "vantage/mesh/measures.h"
#include "vantage/mesh/topology.h"

#include "contraction/component_scaling.h"
#include "contraction/history_summary.h"
#include "contraction/point_steps.h"
#include "core/parallel.h"
#include "mesh/disjoint_sets.h"
#include "spatial/point_rings.h"

namespace vantage {
namespace {

/// Clouds of more points are contracted on this many samples (ours: spread over a sphere of diameter
/// D, each stands for π / 12 000 D², a square of side 0.016 D; the skeleton's samples are 0.02 D apart).
constexpr std::size_t kMostSamples = 12'000;
constexpr std::size_t kOutlierNeighbours = 16;
/// A point whose neighbours are this many times farther than theirs are is an outlier (ours: points
/// at the border of a scan stay below 2).
constexpr double kOutlierRatio = 3.0;
/// Outliers are each other's neighbours, so that more are found when some are gone: of 120 points
/// strewn over the box of a figure of 6 000, one round finds 65, all rounds 115. No more than these.
constexpr int kMostOutlierRounds = 16;
/// Fewer points than this are no statistics.
constexpr std::size_t kFewPoints = 64;
/// Pieces of fewer points than this are specks: they are left out, unless there is nothing else.
constexpr std::size_t kSpeck = 8;
constexpr std::size_t kGrain = 2048;
constexpr std::uint32_t kIsolated = ContractionHistory::kIsolated;

/// Labels of the components of the ring graph, numbered by lowest point.
Components label_components(const PointRings& rings) {
  const std::size_t n = rings.closed.size();
  DisjointSets sets(n);
  for (std::uint32_t i = 0; i < n; ++i) {
    for (const std::uint32_t j : rings.neighbours[i]) {
      sets.join(i, j);
    }
  }
  Components components{.of_vertex = std::vector<std::uint32_t>(n)};
  std::vector<std::uint32_t>& label = components.of_vertex;
  for (std::uint32_t i = 0; i < n; ++i) {
    label[i] =
        sets.root(i) == i ? static_cast<std::uint32_t>(components.count++) : label[sets.root(i)];
  }
  return components;
}

/// One component's points, and the rings in its own numbers.
struct Piece {
  std::vector<std::uint32_t> members{};
  PointRings rings{};
};

std::vector<Piece> cut(const PointRings& rings, std::vector<std::uint32_t>& label,
                       std::size_t count) {
  std::vector<std::size_t> size(count, 0);
  for (const std::uint32_t l : label) {
    ++size[l];
  }
  const bool any_large =
      std::any_of(size.begin(), size.end(), [](std::size_t s) { return s >= kSpeck; });
  std::vector<std::uint32_t> piece_of(count, kIsolated);
  std::vector<Piece> pieces;
  std::vector<std::uint32_t> local(label.size(), 0);
  for (std::uint32_t i = 0; i < label.size(); ++i) {
    const std::uint32_t l = label[i];
    if (size[l] < (any_large ? kSpeck : 3)) {
      label[i] = kIsolated;
      continue;
    }
    if (piece_of[l] == kIsolated) {
      piece_of[l] = static_cast<std::uint32_t>(pieces.size());
      pieces.emplace_back();
    }
    label[i] = piece_of[l];
    local[i] = static_cast<std::uint32_t>(pieces[label[i]].members.size());
    pieces[label[i]].members.push_back(i);
  }
  for (Piece& piece : pieces) {
    for (const std::uint32_t i : piece.members) {
      for (const std::uint32_t j : rings.neighbours[i]) {
        piece.rings.neighbours.values.push_back(local[j]);
      }
      piece.rings.neighbours.offsets.push_back(
          static_cast<std::uint32_t>(piece.rings.neighbours.values.size()));
      piece.rings.closed.push_back(rings.closed[i]);
    }
  }
  return pieces;
}

/// Contracts a piece in its own scale. \return its levels in model units.
ComponentHistory contract_piece(const std::vector<Vec3>& points, const Piece& piece,
                                const ContractionOptions& options, const RunContext& run) {
  std::vector<Vec3> scaled;
  for (const std::uint32_t i : piece.members) {
    scaled.push_back(points[i]);
  }
  const ComponentScaling scaling(scaled, options.scaling);
  for (Vec3& p : scaled) {
    p = scaling.scaled(p);
  }
  ComponentHistory part = contract_point_component(scaled, piece.rings, options, run);
  for (auto& level : part.levels) {
    for (Vec3& p : level) {
      p = scaling.unscaled(p);
    }
  }
  return part;
}

ContractionHistory contract_samples(const std::vector<Vec3>& points, const PointRings& rings,
                                    const ContractionOptions& options, const RunContext& run) {
  ContractionHistory history;
  Components components = label_components(rings);
  history.component_of_vertex = std::move(components.of_vertex);
  const std::vector<Piece> pieces = cut(rings, history.component_of_vertex, components.count);
  history.levels.push_back(points);
  std::vector<ComponentHistory> parts;
  double done = 0.0;
  for (const Piece& piece : pieces) {
    const double share =
        static_cast<double>(piece.members.size()) / static_cast<double>(points.size());
    parts.push_back(
        contract_piece(points, piece, options, run.part(done, std::min(1.0, done + share))));
    done = std::min(1.0, done + share);
    std::vector<std::vector<Vec3>>& levels = parts.back().levels;
    while (history.levels.size() < levels.size()) {
      history.levels.push_back(history.levels.back());
    }
    for (std::size_t j = 1; levels.size() > 1 && j < history.levels.size(); ++j) {
      const auto& from = levels[std::min(j, levels.size() - 1)];
      for (std::size_t i = 0; i < piece.members.size(); ++i) {
        history.levels[j][piece.members[i]] = from[i];
      }
    }
    levels.clear();  // they stand in the history
  }
  summarise(parts, history);
  return history;
}

/// Distance from each point to the nearest of its ring, at a level; 0 without a ring.
std::vector<double> shortest_edges(const std::vector<Vec3>& points, const PointRings& rings) {
  std::vector<double> shortest(points.size(), 0.0);
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (const std::uint32_t j : rings.neighbours[i]) {
      const double length = (points[j] - points[i]).norm();
      shortest[i] = shortest[i] > 0.0 ? std::min(shortest[i], length) : length;
    }
  }
  return shortest;
}

/// Where a point is at a level: with the samples around it that are of its own component, at its
/// offset from them, shrunk.
Vec3 carried(const Vec3& point, const NearestThree& nearest, const ContractionHistory& from,
             std::size_t level, double shrunk) {
  const std::uint32_t component = from.component_of_vertex[nearest.index[0]];
  Vec3 base = Vec3::Zero();
  Vec3 place = Vec3::Zero();
  double total = 0.0;
  for (std::size_t c = 0; c < 3; ++c) {
    const std::uint32_t s = nearest.index[c];
    if (from.component_of_vertex[s] == component) {
      base += nearest.weight[c] * from.levels[0][s];
      place += nearest.weight[c] * from.levels[level][s];
      total += nearest.weight[c];
    }
  }
  return place / total + shrunk * (point - base / total);
}

/// Gives every point the mean way of the three nearest samples; its offset from them shrinks as
/// their rings do. Points of samples that were left out stay.
void carry_back(std::span<const Vec3> points, std::span<const std::uint8_t> left_out,
                const PointRings& rings, PointContraction& result, const RunContext& run) {
  const std::vector<NearestThree> nearest = nearest_three(points, result.samples.positions, run);
  const ContractionHistory& from = result.sample_history;
  ContractionHistory& to = result.history;
  to.shrinkage = from.shrinkage;
  to.components = from.components;
  to.warnings = from.warnings;
  for (ComponentContraction& component : to.components) {
    component.vertices = 0;
  }
  result.sample_of_point.assign(points.size(), kIsolated);
  to.component_of_vertex.assign(points.size(), kIsolated);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const std::uint32_t sample = nearest[i].index[0];
    const std::uint32_t component = from.component_of_vertex[sample];
    if (left_out[i] == 0 && component != kIsolated) {
      result.sample_of_point[i] = sample;
      to.component_of_vertex[i] = component;
      ++to.components[component].vertices;
    }
  }
  const std::vector<double> edge_at_start = shortest_edges(from.levels[0], rings);
  to.levels.assign(from.levels.size(), std::vector<Vec3>(points.begin(), points.end()));
  for (std::size_t level = 1; level < from.levels.size(); ++level) {
    const std::vector<double> edge = shortest_edges(from.levels[level], rings);
    parallel_for(run, points.size(), kGrain, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        const std::uint32_t sample = result.sample_of_point[i];
        if (sample == kIsolated) {
          continue;
        }
        const double shrunk =
            edge_at_start[sample] > 0.0 ? std::min(1.0, edge[sample] / edge_at_start[sample]) : 1.0;
        to.levels[level][i] = carried(points[i], nearest[i], from, level, shrunk);
      }
    });
  }
}

}  // namespace

std::vector<std::uint8_t> find_outliers(std::span<const Vec3> points, const RunContext& run) {
  std::vector<std::uint8_t> outlier(points.size(), 0);
  std::vector<std::size_t> left(points.size());
  std::iota(left.begin(), left.end(), std::size_t{0});
  std::vector<Vec3> places(points.begin(), points.end());
  for (int round = 0; round < kMostOutlierRounds && left.size() >= kFewPoints; ++round) {
    const NeighbourDistances near = neighbour_distances(places, kOutlierNeighbours, run);
    std::size_t kept = 0;
    for (std::size_t row = 0; row < left.size(); ++row) {
      if (near.mean[row] > kOutlierRatio * near.median_of_neighbours[row]) {
        outlier[left[row]] = 1;
      } else {
        places[kept] = places[row];
        left[kept++] = left[row];
      }
    }
    if (kept == left.size()) {
      break;
    }
    places.resize(kept);
    left.resize(kept);
  }
  return outlier;
}

PointContraction contract_points(std::span<const Vec3> points,
                                 std::span<const std::uint8_t> left_out,
                                 const ContractionOptions& options, const RunContext& run) {
  check_fields(options, kContractionFields);
  if (left_out.size() != points.size()) {
    throw InvalidInput("there must be one entry a point that says whether it is left out");
  }
  std::vector<Vec3> kept;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (left_out[i] == 0) {
      kept.push_back(points[i]);
    }
  }
  PointContraction result;
  if (kept.empty()) {
    result.sample_of_point.assign(points.size(), kIsolated);
    result.history = {.levels = {{points.begin(), points.end()}},
                      .shrinkage = {1.0},
                      .component_of_vertex = result.sample_of_point};
    return result;
  }
  for (const std::uint32_t i : spread_sample(kept, kMostSamples, run)) {
    result.samples.positions.push_back(kept[i]);
  }
  const std::vector<Vec3>& samples = result.samples.positions;
  const PointRings rings = point_rings(samples, neighbourhood_size(samples.size()), run);
  result.sample_history = contract_samples(samples, rings, options, run.part(0.1, 0.9));
  result.samples.triangles = agreed_triangles(rings, 1);
  std::erase_if(result.samples.triangles, [&](const Triangle& t) {
    return result.sample_history.component_of_vertex[t[0]] == kIsolated;
  });
  carry_back(points, left_out, rings, result, run);
  ContractionHistory& history = result.history;
  if (const ContractionOptions usual;
      options.method != usual.method || options.weights != usual.weights) {
    history.warnings.push_back(
        "method and weights of the contraction are for meshes; the cloud was contracted as ever");
  }
  if (samples.size() < kept.size()) {
    history.warnings.push_back("the cloud was contracted on " + std::to_string(samples.size()) +
                               " samples of its " + std::to_string(kept.size()) + " points");
  }
  run.advance("contracting", 1.0);
  return result;
}

}  // namespace vantage
