// SPDX-License-Identifier: MIT
#include "render/occlusion.h"

#include <cmath>
#include <cstdint>
#include <numbers>

#include <Eigen/Geometry>

namespace vantage {
namespace {

/// The radical inverse of van der Corput in base 2.
double radical_inverse(std::uint32_t bits) {
  bits = (bits << 16U) | (bits >> 16U);
  bits = ((bits & 0x00ff00ffU) << 8U) | ((bits & 0xff00ff00U) >> 8U);
  bits = ((bits & 0x0f0f0f0fU) << 4U) | ((bits & 0xf0f0f0f0U) >> 4U);
  bits = ((bits & 0x33333333U) << 2U) | ((bits & 0xccccccccU) >> 2U);
  bits = ((bits & 0x55555555U) << 1U) | ((bits & 0xaaaaaaaaU) >> 1U);
  return static_cast<double>(bits) * 0x1p-32;
}

}  // namespace

Occlusion::Occlusion(const RayScene& scene, double reach, double offset,
                     const std::optional<Floor>& floor)
    : scene_(&scene), reach_(reach), offset_(offset), floor_(floor) {}

bool Occlusion::blocked(const Vec3& origin, const Vec3& direction) const {
  if (floor_) {
    const double fall = -direction.dot(floor_->up);
    if (fall > 0.0 && origin.dot(floor_->up) - floor_->height < reach_ * fall) {
      return true;
    }
  }
  return scene_->occluded(origin.cast<float>(), direction.cast<float>(), 0.0F,
                          static_cast<float>(reach_));
}

double Occlusion::openness(const Vec3& position, const Vec3& normal, const Vec3& face_normal,
                           const HemisphereRays& rays) const {
  const Vec3 origin = position + offset_ * face_normal;
  const Vec3 tangent = normal.unitOrthogonal();
  const Vec3 bitangent = normal.cross(tangent);
  std::size_t open = 0;
  for (std::size_t r = 0; r < rays.count; ++r) {
    const std::size_t k = rays.first + rays.stride * r;
    const double u = std::fmod(
        (static_cast<double>(k) + 0.5) / static_cast<double>(rays.total) + rays.shift[0], 1.0);
    const double v = std::fmod(radical_inverse(static_cast<std::uint32_t>(k)) + rays.shift[1], 1.0);
    const double radius = std::sqrt(u);
    const double angle = 2.0 * std::numbers::pi * v;
    Vec3 direction = radius * std::cos(angle) * tangent + radius * std::sin(angle) * bitangent +
                     std::sqrt(1.0 - u) * normal;
    // Smooth normals see below the flat face they stand on; there the face itself would block.
    const double above = direction.dot(face_normal);
    if (above < 0.0) {
      direction -= 2.0 * above * face_normal;
    }
    open += blocked(origin, direction) ? 0 : 1;
  }
  return static_cast<double>(open) / static_cast<double>(rays.count);
}

}  // namespace vantage
