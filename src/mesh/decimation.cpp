// SPDX-License-Identifier: MIT
#include "mesh/decimation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <numeric>
#include <span>
#include <tuple>
#include <utility>

#include "vantage/mesh/measures.h"

#include "core/parallel.h"
#include "mesh/collapse_cost.h"
#include "mesh/place_order.h"
#include "mesh/triangle_corners.h"

namespace vantage {
namespace {

/// A face may turn by at most the angle of this cosine in one collapse [ours: 78°].
constexpr double kLargestTurn = 0.2;
/// Share of the edges, the cheapest ones, that one pass may collapse [ours].
constexpr double kPassShare = 0.4;
/// A pass that removes less than this share of the vertices ends the decimation: what is left must
/// not collapse, and more passes would only crawl.
constexpr double kLeastProgress = 1e-3;
constexpr std::size_t kAhead = 8;          // edges that memory is asked about what a collapse needs
constexpr std::size_t kGrain = 4096;       // vertices a task
constexpr std::size_t kSortGrain = 16384;  // edges

/// An edge that may go, and where its vertex would stand.
struct Candidate {
  float cost = 0.0F;
  std::uint32_t a = 0;
  std::uint32_t b = 0;
};

template <class Policy>
class Decimator {
 public:
  Decimator(const TriMesh& fine, Policy policy, const RunContext& run)
      : run_(run),
        mesh_(fine),
        policy_(std::move(policy)),
        order_(referenced_points(fine)),
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

  /// Edges from the vertices begin … end − 1 to later ones, those that cost less than the limit.
  std::vector<Candidate> edges_from(std::size_t begin, std::size_t end, double limit) const {
    std::vector<Candidate> edges;
    std::vector<std::uint32_t> ends;
    for (std::size_t v = begin; v < end; ++v) {
      ends.clear();
      for (const Fans::Corners& corners : fans_[v]) {
        std::copy_if(corners.begin(), corners.end(), std::back_inserter(ends),
                     [v](std::uint32_t u) { return u > v; });
      }
      std::sort(ends.begin(), ends.end());
      ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
      const auto a = static_cast<std::uint32_t>(v);
      for (const std::uint32_t b : ends) {
        const auto cost = static_cast<float>(policy_.cost(a, b, mesh_.positions));
        if (cost < limit) {
          edges.push_back({cost, a, b});
        }
      }
    }
    return edges;
  }

  /// The cheapest edges, those of less than this cost, in order.
  std::vector<Candidate> cheapest_edges(double limit) {
    const std::size_t count = mesh_.positions.size();
    std::vector<std::vector<Candidate>> found((count + kGrain - 1) / kGrain);
    parallel_for(run_, count, kGrain, [&](std::size_t begin, std::size_t end) {
      found[begin / kGrain] = edges_from(begin, end, limit);
    });
    std::vector<Candidate> edges;
    edges.reserve(3 * mesh_.triangles.size() / 2 + 16);
    for (const std::vector<Candidate>& some : found) {
      edges.insert(edges.end(), some.begin(), some.end());
    }
    keep_cheapest(edges, kPassShare);
    parallel_sort(run_, edges, kSortGrain, [this](const Candidate& x, const Candidate& y) {
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

  /// Counts for each neighbour of `v` now the faces at the edge to it, and lists the neighbours; stops
  /// at more than a vertex may have for an edge at it to go.
  void count_ring(std::uint32_t v, std::vector<std::uint8_t>& count,
                  std::vector<std::uint32_t>& ring) const {
    ring.clear();
    for (const Fans::Corners& corners : fans_[v]) {
      if (is_too_large(ring)) {
        break;
      }
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

  /// All neighbours but the edge's other end are left by a collapse.
  static bool is_too_large(const std::vector<std::uint32_t>& ring) {
    return ring.size() > Policy::kLargestRing + 1;
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
    if (is_too_large(ring_a_) || is_too_large(ring_b_) || edge_faces == 0 || common != edge_faces ||
        lone || (border_a && border_b && edge_faces != 1) || has_faces_twice(a, b)) {
      return false;
    }
    // A tetrahedron, or faces back to back: the common neighbours themselves make an edge of both.
    const std::size_t ring = ring_a_.size() + ring_b_.size() - 2 - static_cast<std::size_t>(common);
    return ring >= 3 && ring <= Policy::kLargestRing;
  }

  /// Whether two faces at the edge have one apex: it would be left without a face.
  [[nodiscard]] bool has_faces_twice(std::uint32_t a, std::uint32_t b) {
    apexes_.clear();
    for (const Fans::Corners& corners : fans_[a]) {
      const std::array c{now(corners[0]), now(corners[1])};
      if (c[0] != c[1] && (c[0] == b || c[1] == b)) {
        const std::uint32_t apex = c[0] == b ? c[1] : c[0];
        if (std::find(apexes_.begin(), apexes_.end(), apex) != apexes_.end()) {
          return true;
        }
        apexes_.push_back(apex);
      }
    }
    return false;
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
      const double cosine = before.dot(after);  // times the root of the product below
      const double squared_areas = before.squaredNorm() * after.squaredNorm();
      if (before.squaredNorm() > 0.0 &&
          !(cosine > 0.0 && cosine * cosine > kLargestTurn * kLargestTurn * squared_areas)) {
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
      if (!names_a_vertex_twice(c)) {
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
  std::vector<std::uint32_t> apexes_{};
};

/// Where costs keep their digits: they are fourth powers of lengths, held in float. A power of two
/// never rounds.
class CostFrame {
 public:
  explicit CostFrame(const TriMesh& mesh) : box_(bounding_box(referenced_points(mesh))) {
    const double size = box_.longest_side();
    exponent_ = size > 0.0 ? std::ilogb(size) : 0;
  }

  /// Brings the mesh near the origin as well: quadrics are differences of squared distances from there.
  /// It goes by multiples of four times its size, so that one that is near stays as it is to the bit, and
  /// one that is far does not round on the way.
  [[nodiscard]] static CostFrame near_origin(const TriMesh& mesh) {
    CostFrame frame(mesh);
    const Box& box = frame.box_;
    const Vec3 middle = times_power(0.5 * box.low + 0.5 * box.high, -frame.exponent_ - 2);
    frame.origin_ = times_power(middle.array().round(), frame.exponent_ + 2);
    return frame;
  }

  [[nodiscard]] TriMesh to_frame(TriMesh mesh) const {
    for (Vec3& p : mesh.positions) {
      p = times_power(p - origin_, -exponent_);
    }
    return mesh;
  }

  [[nodiscard]] Decimation from_frame(Decimation coarse) const {
    for (Vec3& p : coarse.mesh.positions) {
      p = times_power(p, exponent_) + origin_;
    }
    return coarse;
  }

  /// A length of the mesh in the frame.
  [[nodiscard]] double length(double of_mesh) const { return std::ldexp(of_mesh, -exponent_); }

 private:
  static Vec3 times_power(const Vec3& p, int exponent) {
    return {std::ldexp(p.x(), exponent), std::ldexp(p.y(), exponent), std::ldexp(p.z(), exponent)};
  }

  Box box_;
  int exponent_ = 0;
  Vec3 origin_ = Vec3::Zero();  // in the mesh's units
};

}  // namespace

Decimation decimate(const TriMesh& fine, std::size_t target, const RunContext& run,
                    std::span<const double> weights) {
  const CostFrame frame = CostFrame::near_origin(fine);
  const TriMesh scaled = frame.to_frame(fine);
  Decimator decimator(scaled, ByQuadric(scaled, weights), run);
  decimator.reduce_to(target, std::numeric_limits<double>::infinity());
  return frame.from_frame(decimator.result());
}

TwoDecimations decimate_twice(const TriMesh& fine, std::size_t between, std::size_t target,
                              const RunContext& run, std::span<const double> weights) {
  constexpr double kAnyCost = std::numeric_limits<double>::infinity();
  const CostFrame frame = CostFrame::near_origin(fine);
  const TriMesh scaled = frame.to_frame(fine);
  Decimator decimator(scaled, ByQuadric(scaled, weights), run);
  TwoDecimations two;
  decimator.reduce_to(target, kAnyCost, between);
  two.between = frame.from_frame(decimator.result());
  decimator.reduce_to(target, kAnyCost);
  two.coarse = frame.from_frame(decimator.result());
  return two;
}

Decimation merge_short_edges(const TriMesh& fine, const std::vector<double>& weights,
                             double longest, const RunContext& run) {
  const CostFrame frame(fine);
  const double most = frame.length(longest);
  Decimator decimator(frame.to_frame(fine), ByLength(weights), run);
  decimator.reduce_to(0, most * most);
  return frame.from_frame(decimator.result());
}

}  // namespace vantage
