// SPDX-License-Identifier: MIT
// Each step of the method by itself: contract a procedural surface, extract its curve skeleton, and
// print what came out. No file is read.
#include <cmath>
#include <cstdio>
#include <numbers>

#include "vantage/contraction/contraction.h"
#include "vantage/significance/kssm.h"
#include "vantage/skeleton/skeleton.h"

namespace {

/// A torus around the z axis, of radius 1 and thickness 0.3.
vantage::TriMesh torus(unsigned around, unsigned across) {
  vantage::TriMesh mesh;
  for (unsigned i = 0; i < around; ++i) {
    for (unsigned j = 0; j < across; ++j) {
      const double u = 2.0 * std::numbers::pi * i / around;
      const double v = 2.0 * std::numbers::pi * j / across;
      const double r = 1.0 + 0.3 * std::cos(v);
      mesh.positions.emplace_back(r * std::cos(u), r * std::sin(u), 0.3 * std::sin(v));
      const unsigned a = i * across + j;
      const unsigned b = (i + 1) % around * across + j;
      const unsigned c = (i + 1) % around * across + (j + 1) % across;
      const unsigned d = i * across + (j + 1) % across;
      mesh.triangles.push_back({a, b, c});
      mesh.triangles.push_back({a, c, d});
    }
  }
  return mesh;
}

}  // namespace

int main() {
  using namespace vantage;
  const TriMesh mesh = torus(96, 32);
  const ContractionHistory history = contract(mesh);
  const Skeleton skeleton = extract_skeleton(mesh, history);
  const KssmMap map = compute_kssm(mesh, history, skeleton);
  std::printf(
      "%zu levels, %zu nodes, %zu cycle, length %.2f (the circle has %.2f), first KSSM %.3f\n",
      history.level_count(), skeleton.graph.nodes.size(), cycle_count(skeleton.graph),
      total_length(skeleton.graph), 2.0 * std::numbers::pi, map.of_vertex.front());
  return cycle_count(skeleton.graph) == 1 ? 0 : 1;
}
