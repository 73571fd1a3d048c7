// SPDX-License-Identifier: MIT
#include "mesh/curvature.h"

#include <cmath>
#include <numbers>
#include <numeric>

#include <gtest/gtest.h>

#include "core/random.h"
#include "support/shapes.h"
#include "support/worst.h"

namespace vantage {
namespace {

// A few dozen operations of double on values of order 1.
constexpr double kRounding = 1e-11;

TEST(MeanCurvature, OfASphereIsTheInverseOfItsRadiusAtEveryVertex) {
  const TriMesh mesh = test::moved(test::sphere(3), 2.5, 0.7, Vec3(1, 2, 3), Vec3(9, 8, 7));
  for (const double h : mean_curvatures(mesh)) {
    ASSERT_NEAR(h, 1.0 / 2.5, kRounding);
  }
}

TEST(MeanCurvature, ChangesSignWithTheWinding) {
  for (const double h : mean_curvatures(test::inside_out(test::sphere(2)))) {
    ASSERT_NEAR(h, -1.0, kRounding);
  }
}

/// The same torus with its vertices slid along the surface, so that no ring is even.
TriMesh uneven_torus(int n) {
  TriMesh mesh = test::torus(2.0, 0.5, 4 * n, n);
  Pcg32 random(3);
  for (Vec3& p : mesh.positions) {
    const double step = 0.3 * 2.0 * std::numbers::pi / n;
    const double around = std::atan2(p.y(), p.x()) + 0.25 * step * (random.uniform() - 0.5);
    const double tube =
        std::atan2(p.z(), std::hypot(p.x(), p.y()) - 2.0) + step * (random.uniform() - 0.5);
    const double ring = 2.0 + 0.5 * std::cos(tube);
    p = Vec3(ring * std::cos(around), ring * std::sin(around), 0.5 * std::sin(tube));
  }
  return mesh;
}

TEST(MeanCurvature, OfAnUnevenTorusConvergesToTheSmoothOne) {
  double last = 0.5;
  for (const int n : {16, 32, 64, 128}) {
    const TriMesh mesh = uneven_torus(n);
    const std::vector<double> h = mean_curvatures(mesh);
    double worst = 0.0;
    for (std::size_t v = 0; v < h.size(); ++v) {
      // H = (1/r + cos φ / (R + r cos φ)) / 2
      const double ring = std::hypot(mesh.positions[v].x(), mesh.positions[v].y());
      worst = test::larger(worst, std::abs(h[v] - 0.5 * (2.0 + (ring - 2.0) / 0.5 / ring)));
    }
    EXPECT_LT(worst, 0.7 * last) << n;
    last = worst;
  }
}

TEST(MeanCurvature, IsZeroAtBordersAndIsolatedVertices) {
  TriMesh mesh = test::open_cylinder(1.0, 2.0, 24, 8);
  mesh.positions.emplace_back(5.0, 5.0, 5.0);
  const std::vector<double> h = mean_curvatures(mesh);
  EXPECT_EQ(h.back(), 0.0);
  std::size_t inside = 0;
  for (std::size_t v = 0; v + 1 < h.size(); ++v) {
    const double z = mesh.positions[v].z();
    if (z < 1e-9 || z > 2.0 - 1e-9) {
      EXPECT_EQ(h[v], 0.0);
    } else {
      EXPECT_GT(h[v], 0.0);
      ++inside;
    }
  }
  EXPECT_EQ(inside, 24U * 7U);
}

TEST(MeanCurvature, OfARimDoesNotTakeAllOfTheFanBesideIt) {
  // Each vertex of the rim has five neighbours, so that the fit takes those of its neighbours too; were the
  // middle of the fan among those that are asked, this would take a minute.
  constexpr int kAround = 20'000;
  const TriMesh mesh = test::cylinder(1.0, 2.0, kAround, 1);
  const std::vector<double> h = mean_curvatures(mesh);
  int count = 0;
  for (std::size_t v = 0; v < h.size(); ++v) {
    if (mesh.positions[v].head<2>().norm() > 0.5) {
      ASSERT_NEAR(h[v], 0.71, 0.05) << v;
      ++count;
    }
  }
  EXPECT_EQ(count, 2 * kAround);
}

TEST(MeanCurvature, IsZeroWhereTwoShellsTouchInAVertex) {
  TriMesh mesh = test::together(test::box(1, 1, 1, 1), test::box(1, 1, 1, 1), Vec3(1, 1, 1));
  // The far corner of the first box and the near corner of the second become one vertex.
  std::uint32_t far = 0;
  std::uint32_t near = 0;
  const auto half = static_cast<std::uint32_t>(mesh.positions.size() / 2);
  for (std::uint32_t v = 0; v < 2 * half; ++v) {
    if ((mesh.positions[v] - Vec3(1, 1, 1)).norm() < 1e-12) {
      (v < half ? far : near) = v;
    }
  }
  for (Triangle& t : mesh.triangles) {
    for (std::uint32_t& v : t) {
      v = v == near ? far : v;
    }
  }
  EXPECT_EQ(mean_curvatures(mesh)[far], 0.0);
}

TEST(AngleDeficit, SumsToTwoPiTimesTheEulerCharacteristic) {
  const auto total = [](const TriMesh& mesh) {
    const std::vector<double> deficit = angle_deficits(mesh);
    return std::accumulate(deficit.begin(), deficit.end(), 0.0);
  };
  EXPECT_NEAR(total(test::sphere(3)), 4.0 * std::numbers::pi, 1e-9);
  EXPECT_NEAR(total(test::torus(2.0, 0.7, 40, 20)), 0.0, 1e-9);
}

TEST(AngleDeficit, OfACubesCornerIsHalfPi) {
  const TriMesh mesh = test::box(1, 1, 1, 2);
  const std::vector<double> deficit = angle_deficits(mesh);
  int corners = 0;
  for (std::size_t v = 0; v < deficit.size(); ++v) {
    const Vec3 p = mesh.positions[v];
    if ((p.array() * (1.0 - p.array())).abs().maxCoeff() < 1e-12) {
      EXPECT_NEAR(deficit[v], 0.5 * std::numbers::pi, kRounding);
      ++corners;
    } else {
      EXPECT_NEAR(deficit[v], 0.0, kRounding);
    }
  }
  EXPECT_EQ(corners, 8);
}

}  // namespace
}  // namespace vantage
