// SPDX-License-Identifier: MIT
// The cotangent Laplacian at work: noise on a sphere, smoothed by one implicit step
// (I + t LᵀL) x' = x, solved with Eigen.
#include <cmath>
#include <cstdio>
#include <random>

#include <Eigen/SparseCholesky>

#include "vantage/operators/cotangent_laplacian.h"
#include "vantage/spatial/directions.h"

namespace {

/// Root mean square of the distance to the unit sphere.
double roughness(const std::vector<vantage::Vec3>& points) {
  double sum = 0.0;
  for (const vantage::Vec3& p : points) {
    sum += std::pow(p.norm() - 1.0, 2);
  }
  return std::sqrt(sum / static_cast<double>(points.size()));
}

}  // namespace

int main() {
  using namespace vantage;
  const DirectionSet sphere = direction_set(ViewSphereBase::Icosahedron, 4);
  std::vector<Vec3> points = sphere.directions;
  std::mt19937 random(7);  // the same numbers on every platform
  for (Vec3& p : points) {
    p *= 1.0 + 0.02 * (static_cast<double>(random()) / 4294967296.0 - 0.5);
  }
  const double before = roughness(points);

  const Eigen::SparseMatrix<double> laplacian =
      cotangent_laplacian(sphere.directions, sphere.triangles);
  Eigen::SparseMatrix<double> system(laplacian.rows(), laplacian.cols());
  system.setIdentity();
  constexpr double kStep = 0.5;
  system += kStep * Eigen::SparseMatrix<double>(laplacian.transpose() * laplacian);
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver(system);
  for (int axis = 0; axis < 3; ++axis) {
    Eigen::VectorXd x(laplacian.rows());
    for (Eigen::Index i = 0; i < x.size(); ++i) {
      x[i] = points[static_cast<std::size_t>(i)][axis];
    }
    x = solver.solve(x).eval();
    for (Eigen::Index i = 0; i < x.size(); ++i) {
      points[static_cast<std::size_t>(i)][axis] = x[i];
    }
  }
  std::printf("roughness %.5f, smoothed %.5f\n", before, roughness(points));
  return roughness(points) < 0.5 * before ? 0 : 1;
}
