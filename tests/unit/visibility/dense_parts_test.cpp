// SPDX-License-Identifier: MIT
#include "visibility/dense_parts.h"

#include <array>
#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

#include "support/shapes.h"
#include "support/visibility_oracle.h"
#include "visibility/sample_query.h"
#include "visibility/surface.h"

namespace vantage {
namespace {

/// A torus with two small ones of another size each, the second behind the first as the eyes below look.
TriMesh torus_with_small_ones(double size) {
  const Vec3 axis(1.0, 2.0, 3.0);
  const TriMesh small = test::moved(test::torus(1.0, 0.4, 32, 16), size, 0.4, axis, Vec3::Zero());
  const TriMesh both = test::together(small, test::moved(small, 0.25, 0.0, axis, Vec3::Zero()),
                                      {0.0, 0.0, -3.0 * size});
  return test::together(test::torus(1.0, 0.4, 32, 16), both, {0.3, 0.2, 0.6});
}

std::array<Viewpoint, 5> eyes() {
  return {Viewpoint{Projection::Perspective, Vec3(0.3, 0.2, 4.0)},
          Viewpoint{Projection::Perspective, Vec3(2.0, -3.0, 1.5)},
          Viewpoint{Projection::Perspective, Vec3(0.3, 0.2, 900.0)},
          Viewpoint{Projection::Orthographic, Vec3(0.0, 0.0, 1.0)},
          Viewpoint{Projection::Orthographic, Vec3(-0.6, 0.0, -0.8)}};
}

/// Samples asked about by a picture, and one by one.
void expect_answers_of_segments(const TriMesh& mesh, FaceSides sides) {
  const std::array all{sides};
  SampleScene scene(visibility_surface(mesh, all));
  for (const Viewpoint& eye : eyes()) {
    SampleQuery query(scene, eye_in_frame(eye, scene.surface().frame), {});
    const std::vector<std::uint8_t> every(scene.surface().samples.size(), 1);
    EXPECT_EQ(query.seen_among(every), query.seen_by_segments(every)) << eye.position.transpose();
  }
}

TEST(DenseParts, AreNoneOfAnEvenSurface) {
  EXPECT_TRUE(dense_samples(test::torus(1.0, 0.4, 60, 30).positions).empty());
  EXPECT_TRUE(dense_samples(test::sheet(1.0, 1.0, 40).positions).empty());
  EXPECT_TRUE(dense_samples(std::vector<Vec3>(1000, Vec3(1.0, 2.0, 3.0))).empty());
}

TEST(DenseParts, AreTheSmallOnes) {
  const TriMesh mesh = torus_with_small_ones(1e-3);
  const std::vector<std::vector<std::uint32_t>> parts = dense_samples(mesh.positions);
  ASSERT_EQ(parts.size(), 1U);
  EXPECT_EQ(parts[0].size(), 2U * 32U * 16U);
  EXPECT_EQ(parts[0].front(), 32U * 16U);
}

/// Wherever the borders of voxels are, nothing of a model is left beside its part by a stray face far away.
TEST(DenseParts, AreWholeBesideAStrayFace) {
  const TriMesh ring = test::torus(1.0, 0.4, 60, 30);
  for (const double away : {50.0, 60.0, 80.0, 100.0, 140.0, 300.0}) {
    std::vector<Vec3> samples = ring.positions;
    for (const Vec3& corner : {Vec3(0.0, 0.0, 0.0), Vec3(0.01, 0.0, 0.0), Vec3(0.0, 0.01, 0.0)}) {
      samples.emplace_back(corner + Vec3(away, 0.3 * away, 0.1 * away));
    }
    const std::vector<std::vector<std::uint32_t>> parts = dense_samples(samples);
    ASSERT_EQ(parts.size(), 1U) << away;
    EXPECT_EQ(parts[0].size(), ring.positions.size()) << away;
  }
}

/// Each is the small part of another one.
TEST(DenseParts, MayHaveDensePartsInTurn) {
  const TriMesh ring = test::torus(1.0, 0.4, 32, 16);
  const TriMesh small = test::together(
      ring, test::moved(ring, 1e-3, 0.0, Vec3::UnitX(), Vec3::Zero()), {0.0, 0.0, 1.0});
  const TriMesh mesh = test::together(
      ring, test::moved(small, 1e-3, 0.0, Vec3::UnitX(), Vec3::Zero()), {0.0, 0.0, 1.0});
  ASSERT_EQ(dense_samples(mesh.positions).size(), 1U);
  EXPECT_EQ(dense_samples(small.positions).size(), 1U);
  expect_answers_of_segments(mesh, FaceSides::Front);
}

TEST(DenseParts, AreAnsweredAsBySegments) {
  for (const double size : {1e-2, 1e-3, 1e-6}) {
    expect_answers_of_segments(torus_with_small_ones(size), FaceSides::Front);
    expect_answers_of_segments(torus_with_small_ones(size), FaceSides::Both);
  }
}

/// A sheet whose middle is folded out of small cells: faces of the part and of the rest share samples.
TEST(DenseParts, MayBeConnectedWithTheRest) {
  TriMesh mesh = test::sheet(2.0, 2.0, 80);
  for (Vec3& p : mesh.positions) {
    const Vec3 off = p - Vec3(1.0, 1.0, 0.0);
    const double r = off.norm();
    // Most cells are drawn to the middle.
    p = Vec3(1.0, 1.0, 0.0) + std::pow(r, 6.0) * off +
        Vec3(0.0, 0.0, 0.3 * std::pow(r, 7.0) * std::sin(40.0 * r));
  }
  ASSERT_EQ(dense_samples(mesh.positions).size(), 1U);
  expect_answers_of_segments(mesh, FaceSides::Both);
}

TEST(DenseParts, AreSeenAsBruteForceSeesThem) {
  const TriMesh mesh = torus_with_small_ones(1e-3);
  const VertexVisibility visibility(mesh, {FaceSides::Front});
  std::size_t decided = 0;
  for (const Viewpoint& eye : eyes()) {
    constexpr std::size_t kStep = 7;
    const std::vector<std::uint8_t> found = visibility.visible_vertices(eye);
    const std::vector<test::Seen> expected =
        test::brute_force_visibility(mesh, FaceSides::Front, eye, kStep);
    for (std::size_t v = 0; v < found.size(); v += kStep) {
      if (expected[v] != test::Seen::Exactly) {
        ++decided;
        ASSERT_EQ(found[v] != 0, expected[v] == test::Seen::Yes)
            << v << " from " << eye.position.transpose();
      }
    }
  }
  EXPECT_GT(decided, mesh.positions.size() / 2);
}

}  // namespace
}  // namespace vantage
