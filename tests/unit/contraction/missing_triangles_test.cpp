// SPDX-License-Identifier: MIT
#include "contraction/missing_triangles.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "vantage/contraction/contraction.h"

#include "support/shapes.h"

namespace vantage {
namespace {

/// As many triangles with the lowest corner first and wound as they were, in order.
std::vector<Triangle> in_order(std::vector<Triangle> triangles) {
  for (Triangle& t : triangles) {
    std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
  }
  std::sort(triangles.begin(), triangles.end());
  return triangles;
}

int common_corners(const Triangle& a, const Triangle& b) {
  return static_cast<int>(std::count_if(a.begin(), a.end(), [&](std::uint32_t v) {
    return std::find(b.begin(), b.end(), v) != b.end();
  }));
}

/// Takes out the faces whose numbers `step` divides, but none beside another. \return what was taken out
std::vector<Triangle> take_out(TriMesh& mesh, std::size_t step) {
  std::vector<Triangle> kept;
  std::vector<Triangle> taken;
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
    const Triangle& t = mesh.triangles[f];
    const bool is_alone = std::none_of(taken.begin(), taken.end(), [&](const Triangle& other) {
      return common_corners(t, other) > 1;
    });
    (f % step == 0 && is_alone ? taken : kept).push_back(t);
  }
  mesh.triangles = std::move(kept);
  return taken;
}

TEST(MissingTriangles, AreThoseTakenOutOfASphere) {
  for (const std::size_t step : {1280UL, 37UL, 4UL}) {  // 4: many meet in corners
    TriMesh mesh = test::sphere(3);
    const std::vector<Triangle> taken = take_out(mesh, step);
    ASSERT_FALSE(taken.empty());
    EXPECT_EQ(in_order(missing_triangles(mesh)), in_order(taken)) << "every " << step;
  }
}

TEST(MissingTriangles, AreNoneOfASurfaceWithoutSuchHoles) {
  EXPECT_TRUE(missing_triangles(test::sphere(2)).empty());
  EXPECT_TRUE(missing_triangles(test::sheet(1.0, 1.0, 8)).empty());
  TriMesh star_out = test::sphere(3);
  const Triangle first = star_out.triangles.front();  // goes, and its three neighbours
  std::erase_if(star_out.triangles,
                [&](const Triangle& t) { return common_corners(t, first) > 1; });
  EXPECT_TRUE(missing_triangles(star_out).empty());
}

TEST(MissingTriangles, AreNotTheBacksOfFaces) {
  TriMesh mesh = test::sphere(3);  // with a small face that hangs at it by one corner
  const auto n = static_cast<std::uint32_t>(mesh.positions.size());
  const Vec3 corner = mesh.positions[0];
  mesh.positions.insert(mesh.positions.end(), {1.1 * corner, corner + Vec3(0.02, 0.1, 0.0)});
  mesh.triangles.push_back({0, n, n + 1});
  EXPECT_TRUE(missing_triangles(mesh).empty());
}

TEST(MissingTriangles, CloseTheCrackWhereAnEdgeMeetsTwo) {
  TriMesh mesh = test::sphere(3);
  const Triangle cut = mesh.triangles.front();
  const auto middle = static_cast<std::uint32_t>(mesh.positions.size());
  mesh.positions.push_back(0.5 * (mesh.positions[cut[0]] + mesh.positions[cut[1]]));
  mesh.triangles.front() = {cut[0], middle, cut[2]};
  mesh.triangles.push_back({middle, cut[1], cut[2]});
  EXPECT_EQ(in_order(missing_triangles(mesh)),
            in_order({{cut[1], middle, cut[0]}}));  // before the face beyond the edge
  const ContractionHistory history = contract(mesh);
  for (const auto& level : history.levels) {
    EXPECT_TRUE(
        std::all_of(level.begin(), level.end(), [](const Vec3& p) { return p.allFinite(); }));
  }
  EXPECT_LT(history.shrinkage.back(), 0.1);
}

TEST(MissingTriangles, AreNotThoseThatATentLacks) {
  TriMesh tent = test::sphere(1);
  tent.triangles.pop_back();
  EXPECT_TRUE(missing_triangles(tent).empty());
}

TEST(MissingTriangles, AreFoundAtOnceWhereAllFacesMeet) {
  TriMesh fan{.positions = {Vec3::Zero()}, .triangles = {}};
  for (std::uint32_t i = 0; i < 100'000; ++i) {
    const double angle = 6e-5 * i;
    fan.positions.emplace_back(std::cos(angle), std::sin(angle), 0.0);
    fan.positions.emplace_back(std::cos(angle), std::sin(angle), 1e-5);
    fan.triangles.push_back({0, 2 * i + 1, 2 * i + 2});
  }
  EXPECT_TRUE(missing_triangles(fan).empty());
}

TEST(Contract, PutsMissingTrianglesIn) {
  const TriMesh ball = test::sphere(3);
  TriMesh mesh = ball;
  take_out(mesh, 37);
  const ContractionHistory whole = contract(ball);
  const ContractionHistory history = contract(mesh);
  ASSERT_EQ(history.levels.size(), whole.levels.size());
  for (std::size_t v = 0; v < ball.positions.size(); ++v) {
    EXPECT_LT((history.levels[1][v] - whole.levels[1][v]).norm(), 1e-9);
  }
  ASSERT_EQ(history.warnings.size(), 1U);
  EXPECT_EQ(history.warnings[0], "35 holes in the surface were closed before the contraction");
  EXPECT_TRUE(contract(mesh, {.method = ContractionMethod::Exact}).warnings.empty());
}

}  // namespace
}  // namespace vantage
