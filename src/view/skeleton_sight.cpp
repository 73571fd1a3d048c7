// SPDX-License-Identifier: MIT
#include "view/skeleton_sight.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include <Eigen/Geometry>

#include "core/cross.h"

namespace vantage {
namespace {

// What crosses behind another branch is still there, but not where it leads. [ours]
constexpr double kCrossed = 0.5;
// A branch is a limb seen from this share of its length on. [ours]
constexpr double kLimbShare = 0.5;
constexpr double kHalf = 0.5;

/// For each node 1 if shown, 0 if not, −1 if it stands for no surface that faces the eye.
std::vector<double> shown_nodes(const MeasuredModel& model, const SightTable& sight) {
  const TriMesh& mesh = *model.given.surface;
  const std::size_t count = model.given.skeleton->nodes.size();
  const bool is_perspective = sight.eye.projection == Projection::Perspective;
  const Vec3 eye = is_perspective ? Vec3(sight.eye.position - model.given.camera.sphere.centre)
                                  : sight.eye.position;
  std::vector<double> seen(count, 0.0);
  for (std::size_t v = 0; v < sight.vertices.size(); ++v) {
    const std::uint32_t node = model.given.node_of_vertex[v];
    if (sight.vertices[v] != 0 && node < count) {
      seen[node] += model.areas_at_vertex[v];
    }
  }
  // From behind counts where the vertex is seen: on surfaces with two sides.
  std::vector<double> facing = seen;
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
    const auto& [a, b, c] = mesh.triangles[f];
    // Nothing is hidden of most faces that face the eye.
    const bool is_seen = (sight.vertices[a] & sight.vertices[b] & sight.vertices[c]) != 0;
    const FacePlane& plane = model.planes[f];
    if (!is_seen && plane.normal.dot(eye) > (is_perspective ? plane.offset : 0.0)) {
      for (const std::uint32_t v : mesh.triangles[f]) {
        const std::uint32_t node = model.given.node_of_vertex[v];
        if (sight.vertices[v] == 0 && node < count) {
          facing[node] += model.face_areas[f];
        }
      }
    }
  }
  std::vector<double> shown(count, -1.0);
  for (std::size_t n = 0; n < count; ++n) {
    if (facing[n] > 0.0) {
      shown[n] = seen[n] >= kHalf * facing[n] ? 1.0 : 0.0;
    }
  }
  return shown;
}

struct ProjectedEdge {
  std::uint32_t a = 0, b = 0;  // nodes
  std::uint32_t branch = 0;    // of graph_branches()
  double length = 0.0;         // in space
  PicturePoint from{}, to{};   // in the picture
  double near_a = 0.0,
         near_b = 0.0;  // of both ends, smaller is farther; even along the edge in the picture

  /// At a share of the way along the picture.
  [[nodiscard]] double near_at(double share) const { return near_a + share * (near_b - near_a); }
};

std::vector<ProjectedEdge> projected_edges(const CurveGraph& graph, const Sphere& sphere,
                                           const SightTable& sight) {
  const Vec3 right = sight.towards.unitOrthogonal();
  const Vec3 up = sight.towards.cross(right);
  const bool is_perspective = sight.eye.projection == Projection::Perspective;
  const double distance = (sight.eye.position - sphere.centre).norm();
  std::vector<PicturePoint> places;
  std::vector<double> near;
  for (const Vec3& node : graph.nodes) {
    const Vec3 p = node - sphere.centre;
    const double depth = p.dot(sight.towards);
    const double left = distance - depth;
    const double shrink = !is_perspective ? 1.0 : left > 0.0 ? distance / left : 0.0;
    places.emplace_back(shrink * p.dot(right), shrink * p.dot(up));
    near.push_back(is_perspective ? shrink : depth);  // what is behind the eye is farthest
  }
  std::vector<ProjectedEdge> edges;
  const auto branches = graph_branches(graph);
  for (std::uint32_t k = 0; k < branches.size(); ++k) {
    for (std::size_t i = 0; i + 1 < branches[k].size(); ++i) {
      const std::uint32_t a = branches[k][i];
      const std::uint32_t b = branches[k][i + 1];
      edges.push_back({a, b, k, (graph.nodes[a] - graph.nodes[b]).norm(), places[a], places[b],
                       near[a], near[b]});
    }
  }
  return edges;
}

/// Marks the farther of two edges of different branches if they cross in the picture.
void mark_crossing(const std::vector<ProjectedEdge>& edges, std::size_t i, std::size_t j,
                   std::vector<std::uint8_t>& crossed) {
  const ProjectedEdge& p = edges[i];
  const ProjectedEdge& q = edges[j];
  if (std::max(q.from.y(), q.to.y()) < std::min(p.from.y(), p.to.y()) ||
      std::min(q.from.y(), q.to.y()) > std::max(p.from.y(), p.to.y()) || p.branch == q.branch ||
      p.a == q.a || p.a == q.b || p.b == q.a || p.b == q.b) {
    return;
  }
  const PicturePoint along = p.to - p.from;
  const PicturePoint other = q.to - q.from;
  const double area = cross(along, other);
  if (area == 0.0) {
    return;
  }
  const double s = cross(q.from - p.from, other) / area;
  const double t = cross(q.from - p.from, along) / area;
  if (s > 0.0 && s < 1.0 && t > 0.0 && t < 1.0) {
    crossed[p.near_at(s) < q.near_at(t) ? i : j] = 1;
  }
}

/// Of each two edges of different branches that cross in the picture the farther one is marked. Found by a
/// sweep from left to right.
std::vector<std::uint8_t> crossed_edges(const std::vector<ProjectedEdge>& edges) {
  const auto left_of = [&](std::size_t i) { return std::min(edges[i].from.x(), edges[i].to.x()); };
  const auto right_of = [&](std::size_t i) { return std::max(edges[i].from.x(), edges[i].to.x()); };
  std::vector<std::size_t> order(edges.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t i, std::size_t j) {
    return std::pair(left_of(i), i) < std::pair(left_of(j), j);
  });
  std::vector<std::uint8_t> crossed(edges.size(), 0);
  for (std::size_t k = 0; k < order.size(); ++k) {
    for (std::size_t l = k + 1; l < order.size() && left_of(order[l]) <= right_of(order[k]); ++l) {
      mark_crossing(edges, std::min(order[k], order[l]), std::max(order[k], order[l]), crossed);
    }
  }
  return crossed;
}

}  // namespace

SkeletonSight skeleton_sight(const MeasuredModel& model, const SightTable& sight) {
  const CurveGraph& graph = *model.given.skeleton;
  const std::vector<double> shown = shown_nodes(model, sight);
  const std::vector<ProjectedEdge> edges = projected_edges(graph, model.given.camera.sphere, sight);
  const std::vector<std::uint8_t> crossed = crossed_edges(edges);
  SkeletonSight result;
  double all = 0.0;
  double all_shown = 0.0;
  double branch = 0.0;
  double branch_shown = 0.0;
  for (std::size_t i = 0; i < edges.size(); ++i) {
    const ProjectedEdge& edge = edges[i];
    // An end without surface of its own goes with the other end.
    const double a = shown[edge.a] < 0.0 ? shown[edge.b] : shown[edge.a];
    const double b = shown[edge.b] < 0.0 ? shown[edge.a] : shown[edge.b];
    const double share = std::max(0.0, 0.5 * (a + b)) * (crossed[i] != 0 ? kCrossed : 1.0);
    branch += edge.length;
    branch_shown += share * edge.length;
    if (i + 1 == edges.size() || edges[i + 1].branch != edge.branch) {
      all += branch;
      all_shown += branch_shown;
      result.limbs += branch > 0.0 && branch_shown >= kLimbShare * branch ? 1.0 : 0.0;
      branch = branch_shown = 0.0;
    }
  }
  result.share = all > 0.0 ? all_shown / all : 0.0;
  return result;
}

}  // namespace vantage
