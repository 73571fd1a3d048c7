// SPDX-License-Identifier: MIT
#include "pipeline/coarse_surface.h"

#include <utility>

#include "mesh/decimation.h"
#include "view/compact_surface.h"

namespace vantage {

std::vector<double> CoarseSurface::sums(std::span<const double> of_fine_vertex) const {
  std::vector<double> sums(mesh.positions.size(), 0.0);
  for (std::size_t v = 0; v < of_vertex.size(); ++v) {
    if (of_vertex[v] != kNone) {
      sums[of_vertex[v]] += of_fine_vertex[v];
    }
  }
  return sums;
}

CoarseSurface coarse_surface(const TriMesh& fine, const std::vector<FaceSides>& sides,
                             std::size_t vertices, const RunContext& run) {
  CompactSurface whole = compact_surface(fine, sides);
  CoarseSurface coarse;
  coarse.of_vertex.assign(fine.positions.size(), CoarseSurface::kNone);
  // A collapse keeps components apart and their order, and so the sides.
  coarse.sides = std::move(whole.sides);
  if (whole.mesh.positions.size() <= vertices) {
    for (std::uint32_t row = 0; row < whole.vertex_of_row.size(); ++row) {
      coarse.of_vertex[whole.vertex_of_row[row]] = row;
    }
    coarse.mesh = std::move(whole.mesh);
    return coarse;
  }
  Decimation decimated = decimate(whole.mesh, vertices, run);
  for (std::size_t row = 0; row < whole.vertex_of_row.size(); ++row) {
    coarse.of_vertex[whole.vertex_of_row[row]] = decimated.of_vertex[row];
  }
  coarse.mesh = std::move(decimated.mesh);
  return coarse;
}

}  // namespace vantage
