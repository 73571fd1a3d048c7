// SPDX-License-Identifier: MIT
#include "spatial/winding_number.h"

#include <cmath>
#include <numbers>

#include <Eigen/Geometry>

namespace vantage {

double winding_number(const TriMesh& mesh, std::span<const std::uint32_t> faces,
                      const Vec3& point) {
  double halves = 0.0;  // of the solid angles
  for (const std::uint32_t f : faces) {
    const auto& [i, j, k] = mesh.triangles[f];
    const Vec3 a = mesh.positions[i] - point;
    const Vec3 b = mesh.positions[j] - point;
    const Vec3 c = mesh.positions[k] - point;
    const double la = a.norm();
    const double lb = b.norm();
    const double lc = c.norm();
    halves +=
        std::atan2(a.dot(b.cross(c)), la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
  }
  return halves / (2.0 * std::numbers::pi);
}

}  // namespace vantage
