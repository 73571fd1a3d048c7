// SPDX-License-Identifier: MIT
#include "mesh/copied_polygons.h"

#include <algorithm>
#include <ctime>

#include <gtest/gtest.h>

#include "vantage/io/model.h"

namespace vantage {
namespace {

/// The places of faces, each with its corners in ascending order.
std::vector<Triangle> unordered(std::span<const Triangle> faces) {
  std::vector<Triangle> result(faces.begin(), faces.end());
  for (Triangle& corners : result) {
    std::sort(corners.begin(), corners.end());
  }
  std::sort(result.begin(), result.end());
  return result;
}

TEST(CopiedPolygons, FallIntoTheTrianglesOfTheEarlierOne) {
  // A quad, a pentagon that is not convex, and both again from another corner and the other way around.
  const Model model = parse_model(
      "v 0 0 0\nv 2 0 0\nv 2 2 0\nv 0 2 0\nv 1 1 1\n"
      "f 1 2 3 4\nf 1 2 5 3 4\n"
      "f 2 3 4 1\nf 5 3 4 1 2\n"
      "f 4 3 2 1\nf 2 1 4 3 5\n",
      "twice.obj");
  const std::span<const Triangle> faces(model.mesh.triangles);
  ASSERT_EQ(faces.size(), 15U);
  for (const std::size_t first : {5U, 10U}) {
    EXPECT_EQ(unordered(faces.subspan(first, 2)), unordered(faces.first(2)));
    EXPECT_EQ(unordered(faces.subspan(first + 2, 3)), unordered(faces.subspan(2, 3)));
  }
  const auto up = [&](const Triangle& t) {
    const std::vector<Vec3>& p = model.mesh.positions;
    return (p[t[1]] - p[t[0]]).cross(p[t[2]] - p[t[0]]).z() > 0.0;
  };
  EXPECT_TRUE(up(faces[0]) && up(faces[1]) && up(faces[5]) && up(faces[6]));
  EXPECT_FALSE(up(faces[10]) || up(faces[11]));  // windings stay
}

TEST(CopiedPolygons, AreToldByPlacesInTheirOrderAroundThem) {
  const std::vector<Vec3> places{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {-0.0, 0, 0}};
  const std::vector<std::uint32_t> corners{0, 1, 2, 3,   // the first of its place
                                           0, 1, 2,      // triangles are no matter
                                           0, 2, 1, 3,   // the same places in another order
                                           2, 1, 4, 3};  // another vertex in the same place
  const std::vector<CopiedPolygon> copies =
      copied_polygons(corners, std::vector<std::uint32_t>{4, 3, 4, 4}, places);
  ASSERT_EQ(copies.size(), 1U);
  EXPECT_EQ(copies[0].polygon, 3U);
  EXPECT_EQ(copies[0].start, 2U);
  EXPECT_TRUE(copies[0].is_reversed);
}

TEST(CopiedPolygons, OfFewPlacesTakeNoLongerThanOthers) {
  // One of these is where the other ends: each start would be held against half of all corners.
  constexpr std::uint32_t kCorners = 200'000;
  std::vector<std::uint32_t> corners(2 * kCorners, 0);
  corners[kCorners - 1] = 1;
  corners[kCorners - 2] = 2;
  corners[kCorners] = 1;
  corners[2 * kCorners - 2] = 2;
  const std::vector<Vec3> places{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  const std::clock_t begin = std::clock();
  EXPECT_TRUE(
      copied_polygons(corners, std::vector<std::uint32_t>{kCorners, kCorners}, places).empty());
  constexpr double kMostSeconds = 5.0;  // 0.1, and a minute where steps are not bounded
  EXPECT_LT(static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC, kMostSeconds);
}

}  // namespace
}  // namespace vantage
