// SPDX-License-Identifier: MIT
#include "mesh/copied_faces.h"

#include <algorithm>
#include <array>
#include <bit>
#include <utility>

#include "vantage/mesh/topology.h"

#include "mesh/place_hash.h"
#include "mesh/triangle_corners.h"

namespace vantage {
namespace {

std::vector<std::uint64_t> hashes_of_places(const std::vector<Vec3>& positions) {
  std::vector<std::uint64_t> hashes(positions.size());
  std::transform(positions.begin(), positions.end(), hashes.begin(), place_hash);
  return hashes;
}

/// The faces of one place after the other, ascending: corners in order, then the face.
std::vector<std::array<std::uint32_t, 4>> faces_by_place(const TriMesh& mesh) {
  std::vector<std::array<std::uint32_t, 4>> faces;
  faces.reserve(mesh.triangles.size());
  for (std::uint32_t f = 0; f < mesh.triangles.size(); ++f) {
    Triangle corners = mesh.triangles[f];
    std::sort(corners.begin(), corners.end());
    faces.push_back({corners[0], corners[1], corners[2], f});
  }
  std::sort(faces.begin(), faces.end());
  return faces;
}

/// Which faces are copies of earlier ones, and what they are to their components.
class Copies {
 public:
  explicit Copies(const TriMesh& mesh)
      : mesh_(mesh),
        components_(connected_components(mesh)),
        of_component_(components_.count),
        is_copy_(mesh.triangles.size(), false) {
    look_at_places();
    look_at_edges();
  }

  [[nodiscard]] bool is_left_out(std::uint32_t f) const {
    const OfComponent& all = of_component_[component_of(f)];
    return is_copy_[f] && !(all.has_one_side && !all.open_with && all.open_without);
  }

 private:
  struct OfComponent {
    bool has_one_side = false;  // at a place more faces run one way than the other
    bool open_with = false;     // so they do at an edge, copies or not
    bool open_without = false;  // and without the copies
  };

  [[nodiscard]] std::uint32_t component_of(std::uint32_t f) const {
    return components_.of_vertex[mesh_.triangles[f][0]];
  }

  /// Which way a face runs along one of its edges.
  [[nodiscard]] int sense(std::uint32_t f, std::uint32_t a, std::uint32_t b) const {
    return runs_from(mesh_.triangles[f], a, b) ? 1 : -1;
  }

  void look_at_places() {
    const std::vector<std::array<std::uint32_t, 4>> faces = faces_by_place(mesh_);
    for (std::size_t i = 0; i < faces.size();) {
      const auto [a, b, c, first] = faces[i];
      int sum = sense(first, a, b);
      for (++i; i < faces.size() && faces[i][0] == a && faces[i][1] == b && faces[i][2] == c; ++i) {
        is_copy_[faces[i][3]] = true;
        sum += sense(faces[i][3], a, b);
      }
      OfComponent& all = of_component_[component_of(first)];
      all.has_one_side = all.has_one_side || sum != 0;
    }
  }

  void look_at_edges() {
    const EdgeTable table = build_edge_table(mesh_);
    for (std::size_t e = 0; e < table.edges.size(); ++e) {
      int with = 0;
      int without = 0;
      for (const std::uint32_t f : table.faces_of_edge[e]) {
        const int of_face = sense(f, table.edges[e][0], table.edges[e][1]);
        with += of_face;
        without += is_copy_[f] ? 0 : of_face;
      }
      OfComponent& all = of_component_[components_.of_vertex[table.edges[e][0]]];
      all.open_with = all.open_with || with != 0;
      all.open_without = all.open_without || without != 0;
    }
  }

  const TriMesh& mesh_;
  Components components_;
  std::vector<OfComponent> of_component_;
  std::vector<bool> is_copy_;
};

}  // namespace

std::vector<std::uint32_t> faces_beyond_copies(const TriMesh& mesh) {
  const std::vector<std::uint64_t> hashes = hashes_of_places(mesh.positions);
  const auto key = [&](std::size_t f) {
    const Triangle& t = mesh.triangles[f];
    return hashes[t[0]] + hashes[t[1]] + hashes[t[2]];
  };
  // Eight faces of different places in a counter in the mean: more than kMostCopies are copies.
  const std::size_t faces = mesh.triangles.size();
  std::vector<std::uint32_t> counts(std::bit_ceil(faces / 8 + 1), 0);
  const std::size_t mask = counts.size() - 1;
  for (std::size_t f = 0; f < faces; ++f) {
    ++counts[key(f) & mask];
  }
  std::vector<std::pair<std::uint64_t, std::uint32_t>> suspects;
  for (std::size_t f = 0; f < faces; ++f) {
    if (counts[key(f) & mask] > kMostCopies) {
      suspects.emplace_back(key(f), static_cast<std::uint32_t>(f));
    }
  }
  std::sort(suspects.begin(), suspects.end());
  std::vector<std::uint32_t> beyond;
  for (std::size_t i = kMostCopies; i < suspects.size(); ++i) {
    if (suspects[i].first == suspects[i - kMostCopies].first) {
      beyond.push_back(suspects[i].second);
    }
  }
  std::sort(beyond.begin(), beyond.end());
  return beyond;
}

std::size_t leave_out_copies(TriMesh& mesh) {
  const Copies copies(mesh);
  std::vector<Triangle> kept;
  for (std::uint32_t f = 0; f < mesh.triangles.size(); ++f) {
    if (!copies.is_left_out(f)) {
      kept.push_back(mesh.triangles[f]);
    }
  }
  mesh.triangles.swap(kept);
  return kept.size() - mesh.triangles.size();
}

}  // namespace vantage
