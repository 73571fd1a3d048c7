// SPDX-License-Identifier: MIT
#include "contraction/proxy.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "vantage/mesh/measures.h"
#include "vantage/mesh/topology.h"

#include "core/parallel.h"
#include "mesh/decimation.h"

namespace vantage {
namespace {

constexpr std::size_t kFineVerticesPerTask = 2048;
/// Stars visited at most on the way from the vertex a point was merged in to its nearest face.
constexpr int kLongestWalk = 6;

/// Barycentric coordinates of the point of triangle abc nearest to p: Ericson, "Real-Time Collision
/// Detection", 2005, section 5.1.5.
std::array<double, 3> nearest_in_triangle(const Vec3& p, const Vec3& a, const Vec3& b,
                                          const Vec3& c) {
  const Vec3 ab = b - a;
  const Vec3 ac = c - a;
  const Vec3 ap = p - a;
  const double d1 = ab.dot(ap);
  const double d2 = ac.dot(ap);
  if (d1 <= 0.0 && d2 <= 0.0) {
    return {1.0, 0.0, 0.0};
  }
  const Vec3 bp = p - b;
  const double d3 = ab.dot(bp);
  const double d4 = ac.dot(bp);
  if (d3 >= 0.0 && d4 <= d3) {
    return {0.0, 1.0, 0.0};
  }
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0) {
    const double t = d1 > d3 ? d1 / (d1 - d3) : 0.0;
    return {1.0 - t, t, 0.0};
  }
  const Vec3 cp = p - c;
  const double d5 = ab.dot(cp);
  const double d6 = ac.dot(cp);
  if (d6 >= 0.0 && d5 <= d6) {
    return {0.0, 0.0, 1.0};
  }
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0) {
    const double t = d2 > d6 ? d2 / (d2 - d6) : 0.0;
    return {1.0 - t, 0.0, t};
  }
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0.0 && d4 >= d3 && d5 >= d6) {
    const double span = (d4 - d3) + (d5 - d6);
    const double t = span > 0.0 ? (d4 - d3) / span : 0.0;
    return {0.0, 1.0 - t, t};
  }
  const double total = va + vb + vc;
  return {va / total, vb / total, vc / total};
}

/// Finds, from a coarse vertex, the nearest face by walking from star to star while it gets nearer.
class Walker {
 public:
  explicit Walker(const TriMesh& coarse) : coarse_(coarse), faces_(vertex_faces(coarse)) {}

  [[nodiscard]] CoarsePlace nearest(const Vec3& p, std::uint32_t from) const {
    CoarsePlace best;
    double least = std::numeric_limits<double>::infinity();
    for (int step = 0; step < kLongestWalk; ++step) {
      bool nearer = false;
      for (const std::uint32_t f : faces_[from]) {
        const Triangle& t = coarse_.triangles[f];
        const auto weight = nearest_in_triangle(p, coarse_.positions[t[0]], coarse_.positions[t[1]],
                                                coarse_.positions[t[2]]);
        const CoarsePlace place{f, weight};
        const double distance = (position_of(place, coarse_, coarse_.positions) - p).squaredNorm();
        if (distance < least) {
          least = distance;
          best = place;
          nearer = true;
        }
      }
      const auto& w = best.weight;
      const auto corner =
          static_cast<std::size_t>(std::max_element(w.begin(), w.end()) - w.begin());
      const std::uint32_t next = coarse_.triangles[best.face][corner];
      if (!nearer || next == from) {
        break;
      }
      from = next;
    }
    return best;
  }

 private:
  const TriMesh& coarse_;
  IndexLists faces_;
};

}  // namespace

Vec3 position_of(const CoarsePlace& place, const TriMesh& coarse,
                 const std::vector<Vec3>& positions) {
  const Triangle& t = coarse.triangles[place.face];
  return place.weight[0] * positions[t[0]] + place.weight[1] * positions[t[1]] +
         place.weight[2] * positions[t[2]];
}

std::vector<Vec3> carried(const Proxy& proxy, const std::vector<Vec3>& positions,
                          const RunContext& run) {
  std::vector<Vec3> fine(proxy.place.size());
  parallel_for(run, fine.size(), kFineVerticesPerTask, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) {
      fine[v] = position_of(proxy.place[v], proxy.mesh, positions);
    }
  });
  return fine;
}

Proxy make_proxy(const TriMesh& fine, std::size_t between, std::size_t target,
                 const RunContext& run) {
  Proxy proxy;
  TwoDecimations two = decimate_twice(fine, between, target, run);
  proxy.merged = {.vertex_count = two.between.mesh.positions.size(),
                  .triangles = std::move(two.between.mesh.triangles),
                  .of_vertex = std::move(two.between.of_vertex)};
  proxy.mesh = std::move(two.coarse.mesh);
  proxy.of_vertex = std::move(two.coarse.of_vertex);
  const Walker walker(proxy.mesh);
  proxy.place.resize(fine.positions.size());
  parallel_for(run, fine.positions.size(), kFineVerticesPerTask,
               [&](std::size_t begin, std::size_t end) {
                 for (std::size_t v = begin; v < end; ++v) {
                   proxy.place[v] = walker.nearest(fine.positions[v], proxy.of_vertex[v]);
                 }
               });
  proxy.shares = even_shares(proxy.mesh);
  return proxy;
}

}  // namespace vantage
