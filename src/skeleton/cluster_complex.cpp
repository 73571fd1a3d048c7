// SPDX-License-Identifier: MIT
#include "skeleton/cluster_complex.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <tuple>
#include <utility>

#include "vantage/mesh/measures.h"
#include "vantage/mesh/topology.h"

#include "mesh/triangle_corners.h"

namespace vantage {
namespace {

/// Share of a cluster that a split made, against its lighter neighbour: it stands for no vertex.
constexpr double kSplitWeight = 1e-3;

using Link = ClusterComplex::Link;

bool before(const Link& link, std::uint32_t cluster) {
  return link.cluster < cluster;
}

/// The two corners of a triangle other than `corner`.
std::array<std::uint32_t, 2> others(const Triangle& t, std::uint32_t corner) {
  if (t[0] == corner) {
    return {t[1], t[2]};
  }
  return t[1] == corner ? std::array{t[0], t[2]} : std::array{t[0], t[1]};
}

}  // namespace

ClusterComplex::ClusterComplex(const TriMesh& mesh, std::vector<Vec3> positions,
                               std::vector<double> weights)
    : ClusterComplex(mesh, build_edge_table(mesh), std::move(positions), std::move(weights)) {}

ClusterComplex::ClusterComplex(const TriMesh& mesh, const EdgeTable& table,
                               std::vector<Vec3> positions, std::vector<double> weights)
    : position_(std::move(positions)),
      order_(referenced_points({position_, mesh.triangles})),
      weight_(std::move(weights)),
      parent_(position_.size()),
      links_(position_.size()),
      faces_of_(position_.size()),
      faces_(mesh.triangles),
      ends_(table.edges),
      edge_faces_(table.edges.size()),
      vertex_count_(position_.size()),
      guard_(mesh, table),
      annotation_(guard_.take_annotations()) {
  std::iota(parent_.begin(), parent_.end(), 0U);
  // Sorted edges: each cluster first meets its lower, then its higher neighbours.
  for (std::uint32_t e = 0; e < ends_.size(); ++e) {
    links_[ends_[e][1]].push_back({ends_[e][0], e});
    edge_faces_[e] = static_cast<std::uint32_t>(table.faces_of_edge[e].size());
  }
  for (std::uint32_t e = 0; e < ends_.size(); ++e) {
    links_[ends_[e][0]].push_back({ends_[e][1], e});
  }
  // A face that stands twice in the file is one triangle here.
  for (std::uint32_t f = 0; f < faces_.size(); ++f) {
    const Triangle& t = faces_[f];
    if (names_a_vertex_twice(t)) {
      continue;
    }
    if (has_face(t[0], t[1], t[2])) {
      for (std::size_t c = 0; c < 3; ++c) {
        --edge_faces_[find(t[c], t[(c + 1) % 3])->edge];
      }
      continue;
    }
    for (const std::uint32_t corner : t) {
      faces_of_[corner].push_back(f);
    }
    ++live_faces_;
  }
}

double ClusterComplex::length(std::uint32_t edge) const {
  return (position_[ends_[edge][0]] - position_[ends_[edge][1]]).norm();
}

const Link* ClusterComplex::find(std::uint32_t cluster, std::uint32_t neighbour) const {
  const auto& links = links_[cluster];
  const auto at = std::lower_bound(links.begin(), links.end(), neighbour, before);
  return at != links.end() && at->cluster == neighbour ? &*at : nullptr;
}

bool ClusterComplex::has_face(std::uint32_t cluster, std::uint32_t x, std::uint32_t y) const {
  // Looked for at the corner of fewest faces: others may have thousands.
  for (std::uint32_t* corner : {&x, &y}) {
    if (faces_of_[*corner].size() < faces_of_[cluster].size()) {
      std::swap(*corner, cluster);
    }
  }
  return std::any_of(faces_of_[cluster].begin(), faces_of_[cluster].end(), [&](std::uint32_t f) {
    const auto [p, q] = others(faces_[f], cluster);
    return (p == x && q == y) || (p == y && q == x);
  });
}

std::vector<std::uint32_t> ClusterComplex::pinched_by(std::uint32_t edge) const {
  const auto [a, b] = ends_[edge];
  const auto& smaller = links_[a].size() < links_[b].size() ? links_[a] : links_[b];
  const std::uint32_t other = links_[a].size() < links_[b].size() ? b : a;
  std::vector<std::uint32_t> common;
  for (const Link& link : smaller) {
    if (find(other, link.cluster) != nullptr) {
      common.push_back(link.cluster);
    }
  }
  if (common.size() == edge_faces_[edge]) {
    return {};
  }
  const std::uint32_t end = faces_of_[a].size() < faces_of_[b].size() ? a : b;
  const std::uint32_t far = end == a ? b : a;
  std::vector<std::uint32_t> filled;
  for (const std::uint32_t f : faces_of_[end]) {
    const auto [p, q] = others(faces_[f], end);
    if (p == far || q == far) {
      filled.push_back(p == far ? q : p);
    }
  }
  std::sort(filled.begin(), filled.end());
  std::erase_if(
      common, [&](std::uint32_t c) { return std::binary_search(filled.begin(), filled.end(), c); });
  return common;
}

Bits ClusterComplex::loop_class(std::uint32_t edge, std::uint32_t third) const {
  const std::size_t words = guard_.words();
  Bits sum(words, 0);
  const auto [a, b] = ends_[edge];
  for (const std::uint32_t e : {edge, find(third, a)->edge, find(third, b)->edge}) {
    for (std::size_t w = 0; w < words; ++w) {
      sum[w] ^= annotation_[e * words + w];
    }
  }
  return sum;
}

bool ClusterComplex::keeps_handles(std::uint32_t edge) {
  if (guard_.words() == 0) {
    return true;
  }
  refusal_.resize(edge_count());
  if (is_still_refused(edge)) {
    return false;
  }
  refusal_[edge].reset();
  std::vector<Bits> crossed;
  for (const std::uint32_t third : pinched_by(edge)) {
    const Bits loop = loop_class(edge, third);
    if (!may_pinch(loop, crossed)) {
      if (const std::optional<std::size_t> dead = guard_.dead_crossed_by(loop)) {
        refusal_[edge] = {third, *dead};
      }
      return false;
    }
  }
  return true;
}

bool ClusterComplex::is_still_refused(std::uint32_t edge) const {
  const std::optional<Refusal>& refusal = refusal_[edge];
  const auto [a, b] = ends_[edge];
  return refusal && find(refusal->third, a) != nullptr && find(refusal->third, b) != nullptr &&
         !has_face(refusal->third, a, b) &&
         guard_.crosses_dead(loop_class(edge, refusal->third), refusal->dead);
}

bool ClusterComplex::may_pinch(const Bits& loop, std::vector<Bits>& crossed) const {
  if (is_zero(loop)) {
    return true;
  }
  if (!guard_.may_kill(loop, crossed)) {
    return false;
  }
  crossed.push_back(guard_.crossed_by(loop));
  return true;
}

void ClusterComplex::kill_pinched_loops(std::uint32_t edge) {
  if (guard_.words() == 0) {
    return;
  }
  for (const std::uint32_t third : pinched_by(edge)) {
    guard_.kill(loop_class(edge, third), annotation_);
  }
}

std::uint32_t ClusterComplex::add_edge(std::uint32_t a, std::uint32_t b, const Bits& annotation) {
  const auto e = static_cast<std::uint32_t>(ends_.size());
  ends_.push_back({std::min(a, b), std::max(a, b)});
  edge_faces_.push_back(0);
  annotation_.insert(annotation_.end(), annotation.begin(), annotation.end());
  for (const auto& [from, to] : {std::array{a, b}, std::array{b, a}}) {
    auto& links = links_[from];
    links.insert(std::lower_bound(links.begin(), links.end(), to, before), {to, e});
  }
  return e;
}

void ClusterComplex::split(std::uint32_t edge) {
  const std::size_t words = guard_.words();
  const auto [a, c] = ends_[edge];
  const auto middle = static_cast<std::uint32_t>(position_.size());
  position_.emplace_back(0.5 * (position_[a] + position_[c]));
  weight_.push_back(std::min(weight_[a], weight_[c]) * kSplitWeight);
  parent_.push_back(middle);
  links_.emplace_back();
  faces_of_.emplace_back();

  // `edge` becomes a–middle and keeps its annotation; middle–c carries none.
  links_[c].erase(std::lower_bound(links_[c].begin(), links_[c].end(), a, before));
  links_[a].erase(std::lower_bound(links_[a].begin(), links_[a].end(), c, before));
  ends_[edge] = {a, middle};
  links_[a].push_back({middle, edge});  // the highest index of all: stays sorted
  links_[middle].push_back({a, edge});
  const std::uint32_t rest = add_edge(middle, c, Bits(words, 0));

  std::vector<std::uint32_t> halved;
  for (const std::uint32_t f : faces_of_[a]) {
    const auto [x, y] = others(faces_[f], a);
    if (x == c || y == c) {
      halved.push_back(f);
    }
  }
  for (const std::uint32_t f : halved) {
    const auto [x, y] = others(faces_[f], a);
    const std::uint32_t tip = x == c ? y : x;
    const std::uint32_t side = find(a, tip)->edge;
    Bits sum(words, 0);  // a–middle–tip–a bounds a triangle: its annotations add up to nothing
    for (std::size_t w = 0; w < words; ++w) {
      sum[w] = annotation_[edge * words + w] ^ annotation_[side * words + w];
    }
    edge_faces_[add_edge(middle, tip, sum)] = 2;
    ++edge_faces_[rest];
    std::erase(faces_of_[c], f);
    faces_[f] = {a, middle, tip};
    faces_of_[middle].push_back(f);
    const auto other_half = static_cast<std::uint32_t>(faces_.size());
    faces_.push_back({middle, c, tip});
    for (const std::uint32_t corner : faces_.back()) {
      faces_of_[corner].push_back(other_half);
    }
    ++live_faces_;
  }
}

/// The edge of fewer faces; of as many, the longer one, or that which comes first by place.
std::uint32_t ClusterComplex::sparser(std::uint32_t edge, std::uint32_t other) const {
  const auto rank = [this](std::uint32_t e) {
    const Vec3& a = position_[ends_[e][0]];
    const Vec3& b = position_[ends_[e][1]];
    return std::tuple(edge_faces_[e], -static_cast<double>(order_.steps(length(e))),
                      order_.place(a, b), e);
  };
  return rank(edge) < rank(other) ? edge : other;
}

void ClusterComplex::make_room(std::uint32_t edge) {
  std::vector<Bits> crossed;
  std::vector<std::uint32_t> thirds = pinched_by(edge);
  const auto rank = [this](std::uint32_t c) {
    return std::pair(order_.place(position_[c], position_[c]), c);
  };
  std::sort(thirds.begin(), thirds.end(),
            [&](std::uint32_t c, std::uint32_t d) { return rank(c) < rank(d); });
  for (const std::uint32_t third : thirds) {
    if (!may_pinch(loop_class(edge, third), crossed)) {
      const auto [a, b] = ends_[edge];
      const std::uint32_t to_a = find(third, a)->edge;
      const std::uint32_t to_b = find(third, b)->edge;
      split(sparser(to_a, to_b));
    }
  }
}

void ClusterComplex::remove_face(std::uint32_t face) {
  const Triangle t = faces_[face];
  for (std::size_t c = 0; c < 3; ++c) {
    --edge_faces_[find(t[c], t[(c + 1) % 3])->edge];
    std::erase(faces_of_[t[c]], face);
  }
  --live_faces_;
}

void ClusterComplex::absorb_faces(std::uint32_t keep, std::uint32_t gone) {
  const std::vector<std::uint32_t> faces = faces_of_[gone];
  for (const std::uint32_t f : faces) {
    const auto [x, y] = others(faces_[f], gone);
    if (x == keep || y == keep || has_face(keep, x, y)) {
      remove_face(f);
    }
  }
  for (const std::uint32_t f : faces_of_[gone]) {
    for (std::uint32_t& corner : faces_[f]) {
      corner = corner == gone ? keep : corner;
    }
    faces_of_[keep].push_back(f);
  }
  faces_of_[gone] = {};
}

void ClusterComplex::absorb_links(std::uint32_t keep, std::uint32_t gone, std::uint32_t edge) {
  const std::size_t words = guard_.words();
  const std::vector<Link> moving = std::exchange(links_[gone], {});
  for (const auto& [c, e] : moving) {
    auto& back = links_[c];
    back.erase(std::lower_bound(back.begin(), back.end(), gone, before));
    if (c == keep) {
      continue;
    }
    if (const Link* twin = find(keep, c)) {
      edge_faces_[twin->edge] += edge_faces_[e];
      ends_[e] = {c, c};
      continue;
    }
    // The way from `keep` to c now leads over the collapsed edge.
    for (std::size_t w = 0; w < words; ++w) {
      annotation_[e * words + w] ^= annotation_[edge * words + w];
    }
    ends_[e] = {std::min(keep, c), std::max(keep, c)};
    back.insert(std::lower_bound(back.begin(), back.end(), keep, before), {keep, e});
    auto& links = links_[keep];
    links.insert(std::lower_bound(links.begin(), links.end(), c, before), {c, e});
  }
  ends_[edge] = {keep, keep};
}

std::uint32_t ClusterComplex::collapse(std::uint32_t edge) {
  auto [keep, gone] = ends_[edge];
  if (links_[gone].size() > links_[keep].size()) {
    std::swap(keep, gone);
  }
  kill_pinched_loops(edge);
  absorb_faces(keep, gone);
  absorb_links(keep, gone, edge);
  const double weight = weight_[keep] + weight_[gone];
  position_[keep] = (weight_[keep] * position_[keep] + weight_[gone] * position_[gone]) / weight;
  weight_[keep] = weight;
  parent_[gone] = keep;
  return keep;
}

std::uint32_t ClusterComplex::cluster_of(std::uint32_t vertex) {
  while (parent_[vertex] != vertex) {
    parent_[vertex] = parent_[parent_[vertex]];
    vertex = parent_[vertex];
  }
  return vertex;
}

ClusterGraph ClusterComplex::graph() {
  constexpr std::uint32_t kUnset = std::numeric_limits<std::uint32_t>::max();
  ClusterGraph made;
  auto& [graph, node_of_vertex] = made;
  std::vector<std::uint32_t> node_of_cluster(position_.size(), kUnset);
  node_of_vertex.resize(vertex_count_);
  for (std::uint32_t v = 0; v < position_.size(); ++v) {
    const std::uint32_t cluster = cluster_of(v);
    if (node_of_cluster[cluster] == kUnset) {
      node_of_cluster[cluster] = static_cast<std::uint32_t>(graph.nodes.size());
      graph.nodes.push_back(position_[cluster]);
    }
    if (v < vertex_count_) {
      node_of_vertex[v] = node_of_cluster[cluster];
    }
  }
  for (std::uint32_t e = 0; e < ends_.size(); ++e) {
    if (edge_is_live(e)) {
      const std::uint32_t a = node_of_cluster[ends_[e][0]];
      const std::uint32_t b = node_of_cluster[ends_[e][1]];
      graph.edges.push_back({std::min(a, b), std::max(a, b)});
    }
  }
  std::sort(graph.edges.begin(), graph.edges.end());
  return made;
}

}  // namespace vantage
