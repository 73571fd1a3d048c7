// SPDX-License-Identifier: MIT
#include "skeleton/surgery.h"

#include <cmath>
#include <ctime>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "core/random.h"
#include "support/voxel_surface.h"

namespace vantage {
namespace {

/// So many faces at one edge, as the pages of an open book.
TriMesh book(std::uint32_t pages) {
  TriMesh mesh{{{0, 0, -5}, {0, 0, 5}}, {}};  // longer than the pages are wide
  for (std::uint32_t i = 0; i < pages; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / pages;
    mesh.positions.emplace_back(std::cos(angle), std::sin(angle), 0.0);
    mesh.triangles.push_back({0, 1, i + 2});
  }
  return mesh;
}

TEST(Surgery, EndsSoonAtAnEdgeOfThousandsOfFaces) {
  const TriMesh mesh = book(20'000);
  ClusterComplex complex(mesh, mesh.positions, std::vector<double>(mesh.positions.size(), 1.0));
  const std::clock_t begin = std::clock();
  EXPECT_EQ(collapse_to_graph(complex, {}), 0U);
  // Some tenths of a second; where each page queues all others anew, twenty seconds.
  EXPECT_LT(static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC, 5.0);
  EXPECT_EQ(complex.face_count(), 0U);
}

TEST(Surgery, IsGivenUpWhereAsManyHandlesAreLostAsByAnotherWay) {
  const auto is_bar = [](int i, int j, int k) { return i % 2 + j % 2 + k % 2 <= 1; };
  TriMesh mesh = test::voxel_surface(7, 7, 7, is_bar);
  Pcg32 random(1, 1);
  for (Vec3& p : mesh.positions) {  // all handles shrunk into one another
    p = Vec3(random.uniform(), random.uniform(), random.uniform());
  }
  ClusterComplex complex(mesh, mesh.positions, std::vector<double>(mesh.positions.size(), 1.0));
  EXPECT_EQ(collapse_to_graph(complex, {}, 2), 2U);
  EXPECT_GT(complex.face_count(), 0U);
}

}  // namespace
}  // namespace vantage
