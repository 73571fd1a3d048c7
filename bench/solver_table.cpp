// SPDX-License-Identifier: MIT
// Compares our sparse Cholesky with others on the first step's system of real models:
//   solver_table MODEL…
// One Markdown row a model and solver: processor time of analysis, one factorisation and one solve with three
// right-hand sides (the least of five), entries of the factor, and the relative residual.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <exception>
#include <filesystem>
#include <functional>
#include <iostream>  // Eigen 3.4's MetisSupport uses std::cerr without including it
#include <limits>

#include <Eigen/MetisSupport>
#include <Eigen/SparseCholesky>
#ifdef VANTAGE_HAVE_CHOLMOD
#include <Eigen/CholmodSupport>
#endif
#ifdef VANTAGE_HAVE_MUMPS
#include <dmumps_c.h>
#endif

#include "vantage/io/model.h"
#include "vantage/mesh/measures.h"
#include "vantage/mesh/mesh_check.h"
#include "vantage/operators/cotangent_laplacian.h"

#include "mesh/decimation.h"
#include "operators/elimination_order.h"
#include "operators/sparse_cholesky.h"
#include "operators/supernodes.h"

namespace {

using vantage::TriMesh;
using Matrix = Eigen::SparseMatrix<double>;
constexpr int kRuns = 5;

struct Row {
  double analysis = std::numeric_limits<double>::infinity();
  double factorisation = std::numeric_limits<double>::infinity();
  double solve = std::numeric_limits<double>::infinity();
  double residual = 0.0;
  double entries = 0.0;
};

/// Processor seconds, which other programs on the machine disturb least.
double timed(const std::function<void()>& work) {
  const std::clock_t start = std::clock();
  work();
  return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
}

/// The normal matrix of the first step (docs/contraction.md).
Matrix first_system(TriMesh mesh) {
  const vantage::Sphere sphere = vantage::enclosing_sphere(vantage::referenced_points(mesh));
  for (vantage::Vec3& p : mesh.positions) {
    p = (p - sphere.centre) * (2.0 / sphere.diameter);
  }
  const Matrix L = vantage::cotangent_laplacian(mesh.positions, mesh.triangles);
  double area = 0.0;
  for (const double a : vantage::face_areas(mesh)) {
    area += a / static_cast<double>(mesh.triangles.size());
  }
  Matrix A = Matrix(L.transpose()) * L * (1.0 / (100.0 * area));
  for (Eigen::Index i = 0; i < A.rows(); ++i) {
    A.coeffRef(i, i) += 1.0;
  }
  A.makeCompressed();
  return A;
}

/// \param analyse, factorise, solve what the solver calls so. \param solve returns the solution.
Row measure(const Matrix& A, const std::function<void()>& analyse,
            const std::function<void()>& factorise,
            const std::function<Eigen::MatrixX3d(const Eigen::MatrixX3d&)>& solve) {
  Eigen::MatrixX3d B(A.rows(), 3);
  for (Eigen::Index i = 0; i < B.rows(); ++i) {
    B.row(i) << std::sin(static_cast<double>(i)), std::cos(static_cast<double>(i)), 1.0;
  }
  Row row;
  Eigen::MatrixX3d X;
  for (int run = 0; run < kRuns; ++run) {
    row.analysis = std::min(row.analysis, timed(analyse));
    row.factorisation = std::min(row.factorisation, timed(factorise));
    row.solve = std::min(row.solve, timed([&] { X = solve(B); }));
  }
  row.residual = (A * X - B).norm() / B.norm();
  return row;
}

void print(const std::string& model, const Matrix& A, const char* solver, const Row& row) {
  std::printf("| %s | %ld | %s | %.1f | %.1f | %.1f | %.1f | %.2f | %.0e |\n", model.c_str(),
              static_cast<long>(A.rows()), solver, 1e3 * row.analysis, 1e3 * row.factorisation,
              1e3 * row.solve, 1e3 * (row.analysis + 7.0 * (row.factorisation + row.solve)),
              1e-6 * row.entries, row.residual);
  std::fflush(stdout);
}

Row ours(const Matrix& A) {
  const vantage::RunContext run{.report = {}, .stop = {}, .max_threads = 1};
  vantage::SparseCholesky solver;
  Row row = measure(
      A, [&] { solver.analyze(A, run); }, [&] { solver.factorize(A, run); },
      [&](const Eigen::MatrixX3d& B) { return solver.solve(B); });
  row.entries = static_cast<double>(
      vantage::find_supernodes(A, vantage::elimination_order(A)).value_start.back());
  return row;
}

template <class Solver>
Row eigens(const Matrix& A) {
  Solver solver;
  Row row = measure(
      A, [&] { solver.analyzePattern(A); }, [&] { solver.factorize(A); },
      [&](const Eigen::MatrixX3d& B) { return Eigen::MatrixX3d(solver.solve(B)); });
  if constexpr (requires { solver.matrixL().nestedExpression().nonZeros(); }) {
    row.entries = static_cast<double>(solver.matrixL().nestedExpression().nonZeros());
  }
#ifdef VANTAGE_HAVE_CHOLMOD
  if constexpr (requires { solver.cholmod(); }) {
    row.entries = solver.cholmod().lnz;
  }
#endif
  return row;
}

#ifdef VANTAGE_HAVE_MUMPS
constexpr MUMPS_INT kWholeWorld = -987654;  // MUMPS' name for Fortran's MPI_COMM_WORLD

Row mumps(const Matrix& A) {
  std::vector<MUMPS_INT> rows;
  std::vector<MUMPS_INT> columns;
  std::vector<double> values;
  for (Eigen::Index j = 0; j < A.cols(); ++j) {
    for (Matrix::InnerIterator it(A, j); it; ++it) {
      if (it.row() >= j) {
        rows.push_back(static_cast<MUMPS_INT>(it.row()) + 1);
        columns.push_back(static_cast<MUMPS_INT>(j) + 1);
        values.push_back(it.value());
      }
    }
  }
  DMUMPS_STRUC_C id{};
  const auto call = [&id](MUMPS_INT job) {
    id.job = job;
    dmumps_c(&id);
  };
  id.par = 1;
  id.sym = 1;  // positive definite
  id.comm_fortran = kWholeWorld;
  call(-1);
  for (const int silent : {0, 1, 2, 3}) {
    id.icntl[silent] = silent == 3 ? 0 : -1;
  }
  id.icntl[6] = 5;  // ordering: METIS
  id.n = static_cast<MUMPS_INT>(A.rows());
  id.nnz = static_cast<MUMPS_INT8>(values.size());
  id.irn = rows.data();
  id.jcn = columns.data();
  id.a = values.data();
  Eigen::MatrixX3d X;
  Row row = measure(
      A, [&] { call(1); }, [&] { call(2); },
      [&](const Eigen::MatrixX3d& B) {
        X = B;
        id.nrhs = 3;
        id.lrhs = id.n;
        id.rhs = X.data();
        call(3);
        return X;
      });
  row.entries = id.infog[8] < 0 ? -1e6 * id.infog[8] : id.infog[8];
  call(-2);
  return row;
}
#endif

void table_of(const std::string& path) {
  const TriMesh mesh = vantage::weld(vantage::load_model(path).mesh).mesh;
  const std::string name = std::filesystem::path(path).stem().string();
  std::vector<Matrix> systems{first_system(mesh)};
  if (mesh.positions.size() > 20'000) {
    systems.insert(systems.begin(), first_system(vantage::decimate(mesh, 10'000, {}).mesh));
  }
  for (const Matrix& A : systems) {
    print(name, A, "ours", ours(A));
    using Amd = Eigen::SimplicialLLT<Matrix, Eigen::Lower, Eigen::AMDOrdering<int>>;
    using Metis = Eigen::SimplicialLLT<Matrix, Eigen::Lower, Eigen::MetisOrdering<int>>;
    if (A.rows() < 60'000) {
      print(name, A, "Eigen, AMD", eigens<Amd>(A));
    }
    print(name, A, "Eigen, METIS", eigens<Metis>(A));
#ifdef VANTAGE_HAVE_CHOLMOD
    print(name, A, "CHOLMOD", eigens<Eigen::CholmodSupernodalLLT<Matrix>>(A));
#endif
#ifdef VANTAGE_HAVE_MUMPS
    print(name, A, "MUMPS", mumps(A));
#endif
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) {
    std::fprintf(stderr, "usage: solver_table MODEL...\n");
    return 2;
  }
  std::printf(
      "| model | unknowns | solver | analysis ms | factorisation ms | solve ms |"
      " one analysis + 7 steps ms | entries, millions | residual |\n");
  std::printf("| --- | --- | --- | --- | --- | --- | --- | --- | --- |\n");
  try {
    for (int i = 1; i < argc; ++i) {
      table_of(argv[i]);
    }
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
  return 0;
}
