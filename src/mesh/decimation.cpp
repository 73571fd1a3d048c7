// SPDX-License-Identifier: MIT
#include "mesh/decimation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <span>
#include <tuple>
#include <utility>

#include "vantage/mesh/measures.h"
#include "vantage/mesh/topology.h"

#include "core/parallel.h"
#include "mesh/place_order.h"
#include "mesh/quadric.h"

namespace vantage {
namespace {

/// Share of the squared edge length in the cost, against the squared distance to the planes [ours:
/// even triangles contract like the fine surface; docs/contraction.md has the trials].
constexpr double kEvenness = 0.05;
/// Weight of the plane through a border edge, upright on its face, against that of the face.
constexpr double kBorder = 1.0;
/// A face may turn by at most the angle of this cosine in one collapse [ours: 78°].
constexpr double kLargestTurn = 0.2;
/// Share of the edges, the cheapest ones, that one pass may collapse [ours].
constexpr double kPassShare = 0.4;
/// A pass that removes less than this share of the vertices ends the decimation: what is left must
/// not collapse, and more passes would only crawl.
constexpr double kLeastProgress = 1e-3;
constexpr std::size_t kAhead = 8;     // edges that memory is asked about what a collapse needs
constexpr std::size_t kGrain = 4096;  // edges or vertices a task

/// An edge that may go, and where its vertex would stand.
struct Candidate {
  float cost = 0.0F;
  std::uint32_t a = 0;
  std::uint32_t b = 0;
};

/// Cost and place of a collapse by quadric error.
class ByQuadric {
 public:
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
    const EdgeTable table = build_edge_table(mesh);
    for (std::size_t e = 0; e < table.edges.size(); ++e) {
      if (table.faces_of_edge[e].size() == 1) {
        add_border(table.edges[e], mesh.triangles[table.faces_of_edge[e][0]], mesh);
      }
    }
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

Fans fans_of(const TriMesh& mesh) {
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

template <class Policy>
class Decimator {
 public:
  Decimator(const TriMesh& fine, Policy policy, const RunContext& run)
      : run_(run),
        mesh_(fine),
        policy_(std::move(policy)),
        order_(fine.positions),
        of_fine_(fine.positions.size()),
        live_(fine.positions.size()),
        faces_a_(fine.positions.size(), 0),
        faces_b_(fine.positions.size(), 0) {
    std::iota(of_fine_.begin(), of_fine_.end(), 0U);
  }

  /// Collapses until `target` vertices are left, no edge that may go costs less than `limit`, or, between two passes,
  /// at most `rest` are left.
  void reduce_to(std::size_t target, double limit, std::size_t rest = 0) {
    while (live_ > std::max(target, rest)) {
      run_.check();
      const std::size_t before = live_;
      pass(target, limit);
      if (static_cast<double>(before - live_) < kLeastProgress * static_cast<double>(before)) {
        break;
      }
    }
  }

  [[nodiscard]] Decimation result() const { return {.mesh = mesh_, .of_vertex = of_fine_}; }

 private:
  /// A vertex as it stands within a pass: ends of collapsed edges move at most once.
  [[nodiscard]] std::uint32_t now(std::uint32_t v) const { return parent_[v]; }

  static void keep_cheapest(std::vector<Candidate>& edges, double share) {
    const auto wanted = static_cast<std::size_t>(share * static_cast<double>(edges.size()));
    if (wanted == 0 || wanted >= edges.size()) {
      return;
    }
    std::vector<float> costs;
    costs.reserve(edges.size());
    for (const Candidate& edge : edges) {
      costs.push_back(edge.cost);
    }
    const auto last = costs.begin() + static_cast<std::ptrdiff_t>(wanted - 1);
    std::nth_element(costs.begin(), last, costs.end());
    std::erase_if(edges, [most = *last](const Candidate& edge) { return edge.cost > most; });
  }

  /// The cheapest edges, those of at most this cost, in order.
  std::vector<Candidate> cheapest_edges(double limit) {
    std::vector<Candidate> edges;
    edges.reserve(3 * mesh_.triangles.size() / 2 + 16);
    for (std::size_t v = 0; v < mesh_.positions.size(); ++v) {
      const std::size_t first = edges.size();
      for (const Fans::Corners& corners : fans_[v]) {
        for (const std::uint32_t u : corners) {
          if (u > v) {
            edges.push_back({0.0F, static_cast<std::uint32_t>(v), u});
          }
        }
      }
      const auto begin = edges.begin() + static_cast<std::ptrdiff_t>(first);
      std::sort(begin, edges.end(), [](const auto& x, const auto& y) { return x.b < y.b; });
      edges.erase(
          std::unique(begin, edges.end(), [](const auto& x, const auto& y) { return x.b == y.b; }),
          edges.end());
    }
    parallel_for(run_, edges.size(), kGrain, [&](std::size_t begin, std::size_t end) {
      for (std::size_t e = begin; e < end; ++e) {
        edges[e].cost = static_cast<float>(policy_.cost(edges[e].a, edges[e].b, mesh_.positions));
      }
    });
    std::erase_if(edges, [&](const Candidate& edge) { return !(edge.cost < limit); });
    keep_cheapest(edges, kPassShare);
    std::sort(edges.begin(), edges.end(), [this](const Candidate& x, const Candidate& y) {
      if (x.cost != y.cost) {
        return x.cost < y.cost;
      }
      const std::uint32_t x_place = place_of(x);
      const std::uint32_t y_place = place_of(y);
      return std::tie(x_place, x.a, x.b) < std::tie(y_place, y.a, y.b);
    });
    return edges;
  }

  [[nodiscard]] std::uint32_t place_of(const Candidate& edge) const {
    return order_.place(mesh_.positions[edge.a], mesh_.positions[edge.b]);
  }

  void pass(std::size_t target, double limit) {
    fans_ = fans_of(mesh_);
    parent_.resize(mesh_.positions.size());
    std::iota(parent_.begin(), parent_.end(), 0U);
    const std::vector<Candidate> edges = cheapest_edges(limit);
    moved_.assign(mesh_.positions.size(), false);
    for (std::size_t e = 0; e < edges.size(); ++e) {
      const Candidate& edge = edges[e];
      if (e + kAhead < edges.size()) {
        fetch(edges[e + kAhead].a);
        fetch(edges[e + kAhead].b);
      }
      if (live_ <= target) {
        break;
      }
      if (!moved_[edge.a] && !moved_[edge.b]) {
        try_collapse(edge.a, edge.b);
      }
    }
    compact();
  }

  /// Asks for what a collapse needs: edges come by cost, so that each is somewhere else in memory.
  void fetch(std::uint32_t v) const {
    __builtin_prefetch(&fans_.corners[fans_.offsets[v]]);
    __builtin_prefetch(&mesh_.positions[v]);
    policy_.fetch(v);
  }

  void try_collapse(std::uint32_t a, std::uint32_t b) {
    if (!keeps_topology(a, b)) {
      return;
    }
    const Vec3 at = policy_.place(a, b, mesh_.positions);
    if (!Policy::kMayTurn && (turns_a_face(a, b, at) || turns_a_face(b, a, at))) {
      return;
    }
    mesh_.positions[a] = at;
    policy_.merge(a, b);
    parent_[b] = a;
    moved_[a] = true;
    moved_[b] = true;
    --live_;
  }

  /// Counts for each neighbour of `v` now the faces at the edge to it, and lists the neighbours.
  void count_ring(std::uint32_t v, std::vector<std::uint8_t>& count,
                  std::vector<std::uint32_t>& ring) const {
    ring.clear();
    for (const Fans::Corners& corners : fans_[v]) {
      const std::array c{now(corners[0]), now(corners[1])};
      if (c[0] == c[1]) {
        continue;  // collapsed in this pass
      }
      for (const std::uint32_t u : c) {
        if (count[u] == 0) {
          ring.push_back(u);
        }
        count[u] = static_cast<std::uint8_t>(std::min(count[u] + 1, 255));
      }
    }
  }

  /// The link condition: Dey, Edelsbrunner, Guha, Nekhayev, "Topology Preserving Edge Contraction",
  /// 1999, with the border as one more vertex that all border vertices neighbour.
  [[nodiscard]] bool keeps_topology(std::uint32_t a, std::uint32_t b) {
    count_ring(a, faces_a_, ring_a_);
    count_ring(b, faces_b_, ring_b_);
    const int edge_faces = faces_a_[b];
    int common = 0;
    bool border_a = false;
    bool border_b = false;
    bool lone = false;  // both other sides of a face at the edge are borders
    for (const std::uint32_t v : ring_a_) {
      border_a = border_a || faces_a_[v] == 1;
      if (v != b && faces_b_[v] > 0) {
        ++common;
        lone = lone || (faces_a_[v] == 1 && faces_b_[v] == 1);
      }
    }
    for (const std::uint32_t v : ring_b_) {
      border_b = border_b || faces_b_[v] == 1;
      faces_b_[v] = 0;
    }
    for (const std::uint32_t v : ring_a_) {
      faces_a_[v] = 0;
    }
    if (edge_faces == 0 || common != edge_faces || lone ||
        (border_a && border_b && edge_faces != 1)) {
      return false;
    }
    // A tetrahedron, or faces back to back: the common neighbours themselves make an edge of both.
    const std::size_t ring = ring_a_.size() + ring_b_.size() - 2 - static_cast<std::size_t>(common);
    return ring >= 3 && ring <= Policy::kLargestRing;
  }

  /// Whether moving `v` to `at` turns one of its faces that do not hold `other`.
  [[nodiscard]] bool turns_a_face(std::uint32_t v, std::uint32_t other, const Vec3& at) const {
    for (const Fans::Corners& corners : fans_[v]) {
      const std::array c{now(corners[0]), now(corners[1])};
      if (c[0] == c[1] || c[0] == other || c[1] == other) {
        continue;
      }
      const Vec3 side = mesh_.positions[c[1]] - mesh_.positions[c[0]];
      const Vec3 before = side.cross(mesh_.positions[v] - mesh_.positions[c[0]]);
      const Vec3 after = side.cross(at - mesh_.positions[c[0]]);
      if (before.squaredNorm() > 0.0 &&
          !(before.dot(after) > kLargestTurn * before.norm() * after.norm())) {
        return true;
      }
    }
    return false;
  }

  /// Leaves out what was collapsed. What is left keeps its order, and with it what ties go by; that
  /// it lies together is what makes later passes fast.
  void compact() {
    std::vector<std::uint32_t> number(parent_.size());
    std::uint32_t kept = 0;
    for (std::uint32_t v = 0; v < parent_.size(); ++v) {
      if (parent_[v] == v) {
        mesh_.positions[kept] = mesh_.positions[v];
        policy_.move(v, kept);
        number[v] = kept++;
      }
    }
    mesh_.positions.resize(kept);
    for (std::uint32_t v = 0; v < parent_.size(); ++v) {
      number[v] = number[parent_[v]];
    }
    std::size_t faces = 0;
    for (const Triangle& t : mesh_.triangles) {
      const Triangle c{number[t[0]], number[t[1]], number[t[2]]};
      if (c[0] != c[1] && c[1] != c[2] && c[2] != c[0]) {
        mesh_.triangles[faces++] = c;
      }
    }
    mesh_.triangles.resize(faces);
    for (std::uint32_t& v : of_fine_) {
      v = number[v];
    }
  }

  const RunContext& run_;
  TriMesh mesh_;
  Policy policy_;
  PlaceOrder order_;
  std::vector<std::uint32_t> of_fine_;  ///< Vertex that each of the input is part of.
  Fans fans_{};
  std::vector<std::uint32_t> parent_{};  ///< Within a pass.
  std::size_t live_;
  std::vector<bool> moved_{};
  std::vector<std::uint8_t> faces_a_;  // of the edges from an edge's ends; 0 between two calls
  std::vector<std::uint8_t> faces_b_;
  std::vector<std::uint32_t> ring_a_{};
  std::vector<std::uint32_t> ring_b_{};
};

/// Costs are fourth powers of lengths, held in float: they need lengths of about 1.
int unit_exponent(const TriMesh& mesh) {
  return std::ilogb(
      std::max(bounding_box(mesh.positions).longest_side(), std::numeric_limits<double>::min()));
}

/// A power of two never rounds.
void scale_by_power(TriMesh& mesh, int exponent) {
  for (Vec3& p : mesh.positions) {
    p = {std::ldexp(p.x(), exponent), std::ldexp(p.y(), exponent), std::ldexp(p.z(), exponent)};
  }
}

}  // namespace

Decimation decimate(const TriMesh& fine, std::size_t target, const RunContext& run,
                    std::span<const double> weights) {
  const int exponent = unit_exponent(fine);
  TriMesh scaled = fine;
  scale_by_power(scaled, -exponent);
  Decimator decimator(scaled, ByQuadric(scaled, weights), run);
  decimator.reduce_to(target, std::numeric_limits<double>::infinity());
  Decimation coarse = decimator.result();
  scale_by_power(coarse.mesh, exponent);
  return coarse;
}

TwoDecimations decimate_twice(const TriMesh& fine, std::size_t between, std::size_t target,
                              const RunContext& run) {
  constexpr double kAnyCost = std::numeric_limits<double>::infinity();
  const int exponent = unit_exponent(fine);
  TriMesh scaled = fine;
  scale_by_power(scaled, -exponent);
  Decimator decimator(scaled, ByQuadric(scaled, {}), run);
  TwoDecimations two;
  decimator.reduce_to(target, kAnyCost, between);
  two.between = decimator.result();
  decimator.reduce_to(target, kAnyCost);
  two.coarse = decimator.result();
  scale_by_power(two.between.mesh, exponent);
  scale_by_power(two.coarse.mesh, exponent);
  return two;
}

Decimation merge_short_edges(const TriMesh& fine, const std::vector<double>& weights,
                             double longest, const RunContext& run) {
  Decimator decimator(fine, ByLength(weights), run);
  decimator.reduce_to(0, longest * longest);
  return decimator.result();
}

}  // namespace vantage
