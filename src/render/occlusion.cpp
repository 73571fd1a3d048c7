// SPDX-License-Identifier: MIT
#include "render/occlusion.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>

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

HemisphereFrame turned_frame(const Vec3f& normal, const Vec3f& axis, const Vec3f& right,
                             const Vec3f& up) {
  constexpr float kLeast = 1e-3F;  // of normals opposite to the axis
  const Vec3f half = (axis + normal) / std::max(kLeast, 1.0F + axis.dot(normal));
  return {normal, right - normal.dot(right) * half, up - normal.dot(up) * half};
}

HemisphereDirections::HemisphereDirections(std::size_t each, std::size_t parts) : each_(each) {
  const std::size_t total = each * parts;
  directions_.reserve(total);
  for (std::size_t part = 0; part < parts; ++part) {
    for (std::size_t i = 0; i < each; ++i) {
      const std::size_t member = part + parts * i;
      const double u = (static_cast<double>(member) + 0.5) / static_cast<double>(total);
      const double angle =
          2.0 * std::numbers::pi * radical_inverse(static_cast<std::uint32_t>(member));
      directions_.push_back(
          Vec3(std::sqrt(u) * std::cos(angle), std::sqrt(u) * std::sin(angle), std::sqrt(1.0 - u))
              .cast<float>());
    }
  }
}

Occlusion::Occlusion(const RayScene& scene, double reach, double offset,
                     const std::optional<Floor>& floor, double width)
    : scene_(&scene),
      reach_(static_cast<float>(reach)),
      offset_(static_cast<float>(offset)),
      floor_(floor),
      width_(static_cast<float>(width)) {}

bool Occlusion::below_floor(const Vec3f& origin, const Vec3f& direction) const {
  const double fall = -direction.cast<double>().dot(floor_->up);
  return fall > 0.0 && origin.cast<double>().dot(floor_->up) - floor_->height <
                           static_cast<double>(reach_) * fall;
}

float Occlusion::openness(const Vec3f& position, const HemisphereFrame& frame,
                          const Vec3f& face_normal, std::span<const Vec3f> directions) const {
  const Vec3f origin = position + offset_ * face_normal;
  std::size_t blocked = 0;
  RayPacket packet;
  std::size_t waiting = 0;
  const auto trace = [&] {
    blocked += waiting > 0 ? scene_->count_occluded(packet, waiting, width_) : 0;
    waiting = 0;
  };
  for (const Vec3f& d : directions) {
    Vec3f direction = d.x() * frame.tangent + d.y() * frame.bitangent + d.z() * frame.normal;
    // Smooth normals see below the flat face they stand on; there the face itself would block.
    const float above = direction.dot(face_normal);
    if (above < 0.0F) {
      direction -= 2.0F * above * face_normal;
    }
    if (floor_ && below_floor(origin, direction)) {
      ++blocked;
      continue;
    }
    packet[waiting++] = {origin, direction, 0.0F, reach_};
    if (waiting == packet.size()) {
      trace();
    }
  }
  trace();
  return static_cast<float>(directions.size() - blocked) / static_cast<float>(directions.size());
}

}  // namespace vantage
