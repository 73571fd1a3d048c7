// SPDX-License-Identifier: MIT
#include "orientation/surface_traits.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include <Eigen/Geometry>

#include "vantage/mesh/measures.h"

#include "mesh/disjoint_sets.h"
#include "orientation/height_fields.h"

namespace vantage {
namespace {

// Parts this near to the side of the box reach it, over the longest side.
constexpr double kReach = 0.012;
// Vertices with so many faces and more are the middles of caps, the poles of spheres.
constexpr std::uint32_t kManyFaces = 8;
// Edges whose faces' normals differ by more than 20 degrees are bent.
constexpr double kBent = 0.94;

std::uint64_t edge_key(std::uint32_t a, std::uint32_t b) {
  return (static_cast<std::uint64_t>(std::min(a, b)) << 32U) | std::max(a, b);
}

struct EdgeOfFace {
  std::uint64_t key;
  std::uint32_t face;
};

/// Box sides that are square to the vector, as an index into six; 6: none.
std::size_t side_of(const Vec3& vector, double length) {
  for (std::size_t k = 0; k < 3; ++k) {
    const double along = vector[static_cast<Eigen::Index>(k)];
    if (std::abs(along) > kParallel * length) {
      return 2 * k + (along > 0.0 ? 0 : 1);
    }
  }
  return 6;
}

/// Adds one surface up.
class Measurement {
 public:
  Measurement(const TriMesh& surface, SurfaceTraits& traits) : surface_(surface), traits_(traits) {
    const std::vector<Vec3> used = referenced_points(surface);
    const Box box = bounding_box(used);
    const double longest = box.longest_side();
    low_ = box.low;
    unit_ = longest > 0.0 ? 1.0 / longest : 0.0;
    extent_ = box.size() * unit_;
  }

  void run() {
    look_at_faces();
    look_at_edges();
    look_at_poles();
    look_at_parts();
  }

 private:
  [[nodiscard]] Vec3 place(std::uint32_t vertex) const {
    return (surface_.positions[vertex] - low_) * unit_;
  }

  /// Place along an axis as a share of the box's side.
  [[nodiscard]] double share(const Vec3& at, std::size_t k) const {
    const auto i = static_cast<Eigen::Index>(k);
    return extent_[i] > 0.0 ? at[i] / extent_[i] : 0.5;
  }

  void look_at_faces() {
    std::array<double, 3> mean{};
    std::array<double, 3> square{};
    double area = 0.0;
    normals_.reserve(surface_.triangles.size());
    for (const Triangle& t : surface_.triangles) {
      const Vec3 a = place(t[0]);
      const Vec3 b = place(t[1]);
      const Vec3 c = place(t[2]);
      const Vec3 twice = (b - a).cross(c - a);
      const double part = twice.norm();
      normals_.push_back(part > 0.0 ? Vec3(twice / part) : Vec3(Vec3::Zero()));
      area += part;
      const Vec3 middle = (a + b + c) / 3.0;
      if (const std::size_t side = side_of(twice, part); side < 6) {
        traits_.side[side].facing += part;
        facing_sum_[side] += part * share(middle, side / 2);
      }
      for (std::size_t k = 0; k < 3; ++k) {
        const double at = share(middle, k);
        mean[k] += part * at;
        square[k] += part * at * at;
        traits_.side[2 * k].area_end += at > 1.0 - kEnd ? part : 0.0;
        traits_.side[2 * k + 1].area_end += at < kEnd ? part : 0.0;
      }
    }
    if (!(area > 0.0)) {
      return;
    }
    for (std::size_t s = 0; s < 6; ++s) {
      SideTraits& side = traits_.side[s];
      const double from_low = side.facing > 0.0 ? facing_sum_[s] / side.facing : 0.5;
      side.facing_place = s % 2 == 0 ? from_low : 1.0 - from_low;
      side.facing /= area;
      side.area_end /= area;
    }
    for (std::size_t k = 0; k < 3; ++k) {
      mean[k] /= area;
      traits_.axis[k].area_spread = std::sqrt(std::max(0.0, square[k] / area - mean[k] * mean[k]));
    }
  }

  void look_at_edges() {
    std::vector<EdgeOfFace> edges;
    edges.reserve(3 * surface_.triangles.size());
    for (std::uint32_t f = 0; f < surface_.triangles.size(); ++f) {
      const Triangle& t = surface_.triangles[f];
      for (std::size_t i = 0; i < 3; ++i) {
        edges.push_back({edge_key(t[i], t[(i + 1) % 3]), f});
      }
    }
    std::sort(edges.begin(), edges.end(), [](const EdgeOfFace& a, const EdgeOfFace& b) {
      return a.key < b.key || (a.key == b.key && a.face < b.face);
    });
    double bent = 0.0;
    for (std::size_t first = 0; first < edges.size();) {
      std::size_t end = first + 1;
      while (end < edges.size() && edges[end].key == edges[first].key) {
        ++end;
      }
      bent += look_at_edge(edges, first, end);
      first = end;
    }
    for (AxisTraits& axis : traits_.axis) {
      axis.edges_along = bent > 0.0 ? axis.edges_along / bent : 0.0;
    }
    traits_.open = std::log2(1.0 + traits_.open);
  }

  /// Whether two of its faces are at an angle there; of more than two either side counts as the front, as
  /// of surfaces that are there twice, and very many are taken to be.
  [[nodiscard]] bool is_bent(const std::vector<EdgeOfFace>& edges, std::size_t first,
                             std::size_t end) const {
    constexpr std::size_t kMany = 16;
    const bool is_pair = end - first == 2;
    for (std::size_t i = first; i < end; ++i) {
      for (std::size_t k = i + 1; k < end; ++k) {
        const Vec3& one = normals_[edges[i].face];
        const Vec3& other = normals_[edges[k].face];
        if (one.isZero() || other.isZero()) {
          continue;  // a face without area turns nowhere
        }
        const double cosine = one.dot(other);
        if (end - first > kMany || !((is_pair ? cosine : std::abs(cosine)) > kBent)) {
          return true;
        }
      }
    }
    return false;
  }

  /// Length of the edge if it is bent or open.
  double look_at_edge(const std::vector<EdgeOfFace>& edges, std::size_t first, std::size_t end) {
    const bool is_open = end == first + 1;
    if (!is_open && !is_bent(edges, first, end)) {
      return 0.0;
    }
    const Vec3 from = place(static_cast<std::uint32_t>(edges[first].key >> 32U));
    const Vec3 to = place(static_cast<std::uint32_t>(edges[first].key & 0xFFFFFFFFU));
    const double length = (to - from).norm();
    if (const std::size_t side = side_of(to - from, length); side < 6) {
      traits_.axis[side / 2].edges_along += length;
    }
    if (is_open) {
      traits_.open += length;
      for (std::size_t k = 0; k < 3; ++k) {
        const double at = share(0.5 * (from + to), k);
        traits_.side[2 * k].open_end += at > 1.0 - kEnd ? length : 0.0;
        traits_.side[2 * k + 1].open_end += at < kEnd ? length : 0.0;
      }
    }
    return length;
  }

  void look_at_poles() {
    std::vector<std::uint32_t> faces(surface_.positions.size(), 0);
    std::vector<Vec3> sum(surface_.positions.size(), Vec3::Zero());
    for (std::size_t f = 0; f < surface_.triangles.size(); ++f) {
      for (const std::uint32_t v : surface_.triangles[f]) {
        ++faces[v];
        sum[v] += normals_[f];
      }
    }
    double count = 0.0;
    for (std::size_t v = 0; v < faces.size(); ++v) {
      if (faces[v] >= kManyFaces) {
        count += 1.0;
        if (const std::size_t side = side_of(sum[v], sum[v].norm()); side < 6) {
          traits_.side[side].poles += 1.0;
        }
      }
    }
    for (SideTraits& side : traits_.side) {
      side.poles = count > 0.0 ? side.poles / count : 0.0;
    }
  }

  void look_at_parts() {
    DisjointSets parts(surface_.positions.size());
    for (const Triangle& t : surface_.triangles) {
      parts.join(t[0], t[1]);
      parts.join(t[0], t[2]);
    }
    std::vector<std::uint8_t> is_used(surface_.positions.size(), 0);
    for (const Triangle& t : surface_.triangles) {
      for (const std::uint32_t v : t) {
        is_used[v] = 1;
      }
    }
    std::vector<Box> boxes(surface_.positions.size());
    std::vector<std::uint32_t> roots;
    for (std::uint32_t v = 0; v < is_used.size(); ++v) {
      if (is_used[v] == 0) {
        continue;
      }
      const std::uint32_t root = parts.root(v);  // the part's smallest vertex: it comes first
      if (root == v) {
        roots.push_back(v);
        boxes[v].low = boxes[v].high = place(v);
      } else {
        boxes[root].low = boxes[root].low.cwiseMin(place(v));
        boxes[root].high = boxes[root].high.cwiseMax(place(v));
      }
    }
    const double one = roots.empty() ? 0.0 : 1.0 / static_cast<double>(roots.size());
    traits_.parts = std::log2(std::max(1.0, static_cast<double>(roots.size())));
    for (std::size_t k = 0; k < 3; ++k) {
      const auto i = static_cast<Eigen::Index>(k);
      traits_.axis[k].parts_mean = 0.0;
      for (const std::uint32_t root : roots) {
        const Box& box = boxes[root];
        traits_.axis[k].parts_mean += one * share(0.5 * (box.low + box.high), k);
        traits_.side[2 * k].parts_end += box.high[i] > extent_[i] - kReach ? one : 0.0;
        traits_.side[2 * k + 1].parts_end += box.low[i] < kReach ? one : 0.0;
      }
    }
  }

  const TriMesh& surface_;
  SurfaceTraits& traits_;
  Vec3 low_ = Vec3::Zero();
  Vec3 extent_ = Vec3::Zero();
  double unit_ = 0.0;
  std::vector<Vec3> normals_{};
  std::array<double, 6> facing_sum_{};
};

}  // namespace

SurfaceTraits::SurfaceTraits(const TriMesh& surface) {
  Measurement(surface, *this).run();
}

}  // namespace vantage
