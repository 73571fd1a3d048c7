// SPDX-License-Identifier: MIT
#include "support/skeletons.h"

#include "vantage/contraction/contraction.h"

namespace vantage::test {

Skeleton skeleton_of(const TriMesh& mesh, const SkeletonOptions& options) {
  return extract_skeleton(mesh, contract(mesh), options);
}

std::vector<Vec3> ends_of(const CurveGraph& graph) {
  const auto degree = node_degrees(graph);
  std::vector<Vec3> ends;
  for (std::size_t i = 0; i < degree.size(); ++i) {
    if (degree[i] == 1) {
      ends.push_back(graph.nodes[i]);
    }
  }
  return ends;
}

std::vector<std::uint32_t> one_component(const TriMesh& mesh) {
  return std::vector<std::uint32_t>(mesh.positions.size(), 0);
}

}  // namespace vantage::test
