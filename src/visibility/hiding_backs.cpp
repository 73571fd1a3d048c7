// SPDX-License-Identifier: MIT
#include "visibility/hiding_backs.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include <Eigen/Geometry>

#include "vantage/mesh/tri_mesh.h"

namespace vantage {
namespace {

// What is no farther apart than this, in units of a UnitFrame, may meet: thousands of roundings of
// its coordinates.
constexpr double kClear = 0x1p-40;
// A shell whose volume is below this share of what its faces' volumes add up to has no inside to
// speak of.
constexpr double kFlatShell = 1e-9;

using Corners = std::array<Vec3, 3>;

/// Whether a plane across the axis keeps the segment and the triangle apart. However the axis is
/// rounded, its answer "yes" is right.
bool parts(const Vec3& axis, const Vec3& from, const Vec3& to, const Corners& corners) {
  const auto [low, high] = std::minmax({axis.dot(from), axis.dot(to)});
  const double a = axis.dot(corners[0]);
  const double b = axis.dot(corners[1]);
  const double c = axis.dot(corners[2]);
  const double gap = std::max(std::min({a, b, c}) - high, low - std::max({a, b, c}));
  return gap > kClear * axis.norm();
}

/// Whether the segment meets the triangle or may do so.
bool meets(const Vec3& from, const Vec3& to, const Corners& corners, const Vec3& normal) {
  if (parts(normal, from, to, corners)) {
    return false;
  }
  const Vec3 way = to - from;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3 side = corners[(k + 1) % 3] - corners[k];
    if (parts(normal.cross(side), from, to, corners) || parts(way.cross(side), from, to, corners)) {
      return false;
    }
  }
  return !parts(normal.cross(way), from, to, corners);
}

class BackCheck {
 public:
  BackCheck(const Surface& surface, const SurfaceEdges& edges, const CandidateScene& scene)
      : surface_(surface), edges_(edges), scene_(scene), hides_(surface.faces.size(), 0) {}

  /// 1 for each face whose back may hide for itself.
  std::vector<std::uint8_t> of_faces() {
    check_edges();
    check_volumes();
    check_meetings();
    std::vector<std::uint8_t> result(hides_.size());
    for (std::uint32_t f = 0; f < result.size(); ++f) {
      result[f] = hides_[edges_.shell_of_face[f]];
    }
    return result;
  }

 private:
  /// At each edge two faces must meet that run along it either way.
  void check_edges() {
    for (std::size_t e = 0; e < edges_.pairs.size(); ++e) {
      if (edges_.pairs[e] != EdgePair::Opposite) {
        hides_[shell_at(e)] = 1;
      }
    }
  }

  /// The shell must be wound outwards.
  void check_volumes() {
    std::vector<double> volume(hides_.size(), 0.0);
    std::vector<double> size(hides_.size(), 0.0);
    for (std::uint32_t f = 0; f < hides_.size(); ++f) {
      const std::uint32_t shell = edges_.shell_of_face[f];
      const double part = surface_.area_vectors[f].dot(surface_.sites[surface_.faces[f][0]]);
      volume[shell] += part;
      size[shell] += std::abs(part);
    }
    for (std::uint32_t f = 0; f < hides_.size(); ++f) {
      if (!(volume[f] > kFlatShell * size[f])) {
        hides_[f] = 1;  // also of faces that no shell is named after
      }
    }
  }

  /// No edge may meet a face of its shell.
  void check_meetings() {
    for (std::size_t e = 0; e < edges_.table.edges.size(); ++e) {
      const std::uint32_t shell = shell_at(e);
      if (hides_[shell] != 0) {
        continue;
      }
      const Vec3& from = surface_.sites[edges_.table.edges[e][0]];
      const Vec3 way = surface_.sites[edges_.table.edges[e][1]] - from;
      const double length = way.norm();
      const auto meets_own = [&](std::uint32_t f) {
        return edges_.shell_of_face[f] == shell && meets_face(e, f);
      };
      if (!(length > 0.0) || scene_.any(from, way / length, length, meets_own)) {
        hides_[shell] = 1;
      }
    }
  }

  /// Left out are faces that the edge shares a site with: where it lies in one of them, so does its
  /// other end, or it passes over an edge of that face, and a face beside it meets that.
  [[nodiscard]] bool meets_face(std::size_t edge, std::uint32_t face) const {
    const auto [a, b] = edges_.table.edges[edge];
    const Triangle& t = surface_.faces[face];
    const bool is_beside = std::any_of(
        t.begin(), t.end(), [a = a, b = b](std::uint32_t site) { return site == a || site == b; });
    return !is_beside && meets(surface_.sites[a], surface_.sites[b],
                               {surface_.sites[t[0]], surface_.sites[t[1]], surface_.sites[t[2]]},
                               surface_.area_vectors[face]);
  }

  [[nodiscard]] std::uint32_t shell_at(std::size_t edge) const {
    return edges_.shell_of_face[edges_.beside[edge][0]];
  }

  const Surface& surface_;
  const SurfaceEdges& edges_;
  const CandidateScene& scene_;
  std::vector<std::uint8_t> hides_;  // of the face that each shell is named after
};

}  // namespace

std::vector<std::uint8_t> hiding_backs(const Surface& surface, const SurfaceEdges& edges,
                                       const CandidateScene& scene) {
  return BackCheck(surface, edges, scene).of_faces();
}

}  // namespace vantage
