// SPDX-License-Identifier: MIT
#pragma once

#include <tuple>
#include <vector>

#include "vantage/core/fields.h"
#include "vantage/core/run_context.h"
#include "vantage/mesh/tri_mesh.h"

/// \file
/// Mesh saliency: how much the curvature around a vertex differs between two scales. Lee, Varshney,
/// Jacobs, "Mesh Saliency", SIGGRAPH 2005, doi:10.1145/1073204.1073244. docs/mesh_saliency.md has
/// the equations and the choices made.

namespace vantage {

/// Options of compute_mesh_saliency().
struct MeshSaliencyOptions {
  double saliency_scale = 0.003;  ///< [ε] over the diagonal of the bounding box (Lee 2005).
  bool signed_curvature = false;  ///< Keep the sign of the mean curvature instead of |C|.
  bool area_kernel = false;       ///< Weight the Gaussian means by vertex area as well.
};

/// The table of MeshSaliencyOptions.
inline constexpr auto kMeshSaliencyFields = std::tuple{
    Field{"saliency-scale", &MeshSaliencyOptions::saliency_scale, 0.0005, 0.02,
          "smallest scale of mesh saliency, as a fraction of the bounding box's diagonal"},
    Switch{"signed", &MeshSaliencyOptions::signed_curvature,
           "mesh saliency keeps the sign of the mean curvature (its absolute value counts "
           "otherwise)"},
    Choice{"kernel-weight", &MeshSaliencyOptions::area_kernel, "vertex|area",
           "what the Gaussian means of mesh saliency count: vertices, or the area they stand for"},
};

/// The map and what it was made of.
struct MeshSaliency {
  std::vector<double> of_vertex{};     ///< [S] |V| values in [0, 5]; 0 for isolated vertices.
  std::vector<double> curvature{};     ///< [C] mean curvature, 1 / model unit, as it entered.
  std::vector<double> level_factor{};  ///< (1 − m̄)² of each of the five scales; 0 where flat.
};

/// Computes the map. Isolated vertices take no part. Does not depend on the unit of length.
/// \throw InvalidInput, Cancelled
/// \complexity |V| times the vertices within 24 ε: about 2 % of them on a compact surface.
MeshSaliency compute_mesh_saliency(const TriMesh& mesh, const MeshSaliencyOptions& options = {},
                                   const RunContext& run = {});

}  // namespace vantage
