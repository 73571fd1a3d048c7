// SPDX-License-Identifier: MIT
#include "pipeline/prepare_points.h"

#include <algorithm>
#include <numeric>
#include <string>
#include <utility>

#include "vantage/mesh/measures.h"
#include "vantage/mesh/mesh_check.h"
#include "vantage/mesh/topology.h"

#include "core/counted.h"
#include "mesh/extent.h"
#include "pipeline/drawn_points.h"
#include "skeleton/point_skeleton.h"
#include "spatial/point_rings.h"

namespace vantage {
namespace {

/// Stars that must hold a triangle before it hides what is behind it (docs/visibility.md).
constexpr int kVotes = 1;
/// A note tells of points that no triangle joins where they are more of all than this. [ours]
constexpr double kBare = 0.02;

/// The triangles among the points that are not left out.
std::vector<Triangle> join(const std::vector<Vec3>& points,
                           const std::vector<std::uint8_t>& outlier, const RunContext& run) {
  std::vector<std::uint32_t> kept;
  std::vector<Vec3> places;
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    if (outlier[i] == 0) {
      kept.push_back(i);
      places.push_back(points[i]);
    }
  }
  std::vector<Triangle> triangles =
      agreed_triangles(point_rings(places, neighbourhood_size(places.size()), run), kVotes);
  for (Triangle& t : triangles) {
    t = {kept[t[0]], kept[t[1]], kept[t[2]]};
  }
  return triangles;
}

/// Numbers the points outward from their mean, so that the order in the file decides nothing.
void number_outward(WeldedMesh& cloud) {
  std::vector<Vec3>& points = cloud.mesh.positions;
  const auto is_less = [](const Vec3& a, const Vec3& b) {
    return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end());
  };
  std::vector<std::uint32_t> order(points.size());
  std::iota(order.begin(), order.end(), 0U);
  std::sort(order.begin(), order.end(),
            [&](std::uint32_t a, std::uint32_t b) { return is_less(points[a], points[b]); });
  Vec3 mean = Vec3::Zero();
  for (const std::uint32_t i : order) {  // rounded the same in any order of the file
    mean += points[i] / static_cast<double>(points.size());
  }
  std::vector<double> distance;
  distance.reserve(points.size());
  for (const Vec3& p : points) {
    distance.push_back((p - mean).norm());
  }
  std::stable_sort(order.begin(), order.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return distance[a] < distance[b]; });
  std::vector<Vec3> ordered;
  ordered.reserve(points.size());
  std::vector<std::uint32_t> number(points.size());
  for (const std::uint32_t i : order) {
    number[i] = static_cast<std::uint32_t>(ordered.size());
    ordered.push_back(points[i]);
  }
  points = std::move(ordered);
  for (std::uint32_t& i : cloud.welded_of_vertex) {
    i = number[i];
  }
}

}  // namespace

ShapeAnalysis prepare_points(const Model& model, const RunContext& run) {
  WeldedMesh welded = weld(model.mesh, run);
  check_extent(welded.mesh.positions, model.name);
  number_outward(welded);
  ShapeAnalysis shape;
  shape.cloud.emplace();
  std::vector<std::uint8_t>& outlier = shape.cloud->outlier;
  outlier = find_outliers(welded.mesh.positions, run);
  shape.surface.positions = std::move(welded.mesh.positions);
  shape.surface.triangles = join(shape.surface.positions, outlier, run);
  shape.surface_vertex = std::move(welded.welded_of_vertex);
  const std::size_t n = shape.surface.positions.size();
  if (shape.surface.triangles.empty()) {
    throw InvalidInput(about_model(
        model.name,
        "the points lie on one line or are fewer than three, so there is no shape to look at"));
  }
  const std::vector<Vec3> drawn = drawn_points(shape);
  shape.sphere = enclosing_sphere(drawn);
  shape.sides = {FaceSides::Both};
  shape.check.vertices = n;
  shape.check.components = connected_components(shape.surface).count;
  list_coarse_coordinates(shape.surface.positions, shape.warnings);
  if (welded.merged_vertices > 0) {
    shape.warnings.push_back(counted(welded.merged_vertices, "point", "points",
                                     " welded to an earlier one at the same position"));
  }
  const auto outliers =
      static_cast<std::size_t>(std::count(outlier.begin(), outlier.end(), std::uint8_t{1}));
  if (outliers > 0) {
    shape.check.components -= outliers;
    shape.warnings.push_back(counted(outliers, "outlier", "outliers",
                                     " of the cloud left out of the skeleton and the map"));
  }
  const std::size_t bare = drawn.size() - referenced_points(shape.surface).size();
  shape.check.components -= bare;
  if (static_cast<double>(bare) > kBare * static_cast<double>(drawn.size())) {
    shape.warnings.push_back(
        "points on no surface, as those of a straight line, are drawn but not counted: " +
        std::to_string(bare) + " of " + std::to_string(drawn.size()));
  }
  return shape;
}

void add_point_history(ShapeAnalysis& shape, const ViewOptions& options, const RunContext& run) {
  PointContraction& contraction = shape.cloud->contraction;
  contraction =
      contract_points(shape.surface.positions, shape.cloud->outlier, options.contraction, run);
  shape.history = std::move(contraction.history);
}

void add_point_skeleton(ShapeAnalysis& shape, const ViewOptions& options, const RunContext& run) {
  const PointContraction& cloud = shape.cloud->contraction;
  Skeleton& skeleton = shape.skeleton;
  skeleton = extract_point_skeleton(cloud.samples, cloud.sample_history, options.skeleton, run);
  for (auto* nodes : {&skeleton.node_of_vertex, &skeleton.raw_node_of_vertex}) {
    std::vector<std::uint32_t> of_point;
    of_point.reserve(cloud.sample_of_point.size());
    for (const std::uint32_t sample : cloud.sample_of_point) {
      of_point.push_back(sample == ContractionHistory::kIsolated ? Skeleton::kNone
                                                                 : (*nodes)[sample]);
    }
    *nodes = std::move(of_point);
  }
}

}  // namespace vantage
