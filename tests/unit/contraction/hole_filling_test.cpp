// SPDX-License-Identifier: MIT
#include "contraction/hole_filling.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "vantage/contraction/contraction.h"
#include "vantage/mesh/mesh_check.h"
#include "vantage/skeleton/skeleton.h"

#include "support/shapes.h"

namespace vantage {
namespace {

/// Without the faces that have a corner near a point.
TriMesh with_hole(TriMesh mesh, const Vec3& at, double radius) {
  std::erase_if(mesh.triangles, [&](const Triangle& t) {
    return std::any_of(t.begin(), t.end(),
                       [&](std::uint32_t v) { return (mesh.positions[v] - at).norm() < radius; });
  });
  return mesh;
}

std::size_t holes_of(TriMesh mesh) {
  return fill_holes(mesh);
}

/// Whether each side of a face is a side of one other face, which runs through it the other way.
void expect_closed(const TriMesh& mesh) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> runs;
  for (const Triangle& t : mesh.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      ++runs[{t[k], t[(k + 1) % 3]}];
    }
  }
  for (const auto& [side, count] : runs) {
    EXPECT_EQ(count, 1) << side.first << " to " << side.second;
    EXPECT_EQ(runs.count({side.second, side.first}), 1U) << side.first << " to " << side.second;
  }
}

TEST(FillHoles, ClosesASphere) {
  const TriMesh ball = test::sphere(4);
  TriMesh mesh = with_hole(ball, Vec3::UnitX(), 0.3);
  mesh = with_hole(mesh, -Vec3::UnitY(), 0.2);
  mesh = with_hole(mesh, Vec3(1.0, 2.0, 3.0).normalized(), 0.1);
  ASSERT_LT(mesh.triangles.size() + 100, ball.triangles.size());
  const std::size_t count = mesh.positions.size();
  EXPECT_EQ(fill_holes(mesh), 3U);
  EXPECT_EQ(mesh.positions.size(), count + 3);
  expect_closed(mesh);
  const MeshReport report = check_mesh(mesh);
  EXPECT_EQ(report.genus, 0U);
  const double volume = check_mesh(ball).signed_volume;
  EXPECT_NEAR(report.signed_volume, volume, 0.02 * volume);
}

/// Two faces are missing that have one corner in common.
TEST(FillHoles, ClosesHolesThatTouch) {
  TriMesh mesh = test::sphere(4);
  const std::uint32_t corner = 100;
  std::vector<std::size_t> around;
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
    const Triangle& t = mesh.triangles[f];
    if (std::find(t.begin(), t.end(), corner) != t.end()) {
      around.push_back(f);
    }
  }
  ASSERT_EQ(around.size(), 6U);
  const auto common = [&](std::size_t a, std::size_t b) {
    const Triangle& t = mesh.triangles[b];
    return std::count_if(mesh.triangles[a].begin(), mesh.triangles[a].end(), [&](std::uint32_t v) {
      return std::find(t.begin(), t.end(), v) != t.end();
    });
  };
  // A face at the corner and one that has no more than it in common.
  const auto other = std::find_if(around.begin(), around.end(),
                                  [&](std::size_t f) { return common(around[0], f) == 1; });
  ASSERT_NE(other, around.end());
  for (const std::size_t f : {std::max(around[0], *other), std::min(around[0], *other)}) {
    mesh.triangles.erase(mesh.triangles.begin() + static_cast<std::ptrdiff_t>(f));
  }
  EXPECT_EQ(fill_holes(mesh), 2U);
  EXPECT_EQ(mesh.positions.size(), test::sphere(4).positions.size());
  expect_closed(mesh);
}

TEST(FillHoles, LeavesWhatIsMadeOpen) {
  EXPECT_EQ(holes_of(test::sphere(3)), 0U);
  EXPECT_EQ(holes_of(test::sheet(1.0, 1.0, 8)), 0U);
  EXPECT_EQ(holes_of(test::wall_with_window()), 0U);
  EXPECT_EQ(holes_of(test::open_cylinder(1.0, 4.0, 32, 8)), 0U);
  TriMesh box = test::box(1.0, 1.0, 1.0, 8);  // without its lid
  std::erase_if(box.triangles, [&](const Triangle& t) {
    return std::all_of(t.begin(), t.end(),
                       [&](std::uint32_t v) { return box.positions[v].z() > 1.0 - 1e-9; });
  });
  ASSERT_FALSE(check_mesh(box).closed);
  EXPECT_EQ(holes_of(box), 0U);
}

/// At the rim of one of two holes a face is wound the other way, so it would stay open.
TEST(FillHoles, ClosesNoneWhereOneWouldStayOpen) {
  const Vec3 at = Vec3::UnitX();
  TriMesh mesh = with_hole(with_hole(test::sphere(4), at, 0.3), -at, 0.2);
  ASSERT_EQ(holes_of(mesh), 2U);
  const auto distance = [&](const Triangle& t) {
    double least = 2.0;
    for (const std::uint32_t v : t) {
      least = std::min(least, (mesh.positions[v] - at).norm());
    }
    return least;
  };
  Triangle& nearest = *std::min_element(
      mesh.triangles.begin(), mesh.triangles.end(),
      [&](const Triangle& a, const Triangle& b) { return distance(a) < distance(b); });
  std::swap(nearest[0], nearest[1]);
  EXPECT_EQ(holes_of(mesh), 0U);
}

TEST(FillHoles, LooksAtEachComponent) {
  const TriMesh ball = with_hole(test::sphere(3), Vec3::UnitZ(), 0.3);
  const TriMesh both = test::together(test::sheet(9.0, 9.0, 8), ball, {0.0, 0.0, 5.0});
  EXPECT_EQ(holes_of(ball), 1U);
  EXPECT_EQ(holes_of(both), 1U);
}

TEST(FillHoles, IsTheSameAtAnyScale) {
  const TriMesh mesh = with_hole(test::sphere(3), Vec3::UnitZ(), 0.3);
  const TriMesh sheet = test::sheet(1.0, 1.0, 8);
  for (const double scale : {1e-200, 1e-8, 1e8, 1e150}) {
    const auto scaled = [&](const TriMesh& of) {
      return test::moved(of, scale, 0.0, Vec3::UnitX(), Vec3::Zero());
    };
    EXPECT_EQ(holes_of(scaled(mesh)), 1U) << scale;
    EXPECT_EQ(holes_of(scaled(sheet)), 0U) << scale;
  }
}

TEST(FillHoles, IsFastAroundALargeHole) {
  TriMesh mesh = test::cylinder(1.0, 20.0, 40'000, 2);
  std::erase_if(mesh.triangles, [&](const Triangle& t) {
    return std::all_of(t.begin(), t.end(),
                       [&](std::uint32_t v) { return mesh.positions[v].z() > 20.0 - 1e-9; });
  });
  const std::size_t open = mesh.triangles.size();
  EXPECT_EQ(fill_holes(mesh), 1U);
  EXPECT_EQ(mesh.triangles.size(), open + 40'000U);
}

/// A rabbit of the well-known scan had four loops around the holes in its base.
TEST(Contract, ClosesHolesAndSaysSo) {
  const TriMesh ring = test::torus(1.0, 0.4, 160, 80);  // fine enough as it is
  TriMesh mesh = with_hole(ring, {1.4, 0.0, 0.0}, 0.25);
  mesh = with_hole(mesh, {0.0, 1.0, 0.4}, 0.25);
  mesh = with_hole(mesh, {-1.0, 0.0, -0.4}, 0.25);
  const ContractionHistory history = contract(mesh);
  ASSERT_EQ(history.warnings.size(), 1U);
  EXPECT_EQ(history.warnings[0], "3 holes in the surface were closed before the contraction");
  ASSERT_TRUE(history.refinement);
  EXPECT_EQ(history.refinement->mesh.positions.size(), mesh.positions.size() + 3);
  EXPECT_EQ(history.levels.back().size(), mesh.positions.size());
  EXPECT_EQ(history.components[0].strategy, "direct");
  EXPECT_EQ(cycle_count(extract_skeleton(mesh, history).graph), 1U);
  EXPECT_TRUE(contract(mesh, {.method = ContractionMethod::Exact}).warnings.empty());
}

/// One or two faces hang on a vertex of a closed surface.
TEST(FillHoles, LeavesALooseFlapAlone) {
  TriMesh mesh = test::sphere(3);
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  const Vec3 at = mesh.positions[100];
  mesh.positions.insert(mesh.positions.end(),
                        {Vec3(1.1 * at), Vec3(1.1 * at + 0.05 * Vec3::UnitZ()),
                         Vec3(1.1 * at + 0.05 * Vec3::UnitX())});
  mesh.triangles.push_back({100, first, first + 1});
  EXPECT_EQ(holes_of(mesh), 0U);
  mesh.triangles.push_back({100, first + 2, first});
  EXPECT_EQ(holes_of(mesh), 0U);
  EXPECT_EQ(holes_of(with_hole(mesh, -at, 0.2)), 1U);  // which hangs together without the flap
}

}  // namespace
}  // namespace vantage
