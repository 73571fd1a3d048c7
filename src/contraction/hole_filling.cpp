// SPDX-License-Identifier: MIT
#include "contraction/hole_filling.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <numeric>
#include <optional>
#include <span>

#include <Eigen/Geometry>

#include "vantage/mesh/topology.h"

#include "mesh/triangle_corners.h"
#include "spatial/ray_scene.h"

namespace vantage {
namespace {

/// What the holes of a component may add to its area, at most [ours].
constexpr double kMostOfTheArea = 0.1;

constexpr std::uint32_t kNone = ~std::uint32_t{0};

/// The vertices around a hole, in the order in which a face in it would run; none twice.
using Rim = std::vector<std::uint32_t>;

/// Those of all holes.
struct Rims {
  std::vector<Rim> closed{};
  std::vector<std::uint32_t>
      torn{};  ///< A vertex of each that does not come back to where it began.
};

/// Walks along the sides of holes: edges of one face, against the way in which it runs.
class RimWalk {
 public:
  RimWalk(const TriMesh& mesh, const EdgeTable& table)
      : next_(mesh.positions.size() + 1, 0), place_(mesh.positions.size(), kNone) {
    for (std::size_t e = 0; e < table.edges.size(); ++e) {
      if (const auto faces = table.faces_of_edge[e]; faces.size() == 1) {
        const auto [a, b] = table.edges[e];
        sides_.push_back(runs_from(mesh.triangles[faces[0]], a, b) ? Side{b, a} : Side{a, b});
      }
    }
    std::sort(sides_.begin(), sides_.end());
    for (const Side& side : sides_) {
      ++next_[side[0] + 1];
    }
    std::partial_sum(next_.begin(), next_.end(), next_.begin());
  }

  [[nodiscard]] Rims rims() {
    Rims rims;
    for (const Side& side : std::vector<Side>(sides_)) {
      while (walk_from(side[0], rims)) {
      }
    }
    return rims;
  }

 private:
  using Side = std::array<std::uint32_t, 2>;

  /// Where a side that begins at the vertex ends; each is taken once.
  std::optional<std::uint32_t> take_side(std::uint32_t from) {
    std::uint32_t& next = next_[from];
    return next < sides_.size() && sides_[next][0] == from ? std::optional(sides_[next++][1])
                                                           : std::nullopt;
  }

  /// What a walk passes twice it leaves behind as a rim: where holes touch, each has its own.
  /// \return whether a side was left to begin with.
  bool walk_from(std::uint32_t first, Rims& rims) {
    std::optional<std::uint32_t> next = take_side(first);
    if (!next) {
      return false;
    }
    Rim walk{first};
    place_[first] = 0;
    for (; next; next = take_side(walk.back())) {
      if (place_[*next] == kNone) {
        place_[*next] = static_cast<std::uint32_t>(walk.size());
        walk.push_back(*next);
        continue;
      }
      const auto begin = walk.begin() + place_[*next];
      rims.closed.emplace_back(begin, walk.end());
      std::for_each(begin + 1, walk.end(), [&](std::uint32_t v) { place_[v] = kNone; });
      walk.erase(begin + 1, walk.end());
    }
    if (walk.size() > 1) {
      rims.torn.push_back(first);
    }
    for (const std::uint32_t v : walk) {
      place_[v] = kNone;
    }
    return true;
  }

  std::vector<Side> sides_{};         // by the vertex that they begin at
  std::vector<std::uint32_t> next_;   // of each vertex: the side to take next
  std::vector<std::uint32_t> place_;  // of each vertex in the walk, or kNone
};

Vec3 middle_of(std::span<const Vec3> positions, const Rim& rim) {
  Vec3 sum = Vec3::Zero();
  for (const std::uint32_t v : rim) {
    sum += positions[v];
  }
  return sum / static_cast<double>(rim.size());
}

/// Of the triangles around the middle.
double area_in(std::span<const Vec3> positions, const Rim& rim) {
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
void close(const Rim& rim, TriMesh& mesh) {
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

}  // namespace

std::size_t fill_holes(TriMesh& mesh) {
  const Rims rims = RimWalk(mesh, build_edge_table(mesh)).rims();
  if (rims.closed.empty()) {
    return 0;
  }
  const Components components = connected_components(mesh);
  // Areas of a very small or large model would be no numbers.
  const std::vector<Vec3> positions = unit_frame(mesh.positions).to_frame(mesh.positions);
  std::vector<double> left(components.count, 0.0);  // the area that holes may still have
  for (const Triangle& t : mesh.triangles) {
    const Vec3 sides = (positions[t[1]] - positions[t[0]]).cross(positions[t[2]] - positions[t[0]]);
    left[components.of_vertex[t[0]]] += kMostOfTheArea * 0.5 * sides.norm();
  }
  for (const std::uint32_t v : rims.torn) {
    left[components.of_vertex[v]] = -1.0;
  }
  for (const Rim& rim : rims.closed) {
    left[components.of_vertex[rim[0]]] -= area_in(positions, rim);
  }
  std::size_t count = 0;
  for (const Rim& rim : rims.closed) {
    if (left[components.of_vertex[rim[0]]] >= 0.0) {
      close(rim, mesh);
      ++count;
    }
  }
  return count;
}

}  // namespace vantage
