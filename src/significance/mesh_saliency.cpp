// SPDX-License-Identifier: MIT
#include "vantage/significance/mesh_saliency.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "vantage/mesh/measures.h"
#include "vantage/mesh/topology.h"

#include "mesh/curvature.h"
#include "significance/feature_map.h"
#include "significance/gaussian_means.h"

namespace vantage {
namespace {

/// Where in kGaussianScales the five σ and their 2σ stand.
constexpr std::array<std::array<std::size_t, 2>, 5> kPairs{
    {{0, 2}, {1, 4}, {2, 5}, {3, 6}, {4, 7}}};
/// A scale whose saliency spans less than this fraction of the largest |C| is flat: rounding.
constexpr double kFlatShare = 1e-6;

}  // namespace

MeshSaliency compute_mesh_saliency(const TriMesh& mesh, const MeshSaliencyOptions& options,
                                   const RunContext& run) {
  check_fields(options, kMeshSaliencyFields);
  const std::size_t vertex_count = mesh.positions.size();
  MeshSaliency result;
  result.curvature = mean_curvatures(mesh);
  if (!options.signed_curvature) {
    for (double& c : result.curvature) {
      c = std::abs(c);
    }
  }
  result.of_vertex.assign(vertex_count, 0.0);
  const IndexLists rings = vertex_neighbours(mesh);
  const Box box = bounding_box(referenced_points(mesh));
  const double epsilon = options.saliency_scale * box.size().norm();
  if (!(epsilon > 0.0)) {
    result.level_factor.assign(kPairs.size(), 0.0);
    return result;
  }
  const std::vector<double> areas = vertex_areas(mesh);
  FieldPoints points;
  std::vector<std::size_t> vertex_of_point;
  std::vector<bool> counted(vertex_count, false);
  double strongest = 0.0;
  for (std::size_t v = 0; v < vertex_count; ++v) {
    if (!rings[v].empty()) {
      counted[v] = true;
      vertex_of_point.push_back(v);
      points.position.emplace_back((mesh.positions[v] - box.low) / epsilon);
      points.value.push_back(result.curvature[v]);
      points.weight.push_back(options.area_kernel ? areas[v] : 1.0);
      strongest = std::max(strongest, std::abs(result.curvature[v]));
    }
  }
  const std::vector<GaussianMeans> means = gaussian_means(points, run);
  const std::vector<double> alike(vertex_count, 1.0);
  std::vector<double> field(vertex_count, 0.0);
  for (const auto& [centre, surround] : kPairs) {
    for (std::size_t i = 0; i < means.size(); ++i) {
      field[vertex_of_point[i]] = std::abs(means[i][centre] - means[i][surround]);
    }
    const NormalisedField scaled = normalised(field, counted, kFlatShare * strongest);
    if (scaled.flat) {
      result.level_factor.push_back(0.0);
      continue;
    }
    const double mean = mean_of_local_maxima(scaled, rings, alike);
    const double factor = (1.0 - mean) * (1.0 - mean);
    result.level_factor.push_back(factor);
    for (std::size_t v = 0; v < vertex_count; ++v) {
      result.of_vertex[v] += factor * scaled.values[v];
    }
  }
  run.advance("saliency", 1.0);
  return result;
}

}  // namespace vantage
