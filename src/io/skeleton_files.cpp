// SPDX-License-Identifier: MIT
#include <array>
#include <cmath>
#include <cstdint>

#include "vantage/io/write.h"

namespace vantage {
namespace {

std::string coordinates(const Vec3& point, const char* separator) {
  return number_text(point.x()) + separator + number_text(point.y()) + separator +
         number_text(point.z());
}

/// `"name": [item, item, …]` with one item a line.
template <class Items, class Text>
std::string json_list(const char* name, const Items& items, const Text& text) {
  std::string result = std::string("  \"") + name + "\": [";
  const char* separator = "\n    ";
  for (const auto& item : items) {
    result += separator + text(item);
    separator = ",\n    ";
  }
  return result + (items.empty() ? "]" : "\n  ]");
}

std::string index_list(const std::vector<std::uint32_t>& indices) {
  std::string text = "[";
  for (const std::uint32_t i : indices) {
    text += (text.size() == 1 ? "" : ", ") + std::to_string(i);
  }
  return text + "]";
}

/// Where no radius is known the formats that demand one get 0.
std::string radius_text(const SkeletonFile& skeleton, std::size_t node) {
  const double radius = node < skeleton.radius.size() ? skeleton.radius[node] : 0.0;
  return number_text(std::isfinite(radius) ? radius : 0.0);
}

/// A tree for each component of a graph, and the edges left out.
struct Forest {
  std::vector<std::uint32_t> order{};   ///< Nodes, parents first.
  std::vector<std::uint32_t> place{};   ///< Of each node in `order`.
  std::vector<std::uint32_t> parent{};  ///< Of each node; a root is its own.
  std::vector<std::array<std::uint32_t, 2>> cut{};
};

/// Breadth first, from the lowest end of each component or, if it has none, its lowest node.
Forest spanning_forest(const CurveGraph& graph, const std::vector<std::uint32_t>& degree) {
  constexpr std::uint32_t kNone = 0xffffffffU;
  const std::size_t count = graph.nodes.size();
  const IndexLists lists = node_neighbours(graph);
  Forest forest{.order = {},
                .place = std::vector<std::uint32_t>(count, 0),
                .parent = std::vector<std::uint32_t>(count, kNone),
                .cut = {}};
  const auto grow = [&](std::uint32_t root) {
    forest.parent[root] = root;
    forest.order.push_back(root);
    for (std::size_t i = forest.order.size() - 1; i < forest.order.size(); ++i) {
      const std::uint32_t node = forest.order[i];
      forest.place[node] = static_cast<std::uint32_t>(i);
      for (const std::uint32_t next : lists[node]) {
        if (forest.parent[next] == kNone) {
          forest.parent[next] = node;
          forest.order.push_back(next);
        }
      }
    }
  };
  for (const bool ends_only : {true, false}) {
    for (std::uint32_t i = 0; i < count; ++i) {
      if (forest.parent[i] == kNone && (!ends_only || degree[i] == 1)) {
        grow(i);
      }
    }
  }
  for (const auto& [a, b] : graph.edges) {
    if (forest.parent[a] != b && forest.parent[b] != a) {
      forest.cut.push_back({a, b});
    }
  }
  return forest;
}

}  // namespace

std::string skeleton_json(const SkeletonFile& skeleton) {
  std::string text = "{\n";
  text += json_list("nodes", skeleton.graph->nodes,
                    [](const Vec3& node) { return "[" + coordinates(node, ", ") + "]"; });
  text += ",\n" + json_list("edges", skeleton.graph->edges, [](const auto& edge) {
            return "[" + std::to_string(edge[0]) + ", " + std::to_string(edge[1]) + "]";
          });
  text += ",\n" + json_list("radius", skeleton.radius, number_text);
  text += ",\n" + json_list("vertex_node", skeleton.vertex_node,
                            [](std::int64_t node) { return std::to_string(node); });
  text += ",\n" + json_list("degree", node_degrees(*skeleton.graph),
                            [](std::uint32_t degree) { return std::to_string(degree); });
  text += ",\n" + json_list("branches", graph_branches(*skeleton.graph), index_list);
  text += ",\n  \"length\": " + number_text(total_length(*skeleton.graph));
  return text + "\n}\n";
}

std::string skeleton_swc(const SkeletonFile& skeleton) {
  const CurveGraph& graph = *skeleton.graph;
  const std::vector<std::uint32_t> degree = node_degrees(graph);
  const Forest forest = spanning_forest(graph, degree);
  std::string text = "# written by vantage\n# id type x y z radius parent\n";
  text += "# loops cut: " + std::to_string(forest.cut.size()) + "\n";
  for (const auto& [a, b] : forest.cut) {
    text += "# cut between " + std::to_string(forest.place[a] + std::uint64_t{1}) + " and " +
            std::to_string(forest.place[b] + std::uint64_t{1}) + "\n";
  }
  for (std::size_t i = 0; i < forest.order.size(); ++i) {
    const std::uint32_t node = forest.order[i];
    const std::uint32_t parent = forest.parent[node];
    const char* const type = degree[node] > 2 ? " 5 " : degree[node] == 1 ? " 6 " : " 0 ";
    text += std::to_string(i + 1) + type + coordinates(graph.nodes[node], " ") + " " +
            radius_text(skeleton, node) + " " +
            (parent == node ? "-1" : std::to_string(forest.place[parent] + std::uint64_t{1})) +
            "\n";
  }
  return text;
}

std::string skeleton_graphml(const SkeletonFile& skeleton) {
  const CurveGraph& graph = *skeleton.graph;
  std::string text =
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
      "<graphml xmlns=\"http://graphml.graphdrawing.org/xmlns\">\n";
  for (const char* const name : {"x", "y", "z", "radius"}) {
    text += std::string("  <key id=\"") + name + "\" for=\"node\" attr.name=\"" + name +
            "\" attr.type=\"double\"/>\n";
  }
  text += "  <key id=\"length\" for=\"edge\" attr.name=\"length\" attr.type=\"double\"/>\n";
  text += "  <graph id=\"skeleton\" edgedefault=\"undirected\">\n";
  const auto data = [](const char* key, const std::string& value) {
    return std::string("<data key=\"") + key + "\">" + value + "</data>";
  };
  for (std::uint32_t i = 0; i < graph.nodes.size(); ++i) {
    const Vec3& p = graph.nodes[i];
    text += "    <node id=\"n" + std::to_string(i) + "\">" + data("x", number_text(p.x())) +
            data("y", number_text(p.y())) + data("z", number_text(p.z())) +
            data("radius", radius_text(skeleton, i)) + "</node>\n";
  }
  for (const auto& [a, b] : graph.edges) {
    text += "    <edge source=\"n" + std::to_string(a) + "\" target=\"n" + std::to_string(b) +
            "\">" + data("length", number_text((graph.nodes[a] - graph.nodes[b]).norm())) +
            "</edge>\n";
  }
  return text + "  </graph>\n</graphml>\n";
}

std::string skeleton_obj(const CurveGraph& graph) {
  std::string text = "# written by vantage\n";
  for (const Vec3& node : graph.nodes) {
    text += "v " + coordinates(node, " ") + "\n";
  }
  for (const auto& [a, b] : graph.edges) {
    text += "l " + std::to_string(a + std::uint64_t{1}) + " " +
            std::to_string(b + std::uint64_t{1}) + "\n";
  }
  return text;
}

std::string skeleton_ply(const CurveGraph& graph) {
  std::string text = "ply\nformat ascii 1.0\ncomment written by vantage\n";
  text += "element vertex " + std::to_string(graph.nodes.size()) +
          "\nproperty double x\nproperty double y\nproperty double z\n";
  text += "element edge " + std::to_string(graph.edges.size()) +
          "\nproperty int vertex1\nproperty int vertex2\nend_header\n";
  for (const Vec3& node : graph.nodes) {
    text += coordinates(node, " ") + "\n";
  }
  for (const auto& [a, b] : graph.edges) {
    text += std::to_string(a) + " " + std::to_string(b) + "\n";
  }
  return text;
}

}  // namespace vantage
