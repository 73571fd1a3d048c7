// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "vantage/spatial/directions.h"
#include "vantage/visibility/vertex_visibility.h"

#include "support/shapes.h"
#include "view/sketch_picture.h"
#include "view/sketch_scorer.h"

namespace vantage {
namespace {

class SketchScores : public testing::Test {
 protected:
  TriMesh mesh = test::torus(1.0, 0.4, 200, 60);
  std::vector<FaceSides> sides{FaceSides::Front};
  VertexVisibility visibility{mesh, sides};
  std::vector<double> significance = [this] {
    std::vector<double> values;
    for (const Vec3& p : mesh.positions) {
      values.push_back(1.0 + p.x() * p.x() + 0.5 * p.z());
    }
    return values;
  }();
  std::vector<Vec3> directions = direction_set(ViewSphereBase::Icosahedron, 1).directions;

  void expect_near_exact(const ScoringCamera& camera) const {
    const SketchScorer sketch(mesh, sides, significance, camera);
    const ViewScorer exact(visibility, significance, camera);
    const std::vector<double> estimates = sketch.score_all(directions);
    const std::vector<double> scores = exact.score_all(directions);
    for (std::size_t i = 0; i < scores.size(); ++i) {
      // A cell is 1/96 of the picture, which is as wide as the sphere: the tube, 0.8 of 2.8, is 27
      // of them wide and known to half a cell a side, and the ways of its sides have some to spare.
      EXPECT_NEAR(estimates[i], scores[i], exact.total() / 28.0);
    }
  }
};

TEST_F(SketchScores, FollowTheExactOnesInPerspective) {
  expect_near_exact({.sphere = {Vec3::Zero(), 2.8}});
}

TEST_F(SketchScores, FollowTheExactOnesInParallelProjection) {
  expect_near_exact({.sphere = {Vec3::Zero(), 2.8}, .projection = Projection::Orthographic});
}

TEST_F(SketchScores, FollowTheExactOnesFromVeryFar) {
  expect_near_exact({.sphere = {Vec3::Zero(), 2.8}, .distance_factor = 1e6});
}

TEST_F(SketchScores, AreFiniteFromAnEyeOnTheSphereAndInsideTheModel) {
  // The torus has a radius of 1.4: of these spheres it fills the first and reaches out of the
  // others, so that corners lie beside the eye and behind it, at last beyond single precision. (Casts
  // and places in the picture are checked by sanitizers.)
  for (const double diameter : {2.8, 2.0, 1e-3, 1e-12, 1e-60}) {
    const SketchScorer sketch(mesh, sides, significance,
                              {.sphere = {Vec3::Zero(), diameter}, .distance_factor = 1.0 + 1e-15});
    for (const double score : sketch.score_all(directions)) {
      EXPECT_TRUE(score >= 0.0 && std::isfinite(score));
    }
  }
}

TEST_F(SketchScores, AreTheSameForAnyNumberOfThreads) {
  const SketchScorer sketch(mesh, sides, significance, {.sphere = {Vec3::Zero(), 2.8}});
  EXPECT_EQ(sketch.score_all(directions, {.max_threads = 1}),
            sketch.score_all(directions, {.max_threads = 3}));
}

TEST_F(SketchScores, LeaveOutIsolatedVerticesAndKeepTheSidesOfComponents) {
  // An open sheet before the torus, and a vertex of no face before both.
  TriMesh scene;
  scene.positions.emplace_back(9.0, 9.0, 9.0);
  const TriMesh both = test::together(test::sheet(0.5, 0.5, 20), mesh, Vec3(0.0, 0.0, 2.0));
  scene.positions.insert(scene.positions.end(), both.positions.begin(), both.positions.end());
  for (Triangle t : both.triangles) {
    scene.triangles.push_back({t[0] + 1, t[1] + 1, t[2] + 1});
  }
  const std::vector<FaceSides> rules{FaceSides::Front, FaceSides::Both, FaceSides::Front};
  const std::vector<double> ones(scene.positions.size(), 1.0);
  const ScoringCamera far{.sphere = {Vec3(0, 0, 1), 6.0}};
  const SketchScorer sketch(scene, rules, ones, far);
  const VertexVisibility sight(scene, rules);
  const ViewScorer exact(sight, ones, far);
  // From below, the back of the sheet counts as it does for exact scores.
  const std::vector<Vec3> below{-Vec3::UnitZ()};
  EXPECT_NEAR(sketch.score_all(below).front(), exact.score(below.front()), 0.03 * exact.total());
}

TEST(SketchScorer, CountsEachFlatSideOfABoxAtItsCorners) {
  // From along (1, 1, 1) seven of a cube's eight corners are seen, from along x four of them: each
  // corner is seen as soon as one of its three sides is turned to the eye.
  const TriMesh cube = test::box(1.0, 1.0, 1.0, 1);
  const std::vector<double> ones(cube.positions.size(), 1.0);
  const SketchScorer sketch(cube, {FaceSides::Front}, ones, {.sphere = {Vec3::Constant(0.5), 1.8}});
  const std::vector<double> seen =
      sketch.score_all(std::vector<Vec3>{Vec3(1, 1, 1).normalized(), Vec3::UnitX()});
  EXPECT_NEAR(seen[0], 7.0, 1e-3);
  EXPECT_NEAR(seen[1], 4.0, 1e-3);
}

TEST(SketchScorer, FindsNothingOnAMapThatIsZero) {
  const TriMesh mesh = test::sphere(3);
  const std::vector<double> zero(mesh.positions.size(), 0.0);
  const SketchScorer sketch(mesh, {FaceSides::Front}, zero, {.sphere = {Vec3::Zero(), 2.0}});
  EXPECT_EQ(sketch.score_all(std::vector<Vec3>{Vec3::UnitX()}).front(), 0.0);
}

TEST(SketchSurface, HasAboutSoManyFacesAndKeepsTheShape) {
  const TriMesh mesh = test::sphere(5);  // 20 480 faces
  const SketchSurface coarse = sketch_surface(mesh, {FaceSides::Front}, {Vec3::Zero(), 2.0}, 500);
  EXPECT_GT(coarse.face_count, 400U);
  EXPECT_LE(coarse.face_count, 500U);
  // Of a polyhedron inside the sphere: a plane at 0.9 would be that of a face over 0.7 long.
  const auto end = coarse.planes.offset.begin() + static_cast<std::ptrdiff_t>(coarse.face_count);
  const auto [low, high] = std::minmax_element(coarse.planes.offset.begin(), end);
  EXPECT_GT(*low, 0.9F);
  EXPECT_LE(*high, 1.0F);
  for (const SketchCoordinates& corner : coarse.corners) {
    EXPECT_NEAR(Vec3(corner.x[0], corner.y[0], corner.z[0]).norm(), 1.0, 1e-3);
  }
}

TEST(SketchSurface, IsTheSameWithAVertexOfNoFaceFarAway) {
  TriMesh mesh = test::sphere(5);
  const SketchSurface alone = sketch_surface(mesh, {FaceSides::Front}, {Vec3::Zero(), 2.0}, 500);
  mesh.positions.emplace_back(1e4, 0.0, 0.0);
  const SketchSurface with =
      sketch_surface(mesh, {FaceSides::Front, FaceSides::Front}, {Vec3::Zero(), 2.0}, 500);
  EXPECT_EQ(with.corners[0].x, alone.corners[0].x);
  EXPECT_EQ(with.face_count, alone.face_count);
}

/// A thousand tetrahedra around the places of a lattice, up to `jitter` off them.
TriMesh crumbs(double jitter) {
  TriMesh mesh;
  for (std::uint32_t i = 0; i < 1000; ++i) {
    const Vec3 off(std::sin(7.1 * i), std::sin(5.3 * i), std::sin(3.7 * i));
    const Vec3 at = Vec3(i % 10, i / 10 % 10, i / 100 % 10) + jitter * off;
    mesh.positions.insert(
        mesh.positions.end(),
        {at, at + 0.8 * Vec3::UnitX(), at + 0.8 * Vec3::UnitY(), at + 0.8 * Vec3::UnitZ()});
    const std::uint32_t k = 4 * i;
    mesh.triangles.insert(
        mesh.triangles.end(),
        {{k, k + 2, k + 1}, {k, k + 1, k + 3}, {k, k + 3, k + 2}, {k + 1, k + 2, k + 3}});
  }
  return mesh;
}

TEST(SketchSurface, KeepsSomethingOfALatticeOfSmallParts) {
  const std::vector<FaceSides> sides(1000, FaceSides::Front);
  const SketchSurface coarse = sketch_surface(crumbs(0.0), sides, {Vec3::Constant(5.0), 20.0}, 300);
  EXPECT_GT(coarse.face_count, 75U);
  EXPECT_LE(coarse.face_count, 4000U);
}

TEST(SketchScorer, HidesSmallPartsBehindOthers) {
  const TriMesh mesh = crumbs(0.3);
  const std::vector<FaceSides> sides(1000, FaceSides::Front);
  const std::vector<double> ones(mesh.positions.size(), 1.0);
  const ScoringCamera camera{.sphere = {Vec3::Constant(4.9), 18.0}};
  const SketchScorer sketch(mesh, sides, ones, camera);
  const VertexVisibility sight(mesh, sides);
  const ViewScorer exact(sight, ones, camera);
  const std::vector<Vec3> oblique{Vec3(0.5, 0.3, 0.8).normalized(),
                                  Vec3(-0.7, 0.6, 0.2).normalized()};
  const std::vector<double> estimates = sketch.score_all(oblique);
  for (std::size_t i = 0; i < oblique.size(); ++i) {
    EXPECT_NEAR(estimates[i] / exact.score(oblique[i]), 1.0, 0.1);
  }
}

TEST(SketchPicture, HoldsTheNearestFaceOfEachCell) {
  // Two squares across the eye's way, the smaller one nearer: nearness over a plane across is one
  // over its distance.
  const TriMesh mesh =
      test::together(test::sheet(1.0, 1.0, 3), test::sheet(0.4, 0.4, 3), Vec3(0.3, 0.3, 0.5));
  const ScoringCamera camera{.sphere = {Vec3(0.5, 0.5, 0.0), 2.0}, .distance_factor = 3.0};
  const SketchSurface coarse =
      sketch_surface(mesh, {FaceSides::Front, FaceSides::Front}, camera.sphere, 1000);
  constexpr std::size_t kCells = 64;
  SketchPicture picture(coarse, kCells);
  picture.draw(SketchFrame(Vec3::UnitZ(), camera, kCells));
  constexpr std::size_t kMiddle = kCells / 2 * kCells + kCells / 2;
  EXPECT_NEAR(picture.nearness()[kMiddle], 1.0 / 2.5, 1e-6);
  // 0.3 from the middle, at a distance of 3: beside the near square.
  constexpr std::size_t kAside = 8;  // cells; 0.25 of the half picture, of tangent 1 / √8
  EXPECT_NEAR(picture.nearness()[kMiddle + kAside], 1.0 / 3.0, 1e-6);
  EXPECT_LT(picture.nearness()[0], 0.0F);
  // From behind there is nothing, and what was there is gone.
  picture.draw(SketchFrame(-Vec3::UnitZ(), camera, kCells));
  EXPECT_LT(picture.nearness()[kMiddle], 0.0F);
}

TEST(SketchPicture, ShowsTheBacksOfTwoSidedFaces) {
  const TriMesh mesh = test::sheet(1.0, 1.0, 3);
  constexpr std::size_t kCells = 64;
  constexpr std::size_t kMiddle = kCells / 2 * kCells + kCells / 2;
  for (const Projection projection : {Projection::Perspective, Projection::Orthographic}) {
    const ScoringCamera camera{.sphere = {Vec3(0.5, 0.5, -0.5), 4.0}, .projection = projection};
    for (const FaceSides side : {FaceSides::Front, FaceSides::Both}) {
      const SketchSurface coarse = sketch_surface(mesh, {side}, camera.sphere, 1000);
      SketchPicture picture(coarse, kCells);
      picture.draw(SketchFrame(-Vec3::UnitZ(), camera, kCells));
      const bool is_seen = picture.nearness()[kMiddle] > std::numeric_limits<float>::lowest();
      EXPECT_EQ(is_seen, side == FaceSides::Both);
    }
  }
}

}  // namespace
}  // namespace vantage
