// SPDX-License-Identifier: MIT
#include "spatial/face_meetings.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <utility>

#include <Eigen/Geometry>

#include "vantage/mesh/measures.h"
#include "vantage/mesh/tri_mesh.h"

#include "spatial/close_faces.h"
#include "spatial/winding_number.h"

namespace vantage {
namespace {

// What is no farther apart than this, in units of a UnitFrame, may meet: thousands of roundings of
// its coordinates.
constexpr double kClear = 0x1p-40;
// A shell whose volume is below this share of what its faces' volumes add up to has no inside to
// speak of.
constexpr double kFlatPart = 1e-9;

// Steps a face that the search for faces near each other may take; a fine mesh takes thirty.
constexpr std::size_t kStepsPerFace = 100;

// Patches looked at of a shell that meets itself, at most: each takes a walk over its faces. [ours]
constexpr std::size_t kMostPatches = 16;

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
  BackCheck(const TriMesh& mesh, const SurfaceEdges& edges)
      : mesh_(mesh),
        edges_(edges),
        hides_(mesh.triangles.size(), 0),
        meets_itself_(mesh.triangles.size(), 0),
        crossed_(mesh.triangles.size(), 0) {
    for (const Triangle& face : mesh.triangles) {
      normals_.push_back(area_vector(mesh, face));
    }
  }

  FaceMeetings of_faces() {
    check_edges();
    check_volumes();
    check_meetings();
    std::vector<std::uint8_t> back_faces(hides_.size());
    // The faces of each shell that meets itself.
    std::map<std::uint32_t, std::vector<std::uint32_t>> crossing;
    for (std::uint32_t f = 0; f < back_faces.size(); ++f) {
      const std::uint32_t shell = edges_.shell_of_face[f];
      back_faces[f] = hides_[shell] | meets_itself_[shell];
      if (meets_itself_[shell] != 0 && hides_[shell] == 0) {
        crossing[shell].push_back(f);
      }
    }
    std::vector<std::uint8_t> is_done(crossed_);
    for (const auto& [name, shell] : crossing) {
      clear_patches(shell, is_done, back_faces);
    }
    return {std::move(back_faces), std::move(crossed_)};
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
      const double part = normals_[f].dot(mesh_.positions[mesh_.triangles[f][0]]);
      volume[shell] += part;
      size[shell] += std::abs(part);
    }
    for (std::uint32_t f = 0; f < hides_.size(); ++f) {
      if (!(volume[f] > kFlatPart * size[f])) {
        hides_[f] = 1;  // also of faces that no shell is named after
      }
    }
  }

  /// Faces of a shell must not meet.
  void check_meetings() {
    const auto meet = [&](std::uint32_t f, std::uint32_t g) {
      if (!share_edge(f, g) && (has_edge_in(f, g) || has_edge_in(g, f))) {
        crossed_[f] = crossed_[g] = 1;
        if (edges_.shell_of_face[f] == edges_.shell_of_face[g]) {
          meets_itself_[edges_.shell_of_face[f]] = 1;
        }
      }
    };
    if (!for_each_close_pair(mesh_, kStepsPerFace * mesh_.triangles.size(), meet)) {
      std::fill(hides_.begin(), hides_.end(), 1);
      std::fill(crossed_.begin(), crossed_.end(), 1);
    }
  }

  /// Sets to 0 the faces outside of which a shell has no negative winding number. It is the same all over
  /// a patch, whose faces edges hold together and no other face crosses.
  void clear_patches(const std::vector<std::uint32_t>& shell, std::vector<std::uint8_t>& is_done,
                     std::vector<std::uint8_t>& back_faces) const {
    for (const std::uint32_t first : shell) {
      if (is_done[first] != 0) {
        continue;
      }
      const std::vector<std::uint32_t> patch = patch_of(first, is_done);
      if (kMostPatches * patch.size() > shell.size() && winds_forwards(patch, shell)) {
        for (const std::uint32_t f : patch) {
          back_faces[f] = 0;
        }
      }
    }
  }

  /// The faces that can be reached from one over edges, none of them done; they are then.
  [[nodiscard]] std::vector<std::uint32_t> patch_of(std::uint32_t first,
                                                    std::vector<std::uint8_t>& is_done) const {
    std::vector<std::uint32_t> patch{first};
    is_done[first] = 1;
    for (std::size_t next = 0; next < patch.size(); ++next) {
      for (const std::uint32_t edge : edges_.of_face[patch[next]]) {
        for (const std::uint32_t f : edges_.beside[edge]) {
          if (is_done[f] == 0) {
            is_done[f] = 1;
            patch.push_back(f);
          }
        }
      }
    }
    return patch;
  }

  /// Whether the shell's winding number outside of the patch is 0 or more, beyond doubt.
  [[nodiscard]] bool winds_forwards(const std::vector<std::uint32_t>& patch,
                                    std::vector<std::uint32_t> shell) const {
    const std::uint32_t largest =
        *std::max_element(patch.begin(), patch.end(), [&](std::uint32_t f, std::uint32_t g) {
          return normals_[f].squaredNorm() < normals_[g].squaredNorm();
        });
    std::erase(shell, largest);
    const auto& [a, b, c] = mesh_.triangles[largest];
    const Vec3 middle = (mesh_.positions[a] + mesh_.positions[b] + mesh_.positions[c]) / 3.0;
    constexpr double kDoubt = 0.1;
    const double outside = winding_number(mesh_, shell, middle) - 0.5;
    return outside > -0.5 && std::abs(outside - std::round(outside)) < kDoubt;
  }

  /// Whether every edge of either face shares a sample with the other.
  [[nodiscard]] bool share_edge(std::uint32_t f, std::uint32_t g) const {
    const auto& [a, b, c] = mesh_.triangles[f];
    int shared = 0;
    for (const std::uint32_t sample : mesh_.triangles[g]) {
      shared += static_cast<int>(sample == a) + static_cast<int>(sample == b) +
                static_cast<int>(sample == c);
    }
    return shared >= 2;
  }

  /// Whether one of the face's edges meets another face. Left out are edges that share a sample with the other face: where one lies
  /// in it, so does its other end, or it passes over an edge of that face, and a face beside it meets
  /// that.
  [[nodiscard]] bool has_edge_in(std::uint32_t of, std::uint32_t face) const {
    const Triangle& own = mesh_.triangles[of];
    const Triangle& other = mesh_.triangles[face];
    const auto is_shared = [&](std::uint32_t sample) {
      return sample == other[0] || sample == other[1] || sample == other[2];
    };
    const std::array<bool, 3> shared{is_shared(own[0]), is_shared(own[1]), is_shared(own[2])};
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t next = (k + 1) % 3;
      if (!shared[k] && !shared[next] &&
          meets(mesh_.positions[own[k]], mesh_.positions[own[next]],
                {mesh_.positions[other[0]], mesh_.positions[other[1]], mesh_.positions[other[2]]},
                normals_[face])) {
        return true;
      }
    }
    return false;
  }

  [[nodiscard]] std::uint32_t shell_at(std::size_t edge) const {
    return edges_.shell_of_face[edges_.beside[edge][0]];
  }

  const TriMesh& mesh_;
  const SurfaceEdges& edges_;
  std::vector<Vec3> normals_{};  // of each face, of twice its area
  // Of the face that each shell is named after: whether it is open, wound inwards or too crowded to
  // tell; whether it meets itself.
  std::vector<std::uint8_t> hides_, meets_itself_;
  std::vector<std::uint8_t> crossed_;  // of each face
};

}  // namespace

FaceMeetings find_meetings(const TriMesh& mesh, const SurfaceEdges& edges) {
  return BackCheck(mesh, edges).of_faces();
}

}  // namespace vantage
