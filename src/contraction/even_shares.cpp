// SPDX-License-Identifier: MIT
#include <algorithm>
#include <vector>

#include "vantage/mesh/measures.h"

#include "contraction/component_contraction.h"

namespace vantage {
namespace {

/// Even vertices that a surface counts as [ours: the steps are then those of a model of this size].
constexpr double kEvenVertices = 5000.0;
/// Fewest of them that a vertex may stand for: keeps its row in the system.
constexpr double kSmallestShare = 0.01;

}  // namespace

EvenShares even_shares(const TriMesh& mesh) {
  EvenShares shares;
  const double area = surface_area(mesh);
  if (!(area > 0.0)) {
    return shares;
  }
  shares.mean_face_area = 0.5 * area / kEvenVertices;  // a closed surface has two faces a vertex
  for (const double around : vertex_areas(mesh)) {
    shares.count.push_back(std::max(around * kEvenVertices / area, kSmallestShare));
  }
  return shares;
}

}  // namespace vantage
