// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/SparseCore>

#include "vantage/mesh/tri_mesh.h"
#include "vantage/operators/cotangent_laplacian.h"

namespace vantage {

/// Cotangent Laplacians of one triangulation whose positions change: the pattern is found once.
class LaplacianAssembler {
 public:
  /// \pre no face names a vertex twice. \param triangles must outlive this.
  LaplacianAssembler(std::size_t vertices, std::span<const Triangle> triangles);

  /// The matrix of cotangent_laplacian(); valid until the next call.
  const Eigen::SparseMatrix<double>& assemble(std::span<const Vec3> positions,
                                              const LaplacianLimits& limits);

 private:
  std::span<const Triangle> triangles_;
  Eigen::SparseMatrix<double> L_;
  std::vector<std::array<int, 6>> slots_;  ///< Per face: entries (i, j) and (j, i) by corner.
};

/// Lower triangle of Lᵀ R L + diag(d) for matrices L of one symmetric pattern and diagonal R.
class NormalMatrix {
 public:
  /// Rows of more entries are left out, as if R were zero there: the square of a row fills the matrix
  /// with the square of its entries, which one vertex with thousands of neighbours makes gigabytes.
  static constexpr int kWidestRow = 1000;

  /// Whether the pattern of LᵀRL may be found: its entries are at most 2 million or 500 a vertex, and at
  /// most 2³¹ − 1, by a bound from the rows of L. A surface has 10 to 30 a vertex; of a soup of faces that share corners
  /// drawn by lot all n² / 2 may be there.
  static bool fits(const Eigen::SparseMatrix<double>& L);

  /// Finds the pattern. \param L its pattern is symmetric and has a full diagonal.
  explicit NormalMatrix(const Eigen::SparseMatrix<double>& L);

  /// Fills in the values; valid until the next call. \param row_weights R, one per row.
  Eigen::SparseMatrix<double>& assemble(const Eigen::SparseMatrix<double>& L,
                                        const Eigen::VectorXd& row_weights,
                                        const Eigen::VectorXd& diagonal);

 private:
  Eigen::SparseMatrix<double> A_;
  std::vector<int> transposed_;  ///< For each entry (k, i) of L the place of (i, k).
};

}  // namespace vantage
