// SPDX-License-Identifier: MIT
#include "vantage/operators/cotangent_laplacian.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "support/dense_oracles.h"
#include "support/shapes.h"

namespace vantage {
namespace {

using Sparse = Eigen::SparseMatrix<double>;

/// Limits that leave ordinary meshes alone.
constexpr LaplacianLimits kNoLimits{.diagonal = 1e300, .cotangent = 1e300};

Sparse laplacian(const TriMesh& mesh, const LaplacianLimits& limits = kNoLimits) {
  return cotangent_laplacian(mesh.positions, mesh.triangles, limits);
}

TEST(CotangentLaplacian, HasRowsThatSumToZero) {
  const TriMesh mesh = test::torus(1.0, 0.3, 24, 12);
  const Sparse L = laplacian(mesh);
  const Eigen::VectorXd sums = L * Eigen::VectorXd::Ones(L.cols());
  // Six or so terms of order 1 a row.
  EXPECT_LE(sums.cwiseAbs().maxCoeff<Eigen::PropagateNaN>(), 1e-14);
}

TEST(CotangentLaplacian, IsSymmetricBeforeRowsAreScaled) {
  const Sparse L = laplacian(test::y_of_tubes(0.3, 16));
  EXPECT_EQ((L - Sparse(L.transpose())).norm(), 0.0);
}

TEST(CotangentLaplacian, WeighsEachSideOfAnEquilateralTriangleByOneOverRootThree) {
  const TriMesh triangle{.positions = {{0, 0, 0}, {1, 0, 0}, {0.5, std::sqrt(0.75), 0}},
                         .triangles = {{0, 1, 2}}};
  const Sparse L = laplacian(triangle);
  EXPECT_NEAR(L.coeff(0, 1), 1.0 / std::sqrt(3.0), 1e-15);
  EXPECT_NEAR(L.coeff(0, 0), -2.0 / std::sqrt(3.0), 1e-15);
}

TEST(CotangentLaplacian, GivesNothingToAHypotenuseAndOneToEqualLegs) {
  const TriMesh triangle{.positions = {{0, 0, 0}, {2, 0, 0}, {0, 2, 0}}, .triangles = {{0, 1, 2}}};
  const Sparse L = laplacian(triangle);
  EXPECT_EQ(L.coeff(1, 2), 0.0);           // opposite the right angle
  EXPECT_NEAR(L.coeff(0, 1), 1.0, 1e-15);  // opposite 45°
  EXPECT_NEAR(L.coeff(0, 2), 1.0, 1e-15);
}

TEST(CotangentLaplacian, AddsBothSidesOfAnEdge) {
  const TriMesh square{.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.5, 0.5, 0}},
                       .triangles = {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}}};
  // Each spoke is opposite 45° on both sides.
  EXPECT_NEAR(laplacian(square).coeff(4, 0), 2.0, 1e-15);
}

TEST(CotangentLaplacian, OfALinearFunctionVanishesInsideAPlanarPatch) {
  TriMesh mesh = test::sheet(2.0, 1.0, 9);
  for (Vec3& p : mesh.positions) {  // irregular, still planar
    p.x() += 0.03 * std::sin(7.0 * p.y() + 3.0 * p.x());
  }
  Eigen::VectorXd f(static_cast<Eigen::Index>(mesh.positions.size()));
  for (Eigen::Index i = 0; i < f.size(); ++i) {
    f(i) = mesh.positions[static_cast<std::size_t>(i)].dot(Vec3(2.0, -3.0, 0.0)) + 1.0;
  }
  const Eigen::VectorXd Lf = laplacian(mesh) * f;
  for (int row = 1; row < 9; ++row) {
    for (int column = 1; column < 9; ++column) {
      EXPECT_NEAR(Lf(10 * row + column), 0.0, 1e-12);
    }
  }
}

TEST(CotangentLaplacian, AgreesWithTheDenseOracle) {
  const TriMesh mesh = test::y_of_tubes(0.3, 12);
  const Eigen::MatrixXd expected = test::dense_laplacian(mesh, 1e4L).cast<double>();
  const Eigen::MatrixXd L = laplacian(mesh, {});
  EXPECT_LE((L - expected).norm(), 1e-10 * expected.norm());
}

TEST(CotangentLaplacian, TakesNothingFromFacesWithoutArea) {
  TriMesh mesh = test::sheet(1.0, 1.0, 2);
  const Sparse before = laplacian(mesh);
  mesh.triangles.push_back({0, 1, 2});  // three points in a row
  EXPECT_EQ(Eigen::MatrixXd(laplacian(mesh)), Eigen::MatrixXd(before));
}

TEST(CotangentLaplacian, ScalesRowsDownToTheDiagonalLimit) {
  const TriMesh needle{.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1e-6, 0}}, .triangles = {{0, 1, 2}}};
  const Sparse L = laplacian(needle, {.diagonal = 1e4});
  // The short side is opposite an angle of 1e-6: its weight of 1e6 exceeds the limit.
  EXPECT_NEAR(L.coeff(0, 0), -1e4, 1e-8);
  EXPECT_NEAR(L.coeff(2, 2), -1e4, 1e-8);
  EXPECT_NEAR(L.coeff(0, 1) + L.coeff(0, 2), 1e4, 1e-8);
  EXPECT_GT(std::abs(L.coeff(0, 2)), 9e3);
}

TEST(CotangentLaplacian, ClampsCotangents) {
  const TriMesh needle{.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1e-6, 0}}, .triangles = {{0, 1, 2}}};
  EXPECT_EQ(laplacian(needle, {.diagonal = 1e300, .cotangent = 50.0}).coeff(0, 2), 50.0);
}

TEST(CotangentLaplacian, HasNoNegativeWeightsIfAsked) {
  // The angle at 2 is obtuse: cot 143° < 0 for the edge 0–1.
  const TriMesh obtuse{.positions = {{0, 0, 0}, {3, 0, 0}, {1.5, 0.5, 0}},
                       .triangles = {{0, 1, 2}}};
  EXPECT_LT(laplacian(obtuse).coeff(0, 1), 0.0);
  LaplacianLimits limits = kNoLimits;
  limits.non_negative = true;
  EXPECT_EQ(laplacian(obtuse, limits).coeff(0, 1), 0.0);
  EXPECT_GT(laplacian(obtuse, limits).coeff(0, 2), 0.0);
}

TEST(CotangentLaplacian, KeepsItsPatternWhilePositionsChange) {
  TriMesh mesh = test::torus(1.0, 0.3, 12, 8);
  const Sparse before = laplacian(mesh);
  for (Vec3& p : mesh.positions) {
    p.z() = 0.0;  // flat, with folded and zero-area faces
  }
  mesh.positions[1] = mesh.positions[0];
  const Sparse after = laplacian(mesh);
  ASSERT_EQ(before.nonZeros(), after.nonZeros());
  EXPECT_TRUE(std::equal(before.innerIndexPtr(), before.innerIndexPtr() + before.nonZeros(),
                         after.innerIndexPtr()));
  EXPECT_TRUE(std::equal(before.outerIndexPtr(), before.outerIndexPtr() + before.cols() + 1,
                         after.outerIndexPtr()));
}

TEST(CotangentLaplacian, StaysFiniteOnTinyAndHugeTriangles) {
  for (const double scale : {1e-160, 1e-8, 1e8, 1e150}) {
    TriMesh mesh = test::sheet(scale, scale, 3);
    const Sparse L = laplacian(mesh, {});
    EXPECT_TRUE(Eigen::MatrixXd(L).allFinite()) << scale;
  }
}

}  // namespace
}  // namespace vantage
