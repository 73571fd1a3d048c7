// SPDX-License-Identifier: MIT
#include "spatial/interior_path.h"

#include <cmath>
#include <numeric>
#include <vector>

#include <gtest/gtest.h>

#include "support/dense_oracles.h"
#include "support/shapes.h"
#include "support/skeletons.h"

namespace vantage {
namespace {

/// A ring, and two places inside it across the hole from each other.
struct Ring {
  TriMesh mesh = test::torus(1.0, 0.2, 40, 12);
  std::vector<std::uint32_t> component_of_vertex = test::one_component(mesh);
  Shell shell{mesh, component_of_vertex};
  InteriorPaths paths{mesh, shell};
  std::vector<std::uint32_t> all = std::vector<std::uint32_t>(mesh.positions.size());
  Vec3 a{1, 0, 0};
  Vec3 b{-1, 0, 0};

  Ring() { std::iota(all.begin(), all.end(), 0U); }
};

TEST(InteriorPaths, LeadAroundAHoleInside) {
  Ring ring;
  const auto corners = ring.paths.find(0, ring.a, ring.b, ring.all);
  ASSERT_TRUE(corners);
  std::vector<Vec3> way{ring.a};
  way.insert(way.end(), corners->begin(), corners->end());
  way.push_back(ring.b);
  double length = 0.0;
  for (std::size_t i = 1; i < way.size(); ++i) {
    length += (way[i] - way[i - 1]).norm();
    for (const double s : {0.1, 0.3, 0.5, 0.7, 0.9}) {
      EXPECT_NEAR(test::winding_number(ring.mesh, (1.0 - s) * way[i - 1] + s * way[i]), 1.0, 1e-6);
    }
  }
  // At least around the inner circle of the polygonal ring, at most around the outer one.
  EXPECT_GT(length, 0.75 * 3.14159);
  EXPECT_LT(length, 1.2 * 3.14159);
}

TEST(InteriorPaths, KeepToTheVerticesGiven) {
  Ring ring;
  // The half of the ring with y >= 0.
  std::vector<std::uint32_t> upper;
  for (const std::uint32_t v : ring.all) {
    if (ring.mesh.positions[v].y() >= 0.0) {
      upper.push_back(v);
    }
  }
  const auto corners = ring.paths.find(0, ring.a, ring.b, upper);
  ASSERT_TRUE(corners);
  for (const Vec3& corner : *corners) {
    EXPECT_GE(corner.y(), -1e-9);
  }
}

TEST(InteriorPaths, FindNothingWithoutVertices) {
  Ring ring;
  EXPECT_FALSE(ring.paths.find(0, ring.a, ring.b, {}));
}

TEST(InteriorPaths, FindNothingFromOutside) {
  Ring ring;
  EXPECT_FALSE(ring.paths.find(0, Vec3::Zero(), ring.b, ring.all));
}

// At a hub each way would be looked for below the whole surface.
TEST(InteriorPaths, FindNothingBelowMoreVerticesThanAreLeftInAll) {
  Ring ring;
  const std::vector<std::uint32_t> too_many(10'000'001, 0);
  EXPECT_FALSE(ring.paths.find(0, ring.a, Vec3(1.0, 0.01, 0.0), too_many));
  EXPECT_TRUE(ring.paths.find(0, ring.a, Vec3(1.0, 0.01, 0.0), ring.all));
}

TEST(InteriorPaths, AreSpentAfterAHundredThousandLooks) {
  Ring ring;
  for (int i = 0; i < 100 && !ring.paths.is_spent(); ++i) {
    EXPECT_FALSE(ring.paths.find(0, Vec3::Zero(), ring.b, ring.all));
  }
  ASSERT_TRUE(ring.paths.is_spent());
  EXPECT_FALSE(ring.paths.find(0, ring.a, ring.b, ring.all));
}

}  // namespace
}  // namespace vantage
