// SPDX-License-Identifier: MIT
#include "support/dense_oracles.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <set>
#include <utility>

#include <Eigen/Dense>

#include "support/worst.h"

namespace vantage::test {
namespace {

using Real = long double;
using Real3 = Eigen::Matrix<Real, 3, 1>;

Real area_of(const Vec3& a, const Vec3& b, const Vec3& c) {
  const Real3 u = (b - a).cast<Real>();
  const Real3 v = (c - a).cast<Real>();
  return u.cross(v).norm() / 2;
}

/// Cotangent of the angle at a by the law of cosines: (|ab|² + |ac|² − |bc|²) / (4 area).
Real cotangent_at(const Vec3& a, const Vec3& b, const Vec3& c) {
  const Real area = area_of(a, b, c);
  if (!(area > 0)) {
    return 0;
  }
  const Real ab = (b - a).cast<Real>().squaredNorm();
  const Real ac = (c - a).cast<Real>().squaredNorm();
  const Real bc = (c - b).cast<Real>().squaredNorm();
  return (ab + ac - bc) / (4 * area);
}

/// Faces of each vertex by looking at all of them.
std::vector<std::vector<const Triangle*>> faces_at_vertices(const TriMesh& mesh) {
  std::vector<std::vector<const Triangle*>> faces(mesh.positions.size());
  for (const Triangle& t : mesh.triangles) {
    for (const std::uint32_t v : t) {
      faces[v].push_back(&t);
    }
  }
  return faces;
}

Real area_at(std::span<const Vec3> positions, const Triangle& t) {
  return area_of(positions[t[0]], positions[t[1]], positions[t[2]]);
}

Real mean_face_area(const TriMesh& mesh) {
  Real sum = 0;
  for (const Triangle& t : mesh.triangles) {
    sum += area_at(mesh.positions, t);
  }
  return sum / static_cast<Real>(mesh.triangles.size());
}

/// Φ's mean of one level: of all but one maximum, or of the local maxima but the global one.
Real mean_of_level(const std::vector<Real>& D, const std::vector<std::set<std::uint32_t>>& rings,
                   const std::vector<Real>& weight, std::size_t maximum, Suppression suppression) {
  Real sum = 0;
  Real weights = 0;
  for (std::size_t v = 0; v < D.size(); ++v) {
    if (rings[v].empty() || v == maximum) {
      continue;
    }
    const bool counts =
        suppression == Suppression::Mean ||
        std::all_of(rings[v].begin(), rings[v].end(), [&](std::uint32_t u) { return D[u] < D[v]; });
    if (counts) {
      sum += weight[v] * D[v];
      weights += weight[v];
    }
  }
  return weights > 0 ? sum / weights : 0;
}

std::vector<std::set<std::uint32_t>> rings_of(const TriMesh& mesh) {
  std::vector<std::set<std::uint32_t>> rings(mesh.positions.size());
  for (const Triangle& t : mesh.triangles) {
    for (const std::uint32_t a : t) {
      for (const std::uint32_t b : t) {
        if (a != b) {
          rings[a].insert(b);
        }
      }
    }
  }
  return rings;
}

/// Largest distance between two vertices that have a ring: D of any set that is symmetric enough.
Real extent_of(const TriMesh& mesh, const std::vector<std::set<std::uint32_t>>& rings) {
  Real extent = 0;
  for (std::size_t a = 0; a < rings.size(); ++a) {
    for (std::size_t b = 0; b < a; ++b) {
      if (!rings[a].empty() && !rings[b].empty()) {
        extent = std::max(extent, (mesh.positions[a] - mesh.positions[b]).cast<Real>().norm());
      }
    }
  }
  return extent;
}

/// A level that spans less of the extent than this is flat (docs/kssm.md).
constexpr Real kFlat = 1e-6L;

/// A third of the area of the faces at each vertex, or 1.
std::vector<Real> weights_of(const TriMesh& mesh, bool by_area) {
  if (!by_area) {
    return std::vector<Real>(mesh.positions.size(), 1);
  }
  std::vector<Real> weight(mesh.positions.size(), 0);
  for (const Triangle& t : mesh.triangles) {
    for (const std::uint32_t v : t) {
      weight[v] += area_at(mesh.positions, t) / 3;
    }
  }
  return weight;
}

/// First vertices with the least and with the largest value, of those that have a ring; both 0 if
/// none has.
std::pair<std::size_t, std::size_t> extremes_of(const std::vector<Real>& d,
                                                const std::vector<std::set<std::uint32_t>>& rings) {
  std::optional<std::size_t> low;
  std::optional<std::size_t> high;
  for (std::size_t v = 0; v < d.size(); ++v) {
    if (!rings[v].empty()) {
      low = !low || d[v] < d[*low] ? v : *low;
      high = !high || d[v] > d[*high] ? v : *high;
    }
  }
  return {low.value_or(0), high.value_or(0)};
}

}  // namespace

DenseMatrix dense_laplacian(const TriMesh& mesh, long double diagonal_limit) {
  const auto n = static_cast<Eigen::Index>(mesh.positions.size());
  DenseMatrix L = DenseMatrix::Zero(n, n);
  for (const Triangle& t : mesh.triangles) {
    for (std::size_t c = 0; c < 3; ++c) {
      const auto apex = t[c];
      const auto i = static_cast<Eigen::Index>(t[(c + 1) % 3]);
      const auto j = static_cast<Eigen::Index>(t[(c + 2) % 3]);
      const Real w = cotangent_at(mesh.positions[apex], mesh.positions[t[(c + 1) % 3]],
                                  mesh.positions[t[(c + 2) % 3]]);
      L(i, j) += w;
      L(j, i) += w;
      L(i, i) -= w;
      L(j, j) -= w;
    }
  }
  for (Eigen::Index i = 0; i < n; ++i) {
    const Real diagonal = std::abs(L(i, i));
    if (diagonal > diagonal_limit) {
      L.row(i) *= diagonal_limit / diagonal;
    }
  }
  return L;
}

std::vector<double> dense_area_ratios(const TriMesh& start, std::span<const Vec3> now) {
  constexpr Real kTinyFace = 1e-6L;
  const Real smallest = kTinyFace * mean_face_area(start);
  std::vector<double> ratios;
  for (const auto& faces : faces_at_vertices(start)) {
    Real sum = 0;
    int counted = 0;
    for (const Triangle* t : faces) {
      const Real before = area_at(start.positions, *t);
      if (before >= smallest) {
        sum += area_at(now, *t) / before;
        ++counted;
      }
    }
    ratios.push_back(static_cast<double>(counted > 0 ? sum / counted : -1));
  }
  return ratios;
}

StepWeights step_weights(const TriMesh& start, std::span<const Vec3> now, int step,
                         const ContractionOptions& options) {
  StepWeights weights;
  weights.contraction = 1 / (10 * std::sqrt(mean_face_area(start)));
  for (int i = 0; i < step; ++i) {
    weights.contraction =
        std::min<Real>(weights.contraction * options.contraction_growth,
                       std::max<Real>(weights.contraction, options.contraction_limit));
  }
  weights.attraction.assign(now.size(), 1.0);
  if (step > 0) {
    const std::vector<double> ratios = dense_area_ratios(start, now);
    double sum = 0.0;
    int counted = 0;
    for (const double ratio : ratios) {
      sum += std::max(ratio, 0.0);
      counted += ratio < 0.0 ? 0 : 1;
    }
    for (std::size_t v = 0; v < now.size(); ++v) {
      const double ratio = ratios[v] < 0.0 ? sum / counted : ratios[v];
      weights.attraction[v] = std::min(1.0 / std::sqrt(ratio), options.attraction_limit);
    }
  }
  return weights;
}

DenseMatrix dense_step(const TriMesh& now, const StepWeights& weights, long double diagonal_limit) {
  const auto n = static_cast<Eigen::Index>(now.positions.size());
  DenseMatrix stacked(2 * n, n);
  stacked.topRows(n) = weights.contraction * dense_laplacian(now, diagonal_limit);
  stacked.bottomRows(n).setZero();
  DenseMatrix right = DenseMatrix::Zero(2 * n, 3);
  for (Eigen::Index i = 0; i < n; ++i) {
    const auto v = static_cast<std::size_t>(i);
    stacked(n + i, i) = weights.attraction[v];
    right.row(n + i) = weights.attraction[v] * now.positions[v].cast<Real>().transpose();
  }
  return stacked.householderQr().solve(right);
}

double backward_error(const TriMesh& now, std::span<const Vec3> next, const StepWeights& weights,
                      long double diagonal_limit) {
  const auto n = static_cast<Eigen::Index>(now.positions.size());
  const DenseMatrix L = weights.contraction * dense_laplacian(now, diagonal_limit);
  DenseMatrix A = L.transpose() * L;
  DenseMatrix b(n, 3);
  DenseMatrix x(n, 3);
  for (Eigen::Index i = 0; i < n; ++i) {
    const auto v = static_cast<std::size_t>(i);
    const Real squared = static_cast<Real>(weights.attraction[v]) * weights.attraction[v];
    A(i, i) += squared;
    b.row(i) = squared * now.positions[v].cast<Real>().transpose();
    x.row(i) = next[v].cast<Real>().transpose();
  }
  const DenseMatrix residual = A * x - b;
  Real worst = 0;
  for (Eigen::Index c = 0; c < 3; ++c) {
    worst = larger(worst, residual.col(c).norm() / (A.norm() * x.col(c).norm() + b.col(c).norm()));
  }
  return static_cast<double>(worst);
}

double brute_force_distance(const CurveGraph& graph, const Vec3& point) {
  const Real3 p = point.cast<Real>();
  Real nearest = std::numeric_limits<Real>::infinity();
  for (const Vec3& node : graph.nodes) {
    nearest = smaller(nearest, (p - node.cast<Real>()).norm());
  }
  for (const auto& [i, j] : graph.edges) {
    const Real3 a = graph.nodes[i].cast<Real>();
    const Real3 b = graph.nodes[j].cast<Real>();
    const Real along = (p - a).dot(b - a);
    const Real length_squared = (b - a).squaredNorm();
    if (along > 0 && along < length_squared) {
      nearest = smaller(nearest, (p - a).cross(b - a).norm() / std::sqrt(length_squared));
    }
  }
  return static_cast<double>(nearest);
}

std::vector<double> direct_kssm(const TriMesh& mesh, const ContractionHistory& history,
                                const CurveGraph& graph, const KssmOptions& options) {
  const auto rings = rings_of(mesh);
  const Real extent = extent_of(mesh, rings);
  const std::size_t n = mesh.positions.size();
  const std::vector<Real> weight = weights_of(mesh, options.area_weighted_mean);
  const bool velocity = options.kinematics == Kinematics::Velocity;
  std::vector<Real> map(n, 0);
  for (std::size_t j = velocity ? 1 : 0; j < history.levels.size(); ++j) {
    std::vector<Real> d(n, 0);
    std::vector<Real> source(n, 0);  // the displacement that must be resolved
    for (std::size_t v = 0; v < n; ++v) {
      const Real now = brute_force_distance(graph, history.levels[j][v]);
      source[v] = velocity ? brute_force_distance(graph, history.levels[j - 1][v]) : now;
      d[v] = velocity ? source[v] - now : now;
    }
    const auto [nearest, farthest] = extremes_of(source, rings);
    const bool of_input = j == (velocity ? 1U : 0U);
    if (!of_input && !(source[farthest] - source[nearest] > options.flat_level * extent)) {
      continue;
    }
    const auto [low, high] = extremes_of(d, rings);
    if (!(d[high] - d[low] > kFlat * extent)) {
      continue;
    }
    std::vector<Real> D(n, 0);
    for (std::size_t v = 0; v < n; ++v) {
      D[v] = rings[v].empty() ? 0 : (d[v] - d[low]) / (d[high] - d[low]);
    }
    const Real mean = mean_of_level(D, rings, weight, high, options.suppression);
    for (std::size_t v = 0; v < n; ++v) {
      map[v] += D[v] * (1 - mean) * (1 - mean);
    }
  }
  return {map.begin(), map.end()};
}

double winding_number(const TriMesh& mesh, const Vec3& point) {
  double sum = 0.0;
  for (const Triangle& t : mesh.triangles) {
    const Vec3 a = mesh.positions[t[0]] - point;
    const Vec3 b = mesh.positions[t[1]] - point;
    const Vec3 c = mesh.positions[t[2]] - point;
    const double determinant = a.dot(b.cross(c));
    const double divisor = a.norm() * b.norm() * c.norm() + a.dot(b) * c.norm() +
                           b.dot(c) * a.norm() + c.dot(a) * b.norm();
    sum += 2.0 * std::atan2(determinant, divisor);
  }
  return sum / (4.0 * std::numbers::pi);
}

}  // namespace vantage::test
