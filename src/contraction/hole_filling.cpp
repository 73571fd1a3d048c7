// SPDX-License-Identifier: MIT
#include "contraction/hole_filling.h"

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <span>
#include <vector>

#include <Eigen/Geometry>

#include "vantage/mesh/topology.h"

#include "contraction/hole_sides.h"
#include "mesh/disjoint_sets.h"
#include "spatial/ray_scene.h"

namespace vantage {
namespace {

/// What the holes of a part may add to its area, at most [ours].
constexpr double kMostOfTheArea = 0.1;

constexpr std::uint32_t kNone = ~std::uint32_t{0};

/// The vertices around a hole, in the order in which a face in it would run; none twice.
struct Rim {
  std::vector<std::uint32_t> vertices{};
  std::uint32_t face = 0;  ///< One at it.
};

/// Those of all holes.
struct Rims {
  std::vector<Rim> closed{};
  std::vector<std::uint32_t> torn{};  ///< A face at each that does not come back to where it began.
};

/// Walks along the sides of holes.
class RimWalk {
 public:
  RimWalk(const TriMesh& mesh, const EdgeTable& table)
      : sides_(hole_sides(mesh, table)),
        next_(mesh.positions.size() + 1, 0),
        place_(mesh.positions.size(), kNone) {
    for (const HoleSide& side : sides_) {
      ++next_[side.from + 1];
    }
    std::partial_sum(next_.begin(), next_.end(), next_.begin());
  }

  [[nodiscard]] Rims rims() {
    Rims rims;
    for (const HoleSide& side : sides_) {
      while (walk_from(side.from, rims)) {
      }
    }
    return rims;
  }

 private:
  /// A side that begins at the vertex, each once; null if none is left.
  const HoleSide* take_side(std::uint32_t from) {
    std::uint32_t& next = next_[from];
    return next < sides_.size() && sides_[next].from == from ? &sides_[next++] : nullptr;
  }

  /// What a walk passes twice it leaves behind as a rim: where holes touch, each has its own.
  /// \return whether a side was left to begin with.
  bool walk_from(std::uint32_t first, Rims& rims) {
    const HoleSide* side = take_side(first);
    if (side == nullptr) {
      return false;
    }
    const std::uint32_t first_face = side->face;
    std::vector<std::uint32_t> walk{first};
    place_[first] = 0;
    for (; side != nullptr; side = take_side(walk.back())) {
      std::uint32_t& place = place_[side->to];
      if (place == kNone) {
        place = static_cast<std::uint32_t>(walk.size());
        walk.push_back(side->to);
        continue;
      }
      const auto begin = walk.begin() + place;
      rims.closed.push_back({{begin, walk.end()}, side->face});
      std::for_each(begin + 1, walk.end(), [&](std::uint32_t v) { place_[v] = kNone; });
      walk.erase(begin + 1, walk.end());
    }
    if (walk.size() > 1) {
      rims.torn.push_back(first_face);
    }
    for (const std::uint32_t v : walk) {
      place_[v] = kNone;
    }
    return true;
  }

  std::vector<HoleSide> sides_;
  std::vector<std::uint32_t> next_;   // of each vertex: the side to take next
  std::vector<std::uint32_t> place_;  // of each vertex in the walk, or kNone
};

Vec3 middle_of(std::span<const Vec3> positions, const std::vector<std::uint32_t>& rim) {
  Vec3 sum = Vec3::Zero();
  for (const std::uint32_t v : rim) {
    sum += positions[v];
  }
  return sum / static_cast<double>(rim.size());
}

/// Of the triangles around the middle.
double area_in(std::span<const Vec3> positions, const std::vector<std::uint32_t>& rim) {
  const Vec3 middle = middle_of(positions, rim);
  double area = 0.0;
  for (std::size_t i = 0; i < rim.size(); ++i) {
    area +=
        0.5 *
        (positions[rim[i]] - middle).cross(positions[rim[(i + 1) % rim.size()]] - middle).norm();
  }
  return area;
}

/// One triangle if it has three sides, else as many as it has.
void close(const std::vector<std::uint32_t>& rim, TriMesh& mesh) {
  if (rim.size() == 3) {
    mesh.triangles.push_back({rim[0], rim[1], rim[2]});
    return;
  }
  const auto middle = static_cast<std::uint32_t>(mesh.positions.size());
  mesh.positions.push_back(middle_of(mesh.positions, rim));
  for (std::size_t i = 0; i < rim.size(); ++i) {
    mesh.triangles.push_back({rim[i], rim[(i + 1) % rim.size()], middle});
  }
}

/// Groups of faces that hang together over edges.
DisjointSets parts_of(const TriMesh& mesh, const EdgeTable& table) {
  DisjointSets parts(mesh.triangles.size());
  for (std::size_t e = 0; e < table.edges.size(); ++e) {
    for (const std::uint32_t face : table.faces_of_edge[e]) {
      parts.join(table.faces_of_edge[e][0], face);
    }
  }
  return parts;
}

}  // namespace

std::size_t fill_holes(TriMesh& mesh) {
  const EdgeTable table = build_edge_table(mesh);
  const Rims rims = RimWalk(mesh, table).rims();
  if (rims.closed.empty()) {
    return 0;
  }
  DisjointSets parts = parts_of(mesh, table);
  // The square of an area of a very small or large model has no double.
  const std::vector<Vec3> positions = unit_frame(mesh.positions).to_frame(mesh.positions);
  // Of the part with this first face: the area that its holes may still have.
  std::vector<double> left(mesh.triangles.size(), 0.0);
  for (std::uint32_t f = 0; f < mesh.triangles.size(); ++f) {
    const auto& [a, b, c] = mesh.triangles[f];
    const Vec3 sides = (positions[b] - positions[a]).cross(positions[c] - positions[a]);
    left[parts.root(f)] += kMostOfTheArea * 0.5 * sides.norm();
  }
  for (const std::uint32_t face : rims.torn) {
    left[parts.root(face)] = -1.0;
  }
  for (const Rim& rim : rims.closed) {
    left[parts.root(rim.face)] -= area_in(positions, rim.vertices);
  }
  std::size_t count = 0;
  for (const Rim& rim : rims.closed) {
    if (left[parts.root(rim.face)] >= 0.0) {
      close(rim.vertices, mesh);
      ++count;
    }
  }
  return count;
}

}  // namespace vantage
