// SPDX-License-Identifier: MIT
#include "mesh/copied_faces.h"

#include <gtest/gtest.h>

#include "support/shapes.h"

namespace vantage {
namespace {

TEST(CopiedFaces, AreThoseBeyondAsManyAsAreLookedAt) {
  TriMesh mesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-0.0, 0, 0}, {0, 0, 1}}, {}};
  for (std::size_t i = 0; i < kMostCopies; ++i) {
    mesh.triangles.push_back({0, 1, 2});
    mesh.triangles.push_back({0, 1, 4});
  }
  EXPECT_TRUE(faces_beyond_copies(mesh).empty());
  const auto next = static_cast<std::uint32_t>(mesh.triangles.size());
  mesh.triangles.push_back({2, 1, 0});
  mesh.triangles.push_back({1, 4, 2});
  mesh.triangles.push_back({1, 2, 3});  // another vertex in the same place
  EXPECT_EQ(faces_beyond_copies(mesh), (std::vector<std::uint32_t>{next, next + 2}));
}

TEST(CopiedFaces, AreNoneInAModelWithoutCopies) {
  EXPECT_TRUE(faces_beyond_copies(test::box(1.0, 2.0, 3.0, 40)).empty());
  EXPECT_TRUE(faces_beyond_copies({}).empty());
}

}  // namespace
}  // namespace vantage
