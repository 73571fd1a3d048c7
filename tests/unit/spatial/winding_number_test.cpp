// SPDX-License-Identifier: MIT
#include "spatial/winding_number.h"

#include <cstdint>
#include <numeric>
#include <vector>

#include <gtest/gtest.h>

#include "support/shapes.h"

namespace vantage {
namespace {

double around(const TriMesh& mesh, const Vec3& point) {
  std::vector<std::uint32_t> faces(mesh.triangles.size());
  std::iota(faces.begin(), faces.end(), 0U);
  return winding_number(mesh, faces, point);
}

TEST(WindingNumber, IsOneInsideAndNoneOutside) {
  const TriMesh torus = test::torus(1.0, 0.3, 20, 12);
  EXPECT_NEAR(around(torus, Vec3(1.0, 0.0, 0.05)), 1.0, 1e-12);
  EXPECT_NEAR(around(torus, Vec3(0.01, 0.02, 0.0)), 0.0, 1e-12);  // in its hole
  EXPECT_NEAR(around(torus, Vec3(5.0, 4.0, 3.0)), 0.0, 1e-12);
  EXPECT_NEAR(around(test::inside_out(torus), Vec3(1.0, 0.0, 0.05)), -1.0, 1e-12);
}

TEST(WindingNumber, AddsUpWhereShellsOverlap) {
  const TriMesh box = test::box(1.0, 1.0, 1.0, 2);
  const TriMesh two = test::together(box, box, Vec3(0.5, 0.4, 0.3));
  EXPECT_NEAR(around(two, Vec3(0.75, 0.7, 0.65)), 2.0, 1e-12);
  EXPECT_NEAR(around(two, Vec3(0.25, 0.2, 0.15)), 1.0, 1e-12);
}

TEST(WindingNumber, OfAFaceThatIsLeftOutIsTheMeanOfItsSides) {
  const TriMesh box = test::box(1.0, 2.0, 3.0, 3);
  for (std::uint32_t own = 0; own < box.triangles.size(); ++own) {
    std::vector<std::uint32_t> others(box.triangles.size());
    std::iota(others.begin(), others.end(), 0U);
    std::erase(others, own);
    const auto& [a, b, c] = box.triangles[own];
    const Vec3 middle = (box.positions[a] + box.positions[b] + box.positions[c]) / 3.0;
    EXPECT_NEAR(winding_number(box, others, middle), 0.5, 1e-12) << own;
  }
}

TEST(WindingNumber, DoesNotDependOnSizeOrPlace) {
  TriMesh ball = test::sphere(2);
  for (Vec3& p : ball.positions) {
    p = 1e-8 * p + Vec3(3e-8, 0.0, 1e-8);
  }
  EXPECT_NEAR(around(ball, Vec3(3.1e-8, 0.1e-8, 1e-8)), 1.0, 1e-12);
}

}  // namespace
}  // namespace vantage
