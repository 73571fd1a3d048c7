// SPDX-License-Identifier: MIT
#include "mesh/curvature.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/Geometry>

#include "vantage/mesh/measures.h"
#include "vantage/mesh/topology.h"

#include "core/dense_algebra.h"

namespace vantage {
namespace {

/// Of the fit: three of the second fundamental form, two of the tilt.
constexpr std::size_t kUnknowns = 5;
/// A two-ring leaves out the rings of vertices with more neighbours than this: of a fan's middle all
/// of its rim would be taken, at each vertex of the rim. [ours]
constexpr std::size_t kLargestRing = 64;

/// Vertices whose faces close one ring around them.
std::vector<bool> ringed_vertices(const TriMesh& mesh, const EdgeTable& table) {
  const std::vector<std::uint32_t> fans = count_fans(mesh);
  std::vector<bool> ringed(fans.size());
  for (std::size_t v = 0; v < fans.size(); ++v) {
    ringed[v] = fans[v] == 1;
  }
  for (std::size_t e = 0; e < table.edges.size(); ++e) {
    if (table.faces_of_edge[e].size() != 2) {
      for (const std::uint32_t v : table.edges[e]) {
        ringed[v] = false;
      }
    }
  }
  return ringed;
}

/// The one-ring of v, or the two-ring where the one-ring has too few vertices for the fit.
void gather_neighbourhood(const IndexLists& rings, std::size_t v,
                          std::vector<std::uint32_t>& near) {
  near.assign(rings[v].begin(), rings[v].end());
  if (near.size() > kUnknowns) {
    return;
  }
  const std::size_t first = near.size();
  for (std::size_t k = 0; k < first; ++k) {
    const auto ring = rings[near[k]];
    if (ring.size() <= kLargestRing) {
      near.insert(near.end(), ring.begin(), ring.end());
    }
  }
  std::sort(near.begin(), near.end());
  near.erase(std::unique(near.begin(), near.end()), near.end());
  std::erase(near, static_cast<std::uint32_t>(v));
}

/// Fits κ(θ) = a cos² θ + 2 b cos θ sin θ + c sin² θ, the second fundamental form, to the normal
/// curvatures κ = 2 N·(x − x') / |x − x'|² towards the neighbours x', together with a tilt of the
/// normal, which adds 2 (s cos θ + t sin θ) / |x − x'|. Returns (a + c) / 2.
double fitted_mean_curvature(const std::vector<Vec3>& positions, std::size_t v, const Vec3& normal,
                             const std::vector<std::uint32_t>& near) {
  double mean_length = 0.0;
  for (const std::uint32_t u : near) {
    mean_length += (positions[u] - positions[v]).norm();
  }
  mean_length /= static_cast<double>(near.size());
  if (!(mean_length > 0.0) || normal.isZero()) {
    return 0.0;
  }
  const Vec3 right = normal.unitOrthogonal();
  const Vec3 up = normal.cross(right);
  const auto rows = static_cast<Eigen::Index>(near.size());
  Eigen::MatrixXd system(rows, kUnknowns);
  Eigen::VectorXd kappa(rows);
  for (Eigen::Index row = 0; row < rows; ++row) {
    // In units of the mean length, so that the columns weigh the same at any scale.
    const Vec3 along =
        (positions[near[static_cast<std::size_t>(row)]] - positions[v]) / mean_length;
    const double squared = along.squaredNorm();
    const Eigen::Vector2d flat(along.dot(right), along.dot(up));
    const double length = flat.norm();
    if (!(length > 0.0) || !(squared > 0.0)) {
      system.row(row).setZero();
      kappa[row] = 0.0;
      continue;
    }
    const double c = flat.x() / length;
    const double s = flat.y() / length;
    const double tilt = 2.0 / std::sqrt(squared);
    system.row(row) << c * c, 2.0 * c * s, s * s, tilt * c, tilt * s;
    kappa[row] = -2.0 * normal.dot(along) / squared;
  }
  const Eigen::VectorXd form = least_squares(system, kappa);
  return 0.5 * (form[0] + form[2]) / mean_length;
}

double corner_angle(const TriMesh& mesh, const Triangle& t, int corner) {
  const Vec3& p = mesh.positions[t[static_cast<std::size_t>(corner)]];
  const Vec3 a = mesh.positions[t[static_cast<std::size_t>((corner + 1) % 3)]] - p;
  const Vec3 b = mesh.positions[t[static_cast<std::size_t>((corner + 2) % 3)]] - p;
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

}  // namespace

std::vector<Vec3> sphere_exact_normals(const TriMesh& mesh) {
  std::vector<Vec3> normals(mesh.positions.size(), Vec3::Zero());
  for (const Triangle& t : mesh.triangles) {
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const Vec3& p = mesh.positions[t[corner]];
      const Vec3 a = mesh.positions[t[(corner + 1) % 3]] - p;
      const Vec3 b = mesh.positions[t[(corner + 2) % 3]] - p;
      const double scale = a.squaredNorm() * b.squaredNorm();
      if (scale > 0.0) {
        normals[t[corner]] += a.cross(b) / scale;
      }
    }
  }
  for (Vec3& n : normals) {
    n = n.stableNorm() > 0.0 ? Vec3(n.stableNormalized()) : Vec3(Vec3::Zero());
  }
  return normals;
}

std::vector<double> mean_curvatures(const TriMesh& mesh) {
  const std::vector<bool> ringed = ringed_vertices(mesh, build_edge_table(mesh));
  const std::vector<Vec3> normals = sphere_exact_normals(mesh);
  const IndexLists rings = vertex_neighbours(mesh);
  std::vector<double> curvature(mesh.positions.size(), 0.0);
  std::vector<std::uint32_t> near;
  for (std::size_t v = 0; v < curvature.size(); ++v) {
    if (ringed[v]) {
      gather_neighbourhood(rings, v, near);
      curvature[v] = fitted_mean_curvature(mesh.positions, v, normals[v], near);
    }
  }
  return curvature;
}

std::vector<double> angle_deficits(const TriMesh& mesh) {
  const std::vector<bool> ringed = ringed_vertices(mesh, build_edge_table(mesh));
  std::vector<double> deficit(mesh.positions.size(), 2.0 * std::numbers::pi);
  for (const Triangle& t : mesh.triangles) {
    for (int corner = 0; corner < 3; ++corner) {
      deficit[t[static_cast<std::size_t>(corner)]] -= corner_angle(mesh, t, corner);
    }
  }
  for (std::size_t v = 0; v < deficit.size(); ++v) {
    deficit[v] = ringed[v] ? deficit[v] : 0.0;
  }
  return deficit;
}

}  // namespace vantage
