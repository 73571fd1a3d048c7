// SPDX-License-Identifier: MIT
#include "mesh/specks.h"

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <vector>

#include "vantage/mesh/measures.h"
#include "vantage/mesh/topology.h"

namespace vantage {
namespace {

/// What each component holds of the surface.
std::vector<double> area_shares(const TriMesh& mesh, const Components& components) {
  const std::vector<double> areas = face_areas(mesh);
  const double whole = std::accumulate(areas.begin(), areas.end(), 0.0);
  std::vector<double> shares(components.count, 0.0);
  for (std::size_t f = 0; f < areas.size(); ++f) {
    shares[components.of_vertex[mesh.triangles[f][0]]] += whole > 0.0 ? areas[f] / whole : 0.0;
  }
  return shares;
}

constexpr double kMostSpeckArea = 0.01;  // of the surface [ours]

/// Whether each component is one of the smallest, which together hold kMostSpeckArea at most.
std::vector<bool> are_small(const std::vector<double>& shares) {
  std::vector<std::uint32_t> order(shares.size());
  std::iota(order.begin(), order.end(), 0U);
  std::stable_sort(order.begin(), order.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return shares[a] < shares[b]; });
  std::vector<bool> small(shares.size(), false);
  double sum = 0.0;
  for (const std::uint32_t component : order) {
    sum += shares[component];
    if (sum > kMostSpeckArea) {
      break;
    }
    small[component] = true;
  }
  return small;
}

bool is_inside(const Vec3& point, const Box& box) {
  return (point.array() >= box.low.array()).all() && (point.array() <= box.high.array()).all();
}

}  // namespace

Specks find_specks(const TriMesh& mesh) {
  const Components components = connected_components(mesh);
  const std::vector<double> shares = area_shares(mesh, components);
  if (components.count < 2 || !(*std::max_element(shares.begin(), shares.end()) > 0.0)) {
    return {};
  }
  const std::vector<bool> small = are_small(shares);
  const std::vector<bool> has_faces = vertices_with_faces(mesh);
  std::vector<Vec3> all;
  std::vector<Vec3> large;
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    if (has_faces[v]) {
      all.push_back(mesh.positions[v]);
      if (!small[components.of_vertex[v]]) {
        large.push_back(mesh.positions[v]);
      }
    }
  }
  const Box box = bounding_box(large);
  std::vector<bool> is_speck(components.count, false);
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    if (has_faces[v] && !is_inside(mesh.positions[v], box)) {
      is_speck[components.of_vertex[v]] = true;
    }
  }
  Specks specks;
  for (std::size_t c = 0; c < components.count; ++c) {
    specks.count += is_speck[c] ? 1 : 0;
  }
  if (specks.count > 0) {
    specks.enlargement = bounding_box(all).size().norm() / box.size().norm();
  }
  return specks;
}

}  // namespace vantage
