// SPDX-License-Identifier: MIT
#include "pipeline/tangles.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "vantage/mesh/curve_graph.h"
#include "vantage/mesh/topology.h"
#include "vantage/mesh/tri_mesh.h"

#include "mesh/disjoint_sets.h"

namespace vantage {
namespace {

/// A graph of more cycles than this, and of more than one for so many nodes, is a tangle: loops that the
/// shape does not have. [ours; docs/lab]
constexpr double kMostCycles = 8.0;
constexpr double kNodesOfACycle = 4.0;
/// Of the shape's diameter: a missing triangle with shorter edges is a gap between faces, no opening. [ours]
constexpr double kGap = 0.1;
/// Of the area so much must be in tangles. [ours]
constexpr double kTangledShare = 0.25;

bool is_tangled(double cycles, double nodes) {
  return cycles > kMostCycles && kNodesOfACycle * cycles > nodes;
}

/// A component of the surface and its part of the skeleton.
struct LoopCount {
  double nodes = 0.0;
  double cycles = 0.0;  ///< Of the skeleton.
  double loops = 1.0;   ///< Of the surface, 1 − χ: those of all handles and holes, and more.
  double gaps = 0.0;    ///< Of these, around single triangles that are missing.
  double area = 0.0;    ///< Twice that of the surface.

  /// Whether it is one by the loops around gaps, where all others of the surface are in it.
  [[nodiscard]] bool is_tangle() const {
    return is_tangled(std::min(gaps, cycles - std::max(0.0, loops - gaps)), nodes);
  }
};

/// Adds where faces are missing that have all their edges. A face that stands alone is none.
void count_gaps(const TriMesh& mesh, const EdgeTable& table,
                const std::vector<std::uint32_t>& of_vertex, double size,
                std::vector<LoopCount>& counts) {
  using Edge = std::array<std::uint32_t, 2>;
  std::vector<Edge> rim;  // sorted as the table is
  for (std::size_t e = 0; e < table.edges.size(); ++e) {
    const auto [a, b] = table.edges[e];
    if (table.faces_of_edge[e].size() == 1 &&
        (mesh.positions[a] - mesh.positions[b]).norm() < size) {
      rim.push_back(table.edges[e]);
    }
  }
  const auto from = [&](std::uint32_t a) {
    return std::lower_bound(rim.begin(), rim.end(), Edge{a, 0});
  };
  const auto is_face = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    const auto edge = std::lower_bound(table.edges.begin(), table.edges.end(), Edge{a, b});
    const auto place = static_cast<std::size_t>(edge - table.edges.begin());
    const Triangle& t = mesh.triangles[table.faces_of_edge[place][0]];
    return std::find(t.begin(), t.end(), c) != t.end();
  };
  for (const auto& [a, b] : rim) {
    for (auto edge = from(a); edge != rim.end() && (*edge)[0] == a; ++edge) {
      const std::uint32_t c = (*edge)[1];
      if (c > b && std::binary_search(rim.begin(), rim.end(), Edge{b, c}) && !is_face(a, b, c)) {
        counts[of_vertex[a]].gaps += 1.0;
      }
    }
  }
}

/// Sets what there is to count of the surface.
void count_loops_of_surface(const ShapeAnalysis& shape, std::vector<LoopCount>& counts) {
  const TriMesh& mesh = shape.surface;
  const std::vector<std::uint32_t>& of_vertex = shape.history.component_of_vertex;
  const EdgeTable table = build_edge_table(mesh);
  for (const std::uint32_t component : of_vertex) {
    if (component != ContractionHistory::kIsolated) {
      counts[component].loops -= 1.0;
    }
  }
  for (const auto& edge : table.edges) {
    counts[of_vertex[edge[0]]].loops += 1.0;
  }
  for (const Triangle& t : mesh.triangles) {
    counts[of_vertex[t[0]]].loops -= 1.0;
    counts[of_vertex[t[0]]].area += area_vector(mesh, t).norm();
  }
  count_gaps(mesh, table, of_vertex, kGap * shape.sphere.diameter, counts);
}

/// Nodes and cycles of the skeleton of each component. \pre the skeleton's nodes stand for vertices
void count_loops_of_skeleton(const ShapeAnalysis& shape, std::vector<LoopCount>& counts) {
  const CurveGraph& graph = shape.skeleton.graph;
  DisjointSets parts(graph.nodes.size());
  for (const auto& [a, b] : graph.edges) {
    parts.join(a, b);
  }
  std::vector<std::uint32_t> of_part(graph.nodes.size(), ContractionHistory::kIsolated);
  for (std::size_t v = 0; v < shape.skeleton.node_of_vertex.size(); ++v) {
    if (const std::uint32_t node = shape.skeleton.node_of_vertex[v]; node < graph.nodes.size()) {
      of_part[parts.root(node)] = shape.history.component_of_vertex[v];
    }
  }
  const auto add = [&](std::uint32_t node, double nodes, double cycles) {
    if (const std::uint32_t part = of_part[parts.root(node)]; part < counts.size()) {
      counts[part].nodes += nodes;
      counts[part].cycles += cycles;
    }
  };
  for (std::uint32_t node = 0; node < graph.nodes.size(); ++node) {
    add(node, 1.0, parts.root(node) == node ? 0.0 : -1.0);
  }
  for (const auto& edge : graph.edges) {
    add(edge[0], 0.0, 1.0);
  }
}

std::string tangle_of_surface(const ShapeAnalysis& shape) {
  std::vector<LoopCount> counts(shape.history.components.size());
  count_loops_of_skeleton(shape, counts);
  count_loops_of_surface(shape, counts);
  LoopCount tangles;
  double all = 0.0;
  for (const LoopCount& c : counts) {
    all += c.area;
    if (c.is_tangle()) {
      tangles.nodes += c.nodes;
      tangles.cycles += c.cycles;
      tangles.gaps += c.gaps;
      tangles.area += c.area;
    }
  }
  if (!(tangles.area > kTangledShare * all)) {
    return {};
  }
  const auto text = [](double count) { return std::to_string(static_cast<std::size_t>(count)); };
  return "the skeleton is a tangle of " + text(tangles.cycles) + " cycles at " +
         text(tangles.nodes) + " nodes, as " + text(tangles.gaps) +
         " single triangles are missing, so that map, skeleton and views are hardly more than a "
         "guess: fill these holes";
}

}  // namespace

std::string tangle_text(const ShapeAnalysis& shape) {
  const std::size_t nodes = shape.skeleton.graph.nodes.size();
  const std::size_t cycles = cycle_count(shape.skeleton.graph);
  if (shape.cloud) {
    return is_tangled(static_cast<double>(cycles), static_cast<double>(nodes))
               ? "the skeleton of the points is a tangle of " + std::to_string(cycles) +
                     " cycles at " + std::to_string(nodes) +
                     " nodes, so that map, skeleton and views are hardly more than a guess: thin "
                     "the points out evenly, or mesh them"
               : "";
  }
  return shape.check.closed || static_cast<double>(cycles) <= kMostCycles
             ? ""
             : tangle_of_surface(shape);
}

}  // namespace vantage
