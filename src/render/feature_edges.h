// SPDX-License-Identifier: MIT
#pragma once

#include "vantage/mesh/curve_graph.h"
#include "vantage/mesh/tri_mesh.h"

namespace vantage {

/// Edges that a draughtsman would draw whatever the view: where the surface bends by more than
/// `crease_rad`, ends, or branches. Edges belong together by position, not by shared vertices.
/// Pieces that hang together but are shorter in all than `least_length` are left out: on scans
/// they are noise. \param longest_piece longer edges are split into equal pieces, > 0;
/// into longer ones where that would be more than some kMostFeatureEdges.
/// Empty if there are more than kMostFeatureEdges: then they are texture, not features.
CurveGraph feature_edges(const TriMesh& mesh, double crease_rad, double least_length,
                         double longest_piece);

/// [ours]: beyond this the lines of a picture run together.
inline constexpr std::size_t kMostFeatureEdges = 200'000;

}  // namespace vantage
