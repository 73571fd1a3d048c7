// SPDX-License-Identifier: MIT
#include "operators/intrinsic_delaunay.h"

#include <cmath>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "support/shapes.h"
#include "support/worst.h"

namespace vantage {
namespace {

using Sparse = Eigen::SparseMatrix<double>;

/// Mollification lengthens edges by 1e-5 of their mean where it has to, and by nothing elsewhere.
constexpr double kMollified = 1e-4;

Sparse intrinsic(const TriMesh& mesh) {
  return intrinsic_laplacian(mesh.positions, mesh.triangles,
                             {.diagonal = 1e300, .cotangent = 1e300});
}

/// A kite whose long diagonal is 0 1, and whose short one is 2 3.
const std::vector<Vec3> kKite{{-1, 0, 0}, {1, 0, 0}, {0, 0.2, 0}, {0, -0.2, 0}};

TEST(IntrinsicLaplacian, DoesNotDependOnTheDiagonalOfAFlatQuad) {
  const Sparse along = intrinsic({kKite, {{0, 1, 2}, {1, 0, 3}}});
  const Sparse across = intrinsic({kKite, {{0, 3, 2}, {1, 2, 3}}});
  EXPECT_LE((along - across).norm(), 1e-12 * across.norm());
  EXPECT_EQ(along.coeff(0, 1), 0.0);
  EXPECT_GT(along.coeff(2, 3), 0.0);
}

TEST(IntrinsicLaplacian, OfADelaunayMeshIsTheCotangentLaplacian) {
  const TriMesh mesh = test::sphere(2);
  const Sparse L = cotangent_laplacian(mesh.positions, mesh.triangles);
  EXPECT_LE((intrinsic(mesh) - L).norm(), 1e-10 * L.norm());
}

/// A torus, its vertices pushed about by up to a third of an edge.
TriMesh uneven_torus() {
  TriMesh mesh = test::torus(1.0, 0.3, 40, 12);
  std::mt19937 random(1);
  std::uniform_real_distribution<double> by(-0.05, 0.05);
  for (Vec3& p : mesh.positions) {
    p += Vec3(by(random), by(random), by(random));
  }
  return mesh;
}

TEST(IntrinsicLaplacian, HasNoNegativeWeightOnAClosedSurface) {
  const TriMesh mesh = uneven_torus();
  const Sparse plain = cotangent_laplacian(mesh.positions, mesh.triangles);
  const Sparse L = intrinsic(mesh);
  double least_plain = 0.0;
  double least = 0.0;
  for (int j = 0; j < L.outerSize(); ++j) {
    for (Sparse::InnerIterator entry(plain, j); entry; ++entry) {
      least_plain = entry.row() != j ? test::smaller(least_plain, entry.value()) : least_plain;
    }
    for (Sparse::InnerIterator entry(L, j); entry; ++entry) {
      least = entry.row() != j ? test::smaller(least, entry.value()) : least;
    }
  }
  EXPECT_LT(least_plain, -0.1);  // so that there was something to flip
  EXPECT_GE(least, -1e-8);
}

TEST(IntrinsicLaplacian, IsSymmetricWithRowsThatSumToZero) {
  const Sparse L = intrinsic(uneven_torus());
  EXPECT_LE((L - Sparse(L.transpose())).norm(), 1e-13 * L.norm());
  EXPECT_LE((L * Eigen::VectorXd::Ones(L.cols())).cwiseAbs().maxCoeff<Eigen::PropagateNaN>(),
            1e-12);
}

TEST(IntrinsicLaplacian, OfALinearFunctionVanishesInsideAPlaneOfSlivers) {
  TriMesh mesh = test::sheet(1.0, 1.0, 6);
  for (Vec3& p : mesh.positions) {
    p = Vec3(p.x(), 0.05 * p.y() + 0.7 * p.x(), 0.0);  // sheared to needles
  }
  const Sparse L = intrinsic(mesh);
  Eigen::VectorXd x(L.cols());
  for (Eigen::Index i = 0; i < x.size(); ++i) {
    x[i] = mesh.positions[static_cast<std::size_t>(i)].x();
  }
  const Eigen::VectorXd Lx = L * x;
  const auto inside = (Lx.array().abs() < 1e-9).count();
  EXPECT_GE(inside, 25);  // 5 × 5 vertices lie inside
}

TEST(IntrinsicLaplacian, IsFiniteWhereTrianglesHaveNoArea) {
  const TriMesh needles{.positions = {{0, 0, 0}, {1, 0, 0}, {0.5, 0, 0}, {0, 1, 0}},
                        .triangles = {{0, 1, 2}, {0, 2, 3}, {2, 1, 3}, {0, 3, 1}}};
  const Sparse L = intrinsic(needles);
  for (int j = 0; j < L.outerSize(); ++j) {
    for (Sparse::InnerIterator entry(L, j); entry; ++entry) {
      EXPECT_TRUE(std::isfinite(entry.value()));
      EXPECT_LE(std::abs(entry.value()), 1.0 / (kMollified * kMollified));
    }
  }
}

TEST(IntrinsicLaplacian, LeavesEdgesOfThreeFacesAndBadlyWoundOnesAlone) {
  const TriMesh fins{.positions = {{-1, 0, 0}, {1, 0, 0}, {0, 0.2, 0}, {0, -0.2, 0}, {0, 0, 0.2}},
                     .triangles = {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}}};
  EXPECT_NE(intrinsic(fins).coeff(0, 1), 0.0);
  EXPECT_NE(intrinsic({kKite, {{0, 1, 2}, {0, 1, 3}}}).coeff(0, 1), 0.0);
}

}  // namespace
}  // namespace vantage
