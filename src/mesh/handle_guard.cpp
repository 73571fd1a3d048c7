// SPDX-License-Identifier: MIT
#include "mesh/handle_guard.h"

#include <algorithm>
#include <bit>
#include <limits>
#include <utility>

#include "mesh/disjoint_sets.h"

namespace vantage {
namespace {

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
/// Annotations of more bits than this in total are not kept: half a gigabyte.
constexpr std::size_t kMostBits = std::size_t{1} << 32U;

bool bit(const std::uint64_t* words, std::size_t i) {
  return ((words[i / 64] >> (i % 64)) & 1U) != 0;
}

void flip(std::uint64_t* words, std::size_t i) {
  words[i / 64] ^= std::uint64_t{1} << (i % 64);
}

void add(Bits& to, const Bits& from) {
  for (std::size_t w = 0; w < to.size(); ++w) {
    to[w] ^= from[w];
  }
}

/// Whether the number of coordinates that are set in both is odd: their product over Z₂.
bool is_odd_in_common(const Bits& a, const Bits& b) {
  std::uint64_t parity = 0;
  for (std::size_t w = 0; w < a.size(); ++w) {
    parity ^= a[w] & b[w];
  }
  return (std::popcount(parity) & 1) != 0;
}

/// Index of the highest set bit. \pre there is one.
std::size_t leading_bit(const Bits& bits) {
  std::size_t w = bits.size() - 1;
  while (bits[w] == 0) {
    --w;
  }
  return 64 * w + 63 - static_cast<std::size_t>(std::countl_zero(bits[w]));
}

std::size_t edge_between(const EdgeTable& table, std::uint32_t a, std::uint32_t b) {
  const std::array<std::uint32_t, 2> key{std::min(a, b), std::max(a, b)};
  return static_cast<std::size_t>(std::lower_bound(table.edges.begin(), table.edges.end(), key) -
                                  table.edges.begin());
}

/// A spanning tree of vertices and a disjoint one of faces across the remaining edges; what is left
/// are the generators of first homology (Eppstein, "Dynamic generators of topologically embedded
/// graphs", SODA 2003).
struct TreeCotree {
  std::vector<std::uint32_t> parent_face{};  ///< kNone at roots.
  std::vector<std::uint32_t> parent_edge{};  ///< Edge crossed to the parent.
  std::vector<std::uint32_t> depth{};
  std::vector<std::uint32_t> generators{};  ///< Edges, ascending.
};

/// Edges of components in which every edge has two faces.
std::vector<bool> closed_edges(const TriMesh& mesh, const EdgeTable& table) {
  const Components components = connected_components(mesh);
  std::vector<bool> closed(components.count, true);
  for (std::size_t e = 0; e < table.edges.size(); ++e) {
    if (table.faces_of_edge[e].size() != 2) {
      closed[components.of_vertex[table.edges[e][0]]] = false;
    }
  }
  std::vector<bool> result(table.edges.size());
  for (std::size_t e = 0; e < table.edges.size(); ++e) {
    result[e] = closed[components.of_vertex[table.edges[e][0]]];
  }
  return result;
}

/// Builds a breadth-first spanning forest of the dual graph; the root of a tree is its lowest face.
void hang_faces(std::size_t face_count, const EdgeTable& table,
                const std::vector<std::vector<std::uint32_t>>& dual, TreeCotree& trees) {
  trees.parent_face.assign(face_count, kNone);
  trees.parent_edge.assign(face_count, kNone);
  trees.depth.assign(face_count, kNone);
  std::vector<std::uint32_t> queue;
  for (std::uint32_t root = 0; root < face_count; ++root) {
    if (trees.depth[root] != kNone) {
      continue;
    }
    trees.depth[root] = 0;
    queue.assign(1, root);
    for (std::size_t head = 0; head < queue.size(); ++head) {
      const std::uint32_t face = queue[head];
      for (const std::uint32_t e : dual[face]) {
        const auto pair = table.faces_of_edge[e];
        const std::uint32_t other = pair[0] == face ? pair[1] : pair[0];
        if (trees.depth[other] == kNone) {
          trees.depth[other] = trees.depth[face] + 1;
          trees.parent_face[other] = face;
          trees.parent_edge[other] = e;
          queue.push_back(other);
        }
      }
    }
  }
}

TreeCotree build_trees(const TriMesh& mesh, const EdgeTable& table) {
  const std::vector<bool> closed = closed_edges(mesh, table);
  DisjointSets vertex_sets(mesh.positions.size());
  DisjointSets face_sets(mesh.triangles.size());
  TreeCotree trees;
  std::vector<std::vector<std::uint32_t>> dual(mesh.triangles.size());
  std::vector<std::uint32_t> rest;
  for (std::uint32_t e = 0; e < table.edges.size(); ++e) {
    if (closed[e] && !vertex_sets.join(table.edges[e][0], table.edges[e][1])) {
      rest.push_back(e);
    }
  }
  for (const std::uint32_t e : rest) {
    const auto faces = table.faces_of_edge[e];
    if (face_sets.join(faces[0], faces[1])) {
      dual[faces[0]].push_back(e);
      dual[faces[1]].push_back(e);
    } else {
      trees.generators.push_back(e);
    }
  }
  if (!trees.generators.empty()) {
    hang_faces(mesh.triangles.size(), table, dual, trees);
  }
  return trees;
}

/// Edges that the dual loop through generator `e` crosses, in order around the loop.
std::vector<std::uint32_t> dual_loop(const TreeCotree& trees, const EdgeTable& table,
                                     std::uint32_t e) {
  const auto ends = table.faces_of_edge[e];
  std::uint32_t a = ends[0];
  std::uint32_t b = ends[1];
  std::vector<std::uint32_t> up{e};
  std::vector<std::uint32_t> down;
  while (a != b) {
    if (trees.depth[a] >= trees.depth[b]) {
      up.push_back(trees.parent_edge[a]);
      a = trees.parent_face[a];
    } else {
      down.push_back(trees.parent_edge[b]);
      b = trees.parent_face[b];
    }
  }
  up.insert(up.end(), down.rbegin(), down.rend());
  return up;
}

/// Inverse of a square matrix over Z₂ that is made of diagonal blocks. Columns without a pivot are
/// added to `singular`; the blocks they belong to mean nothing then, the others are right.
std::vector<Bits> inverse(std::vector<Bits> A, std::vector<std::size_t>& singular) {
  const std::size_t n = A.size();
  std::vector<Bits> I(n, Bits(A.front().size(), 0));
  for (std::size_t i = 0; i < n; ++i) {
    flip(I[i].data(), i);
  }
  for (std::size_t column = 0; column < n; ++column) {
    std::size_t pivot = column;
    while (pivot < n && !bit(A[pivot].data(), column)) {
      ++pivot;
    }
    if (pivot == n) {
      singular.push_back(column);
      continue;
    }
    std::swap(A[pivot], A[column]);
    std::swap(I[pivot], I[column]);
    for (std::size_t row = 0; row < n; ++row) {
      if (row != column && bit(A[row].data(), column)) {
        add(A[row], A[column]);
        add(I[row], I[column]);
      }
    }
  }
  return I;
}

/// Coordinates of every component that has a singular one: there two sheets touch in a vertex, so
/// that it is no surface after all, and its handles are not guarded.
Bits coordinates_to_drop(const TriMesh& mesh, const EdgeTable& table, const TreeCotree& trees,
                         const std::vector<std::size_t>& singular, std::size_t words) {
  Bits dropped(words, 0);
  if (singular.empty()) {
    return dropped;
  }
  const Components components = connected_components(mesh);
  const auto component_of = [&](std::size_t i) {
    return components.of_vertex[table.edges[trees.generators[i]][0]];
  };
  std::vector<bool> bad(components.count, false);
  for (const std::size_t i : singular) {
    bad[component_of(i)] = true;
  }
  for (std::size_t i = 0; i < trees.generators.size(); ++i) {
    if (bad[component_of(i)]) {
      flip(dropped.data(), i);
    }
  }
  return dropped;
}

}  // namespace

HandleGuard::HandleGuard(const TriMesh& mesh, const EdgeTable& table) {
  const TreeCotree trees = build_trees(mesh, table);
  const std::size_t n = trees.generators.size();
  if (n == 0 || n * table.edges.size() > kMostBits) {
    return;
  }
  const std::size_t words = (n + 63) / 64;
  annotation_.assign(words * table.edges.size(), 0);
  std::vector<std::vector<std::uint32_t>> loops(n);
  for (std::size_t i = 0; i < n; ++i) {
    loops[i] = dual_loop(trees, table, trees.generators[i]);
    for (const std::uint32_t e : loops[i]) {
      flip(annotation_.data() + e * words, i);
    }
  }
  // Slide each dual loop onto the edges: its class in the basis of the generators is row i of A.
  // Dual loop i crosses generator k iff i = k, so A times the matrix of crossings is the identity.
  std::vector<Bits> A(n, Bits(words, 0));
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t k = 0; k < loops[i].size(); ++k) {
      const std::uint32_t from = table.edges[loops[i][k]][0];
      const std::uint32_t to = table.edges[loops[i][(k + 1) % loops[i].size()]][0];
      if (from != to) {
        const std::uint64_t* step = annotation_.data() + edge_between(table, from, to) * words;
        for (std::size_t w = 0; w < words; ++w) {
          A[i][w] ^= step[w];
        }
      }
    }
  }
  std::vector<std::size_t> singular;
  crossings_ = inverse(std::move(A), singular);
  const Bits dropped = coordinates_to_drop(mesh, table, trees, singular, words);
  for (std::size_t i = 0; i < annotation_.size(); ++i) {
    annotation_[i] &= ~dropped[i % words];
  }
  words_ = words;
}

Bits HandleGuard::crossed_by(const Bits& loop) const {
  Bits crossed(words_, 0);
  for (std::size_t i = 0; i < crossings_.size(); ++i) {
    if (is_odd_in_common(crossings_[i], loop)) {
      flip(crossed.data(), i);
    }
  }
  return crossed;
}

bool HandleGuard::may_kill(const Bits& loop, const std::vector<Bits>& crossed_by_others) const {
  return !dead_crossed_by(loop) &&
         std::none_of(crossed_by_others.begin(), crossed_by_others.end(),
                      [&](const Bits& crossed) { return is_odd_in_common(loop, crossed); });
}

std::optional<std::size_t> HandleGuard::dead_crossed_by(const Bits& loop) const {
  for (std::size_t dead = 0; dead < crossed_by_dead_.size(); ++dead) {
    if (crosses_dead(loop, dead)) {
      return dead;
    }
  }
  return std::nullopt;
}

bool HandleGuard::crosses_dead(const Bits& loop, std::size_t dead) const {
  return is_odd_in_common(loop, crossed_by_dead_[dead]);
}

void HandleGuard::kill(const Bits& loop, std::vector<std::uint64_t>& annotations) {
  if (is_zero(loop)) {
    return;
  }
  const std::size_t lead = leading_bit(loop);
  for (std::size_t first = 0; first < annotations.size(); first += words_) {
    if (bit(annotations.data() + first, lead)) {
      for (std::size_t w = 0; w < words_; ++w) {
        annotations[first + w] ^= loop[w];
      }
    }
  }
  crossed_by_dead_.push_back(crossed_by(loop));
}

bool is_zero(const Bits& bits) {
  return std::all_of(bits.begin(), bits.end(), [](std::uint64_t word) { return word == 0; });
}

}  // namespace vantage
