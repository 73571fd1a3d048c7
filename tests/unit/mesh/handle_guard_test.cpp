// SPDX-License-Identifier: MIT
#include "mesh/handle_guard.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <vector>

#include <gtest/gtest.h>

#include "vantage/mesh/mesh_check.h"

#include "support/shapes.h"
#include "unit/skeleton/genus_two.h"

namespace vantage {
namespace {

constexpr int kMajor = 12;
constexpr int kMinor = 7;

/// A mesh with its guard, and the classes of loops on it.
struct Guarded {
  explicit Guarded(TriMesh surface)
      : mesh(std::move(surface)),
        table(build_edge_table(mesh)),
        guard(mesh, table),
        annotations(guard.take_annotations()) {}

  /// Class of the closed loop over these vertices.
  [[nodiscard]] Bits loop(const std::vector<std::uint32_t>& vertices) const {
    Bits sum(guard.words(), 0);
    for (std::size_t i = 0; i < vertices.size(); ++i) {
      const std::uint32_t a = vertices[i];
      const std::uint32_t b = vertices[(i + 1) % vertices.size()];
      const std::array key{std::min(a, b), std::max(a, b)};
      const auto at = std::lower_bound(table.edges.begin(), table.edges.end(), key);
      EXPECT_TRUE(at != table.edges.end() && *at == key) << "no edge " << a << "–" << b;
      const auto e = static_cast<std::size_t>(at - table.edges.begin());
      for (std::size_t w = 0; w < sum.size(); ++w) {
        sum[w] ^= annotations[e * sum.size() + w];
      }
    }
    return sum;
  }

  /// Once around the tube of torus number `which`, at segment `i`.
  [[nodiscard]] Bits meridian(std::uint32_t which = 0, std::uint32_t i = 0) const {
    std::vector<std::uint32_t> vertices;
    for (std::uint32_t j = 0; j < kMinor; ++j) {
      vertices.push_back((which * kMajor + i) * kMinor + j);
    }
    return loop(vertices);
  }

  /// Once around the hole.
  [[nodiscard]] Bits longitude(std::uint32_t which = 0, std::uint32_t j = 2) const {
    std::vector<std::uint32_t> vertices;
    for (std::uint32_t i = 0; i < kMajor; ++i) {
      vertices.push_back((which * kMajor + i) * kMinor + j);
    }
    return loop(vertices);
  }

  [[nodiscard]] bool may_kill(const Bits& loop) const { return guard.may_kill(loop, {}); }

  void kill(const Bits& loop) { guard.kill(loop, annotations); }

  TriMesh mesh;
  EdgeTable table;
  HandleGuard guard;
  std::vector<std::uint64_t> annotations;
};

Guarded torus() {
  return Guarded(test::torus(1.0, 0.4, kMajor, kMinor));
}

Guarded genus_two() {
  return Guarded(test::genus_two(kMajor, kMinor));
}

Bits sum(Bits a, const Bits& b) {
  for (std::size_t w = 0; w < a.size(); ++w) {
    a[w] ^= b[w];
  }
  return a;
}

/// Coordinates that some edge uses.
int coordinates(const Guarded& surface) {
  Bits any(surface.guard.words(), 0);
  for (std::size_t i = 0; i < surface.annotations.size(); ++i) {
    any[i % any.size()] |= surface.annotations[i];
  }
  int count = 0;
  for (const std::uint64_t w : any) {
    count += std::popcount(w);
  }
  return count;
}

TEST(GenusTwoShape, IsAClosedOrientedSurfaceOfGenusTwo) {
  const MeshReport report = check_mesh(test::genus_two(kMajor, kMinor));
  ASSERT_TRUE(report.closed && report.oriented);
  EXPECT_EQ(report.genus, 2U);
}

TEST(HandleGuard, HasNothingToGuardOnASphere) {
  EXPECT_EQ(Guarded(test::sphere(2)).guard.words(), 0U);
}

TEST(HandleGuard, DoesNotGuardAnOpenSurface) {
  EXPECT_EQ(Guarded(test::open_cylinder(1.0, 2.0, 8, 4)).guard.words(), 0U);
}

TEST(HandleGuard, DoesNotGuardATorusWithAHoleInItsSurface) {
  TriMesh mesh = test::torus(1.0, 0.4, kMajor, kMinor);
  mesh.triangles.pop_back();
  EXPECT_EQ(Guarded(mesh).guard.words(), 0U);
}

TEST(HandleGuard, GuardsTheClosedComponentBesideAnOpenOne) {
  const Guarded both(test::together(test::torus(1.0, 0.4, kMajor, kMinor), test::sheet(1.0, 1.0, 4),
                                    Vec3(5.0, 0.0, 0.0)));
  EXPECT_EQ(coordinates(both), 2);
}

TEST(HandleGuard, GuardsATorusBesideASphereThatTouchesItself) {
  // Two opposite vertices of the sphere become one: closed over its edges, but no surface there.
  TriMesh pinched = test::sphere(2);
  std::uint32_t opposite = 0;
  for (std::uint32_t v = 0; v < pinched.positions.size(); ++v) {
    if (pinched.positions[v].dot(pinched.positions[0]) <
        pinched.positions[opposite].dot(pinched.positions[0])) {
      opposite = v;
    }
  }
  for (Triangle& t : pinched.triangles) {
    std::replace(t.begin(), t.end(), opposite, 0U);
  }
  const auto sphere_vertices = static_cast<std::uint32_t>(pinched.positions.size());
  const TriMesh mesh = test::together(pinched, test::torus(1.0, 0.3, 8, 6), Vec3(5.0, 0.0, 0.0));
  const EdgeTable table = build_edge_table(mesh);
  HandleGuard guard(mesh, table);
  ASSERT_EQ(guard.words(), 1U);
  const std::vector<std::uint64_t> annotations = guard.take_annotations();
  std::uint64_t on_sphere = 0;
  std::uint64_t on_torus = 0;
  for (std::size_t e = 0; e < table.edges.size(); ++e) {
    (table.edges[e][0] < sphere_vertices ? on_sphere : on_torus) |= annotations[e];
  }
  EXPECT_EQ(on_sphere, 0U);
  EXPECT_EQ(std::popcount(on_torus), 2);
}

TEST(HandleGuard, HasTwoCoordinatesOnATorus) {
  EXPECT_EQ(coordinates(torus()), 2);
}

TEST(HandleGuard, HasFourCoordinatesOnAGenusTwoSurface) {
  EXPECT_EQ(coordinates(genus_two()), 4);
}

TEST(HandleGuard, AnnotationsOfEveryTriangleAddUpToNothing) {
  const Guarded surface = genus_two();
  for (const auto& [a, b, c] : surface.mesh.triangles) {
    EXPECT_TRUE(is_zero(surface.loop({a, b, c})));
  }
}

TEST(HandleGuard, TheLoopAroundAVertexIsTrivial) {
  // The ring of vertex (3, 3) of the torus grid, whose quads are cut from (i, j) to (i+1, j+1).
  const Guarded surface = torus();
  const auto at = [](std::uint32_t i, std::uint32_t j) { return i * kMinor + j; };
  EXPECT_TRUE(is_zero(surface.loop({at(2, 2), at(3, 2), at(4, 3), at(4, 4), at(3, 4), at(2, 3)})));
}

TEST(HandleGuard, TheGeneratorsOfATorusAreIndependent) {
  const Guarded surface = torus();
  EXPECT_FALSE(is_zero(surface.meridian()));
  EXPECT_FALSE(is_zero(surface.longitude()));
  EXPECT_FALSE(is_zero(sum(surface.meridian(), surface.longitude())));
}

TEST(HandleGuard, ParallelLoopsAreOfOneClass) {
  const Guarded surface = torus();
  EXPECT_EQ(surface.meridian(0, 0), surface.meridian(0, 5));
  EXPECT_EQ(surface.longitude(0, 0), surface.longitude(0, 4));
}

TEST(HandleGuard, EitherGeneratorMayDieFirst) {
  const Guarded surface = torus();
  EXPECT_TRUE(surface.may_kill(surface.meridian()));
  EXPECT_TRUE(surface.may_kill(surface.longitude()));
}

TEST(HandleGuard, CrossingLoopsMayNotDieTogether) {
  const Guarded surface = torus();
  EXPECT_FALSE(
      surface.guard.may_kill(surface.longitude(), {surface.guard.crossed_by(surface.meridian())}));
}

TEST(HandleGuard, TheLongitudeMayNotDieAfterTheMeridian) {
  Guarded surface = torus();
  surface.kill(surface.meridian());
  EXPECT_FALSE(surface.may_kill(surface.longitude()));
}

TEST(HandleGuard, TheMeridianMayNotDieAfterTheLongitude) {
  Guarded surface = torus();
  surface.kill(surface.longitude());
  EXPECT_FALSE(surface.may_kill(surface.meridian()));
}

TEST(HandleGuard, ADiagonalLoopMayNotDieAfterTheMeridian) {
  Guarded surface = torus();
  surface.kill(surface.meridian());
  EXPECT_FALSE(surface.may_kill(sum(surface.meridian(), surface.longitude())));
}

TEST(HandleGuard, ADeadClassMayDieAgain) {
  Guarded surface = torus();
  surface.kill(surface.meridian());
  EXPECT_TRUE(is_zero(surface.meridian(0, 6)));
  EXPECT_TRUE(surface.may_kill(surface.meridian(0, 6)));
}

TEST(HandleGuard, ATrivialLoopMayAlwaysDieAndKillsNothing) {
  Guarded surface = torus();
  const Triangle& t = surface.mesh.triangles.front();
  surface.kill(surface.loop({t[0], t[1], t[2]}));
  EXPECT_TRUE(surface.may_kill(surface.meridian()));
  EXPECT_TRUE(surface.may_kill(surface.longitude()));
}

TEST(HandleGuard, OneLoopOfEachHandleMayDie) {
  Guarded surface = genus_two();
  surface.kill(surface.meridian(0));
  EXPECT_TRUE(surface.may_kill(surface.longitude(1)));
  surface.kill(surface.longitude(1));
  EXPECT_FALSE(surface.may_kill(surface.longitude(0)));
  EXPECT_FALSE(surface.may_kill(surface.meridian(1)));
}

TEST(HandleGuard, TheLoopAroundTheNeckBetweenTwoHandlesIsTrivial) {
  // It separates the surface: the three vertices that the bridge starts from.
  const Guarded surface = genus_two();
  const Triangle& wall = surface.mesh.triangles[surface.mesh.triangles.size() - 6];
  const Triangle& next = surface.mesh.triangles[surface.mesh.triangles.size() - 4];
  EXPECT_TRUE(is_zero(surface.loop({wall[0], wall[1], next[1]})));
}

}  // namespace
}  // namespace vantage
