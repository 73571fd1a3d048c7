// SPDX-License-Identifier: MIT
#include "report/display_mesh.h"

#include <algorithm>
#include <cmath>
#include <set>

#include <gtest/gtest.h>

#include "support/shapes.h"

namespace vantage::test {
namespace {

const std::vector<FaceSides> kOutside{FaceSides::Front};

std::vector<double> upper_half(const TriMesh& mesh) {
  std::vector<double> values;
  for (const Vec3& p : mesh.positions) {
    values.push_back(p.y() > 0.0 ? 1.0 : 0.0);
  }
  return values;
}

/// The smaller of two copies.
DisplayMesh copy_of(const TriMesh& mesh, const std::vector<double>& significance,
                    const std::vector<FaceSides>& sides, std::size_t max_faces,
                    std::size_t max_vertices) {
  const DisplaySize larger{2 * max_faces, 2 * max_vertices};
  return display_meshes(mesh, significance, sides, {{larger, {max_faces, max_vertices}}})[1];
}

TEST(DisplayMesh, OfASmallSurfaceIsTheSurface) {
  const TriMesh mesh = sphere(3);
  const DisplayMesh display =
      copy_of(mesh, std::vector<double>(mesh.positions.size(), 0.0), kOutside, 100000, 100000);
  EXPECT_EQ(display.triangles, mesh.triangles);
}

TEST(DisplayMesh, KeepsWithinItsLimits) {
  const TriMesh mesh = sphere(5);
  const DisplayMesh display = copy_of(mesh, upper_half(mesh), kOutside, 4000, 1500);
  EXPECT_LE(display.triangles.size(), 4000U);
  EXPECT_LE(display.vertex_of_row.size(), 1500U);
  EXPECT_GT(display.vertex_of_row.size(), 1200U);
  EXPECT_TRUE(std::is_sorted(display.vertex_of_row.begin(), display.vertex_of_row.end()));
}

TEST(DisplayMesh, TheLargerCopyKeepsWithinItsOwnLimits) {
  const TriMesh mesh = sphere(5);
  const auto copies =
      display_meshes(mesh, upper_half(mesh), kOutside, {{{8000, 16000}, {8000, 1500}}});
  ASSERT_EQ(copies.size(), 2U);
  EXPECT_LE(copies[0].triangles.size(), 8000U);
  EXPECT_GT(copies[0].vertex_of_row.size(), copies[1].vertex_of_row.size());
  EXPECT_LE(copies[1].vertex_of_row.size(), 1500U);
}

TEST(DisplayMesh, KeepsMoreWhereTheSignificanceIs) {
  const TriMesh mesh = sphere(5);
  const auto above = [&](const std::vector<double>& significance) {
    const DisplayMesh display = copy_of(mesh, significance, kOutside, 100000, 1500);
    return std::count_if(display.vertex_of_row.begin(), display.vertex_of_row.end(),
                         [&](std::uint32_t v) { return mesh.positions[v].y() > 0.0; });
  };
  // 25 times the cost above the equator; on a sphere the cost of a vertex falls with the square of
  // their number, so that about five times as many are left there.
  EXPECT_GT(above(upper_half(mesh)),
            1.5 * static_cast<double>(above(std::vector<double>(mesh.positions.size(), 0.0))));
}

TEST(DisplayMesh, OfASoupIsMadeSmallToo) {
  const TriMesh mesh = soup(sphere(4));
  const DisplayMesh display =
      copy_of(mesh, std::vector<double>(mesh.positions.size(), 1.0),
              std::vector<FaceSides>(mesh.triangles.size(), FaceSides::Both), 1000, 3000);
  EXPECT_LE(display.triangles.size(), 1000U);
  EXPECT_FALSE(display.triangles.empty());
}

TEST(DisplayMesh, OfASoupWithTooManyVerticesButFewFacesIsMadeSmall) {
  const TriMesh mesh = soup(sphere(1));
  const std::size_t faces = mesh.triangles.size();
  const DisplayMesh display =
      copy_of(mesh, std::vector<double>(mesh.positions.size(), 1.0),
              std::vector<FaceSides>(faces, FaceSides::Both), 2 * faces, 2 * faces);
  EXPECT_LE(display.vertex_of_row.size(), 2 * faces);
  EXPECT_GT(display.triangles.size(), faces / 3);
}

}  // namespace
}  // namespace vantage::test
