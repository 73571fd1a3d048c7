// SPDX-License-Identifier: MIT
#include "skeleton/cloud_graph.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <numeric>
#include <utility>

#include "vantage/mesh/topology.h"

#include "mesh/disjoint_sets.h"
#include "skeleton/cluster_complex.h"
#include "skeleton/surgery.h"

namespace vantage {
namespace {

/// Parts of a cluster of fewer points than this, cut off from the rest, go to what they touch most
/// [ours: noise].
constexpr std::size_t kSmallPart = 4;
/// Neighbouring pairs that join two clusters; one pair does where they would fall apart otherwise
/// [ours: noise makes single pairs across gaps].
constexpr std::size_t kFirmLink = 2;
/// Share of a point that stands for no sample.
constexpr double kNoWeight = 1e-6;

/// For each point the farthest-point sample of its component that is nearest to it; samples are
/// taken until no point is farther than `spacing` from all.
std::vector<std::uint32_t> nearest_centres(const std::vector<Vec3>& points,
                                           const std::vector<std::uint32_t>& component,
                                           double spacing, const RunContext& run) {
  std::vector<std::vector<std::uint32_t>> members;
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    if (component[i] != ContractionHistory::kIsolated) {
      members.resize(std::max<std::size_t>(members.size(), component[i] + 1));
      members[component[i]].push_back(i);
    }
  }
  std::vector<std::uint32_t> centre(points.size());
  std::iota(centre.begin(), centre.end(), 0U);
  std::vector<double> distance(points.size(), std::numeric_limits<double>::infinity());
  for (const auto& list : members) {
    if (list.empty()) {
      continue;
    }
    Vec3 mean = Vec3::Zero();
    for (const std::uint32_t i : list) {
      mean += points[i] / static_cast<double>(list.size());
    }
    const auto farther = [&](std::uint32_t a, std::uint32_t b) {
      return (points[a] - mean).squaredNorm() < (points[b] - mean).squaredNorm();
    };
    std::uint32_t next = *std::max_element(list.begin(), list.end(), farther);
    for (;;) {
      run.check();
      double most = 0.0;
      const std::uint32_t taken = next;
      for (const std::uint32_t i : list) {
        const double d = (points[i] - points[taken]).squaredNorm();
        if (d < distance[i]) {
          distance[i] = d;
          centre[i] = taken;
        }
        if (distance[i] > most) {
          most = distance[i];
          next = i;
        }
      }
      if (!(most > spacing * spacing)) {
        break;
      }
    }
  }
  return centre;
}

/// Clusters: the connected parts of what is nearest to each centre, numbered by lowest point.
Components connected_parts(const std::vector<std::uint32_t>& centre, const IndexLists& neighbours) {
  const std::size_t n = centre.size();
  DisjointSets parts(n);
  for (std::uint32_t i = 0; i < n; ++i) {
    for (const std::uint32_t j : neighbours[i]) {
      if (centre[i] == centre[j]) {
        parts.join(i, j);
      }
    }
  }
  std::vector<std::size_t> size(n, 0);
  for (std::uint32_t i = 0; i < n; ++i) {
    ++size[parts.root(i)];
  }
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint32_t part = parts.root(i);
    if (size[part] >= kSmallPart) {
      continue;
    }
    const auto larger = [&](std::uint32_t a, std::uint32_t b) {
      return size[parts.root(a)] < size[parts.root(b)];
    };
    const auto around = neighbours[i];
    const auto best = std::max_element(around.begin(), around.end(), larger);
    if (best != around.end() && size[parts.root(*best)] >= kSmallPart) {
      const std::uint32_t into = parts.root(*best);
      const std::size_t both = size[part] + size[into];
      parts.join(i, *best);
      size[parts.root(i)] = both;
    }
  }
  Components clusters{.of_vertex = std::vector<std::uint32_t>(n)};
  std::vector<std::uint32_t>& cluster = clusters.of_vertex;
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint32_t part = parts.root(i);
    cluster[i] = part == i ? static_cast<std::uint32_t>(clusters.count++) : cluster[part];
  }
  return clusters;
}

using Links = std::vector<std::array<std::uint32_t, 2>>;

/// Pairs of clusters that neighbouring points join, ascending.
Links links_of(const std::vector<std::uint32_t>& cluster, const IndexLists& neighbours,
               std::size_t count) {
  Links pairs;
  for (std::uint32_t i = 0; i < cluster.size(); ++i) {
    for (const std::uint32_t j : neighbours[i]) {
      if (i < j && cluster[i] != cluster[j]) {
        pairs.push_back({std::min(cluster[i], cluster[j]), std::max(cluster[i], cluster[j])});
      }
    }
  }
  std::sort(pairs.begin(), pairs.end());
  DisjointSets parts(count);
  Links links;
  Links single;
  for (std::size_t begin = 0; begin < pairs.size();) {
    std::size_t end = begin;
    while (end < pairs.size() && pairs[end] == pairs[begin]) {
      ++end;
    }
    if (end - begin >= kFirmLink) {
      links.push_back(pairs[begin]);
      parts.join(pairs[begin][0], pairs[begin][1]);
    } else {
      single.push_back(pairs[begin]);
    }
    begin = end;
  }
  for (const auto& pair : single) {
    if (parts.join(pair[0], pair[1])) {
      links.push_back(pair);
    }
  }
  std::sort(links.begin(), links.end());
  return links;
}

/// Triangles of all triples that are joined to each other. A link that is in none gets a triangle
/// with a point of its own at its middle, since links are known by their triangles.
TriMesh clique_complex(std::vector<Vec3> places, const Links& links, std::vector<double>& weights) {
  std::vector<std::vector<std::uint32_t>> higher(places.size());
  for (const auto& [a, b] : links) {
    higher[a].push_back(b);
  }
  std::vector<bool> covered(links.size(), false);
  const auto cover = [&](std::uint32_t a, std::uint32_t b) {
    const auto at = std::lower_bound(links.begin(), links.end(), std::array{a, b});
    covered[static_cast<std::size_t>(at - links.begin())] = true;
  };
  TriMesh complex{.positions = std::move(places), .triangles = {}};
  for (const auto& [a, b] : links) {
    for (const std::uint32_t c : higher[b]) {
      if (std::binary_search(higher[a].begin(), higher[a].end(), c)) {
        complex.triangles.push_back({a, b, c});
        cover(a, b);
        cover(b, c);
        cover(a, c);
      }
    }
  }
  for (std::size_t l = 0; l < links.size(); ++l) {
    if (!covered[l]) {
      const auto [a, b] = links[l];
      const auto middle = static_cast<std::uint32_t>(complex.positions.size());
      complex.positions.emplace_back(0.5 * (complex.positions[a] + complex.positions[b]));
      weights.push_back(kNoWeight);
      complex.triangles.push_back({a, b, middle});
    }
  }
  return complex;
}

}  // namespace

Collapsed thin_cloud(const TriMesh& samples, const ContractionHistory& history, double spacing,
                     const RunContext& run) {
  const std::vector<Vec3>& points = history.levels.back();
  const IndexLists neighbours = vertex_neighbours(samples);
  const auto [cluster, count] = connected_parts(
      nearest_centres(points, history.component_of_vertex, spacing, run), neighbours);
  std::vector<Vec3> places(count, Vec3::Zero());
  std::vector<double> weights(count, 0.0);
  for (std::size_t i = 0; i < points.size(); ++i) {
    places[cluster[i]] += points[i];
    weights[cluster[i]] += 1.0;
  }
  for (std::size_t c = 0; c < count; ++c) {
    places[c] /= weights[c];
  }
  const TriMesh mesh =
      clique_complex(std::move(places), links_of(cluster, neighbours, count), weights);
  ClusterComplex complex(mesh, mesh.positions, weights);
  Collapsed collapsed;
  collapsed.lost_handles = collapse_to_graph(complex, run);
  ClusterGraph made = complex.graph();
  collapsed.graph = std::move(made.graph);
  for (const std::uint32_t c : cluster) {
    collapsed.node_of_vertex.push_back(made.node_of_vertex[c]);
  }
  return collapsed;
}

}  // namespace vantage
