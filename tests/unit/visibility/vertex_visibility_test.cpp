// SPDX-License-Identifier: MIT
#include "vantage/visibility/vertex_visibility.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <random>
#include <stop_token>
#include <vector>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "vantage/core/error.h"

#include "support/shapes.h"

namespace vantage {
namespace {

using Bytes = std::vector<std::uint8_t>;

Viewpoint at(double x, double y, double z) {
  return {Projection::Perspective, Vec3(x, y, z)};
}

Viewpoint along(const Vec3& direction) {
  return {Projection::Orthographic, direction.normalized()};
}

Bytes seen(const TriMesh& mesh, FaceSides sides, const Viewpoint& eye) {
  return VertexVisibility(mesh, {sides}).visible_vertices(eye);
}

std::size_t count(const Bytes& visible) {
  return std::accumulate(visible.begin(), visible.end(), std::size_t{0});
}

/// A triangle in the plane z = height around the z axis.
TriMesh lid(double height, double size) {
  return {{{-size, -size, height}, {size, -size, height}, {0, size, height}}, {{0, 1, 2}}};
}

TEST(VertexVisibility, SeesOfASphereTheFractionThatTheDistanceAllows) {
  const TriMesh ball = test::sphere(5);
  for (const double distance : {1.5, 2.0, 4.0}) {
    const Bytes visible = seen(ball, FaceSides::Front, at(0.0, 0.6 * distance, 0.8 * distance));
    const double fraction =
        static_cast<double>(count(visible)) / static_cast<double>(visible.size());
    // A spherical cap: (1 − r/d)/2. A vertex counts up to one edge beyond the rim, as long as one
    // of its faces is turned to the eye: edges are up to 0.04 rad long at level 5, and a band that
    // wide holds at most 0.04/2 of the sphere.
    const double cap = (1.0 - 1.0 / distance) / 2.0;
    EXPECT_GT(fraction, cap) << distance;
    EXPECT_LT(fraction, cap + 0.02) << distance;
  }
}

TEST(VertexVisibility, SegmentsOneByOneDecideAsAllAtOnceDo) {
  for (const TriMesh& mesh : {test::torus(1.0, 0.4, 40, 20), test::box(1.0, 2.0, 3.0, 6)}) {
    const VertexVisibility visibility(mesh, {FaceSides::Front});
    Bytes some(mesh.positions.size(), 0);
    for (std::size_t v = 0; v < some.size(); v += 3) {
      some[v] = 1;
    }
    for (const Viewpoint& eye : {at(0.0, 0.9, 6.0), at(5.0, 3.0, 1.0), along({1.0, 0.2, 0.1})}) {
      EXPECT_EQ(visibility.visible_by_segments(some, eye), visibility.visible_among(some, eye));
    }
  }
}

TEST(VertexVisibility, FacesSeenAlmostEdgeOnHideWhatIsBehindThem) {
  // Each runs along the line of sight, wider across it than what a float tells by a hundredth to some
  // times; a small face's corner is behind its middle. The picture cannot tell its sides apart.
  constexpr int kFaces = 300;
  const Vec3 eye(0.0, 0.0, 10.0);
  std::mt19937 random(5);
  std::uniform_real_distribution<double> place(-1.0, 1.0);
  TriMesh mesh;
  const auto add = [&](const Vec3& a, const Vec3& b, const Vec3& c) {
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    mesh.positions.insert(mesh.positions.end(), {a, b, c});
    mesh.triangles.push_back({first, first + 1, first + 2});
  };
  for (int k = 0; k < kFaces; ++k) {
    const Vec3 middle(place(random), place(random), 0.5 + 0.4 * place(random));
    const Vec3 sight = (middle - eye).normalized();
    const Vec3 along = sight.cross(Vec3(place(random), place(random), place(random))).normalized();
    const Vec3 across = std::pow(10.0, -7.5 + 1.5 * place(random)) * sight.cross(along);
    add(middle - 0.1 * along - 0.02 * sight - across, middle + 0.1 * along - 0.02 * sight - across,
        middle + 0.04 * sight + 2.0 * across);
    const Vec3 behind = middle + 0.1 * sight;
    add(behind, behind + 0.001 * along + 0.01 * sight, behind - 0.001 * along + 0.01 * sight);
  }
  const VertexVisibility visibility(mesh, {FaceSides::Both});
  const Bytes all(mesh.positions.size(), 1);
  const Bytes by_segments = visibility.visible_by_segments(all, at(eye.x(), eye.y(), eye.z()));
  std::size_t hidden = 0;
  for (std::size_t v = 3; v < by_segments.size(); v += 6) {
    hidden += by_segments[v] == 0 ? 1 : 0;
  }
  EXPECT_EQ(hidden, std::size_t{kFaces});
  EXPECT_EQ(visibility.visible_among(all, at(eye.x(), eye.y(), eye.z())), by_segments);
}

TEST(VertexVisibility, SeesSevenCornersOfACubeFromBeyondOne) {
  const Bytes visible = seen(test::box(1.0, 1.0, 1.0, 1), FaceSides::Front, at(3.0, 3.0, 3.0));
  EXPECT_EQ(count(visible), 7U);  // all but the opposite one
}

TEST(VertexVisibility, SeesFourCornersOfACubeAlongAnAxis) {
  EXPECT_EQ(count(seen(test::box(1.0, 1.0, 1.0, 1), FaceSides::Front, along(Vec3::UnitX()))), 4U);
}

TEST(VertexVisibility, OfAConvexBodyIsFacingTheEye) {
  const TriMesh body = test::sphere(3);
  const Vec3 eye(1.0, -2.0, 1.5);
  Bytes expected(body.positions.size(), 0);
  for (const Triangle& t : body.triangles) {
    const Vec3& a = body.positions[t[0]];
    const Vec3 normal = (body.positions[t[1]] - a).cross(body.positions[t[2]] - a);
    if (normal.dot(eye - a) > 0.0) {
      expected[t[0]] = expected[t[1]] = expected[t[2]] = 1;
    }
  }
  EXPECT_EQ(seen(body, FaceSides::Front, {Projection::Perspective, eye}), expected);
}

TEST(VertexVisibility, HidesWhatLiesExactlyBehindVerticesAndEdges) {
  // Two equal grids, one behind the other: along z every vertex of the far one, (2, 2)-inside the
  // rim too, is exactly behind a vertex of the near one.
  const TriMesh grids =
      test::together(test::sheet(1.0, 1.0, 8), test::sheet(1.0, 1.0, 8), Vec3(0.0, 0.0, 1.0));
  const Bytes visible = seen(grids, FaceSides::Both, along(Vec3::UnitZ()));
  const std::size_t half = visible.size() / 2;
  EXPECT_EQ(std::count(visible.begin(), visible.begin() + static_cast<std::ptrdiff_t>(half), 1), 0);
  EXPECT_EQ(std::count(visible.begin() + static_cast<std::ptrdiff_t>(half), visible.end(), 1),
            static_cast<std::ptrdiff_t>(half));
}

TEST(VertexVisibility, HidesWhatLiesExactlyBehindVerticesFromANearEye) {
  // The far grid is twice as large and twice as far from the eye at (0.5, 0.5, 2): its vertices
  // project exactly onto those of the near one.
  TriMesh far_grid = test::sheet(2.0, 2.0, 8);
  const TriMesh grids = test::together(far_grid, test::sheet(1.0, 1.0, 8), Vec3(0.5, 0.5, 1.0));
  const Bytes visible = seen(grids, FaceSides::Both, at(1.0, 1.0, 2.0));
  EXPECT_EQ(std::count(visible.begin(), visible.begin() + 81, 1), 0);
}

TEST(VertexVisibility, OfASheetHasTwoSides) {
  const TriMesh sheet = test::sheet(1.0, 1.0, 3);
  EXPECT_EQ(count(seen(sheet, FaceSides::Both, at(0.4, 0.5, 2.0))), 16U);
  EXPECT_EQ(count(seen(sheet, FaceSides::Both, at(0.4, 0.5, -2.0))), 16U);
}

TEST(VertexVisibility, OfFrontSidesOnlyIgnoresTheBack) {
  const TriMesh sheet = test::sheet(1.0, 1.0, 3);
  EXPECT_EQ(count(seen(sheet, FaceSides::Front, at(0.4, 0.5, 2.0))), 16U);
  EXPECT_EQ(count(seen(sheet, FaceSides::Front, at(0.4, 0.5, -2.0))), 0U);
}

TEST(VertexVisibility, OfASheetSeenEdgeOnIsNone) {
  EXPECT_EQ(count(seen(test::sheet(1.0, 1.0, 3), FaceSides::Both, along(Vec3::UnitX()))), 0U);
}

TEST(VertexVisibility, TakesSidesPerComponent) {
  const TriMesh two =
      test::together(test::sheet(1.0, 1.0, 1), test::sheet(1.0, 1.0, 1), Vec3(5.0, 0.0, 0.0));
  const VertexVisibility visibility(two, {FaceSides::Front, FaceSides::Both});
  const Bytes expected{0, 0, 0, 0, 1, 1, 1, 1};
  EXPECT_EQ(visibility.visible_vertices(at(3.0, 0.5, -4.0)), expected);
}

TEST(VertexVisibility, IsTheSameForASoupAndItsWeldedSurface) {
  const TriMesh ring = test::torus(1.0, 0.4, 24, 12);
  const TriMesh loose = test::soup(ring);
  const Viewpoint eye = at(2.0, 3.0, 1.0);
  const Bytes welded_seen = seen(ring, FaceSides::Front, eye);
  const Bytes loose_seen = seen(loose, FaceSides::Front, eye);
  for (std::size_t f = 0; f < ring.triangles.size(); ++f) {
    for (std::size_t corner = 0; corner < 3; ++corner) {
      ASSERT_EQ(loose_seen[3 * f + corner], welded_seen[ring.triangles[f][corner]]);
    }
  }
}

TEST(VertexVisibility, HoldsPositionsThatDifferInTheSignOfZeroForOne) {
  TriMesh mesh = test::together(lid(0.0, 1.0), lid(0.0, 1.0), Vec3::Zero());
  for (std::size_t v = 3; v < 6; ++v) {
    mesh.positions[v].z() = -0.0;
  }
  EXPECT_EQ(count(seen(mesh, FaceSides::Both, at(0.1, 0.2, 3.0))), 6U);
}

TEST(VertexVisibility, LetsNoFaceWithoutAreaBlock) {
  TriMesh mesh = lid(0.0, 1.0);
  // A needle that crosses the segment from vertex 2, (0, 1, 0), to the eye, (0, 1, 4).
  mesh.positions.insert(mesh.positions.end(), {{-1, 1, 2}, {0, 1, 2}, {1, 1, 2}});
  mesh.triangles.push_back({3, 4, 5});
  const Bytes expected{1, 1, 1, 0, 0, 0};
  EXPECT_EQ(seen(mesh, FaceSides::Both, at(0.0, 1.0, 4.0)), expected);
}

TEST(VertexVisibility, NeverSeesIsolatedVertices) {
  TriMesh mesh = lid(0.0, 1.0);
  mesh.positions.emplace_back(0.0, 0.0, 5.0);
  mesh.positions.push_back(mesh.positions[0]);  // even where another vertex is visible
  const Bytes expected{1, 1, 1, 0, 0};
  EXPECT_EQ(seen(mesh, FaceSides::Both, at(0.0, 0.0, 9.0)), expected);
}

TEST(VertexVisibility, DoesNotCountATouchAsBlocking) {
  // A vertex of the upright triangle stands in the middle of the lid, on the eye's side.
  TriMesh mesh = lid(0.0, 1.0);
  mesh.positions.insert(mesh.positions.end(), {{0, 0, 0}, {0.1, 0, 1}, {-0.1, 0.05, 1}});
  mesh.triangles.push_back({3, 4, 5});
  EXPECT_EQ(seen(mesh, FaceSides::Both, at(0.0, -3.0, 1.0))[3], 1);
}

TEST(VertexVisibility, WorksFromAnEyeInsideTheModel) {
  const TriMesh room = test::inside_out(test::sphere(3));
  EXPECT_EQ(count(seen(room, FaceSides::Front, at(0.2, -0.1, 0.3))), room.positions.size());
}

TEST(VertexVisibility, HidesFromAnEyeInsideWhatAScreenHides) {
  // Eye at the origin inside a sphere, a screen of half-width 1/4 at z = 1/4: it hides directions
  // within the triangle's solid angle and nothing below.
  const TriMesh scene =
      test::together(test::inside_out(test::sphere(3)), lid(0.25, 0.25), Vec3::Zero());
  const Bytes visible = seen(scene, FaceSides::Both, at(0.0, 0.0, 0.0));
  for (std::size_t v = 0; v + 3 < visible.size(); ++v) {
    const Vec3& p = scene.positions[v];
    const bool above = p.z() > 0.0;
    // Corners (−1,−1), (1,−1), (0,1) in the plane z = 1 after projection from the origin.
    const double x = p.x() / p.z();
    const double y = p.y() / p.z();
    const bool behind = above && y > -1.0 && y < 1.0 - 2.0 * std::abs(x);
    ASSERT_EQ(visible[v] == 0, behind) << p.transpose();
  }
}

TEST(VertexVisibility, OfSomeVerticesIsThatOfAll) {
  const TriMesh ball = test::sphere(4);
  const VertexVisibility visibility(ball, {FaceSides::Front});
  const Bytes all = visibility.visible_vertices(at(0.0, 1.0, 2.0));
  Bytes asked(all.size(), 0);
  Bytes expected(all.size(), 0);
  for (std::size_t v = 0; v < all.size(); v += 5) {
    asked[v] = 1;
    expected[v] = all[v];
  }
  EXPECT_EQ(visibility.visible_among(asked, at(0.0, 1.0, 2.0)), expected);
}

TEST(VertexVisibility, OfAnEmptyMeshIsEmpty) {
  EXPECT_TRUE(seen(TriMesh{}, FaceSides::Both, at(0.0, 0.0, 1.0)).empty());
}

TEST(VertexVisibility, RefusesTheWrongNumberOfSides) {
  EXPECT_THROW(VertexVisibility(lid(0.0, 1.0), {FaceSides::Both, FaceSides::Both}), InvalidInput);
}

TEST(VertexVisibility, RefusesAnEyeThatIsNotFinite) {
  const VertexVisibility visibility(lid(0.0, 1.0), {FaceSides::Both});
  EXPECT_THROW(static_cast<void>(visibility.visible_vertices(at(NAN, 0.0, 1.0))), InvalidInput);
  EXPECT_THROW(
      static_cast<void>(visibility.visible_vertices({Projection::Orthographic, Vec3::Zero()})),
      InvalidInput);
}

TEST(VertexVisibility, RefusesAnotherNumberOfFlagsThanVertices) {
  const VertexVisibility visibility(lid(0.0, 1.0), {FaceSides::Both});
  const Viewpoint eye = at(0.0, 0.0, 1.0);
  const std::size_t vertices = visibility.visible_vertices(eye).size();
  for (const std::size_t flags : {std::size_t{0}, vertices - 1, vertices + 1}) {
    const std::vector<std::uint8_t> asked(flags, 1);
    EXPECT_THROW((void)visibility.visible_among(asked, eye), InvalidInput);
    EXPECT_THROW((void)visibility.visible_by_segments(asked, eye), InvalidInput);
  }
}

TEST(VertexVisibility, StopsOnRequest) {
  const VertexVisibility visibility(test::sphere(2), {FaceSides::Front});
  std::stop_source source;
  source.request_stop();
  EXPECT_THROW(static_cast<void>(
                   visibility.visible_vertices(at(0.0, 0.0, 3.0), {.stop = source.get_token()})),
               Cancelled);
}

}  // namespace
}  // namespace vantage
