// SPDX-License-Identifier: MIT
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
  return text + "\n}\n";
}

std::string skeleton_obj(const CurveGraph& graph) {
  std::string text;
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
