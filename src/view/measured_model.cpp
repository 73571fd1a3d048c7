// SPDX-License-Identifier: MIT
#include "view/measured_model.h"

#include <algorithm>

#include "vantage/core/error.h"
#include "vantage/mesh/measures.h"
#include "vantage/mesh/topology.h"
#include "vantage/significance/mesh_saliency.h"

#include "core/shannon.h"
#include "mesh/curvature.h"
#include "visibility/surface.h"

namespace vantage {
namespace {

void check(const MeasureSubject& subject, const MeasureNeeds& needs) {
  const std::size_t count = subject.surface->positions.size();
  const bool has_kssm = subject.kssm.size() == count;
  const bool has_skeleton = subject.skeleton != nullptr && subject.node_of_vertex.size() == count;
  if ((needs.kssm && !has_kssm) || (needs.skeleton && !has_skeleton)) {
    throw InvalidInput("a measure needs a map or a skeleton that the model was not given");
  }
}

/// Areas of the faces, one by one and together: what stands in one place counts once. \throw InvalidInput
void take_areas(MeasuredModel& model) {
  model.face_areas = face_areas(*model.given.surface);
  const std::vector<std::uint32_t> repeated =
      repeated_faces(*model.given.surface, model.given.sides);
  for (const std::uint32_t f : repeated) {
    model.face_areas[f] = 0.0;
  }
  model.face_count = model.face_areas.size() - repeated.size();
  model.log_face_areas.reserve(model.face_areas.size());
  for (const double area : model.face_areas) {
    model.surface_area += area;
    model.log_face_areas.push_back(area > 0.0 ? log_2(area) : 0.0);
  }
  if (!(model.surface_area > 0.0) || !(model.given.camera.sphere.diameter > 0.0)) {
    throw InvalidInput("a surface without area cannot be measured");
  }
}

/// Second moment of the surface about its centroid over its area, in closed form.
Eigen::Matrix3d spread_of(const TriMesh& mesh, const std::vector<double>& areas, double total) {
  Vec3 centre = Vec3::Zero();
  for (std::size_t f = 0; f < areas.size(); ++f) {
    for (const std::uint32_t v : mesh.triangles[f]) {
      centre += areas[f] / 3.0 * (mesh.positions[v] - mesh.positions[0]);
    }
  }
  centre = mesh.positions[0] + centre / total;
  Eigen::Matrix3d moment = Eigen::Matrix3d::Zero();
  for (std::size_t f = 0; f < areas.size(); ++f) {
    // ∫ x xᵀ over a triangle: area / 12 times (Σ of the corners' own products + that of their sum).
    Vec3 sum = Vec3::Zero();
    for (const std::uint32_t v : mesh.triangles[f]) {
      const Vec3 p = mesh.positions[v] - centre;
      moment += areas[f] / 12.0 * p * p.transpose();
      sum += p;
    }
    moment += areas[f] / 12.0 * sum * sum.transpose();
  }
  return moment / total;
}

/// What tells whether a branch of the skeleton is shown: the faces' planes, and areas at vertices.
void take_planes(MeasuredModel& model) {
  const TriMesh& mesh = *model.given.surface;
  const Vec3& centre = model.given.camera.sphere.centre;
  model.areas_at_vertex.assign(mesh.positions.size(), 0.0);
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
    const Triangle& face = mesh.triangles[f];
    const Vec3 normal = area_vector(mesh, face);
    model.planes.push_back({normal, normal.dot(mesh.positions[face[0]] - centre)});
    for (const std::uint32_t v : face) {
      model.areas_at_vertex[v] += model.face_areas[f];
    }
  }
}

std::vector<double> saliency_of(const MeasureSubject& subject, const RunContext& run) {
  if (subject.saliency.size() == subject.surface->positions.size()) {
    return {subject.saliency.begin(), subject.saliency.end()};
  }
  return compute_mesh_saliency(*subject.surface, subject.saliency_options, run).of_vertex;
}

}  // namespace

MeasuredModel measured_model(const MeasureSubject& subject, int level, const MeasureNeeds& needs,
                             const RunContext& run) {
  MeasuredModel model;
  model.given = subject;
  take_areas(model);
  check(subject, needs);
  model.spread = spread_of(*subject.surface, model.face_areas, model.surface_area);
  model.set = direction_set(ViewSphereBase::Icosahedron, level);
  model.coarse_set = direction_set(ViewSphereBase::Icosahedron, std::max(0, level - 1));
  if (needs.skeleton) {
    take_planes(model);
  }
  if (needs.vertices) {
    model.angle_deficits = angle_deficits(*subject.surface);
  }
  if (needs.neighbours) {
    model.next_views = vertex_neighbours({model.set.directions, model.set.triangles});
    model.next_coarse_views =
        vertex_neighbours({model.coarse_set.directions, model.coarse_set.triangles});
  }
  if (needs.saliency) {
    model.saliency = saliency_of(subject, run);
  }
  return model;
}

}  // namespace vantage
