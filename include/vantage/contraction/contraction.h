// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <tuple>
#include <vector>

#include "vantage/contraction/history.h"
#include "vantage/core/fields.h"
#include "vantage/core/run_context.h"
#include "vantage/mesh/tri_mesh.h"

/// \file
/// Contraction of a surface towards a curve by constrained Laplacian smoothing: Au, Tai, Chu,
/// Cohen-Or, Lee, "Skeleton Extraction by Mesh Contraction", SIGGRAPH 2008,
/// doi:10.1145/1360612.1360643, with the constants of Cao, Tagliasacchi, Olson, Zhang, Su,
/// "Point Cloud Skeletons via Laplacian-Based Contraction", SMI 2010, doi:10.1109/SMI.2010.25.
/// Symbols in [brackets] are the papers'. docs/contraction.md has the equations.

namespace vantage {

/// How a surface is contracted.
enum class ContractionMethod {
  Auto,   ///< Large components by a decimated proxy (ours).
  Exact,  ///< Every component by exact solves at full resolution (the paper's).
};

/// What the sums of a step run over.
enum class ContractionWeights {
  Auto,  ///< As the method has it: Area with Auto, Vertex with Exact.
  Area,  ///< The surface: vertices count by area, components of few huge faces are refined (ours).
  Vertex,  ///< The vertices of the mesh, each alike (Cao).
};

/// Weights and stopping rule of contract().
struct ContractionOptions {
  ContractionMethod method = ContractionMethod::Auto;       ///< Proxies or not.
  ContractionScaling scaling = ContractionScaling::Sphere;  ///< Unit of the weights.
  ContractionWeights weights = ContractionWeights::Auto;    ///< What vertices count by.
  double contraction_growth = 3.0;    ///< [s_L] factor on W_L per step (Cao; Au used 2); > 1.
  double contraction_limit = 2048.0;  ///< Largest W_L (Cao).
  double sheet_limit = 8192.0;        ///< Largest W_L of ContractionHistory::thinned (ours).
  double attraction_limit = 1e4;      ///< Largest W_H (Cao).
  double diagonal_limit = 1e4;        ///< Rows of L with a larger diagonal are scaled down (Cao).
  double shrinkage_tolerance = 0.01;  ///< Stop when a_{t−1} − a_t falls below (Cao).
  int max_steps = 20;                 ///< At most this many steps (Cao).
  bool second_mesh = true;            ///< Whether ContractionHistory::second is made.
};

/// The table of ContractionOptions.
inline constexpr auto kContractionFields = std::tuple{
    Choice{"contraction", &ContractionOptions::method, "auto|exact",
           "how the surface is contracted: large components by a decimated proxy, or all exactly"},
    Choice{"contraction-weights", &ContractionOptions::weights, "auto|area|vertex",
           "what a vertex counts by: the area around it, or each alike as the paper has it, which "
           "makes the map that of the mesh more than of the surface; auto: area, but vertex with "
           "contraction exact"},
    Choice{"contraction-scaling", &ContractionOptions::scaling, "sphere|box", kNoFlag},
    Field{"contraction-growth", &ContractionOptions::contraction_growth, 1.01, 100.0,
          "factor on the contraction weight per step [s_L] (Cao 2010: 3; Au 2008: 2)"},
    Field{"contraction-limit", &ContractionOptions::contraction_limit, 1.0, 1e9,
          "largest contraction weight W_L (Cao 2010)"},
    Field{"sheet-limit", &ContractionOptions::sheet_limit, 1.0, 1e9,
          "largest contraction weight where a sheet is contracted further to a curve, for the "
          "skeleton alone (meshes only); up to contraction-limit: never"},
    Field{"attraction-limit", &ContractionOptions::attraction_limit, 1.0, 1e9,
          "largest attraction weight W_H (Cao 2010)"},
    Field{"diagonal-limit", &ContractionOptions::diagonal_limit, 1.0, 1e12,
          "largest diagonal of a row of L before it is scaled down (Cao 2010)"},
    Field{"shrinkage-tolerance", &ContractionOptions::shrinkage_tolerance, 0.0, 1.0,
          "stop when a step shrinks the mean face area ratio by less (Cao 2010)"},
    Field{"max-steps", &ContractionOptions::max_steps, 1, 100, "at most this many steps"},
    Switch{"second-mesh", &ContractionOptions::second_mesh, kNoFlag},
};

/// Contracts each connected component of `mesh` by itself, as options.method says.
/// Vertex i of every level is vertex i of the input. Commutes with similarity transforms of the input
/// up to rounding. Coincident vertices should be welded first.
///
/// \throw InvalidInput if an option is outside its range, or a coordinate is not finite.
/// \throw Cancelled
/// \complexity One sparse Cholesky factorisation a step: of a proxy of about 10 000 vertices where a
/// component has more than 20 000, can be decimated to less than 0.7 of them and the method is Auto. A step
/// that is not sound is tried up to nine ways, each with up to seven weights; what still fails is contracted
/// anew up to three times, a plate up to four. A second, coarser mesh is contracted as well
/// (ContractionHistory::second).
ContractionHistory contract(const TriMesh& mesh, const ContractionOptions& options = {},
                            const RunContext& run = {});

/// A cloud's history, and the samples that were contracted in its place.
struct PointContraction {
  ContractionHistory history{};  ///< Of every point; outliers stay and are kIsolated.
  TriMesh samples{};             ///< What was contracted; the triangles their rings agree on.
  ContractionHistory sample_history{};           ///< Of the samples.
  std::vector<std::uint32_t> sample_of_point{};  ///< Nearest sample; kIsolated for outliers.
};

/// Marks statistical outliers: points whose mean distance to their 16 nearest exceeds 3 × the median
/// of what those have; then among the rest, until there are none. Of a few points none is one.
/// \return one entry per point, 1 for outliers. \pre points pairwise different.
std::vector<std::uint8_t> find_outliers(std::span<const Vec3> points, const RunContext& run = {});

/// Contracts each component of the cloud's ring graph by itself.
/// \param points    pairwise different, finite.
/// \param left_out  one entry per point; 1 leaves it out (outliers).
/// \throw InvalidInput if an option is outside its range, or `left_out` of another length. \throw Cancelled
PointContraction contract_points(std::span<const Vec3> points,
                                 std::span<const std::uint8_t> left_out,
                                 const ContractionOptions& options = {},
                                 const RunContext& run = {});

}  // namespace vantage
