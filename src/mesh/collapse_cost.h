// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include "vantage/mesh/measures.h"
#include "vantage/mesh/tri_mesh.h"

#include "mesh/quadric.h"

/// \file
/// What collapsing an edge costs, and where its vertex then stands: the policies of the decimation.

namespace vantage {

/// The faces at each vertex, by their two other corners in the order of the face: what a collapse
/// asks for lies side by side.
struct Fans {
  using Corners = std::array<std::uint32_t, 2>;
  std::vector<std::uint32_t> offsets{};
  std::vector<Corners> corners{};

  [[nodiscard]] std::span<const Corners> operator[](std::size_t v) const {
    return std::span(corners).subspan(offsets[v], offsets[v + 1] - offsets[v]);
  }
};

inline Fans fans_of(const TriMesh& mesh) {
  Fans fans;
  fans.offsets.assign(mesh.positions.size() + 1, 0);
  for (const Triangle& t : mesh.triangles) {
    for (const std::uint32_t v : t) {
      ++fans.offsets[v + 1];
    }
  }
  std::partial_sum(fans.offsets.begin(), fans.offsets.end(), fans.offsets.begin());
  fans.corners.resize(fans.offsets.back());
  std::vector<std::uint32_t> cursor(fans.offsets.begin(), fans.offsets.end() - 1);
  for (const Triangle& t : mesh.triangles) {
    fans.corners[cursor[t[0]]++] = {t[1], t[2]};
    fans.corners[cursor[t[1]]++] = {t[2], t[0]};
    fans.corners[cursor[t[2]]++] = {t[0], t[1]};
  }
  return fans;
}

/// Cost and place of a collapse by quadric error.
class ByQuadric {
 public:
  /// Share of the squared edge length in the cost, against the squared distance to the planes [ours:
  /// even triangles contract like the fine surface; docs/lab has the trials].
  static constexpr double kEvenness = 0.05;
  /// Weight of the plane through a border edge, upright on its face, against that of the face.
  static constexpr double kBorder = 1.0;
  static constexpr bool kMayTurn = false;
  static constexpr std::size_t kLargestRing = 14;  // neighbours a collapse may leave

  ByQuadric(const TriMesh& mesh, std::span<const double> weights)
      : quadrics_(mesh.positions.size()) {
    for (const Triangle& t : mesh.triangles) {
      const Vec3 normal = area_vector(mesh, t);
      const double twice = normal.norm();
      if (twice > 0.0) {
        for (const std::uint32_t v : t) {
          quadrics_[v].add_plane(normal / twice, mesh.positions[v], 0.5 * twice);
        }
      }
    }
    add_borders(mesh);
    for (std::size_t v = 0; v < weights.size(); ++v) {
      quadrics_[v] *= weights[v];
    }
  }

  [[nodiscard]] Vec3 place(std::uint32_t a, std::uint32_t b, const std::vector<Vec3>& x) const {
    return joint(a, b).best_point(0.5 * (x[a] + x[b]));
  }

  [[nodiscard]] double cost(std::uint32_t a, std::uint32_t b, const std::vector<Vec3>& x) const {
    const Quadric sum = joint(a, b);
    return sum.error(sum.best_point(0.5 * (x[a] + x[b]))) +
           kEvenness * sum.weight * (x[a] - x[b]).squaredNorm();
  }

  void merge(std::uint32_t a, std::uint32_t b) { quadrics_[a] += quadrics_[b]; }

  void move(std::uint32_t from, std::uint32_t to) { quadrics_[to] = quadrics_[from]; }

  void fetch(std::uint32_t v) const {
    __builtin_prefetch(&quadrics_[v]);
    __builtin_prefetch(&quadrics_[v].weight);
  }

 private:
  [[nodiscard]] Quadric joint(std::uint32_t a, std::uint32_t b) const {
    Quadric sum = quadrics_[a];
    sum += quadrics_[b];
    return sum;
  }

  /// Neighbours that a vertex has one face with are found by its fan: a table of all edges would
  /// take several times as long.
  void add_borders(const TriMesh& mesh) {
    const Fans fans = fans_of(mesh);
    std::vector<std::uint8_t> faces(mesh.positions.size(), 0);  // at the edge to each neighbour
    std::vector<std::array<std::uint32_t, 3>> border;           // neighbour, and the face's corners
    for (std::uint32_t v = 0; v < mesh.positions.size(); ++v) {
      border.clear();
      each_side(fans, v, [&](std::uint32_t u, const Fans::Corners&) {
        faces[u] = static_cast<std::uint8_t>(std::min(faces[u] + 1, 2));
      });
      each_side(fans, v, [&](std::uint32_t u, const Fans::Corners& corners) {
        if (faces[u] == 1) {
          border.push_back({u, corners[0], corners[1]});
        }
      });
      each_side(fans, v, [&](std::uint32_t u, const Fans::Corners&) { faces[u] = 0; });
      std::sort(border.begin(), border.end());
      for (const auto& [u, next, last] : border) {
        add_border({v, u}, {v, next, last}, mesh);
      }
    }
  }

  /// Calls each(neighbour, corners) for both sides at `v` of its faces, those to later vertices.
  template <class Each>
  static void each_side(const Fans& fans, std::uint32_t v, const Each& each) {
    for (const Fans::Corners& corners : fans[v]) {
      for (const std::uint32_t u : corners) {
        if (u > v && corners[0] != v && corners[1] != v && corners[0] != corners[1]) {
          each(u, corners);
        }
      }
    }
  }

  void add_border(const std::array<std::uint32_t, 2>& edge, const Triangle& face,
                  const TriMesh& mesh) {
    const Vec3 along = mesh.positions[edge[1]] - mesh.positions[edge[0]];
    const Vec3 normal = along.cross(area_vector(mesh, face));
    const double length = normal.norm();
    if (length > 0.0) {
      for (const std::uint32_t v : edge) {
        quadrics_[v].add_plane(normal / length, mesh.positions[v], kBorder * along.squaredNorm());
      }
    }
  }

  std::vector<Quadric> quadrics_;
};

/// Cost and place of a collapse by length.
class ByLength {
 public:
  static constexpr bool kMayTurn = true;
  static constexpr std::size_t kLargestRing = 32;  // neighbours a collapse may leave

  explicit ByLength(std::vector<double> weights) : weights_(std::move(weights)) {}

  [[nodiscard]] Vec3 place(std::uint32_t a, std::uint32_t b, const std::vector<Vec3>& x) const {
    return (weights_[a] * x[a] + weights_[b] * x[b]) / (weights_[a] + weights_[b]);
  }

  [[nodiscard]] static double cost(std::uint32_t a, std::uint32_t b, const std::vector<Vec3>& x) {
    return (x[a] - x[b]).squaredNorm();
  }

  void merge(std::uint32_t a, std::uint32_t b) { weights_[a] += weights_[b]; }

  void move(std::uint32_t from, std::uint32_t to) { weights_[to] = weights_[from]; }

  void fetch(std::uint32_t v) const { __builtin_prefetch(&weights_[v]); }

 private:
  std::vector<double> weights_;
};

}  // namespace vantage
