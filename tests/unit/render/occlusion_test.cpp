// SPDX-License-Identifier: MIT
#include "render/occlusion.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "support/shapes.h"

namespace vantage {
namespace {

constexpr HemisphereRays kMany{.count = 4096, .total = 4096, .shift = {0.37, 0.61}};
/// 4096 members of a Hammersley set count areas of simple outline to about 1 in 500.
constexpr double kCounting = 0.004;
constexpr double kFar = 10.0;

/// A disc of radius `radius` around the z axis at height `height`.
TriMesh disc(double radius, double height) {
  TriMesh mesh;
  constexpr int kAround = 256;
  mesh.positions.emplace_back(0, 0, height);
  for (int i = 0; i < kAround; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / kAround;
    mesh.positions.emplace_back(radius * std::cos(angle), radius * std::sin(angle), height);
    mesh.triangles.push_back(
        {0, static_cast<std::uint32_t>(i + 1), static_cast<std::uint32_t>((i + 1) % kAround + 1)});
  }
  return mesh;
}

double openness_under(const TriMesh& mesh, double reach, std::optional<Floor> floor = {},
                      const Vec3& normal = Vec3::UnitZ()) {
  const RayScene scene(mesh);
  return Occlusion(scene, reach, 1e-4, floor).openness(Vec3::Zero(), normal, normal, kMany);
}

TEST(Occlusion, OfADiscOverheadIsItsFormFactor) {
  for (const double radius : {0.3, 1.0, 3.0}) {
    // Seen from below its middle, a disc fills R² / (R² + h²) of a cosine-weighted hemisphere.
    const double height = 1.0;
    const double blocked = radius * radius / (radius * radius + height * height);
    EXPECT_NEAR(openness_under(disc(radius, height), kFar), 1.0 - blocked, kCounting) << radius;
  }
}

TEST(Occlusion, ReachesNoFurtherThanAsked) {
  EXPECT_EQ(openness_under(disc(0.3, 1.0), 0.99), 1.0);
}

TEST(Occlusion, InsideAClosedShellNothingIsOpen) {
  EXPECT_EQ(openness_under(test::sphere(2), kFar), 0.0);
}

TEST(Occlusion, AFloorBlocksWhatGoesBelowIt) {
  const Floor floor{Vec3::UnitZ(), -0.1};
  const TriMesh nothing_near = disc(0.1, 100.0);
  EXPECT_EQ(openness_under(nothing_near, kFar, floor, Vec3::UnitZ()), 1.0);
  EXPECT_NEAR(openness_under(nothing_near, 1e6, floor, -Vec3::UnitZ()), 0.0, kCounting);
  EXPECT_NEAR(openness_under(nothing_near, 1e6, floor, Vec3::UnitX()), 0.5, kCounting);
}

TEST(Occlusion, AFloorOutOfReachBlocksNothing) {
  EXPECT_EQ(openness_under(disc(0.1, 100.0), 1.0, Floor{Vec3::UnitZ(), -2.0}, -Vec3::UnitZ()), 1.0);
}

TEST(Occlusion, PartsOfASetTogetherAreTheSet) {
  const TriMesh mesh = disc(1.0, 1.0);
  const RayScene scene(mesh);
  const Occlusion occlusion(scene, kFar, 1e-4, {});
  double sum = 0.0;
  for (std::size_t part = 0; part < 8; ++part) {
    HemisphereRays rays = kMany;
    rays.first = part;
    rays.stride = 8;
    rays.count = kMany.total / 8;
    sum += occlusion.openness(Vec3::Zero(), Vec3::UnitZ(), Vec3::UnitZ(), rays) / 8.0;
  }
  EXPECT_DOUBLE_EQ(sum, occlusion.openness(Vec3::Zero(), Vec3::UnitZ(), Vec3::UnitZ(), kMany));
}

}  // namespace
}  // namespace vantage
