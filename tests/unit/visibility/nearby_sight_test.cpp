// SPDX-License-Identifier: MIT
#include "visibility/nearby_sight.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "support/shapes.h"

namespace vantage {
namespace {

constexpr double kStep = 0.02;  // radians between eyes: a good degree

/// Eyes around one, which comes first.
std::vector<Viewpoint> ring(Projection projection, const Vec3& direction, double distance,
                            double angle) {
  const Vec3 right = direction.unitOrthogonal();
  const Vec3 up = direction.cross(right);
  std::vector<Viewpoint> eyes{{projection, distance * direction}};
  for (int k = 0; k < 6; ++k) {
    const Vec3 aside = std::cos(1.05 * k) * right + std::sin(1.05 * k) * up;
    eyes.push_back({projection, distance * (direction + angle * aside).normalized()});
  }
  return eyes;
}

std::vector<std::uint32_t> all_of(const TriMesh& mesh) {
  std::vector<std::uint32_t> vertices(mesh.positions.size());
  std::iota(vertices.begin(), vertices.end(), 0U);
  return vertices;
}

void expect_the_same(const TriMesh& mesh, const std::vector<FaceSides>& sides,
                     Projection projection) {
  const VertexVisibility visibility(mesh, sides);
  const double distance = projection == Projection::Perspective ? 4.0 : 1.0;
  for (const Vec3& towards : {Vec3(0.3, -0.5, 0.8), Vec3(-0.9, 0.1, 0.2), Vec3(0, 0, 1)}) {
    const auto eyes = ring(projection, towards.normalized(), distance, kStep);
    const NearbySight sight(visibility, all_of(mesh), eyes);
    for (const double angle : {0.0, 0.3 * kStep, kStep}) {
      for (const Viewpoint& eye : ring(projection, towards.normalized(), distance, angle)) {
        ASSERT_TRUE(sight.covers(eye));
        ASSERT_EQ(sight.seen(eye), visibility.visible_vertices(eye)) << angle;
      }
    }
    const auto beyond = ring(projection, towards.normalized(), distance, 1.01 * kStep);
    EXPECT_TRUE(std::none_of(beyond.begin() + 1, beyond.end(),
                             [&](const Viewpoint& eye) { return sight.covers(eye); }));
  }
}

TEST(NearbySight, SeesTheSameWithinAWiderOne) {
  const TriMesh mesh = test::torus(1.0, 0.4, 60, 24);
  const VertexVisibility visibility(mesh, {FaceSides::Front});
  const Vec3 towards = Vec3(0.3, -0.5, 0.8).normalized();
  const std::vector<Viewpoint> eyes = ring(Projection::Perspective, towards, 4.0, kStep);
  const std::vector<Viewpoint> close = ring(Projection::Perspective, towards, 4.0, 0.4 * kStep);
  const NearbySight wide(visibility, all_of(mesh), eyes);
  std::vector<std::uint32_t> some;
  for (std::uint32_t v = 0; v < mesh.positions.size(); v += 3) {
    some.push_back(v);
  }
  const NearbySight narrow(wide, some, close);
  EXPECT_FALSE(narrow.covers(eyes[1]));
  for (const Viewpoint& eye : close) {
    const std::vector<std::uint8_t> all = visibility.visible_vertices(eye);
    const std::vector<std::uint8_t> seen = narrow.seen(eye);
    for (std::size_t k = 0; k < some.size(); ++k) {
      ASSERT_EQ(seen[k], all[some[k]]);
    }
  }
}

TEST(NearbySight, SeesWhatASingleEyeSees) {
  expect_the_same(test::torus(1.0, 0.4, 60, 24), {FaceSides::Front}, Projection::Perspective);
  expect_the_same(test::torus(1.0, 0.4, 60, 24), {FaceSides::Front}, Projection::Orthographic);
}

TEST(NearbySight, KnowsOpenSurfacesAndComponentsFarApart) {
  // A sheet, seen from either side, and a ball that hides some of it.
  const TriMesh scene =
      test::together(test::sheet(1.0, 1.0, 20), test::sphere(3), Vec3(0.2, 0.3, 1.2));
  for (const Projection projection : {Projection::Perspective, Projection::Orthographic}) {
    expect_the_same(scene, {FaceSides::Both, FaceSides::Front}, projection);
  }
}

TEST(NearbySight, KnowsVerticesOfOnePositionAndOfNoFace) {
  TriMesh mesh = test::soup(test::torus(1.0, 0.4, 30, 12));
  mesh.positions.emplace_back(0.0, 0.0, 3.0);
  expect_the_same(mesh, {FaceSides::Front}, Projection::Perspective);
}

TEST(NearbySight, CoversNoEyeFarAwayOrNoneWhereTheMiddleIsInTheModel) {
  const TriMesh mesh = test::torus(1.0, 0.4, 60, 24);
  const VertexVisibility visibility(mesh, {FaceSides::Front});
  const auto outside = ring(Projection::Perspective, Vec3::UnitX(), 4.0, kStep);
  const NearbySight sight(visibility, all_of(mesh), outside);
  EXPECT_FALSE(sight.covers(ring(Projection::Perspective, Vec3::UnitX(), 4.0, 2.0 * kStep)[1]));
  const auto within = ring(Projection::Perspective, Vec3::UnitX(), 0.9, kStep);
  const NearbySight blind(visibility, all_of(mesh), within);
  EXPECT_FALSE(blind.covers(within.front()));
}

}  // namespace
}  // namespace vantage
