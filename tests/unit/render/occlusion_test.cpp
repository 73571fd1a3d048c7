// SPDX-License-Identifier: MIT
#include "render/occlusion.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "support/shapes.h"

namespace vantage {
namespace {

constexpr std::size_t kMany = 4096;
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

HemisphereFrame frame_of(const Vec3f& normal) {
  return turned_frame(normal, Vec3f(0.6F, 0.0F, 0.8F), Vec3f(0.8F, 0.0F, -0.6F), Vec3f::UnitY());
}

double openness_under(const TriMesh& mesh, double reach, std::optional<Floor> floor = {},
                      const Vec3f& normal = Vec3f::UnitZ()) {
  const RayScene scene(mesh);
  const HemisphereDirections directions(kMany, 1);
  return static_cast<double>(
      Occlusion(scene, reach, 1e-4, floor)
          .openness(Vec3f::Zero(), frame_of(normal), normal, directions.part(0)));
}

TEST(TurnedFrame, StandsAtRightAnglesOnEveryNormal) {
  for (int i = 0; i < 100; ++i) {
    const auto turn = static_cast<float>(i);
    const Vec3f normal =
        Vec3f(std::sin(turn), std::cos(1.7F * turn), std::sin(0.3F * turn) + 1.1F).normalized();
    const HemisphereFrame frame = frame_of(normal);
    EXPECT_NEAR(frame.tangent.dot(normal), 0.0F, 1e-6F);
    EXPECT_NEAR(frame.bitangent.dot(normal), 0.0F, 1e-6F);
    EXPECT_NEAR(frame.tangent.dot(frame.bitangent), 0.0F, 1e-6F);
    EXPECT_NEAR(frame.tangent.norm(), 1.0F, 1e-6F);
    EXPECT_NEAR(frame.bitangent.norm(), 1.0F, 1e-6F);
  }
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
  EXPECT_EQ(openness_under(nothing_near, kFar, floor, Vec3f::UnitZ()), 1.0);
  EXPECT_NEAR(openness_under(nothing_near, 1e6, floor, -Vec3f::UnitZ()), 0.0, kCounting);
  EXPECT_NEAR(openness_under(nothing_near, 1e6, floor, Vec3f::UnitX()), 0.5, kCounting);
}

TEST(Occlusion, AFloorOutOfReachBlocksNothing) {
  EXPECT_EQ(openness_under(disc(0.1, 100.0), 1.0, Floor{Vec3::UnitZ(), -2.0}, -Vec3f::UnitZ()),
            1.0);
}

TEST(Occlusion, PartsOfASetTogetherAreTheSet) {
  const TriMesh mesh = disc(1.0, 1.0);
  const RayScene scene(mesh);
  const Occlusion occlusion(scene, kFar, 1e-4, {});
  const HemisphereFrame frame = frame_of(Vec3f::UnitZ());
  const auto open = [&](std::span<const Vec3f> directions) {
    return static_cast<double>(
        occlusion.openness(Vec3f::Zero(), frame, Vec3f::UnitZ(), directions));
  };
  constexpr std::size_t kParts = 8;
  const HemisphereDirections dealt(kMany / kParts, kParts);
  double sum = 0.0;
  for (std::size_t part = 0; part < kParts; ++part) {
    sum += open(dealt.part(part)) / kParts;
  }
  EXPECT_NEAR(sum, open(HemisphereDirections(kMany, 1).part(0)), 1e-6);
}

}  // namespace
}  // namespace vantage
