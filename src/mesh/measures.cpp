// SPDX-License-Identifier: MIT
#include "vantage/mesh/measures.h"

#include <Eigen/Geometry>

namespace vantage {

Box bounding_box(std::span<const Vec3> points) {
  if (points.empty()) {
    return {};
  }
  Box box{points.front(), points.front()};
  for (const Vec3& p : points) {
    box.low = box.low.cwiseMin(p);
    box.high = box.high.cwiseMax(p);
  }
  return box;
}

std::vector<Vec3> referenced_points(const TriMesh& mesh) {
  if (mesh.triangles.empty()) {
    return mesh.positions;
  }
  std::vector<bool> used(mesh.positions.size(), false);
  for (const Triangle& t : mesh.triangles) {
    for (const std::uint32_t v : t) {
      used[v] = true;
    }
  }
  std::vector<Vec3> points;
  for (std::size_t v = 0; v < used.size(); ++v) {
    if (used[v]) {
      points.push_back(mesh.positions[v]);
    }
  }
  return points;
}

Vec3 area_vector(const TriMesh& mesh, const Triangle& triangle) {
  const Vec3& a = mesh.positions[triangle[0]];
  return (mesh.positions[triangle[1]] - a).cross(mesh.positions[triangle[2]] - a);
}

std::vector<double> face_areas(const TriMesh& mesh) {
  std::vector<double> areas;
  areas.reserve(mesh.triangles.size());
  for (const Triangle& t : mesh.triangles) {
    areas.push_back(0.5 * area_vector(mesh, t).norm());
  }
  return areas;
}

std::vector<double> vertex_areas(const TriMesh& mesh) {
  std::vector<double> areas(mesh.positions.size(), 0.0);
  for (const Triangle& t : mesh.triangles) {
    const double third = area_vector(mesh, t).norm() / 6.0;
    for (const std::uint32_t v : t) {
      areas[v] += third;
    }
  }
  return areas;
}

double surface_area(const TriMesh& mesh) {
  double area = 0.0;
  for (const Triangle& t : mesh.triangles) {
    area += 0.5 * area_vector(mesh, t).norm();
  }
  return area;
}

double signed_volume(const TriMesh& mesh) {
  if (mesh.triangles.empty()) {
    return 0.0;
  }
  // Relative to a corner of the mesh: far from the origin the tetrahedra would cancel badly.
  const Vec3 origin = mesh.positions[mesh.triangles.front()[0]];
  double volume = 0.0;
  for (const Triangle& t : mesh.triangles) {
    const Vec3 a = mesh.positions[t[0]] - origin;
    const Vec3 b = mesh.positions[t[1]] - origin;
    const Vec3 c = mesh.positions[t[2]] - origin;
    volume += a.dot(b.cross(c)) / 6.0;
  }
  return volume;
}

}  // namespace vantage
