// SPDX-License-Identifier: MIT
#include "vantage/spatial/mirror_symmetry.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include <gtest/gtest.h>

#include "support/shapes.h"

namespace vantage::test {
namespace {

bool has_normal(const std::vector<MirrorPlane>& planes, const Vec3& normal) {
  for (const MirrorPlane& plane : planes) {
    if (std::abs(plane.normal.dot(normal)) > 1.0 - 1e-6) {
      return true;
    }
  }
  return false;
}

/// A box of unequal sides with a small one on its top, off centre in x: it mirrors in y alone.
TriMesh box_with_a_bump() {
  return together(box(2.0, 1.0, 3.0, 8), box(0.4, 0.4, 0.4, 4), Vec3(1.5, 0.3, 3.0));
}

TEST(MirrorPlanes, OfABoxAreItsThree) {
  const auto planes = mirror_planes(box(2.0, 1.0, 3.0, 8));
  ASSERT_EQ(planes.size(), 3U);
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_TRUE(has_normal(planes, Vec3::Unit(axis)));
  }
  EXPECT_NEAR((planes.front().point - Vec3(1.0, 0.5, 1.5)).norm(), 0.0, 1e-9);
}

TEST(MirrorPlanes, OfABoxWithABumpIsTheOneThroughTheBump) {
  const auto planes = mirror_planes(box_with_a_bump());
  ASSERT_EQ(planes.size(), 1U);
  EXPECT_NEAR(planes.front().normal.y(), 1.0, 1e-6);
}

TEST(MirrorPlanes, OfALargeMeshDoNotDependOnTheOrderOfItsFaces) {
  TriMesh surface = box(2.0, 1.0, 3.0, 70);  // 58 800 faces, of which some are sampled
  for (Vec3& p : surface.positions) {
    p.y() += 0.1 * p.x() * p.z();  // mirrors nothing any more
    p.z() *= 1.0 + 0.2 * p.y();
  }
  TriMesh both = surface;  // but the two sides of x = 3
  for (const Vec3& p : surface.positions) {
    both.positions.emplace_back(6.0 - p.x(), p.y(), p.z());
  }
  const auto count = static_cast<std::uint32_t>(surface.positions.size());
  both.triangles.clear();
  for (const auto& [a, b, c] : surface.triangles) {  // by turns
    both.triangles.push_back({a, b, c});
    both.triangles.push_back({count + a, count + c, count + b});
  }
  const auto planes = mirror_planes(both);
  ASSERT_EQ(planes.size(), 1U);
  EXPECT_GT(std::abs(planes[0].normal.x()), 0.9999);  // samples tell it so well
  std::stable_partition(both.triangles.begin(), both.triangles.end(),
                        [&](const Triangle& t) { return t[0] < count; });
  const auto others = mirror_planes(both);
  ASSERT_EQ(others.size(), planes.size());
  for (std::size_t i = 0; i < planes.size(); ++i) {
    EXPECT_NEAR((others[i].normal - planes[i].normal).norm(), 0.0, 1e-9);
  }
}

// 12 faces make nearly all of the surface; those of the ornaments are so many that some are drawn by lot.
TEST(MirrorPlanes, OfAPlainBoxWithFineOrnamentsAreThoseOfBoth) {
  const TriMesh knob = box(0.05, 0.04, 0.03, 90);
  const TriMesh body = together(box(4.0, 2.0, 1.5, 1), knob, Vec3(4.0, 0.98, 0.735));
  const auto planes = mirror_planes(together(body, knob, Vec3(-0.05, 0.98, 0.735)));
  ASSERT_EQ(planes.size(), 3U);
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_TRUE(has_normal(planes, Vec3::Unit(axis)));
  }
}

TEST(MirrorPlanes, MayBeBrokenByAShareOfTheArea) {
  // A small bump has 0.24 of 22.24, and most of that is far from its image in x.
  const TriMesh surface =
      together(box(2.0, 1.0, 3.0, 8), box(0.2, 0.2, 0.2, 2), Vec3(1.5, 0.4, 3.0));
  for (const double share : {0.006, 0.014}) {
    const auto planes = mirror_planes(surface, {.outlier_share = share});
    // The principal axis, which the bump tilts, comes before the coordinate axis.
    const bool across_x = std::any_of(planes.begin(), planes.end(), [](const MirrorPlane& plane) {
      return plane.normal.x() > 0.99;
    });
    EXPECT_EQ(across_x, share == 0.014) << share;
  }
}

TEST(MirrorPlanes, TurnAndScaleWithTheSurface) {
  for (const double scale : {1e-8, 1.0, 1e8}) {
    const TriMesh surface = moved(box_with_a_bump(), scale, 0.7, Vec3(1.0, 2.0, 3.0).normalized(),
                                  Vec3(5, 6, 7) * scale);
    const TriMesh axis = moved({.positions = {Vec3::UnitY()}}, 1.0, 0.7,
                               Vec3(1.0, 2.0, 3.0).normalized(), Vec3::Zero());
    const auto planes = mirror_planes(surface);
    ASSERT_EQ(planes.size(), 1U) << scale;
    EXPECT_TRUE(has_normal(planes, axis.positions.front())) << scale;
  }
}

TEST(MirrorPlanes, OfNothingAreNone) {
  EXPECT_TRUE(mirror_planes({}).empty());
}

TEST(MirrorImages, OfTwoOrthogonalPlanesAreFour) {
  const std::vector<MirrorPlane> planes{{Vec3::UnitX(), Vec3::Zero()},
                                        {Vec3::UnitZ(), Vec3::Zero()}};
  const Vec3 d = Vec3(1.0, 2.0, 3.0).normalized();
  const auto images = mirror_images(d, planes, 0.01);
  ASSERT_EQ(images.size(), 4U);
  EXPECT_EQ(images.front(), d);
  EXPECT_NEAR((images.back() - Vec3(-d.x(), d.y(), -d.z())).norm(), 0.0, 1e-15);
}

TEST(MirrorImages, InThePlaneAreNoTwins) {
  const std::vector<MirrorPlane> planes{{Vec3::UnitX(), Vec3::Zero()}};
  EXPECT_EQ(mirror_images(Vec3::UnitZ(), planes, 0.01).size(), 1U);
}

}  // namespace
}  // namespace vantage::test
