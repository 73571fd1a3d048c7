// SPDX-License-Identifier: MIT
#include "contraction/hole_filling.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <numeric>
#include <optional>
#include <queue>
#include <span>
#include <tuple>

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

/// Triangles across a rim. Always that corner is cut off whose neighbours are nearest to each other, so that the hole
/// gets narrower from all sides. Empty if an edge would get a third face.
std::vector<Triangle> triangles_across(const Rim& rim, std::span<const Vec3> positions,
                                       const EdgeTable& table) {
  using Cut = std::tuple<double, std::uint32_t, std::uint32_t, std::uint32_t>;  // length, corners
  const auto size = static_cast<std::uint32_t>(rim.size());
  std::vector<std::uint32_t> before(size);
  std::vector<std::uint32_t> after(size);
  std::priority_queue<Cut, std::vector<Cut>, std::greater<>> cuts;
  const auto offer = [&](std::uint32_t corner) {
    const std::uint32_t a = before[corner];
    const std::uint32_t b = after[corner];
    const auto [low, high] = std::minmax(rim[a], rim[b]);
    if (!std::binary_search(table.edges.begin(), table.edges.end(), std::array{low, high})) {
      cuts.emplace((positions[rim[a]] - positions[rim[b]]).squaredNorm(), a, corner, b);
    }
  };
  for (std::uint32_t i = 0; i < size; ++i) {
    before[i] = (i + size - 1) % size;
    after[i] = (i + 1) % size;
  }
  for (std::uint32_t i = 0; i < size; ++i) {
    offer(i);
  }
  std::vector<Triangle> triangles;
  std::vector<std::uint8_t> is_cut(size, 0);
  std::uint32_t last = 0;
  while (triangles.size() + 3 < size) {
    if (cuts.empty()) {
      return {};
    }
    const auto [length, a, corner, b] = cuts.top();
    cuts.pop();
    if (is_cut[corner] == 0 && before[corner] == a && after[corner] == b) {
      triangles.push_back({rim[a], rim[corner], rim[b]});
      is_cut[corner] = 1;
      after[a] = b;
      before[b] = a;
      offer(a);
      offer(b);
      last = a;
    }
  }
  triangles.push_back({rim[before[last]], rim[last], rim[after[last]]});
  return triangles;
}

double area_of(std::span<const Vec3> x, const Triangle& t) {
  return 0.5 * (x[t[1]] - x[t[0]]).cross(x[t[2]] - x[t[0]]).norm();
}

}  // namespace

std::vector<Triangle> fill_holes(const TriMesh& mesh) {
  const EdgeTable table = build_edge_table(mesh);
  const Rims rims = RimWalk(mesh, table).rims();
  if (rims.closed.empty()) {
    return {};
  }
  const Components components = connected_components(mesh);
  // Areas of a very small or large model would be no numbers.
  const std::vector<Vec3> positions = unit_frame(mesh.positions).to_frame(mesh.positions);
  std::vector<double> left(components.count, 0.0);  // the area that holes may still have
  for (const Triangle& t : mesh.triangles) {
    left[components.of_vertex[t[0]]] += kMostOfTheArea * area_of(positions, t);
  }
  for (const std::uint32_t v : rims.torn) {
    left[components.of_vertex[v]] = -1.0;
  }
  std::vector<Triangle> triangles;
  for (const Rim& rim : rims.closed) {
    double& of_component = left[components.of_vertex[rim[0]]];
    if (of_component < 0.0) {
      continue;
    }
    const std::vector<Triangle> across = triangles_across(rim, positions, table);
    if (across.empty()) {
      of_component = -1.0;
    }
    for (const Triangle& t : across) {
      of_component -= area_of(positions, t);
      triangles.push_back(t);
    }
  }
  std::erase_if(triangles,
                [&](const Triangle& t) { return left[components.of_vertex[t[0]]] < 0.0; });
  return triangles;
}

}  // namespace vantage
