// SPDX-License-Identifier: MIT
#include "vantage/significance/kssm.h"

#include <algorithm>
#include <cstddef>
#include <functional>
#include <limits>
#include <numeric>

#include "vantage/core/error.h"
#include "vantage/mesh/measures.h"
#include "vantage/mesh/topology.h"

#include "core/parallel.h"
#include "mesh/extent.h"
#include "significance/feature_map.h"
#include "spatial/graph_distance.h"

namespace vantage {
namespace {

/// A level whose displacement spans less than this fraction of D is flat: rounding, not shape.
constexpr double kFlat = 1e-6;
constexpr std::size_t kVerticesPerTask = 2048;
/// A level counts in full where it correlates by this share of what is missing to 1 above the least
/// [ours: trials in docs/lab].
constexpr double kRamp = 0.5;

/// Difference of the largest and the smallest value of the referenced vertices.
double span_of(const std::vector<double>& d, const std::vector<bool>& referenced) {
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  for (std::size_t v = 0; v < d.size(); ++v) {
    if (referenced[v]) {
      low = std::min(low, d[v]);
      high = std::max(high, d[v]);
    }
  }
  return high - low;
}

/// Distance of each position to a graph.
std::vector<double> distances(const std::vector<Vec3>& positions, const GraphDistance& distance,
                              const RunContext& run) {
  std::vector<double> d(positions.size());
  parallel_for(run, positions.size(), kVerticesPerTask, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) {
      d[v] = distance(positions[v]);
    }
  });
  return d;
}

/// d^(j) of each level. The surface itself, level 0, is measured to the curves of both meshes: what one
/// of them owes to its triangles, as the place of a junction, the other does not.
std::vector<std::vector<double>> displacements(const ContractionHistory& history,
                                               const CurveGraph& skeleton, const CurveGraph& other,
                                               const RunContext& run) {
  const GraphDistance to_skeleton(skeleton);
  std::vector<std::vector<double>> d;
  const auto levels = static_cast<double>(history.levels.size());
  for (const auto& positions : history.levels) {
    run.advance("map", static_cast<double>(d.size()) / levels);
    d.push_back(distances(positions, to_skeleton, run));
  }
  if (!other.nodes.empty()) {
    const std::vector<double> to_other =
        distances(history.levels.front(), GraphDistance(other), run);
    for (std::size_t v = 0; v < to_other.size(); ++v) {
      d.front()[v] = 0.5 * (d.front()[v] + to_other[v]);
    }
  }
  return d;
}

/// Weighted variance.
double variance(const std::vector<double>& x, const std::vector<double>& weight) {
  const double total = std::accumulate(weight.begin(), weight.end(), 0.0);
  const double mean = std::inner_product(x.begin(), x.end(), weight.begin(), 0.0) / total;
  double sum = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    sum += weight[i] * (x[i] - mean) * (x[i] - mean);
  }
  return sum / total;
}

/// Areas by which the second mesh tells whether levels count [ours].
struct Evidence {
  std::vector<double> area{};  ///< Of each of its vertices; 0 where it is no other mesh.
  double tested = 0.0;         ///< The sum of these.
  double none = 0.0;           ///< Where it is the first mesh.
  double hardly = 0.0;         ///< Where it nearly is.
};

Evidence evidence_of(const SecondMesh& second) {
  Evidence evidence{.area = vertex_areas(second.mesh)};
  for (std::size_t v = 0; v < evidence.area.size(); ++v) {
    const Remeshing remeshing = second.remeshing[second.component_of_vertex[v]];
    double& sum = remeshing == Remeshing::Coarser ? evidence.tested
                  : remeshing == Remeshing::None  ? evidence.none
                                                  : evidence.hardly;
    sum += evidence.area[v];
    if (remeshing != Remeshing::Coarser) {
      evidence.area[v] = 0.0;
    }
  }
  return evidence;
}

/// The correlation r of each level's displacements with those of the surface meshed anew. Two meshes may
/// agree by chance: r is taken with the largest variance of the difference at this level or an earlier one.
/// \param area by which the second mesh's vertices count.
std::vector<double> correlations(const SecondMesh& second, const std::vector<double>& area,
                                 const CurveGraph& skeleton, const CurveGraph& other,
                                 const RunContext& run) {
  const GraphDistance to_first(skeleton);
  const GraphDistance to_second(other);
  std::vector<double> r;
  std::vector<double> difference(area.size());
  double noise = 0.0;
  for (std::size_t level = 0; level < second.here.size(); ++level) {
    const std::vector<double> by_first = distances(second.here[level], to_first, run);
    const std::vector<double> by_second = distances(second.there[level], to_second, run);
    std::transform(by_first.begin(), by_first.end(), by_second.begin(), difference.begin(),
                   std::minus<>());
    noise = std::max(noise, variance(difference, area));
    const double signal = std::min(variance(by_first, area), variance(by_second, area));
    // Where both vary alike, this is their correlation.
    r.push_back(signal > 0.0 ? 1.0 - 0.5 * noise / signal : 1.0);
  }
  return r;
}

/// The weight of each level: 0 up to a correlation of r = least, 1 from r = (1 + least) / 2 on, linear
/// between. What was not meshed anew has no say. If nothing was, all later levels weigh alike: by the share
/// of the area in components of too few vertices for another mesh. Level 0 has weight 1. [ours]
std::vector<double> level_weights(const ContractionHistory& history, const CurveGraph& skeleton,
                                  const CurveGraph& other, double least, const RunContext& run) {
  std::vector<double> weights(history.levels.size(), 1.0);
  const SecondMesh& second = history.second;
  const Evidence evidence = evidence_of(second);
  const double untested = evidence.none + evidence.hardly;
  if (other.nodes.empty() || !(least > 0.0) || second.here.size() != weights.size() ||
      !(evidence.tested + untested > 0.0)) {
    return weights;
  }
  if (!(evidence.tested > 0.0)) {
    std::fill(weights.begin() + 1, weights.end(), evidence.none / untested);
    return weights;
  }
  const double full = kRamp * (1.0 - least);
  const std::vector<double> r = correlations(second, evidence.area, skeleton, other, run);
  for (std::size_t level = 1; level < weights.size(); ++level) {
    const double surplus = r[level] - least;
    const double unramped = surplus >= 0.0 ? 1.0 : 0.0;
    weights[level] = full > 0.0 ? std::clamp(surplus / full, 0.0, 1.0) : unramped;
  }
  return weights;
}

void check_input(const TriMesh& mesh, const ContractionHistory& history, const CurveGraph& skeleton,
                 const KssmOptions& options) {
  check_fields(options, kKssmFields);
  check_coordinates(mesh);
  const bool fits =
      std::all_of(history.levels.begin(), history.levels.end(),
                  [&](const auto& level) { return level.size() == mesh.positions.size(); });
  if (history.levels.empty() || !fits) {
    throw InvalidInput("the contraction history does not belong to this mesh");
  }
  if (skeleton.nodes.empty()) {
    throw InvalidInput("the skeleton has no nodes to measure distances to");
  }
}

/// What is normalised and summed of a level: its displacement, or what the step to it took from that.
/// \pre level > 0 for velocities
std::vector<double> kinematics_of(const std::vector<std::vector<double>>& displacement,
                                  std::size_t level, Kinematics kinematics) {
  std::vector<double> field = displacement[level];
  if (kinematics == Kinematics::Velocity) {
    for (std::size_t v = 0; v < field.size(); ++v) {
      field[v] = displacement[level - 1][v] - field[v];
    }
  }
  return field;
}

NormalisedField normalised_level(const std::vector<std::vector<double>>& displacement,
                                 std::size_t level, Kinematics kinematics,
                                 const std::vector<bool>& referenced, double diameter) {
  return normalised(kinematics_of(displacement, level, kinematics), referenced, kFlat * diameter);
}

}  // namespace

std::vector<double> level_summand(const TriMesh& mesh, const KssmMap& map, std::size_t level,
                                  Kinematics kinematics) {
  if (level >= map.level_factor.size() || map.of_vertex.size() != mesh.positions.size()) {
    throw InvalidInput("the map has no such level, or belongs to another mesh");
  }
  if (map.level_factor[level] == 0.0) {
    return std::vector<double>(mesh.positions.size(), 0.0);
  }
  const double diameter = enclosing_sphere(referenced_points(mesh)).diameter;
  std::vector<double> summand =
      normalised_level(map.displacement, level, kinematics, vertices_with_faces(mesh), diameter)
          .values;
  for (double& value : summand) {
    value *= map.level_factor[level];
  }
  return summand;
}

KssmMap compute_kssm(const TriMesh& mesh, const ContractionHistory& history,
                     const CurveGraph& skeleton, const KssmOptions& options, const RunContext& run,
                     const CurveGraph& other) {
  check_input(mesh, history, skeleton, options);
  const std::size_t vertex_count = mesh.positions.size();
  const bool by_rings = options.suppression == Suppression::LocalMaxima;
  const IndexLists rings = by_rings ? vertex_neighbours(mesh) : IndexLists{};
  const std::vector<bool> referenced = vertices_with_faces(mesh);
  const double diameter = enclosing_sphere(referenced_points(mesh)).diameter;
  const std::vector<double> weight =
      options.area_weighted_mean ? vertex_areas(mesh) : std::vector<double>(vertex_count, 1.0);

  KssmMap map;
  const bool velocity = options.kinematics == Kinematics::Velocity;
  // A step's velocity is a difference of distances to one curve.
  map.displacement = displacements(history, skeleton, velocity ? CurveGraph{} : other, run);
  map.of_vertex.assign(vertex_count, 0.0);
  const std::vector<double> level_weight =
      level_weights(history, skeleton, other, options.level_agreement, run);
  // The input is always resolved.
  const auto is_resolved = [&](std::size_t level) {
    return level == 0 ||
           (level_weight[level] > 0.0 &&
            span_of(map.displacement[level], referenced) > options.flat_level * diameter);
  };
  // A velocity is as good as the displacement that it starts from; no step led to the input.
  const std::size_t lag = velocity ? 1 : 0;
  map.level_factor.assign(map.displacement.size(), 0.0);
  for (std::size_t level = lag; level < map.displacement.size(); ++level) {
    if (!is_resolved(level - lag)) {
      continue;
    }
    const NormalisedField field =
        normalised_level(map.displacement, level, options.kinematics, referenced, diameter);
    if (field.flat) {
      continue;
    }
    const double mean = by_rings ? mean_of_local_maxima(field, rings, weight)
                                 : mean_without_maximum(field, referenced, weight);
    // Φ of the paper, on normalised values
    const double factor = level_weight[level - lag] * (1.0 - mean) * (1.0 - mean);
    map.level_factor[level] = factor;
    map.levels_used.push_back(level);
    for (std::size_t v = 0; v < vertex_count; ++v) {
      map.of_vertex[v] += factor * field.values[v];
    }
  }
  return map;
}

KssmMap compute_kssm(const TriMesh& mesh, const ContractionHistory& history,
                     const Skeleton& skeleton, const KssmOptions& options, const RunContext& run) {
  return compute_kssm(mesh, history, skeleton.curve, options, run, skeleton.other_curve);
}

}  // namespace vantage
