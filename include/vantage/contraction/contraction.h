// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <tuple>
#include <vector>

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

/// What the weights are scaled against, so that results do not depend on the unit of length.
enum class ContractionScaling {
  Sphere,  ///< Enclosing sphere of each component to diameter 2 (ours: independent of rotation).
  Box,     ///< Longest side of each component's axis-aligned box to 1.6 (the paper's).
};

/// How a surface is contracted.
enum class ContractionMethod {
  Auto,   ///< Large components by a decimated proxy (ours).
  Exact,  ///< Every component by exact solves at full resolution (the paper's).
};

/// What the sums of a step run over.
enum class ContractionWeights {
  Area,  ///< The surface: vertices count by area, components of few huge faces are refined (ours).
  Vertex,  ///< The vertices of the mesh, each alike (Cao).
};

/// Weights and stopping rule of contract().
struct ContractionOptions {
  ContractionMethod method = ContractionMethod::Auto;       ///< Proxies or not.
  ContractionScaling scaling = ContractionScaling::Sphere;  ///< Unit of the weights.
  ContractionWeights weights = ContractionWeights::Area;    ///< What vertices count by.
  double contraction_growth = 3.0;    ///< [s_L] factor on W_L per step (Cao; Au used 2); > 1.
  double contraction_limit = 2048.0;  ///< Largest W_L (Cao).
  double sheet_limit = 8192.0;        ///< Largest W_L of ContractionHistory::thinned (ours).
  double attraction_limit = 1e4;      ///< Largest W_H (Cao).
  double diagonal_limit = 1e4;        ///< Rows of L with a larger diagonal are scaled down (Cao).
  double shrinkage_tolerance = 0.01;  ///< Stop when a_{t−1} − a_t falls below (Cao).
  int max_steps = 20;                 ///< At most this many steps (Cao).
};

/// The table of ContractionOptions.
inline constexpr auto kContractionFields = std::tuple{
    Choice{"contraction", &ContractionOptions::method, "auto|exact",
           "how the surface is contracted: large components by a decimated proxy, or all exactly"},
    Choice{"contraction-weights", &ContractionOptions::weights, "area|vertex",
           "what a vertex counts by: the area around it, or each alike as the paper has it, which "
           "makes the map that of the mesh more than of the surface"},
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
};

/// Why the contraction of a component ended. None of these is an error.
enum class ContractionStop {
  Shrunk,         ///< A step shrank the surface by less than the tolerance.
  Grew,           ///< A side of the bounding box grew past its bound; that step was discarded.
  Collapsed,      ///< A step would have run a curve to a point; that step was discarded.
  StepLimit,      ///< `max_steps` were taken.
  NothingToMove,  ///< No face with area: a point or a needle.
  SolverFailed,   ///< No regularisation gave a finite solution; that step was discarded.
};

/// Lower-case name of a stop reason for results, e.g. "shrunk".
std::string_view stop_name(ContractionStop stop);

/// What happened to one connected component.
struct ComponentContraction {
  std::size_t vertices = 0;  ///< Of the component.
  int steps = 0;             ///< Accepted steps; later levels repeat the last one.
  ContractionStop stop = ContractionStop::NothingToMove;  ///< Why it ended.
  int regularised_steps = 0;            ///< Steps that could not be taken as defined.
  std::vector<std::string> remedies{};  ///< What was done about them, a phrase each.
  std::string strategy{"exact"};        ///< Which method contracted it.
  double shrinkage = 1.0;               ///< [a_t] of its last level.
};

/// A finer surface that was contracted in place of the input; the input's vertices come first.
struct ContractedRefinement {
  TriMesh mesh{};                                    ///< The same surface with more vertices.
  std::vector<std::vector<Vec3>> levels{};           ///< K + 1 levels of its vertices, model units.
  std::vector<std::uint32_t> component_of_vertex{};  ///< As in ContractionHistory.
  std::vector<Vec3> thinned{};                       ///< As in ContractionHistory.
};

/// The surface with some vertices merged: the same components, borders and genus, fewer faces. A skeleton that starts
/// from it need not collapse every edge of a large surface.
struct MergedSurface {
  std::size_t vertex_count = 0;
  std::vector<Triangle> triangles{};       ///< Of merged vertices.
  std::vector<std::uint32_t> of_vertex{};  ///< |V| merged vertex that each vertex is part of.
};

/// A second mesh of the same surface, coarser, contracted by itself. Where the two contractions agree, they tell of
/// the surface; the rest hangs on how it is cut into triangles.
struct SecondMesh {
  TriMesh mesh{};
  std::vector<std::vector<Vec3>> levels{};           ///< Of its vertices, model units.
  std::vector<std::uint32_t> component_of_vertex{};  ///< As in ContractionHistory.
  /// Points of the surface, next to each of its vertices, at the levels of the first contraction.
  std::vector<std::vector<Vec3>> here{};
  std::vector<std::vector<Vec3>> there{};  ///< The same points by the second contraction.
};

/// Positions of every vertex at every level.
struct ContractionHistory {
  /// K + 1 levels of |V| points in model units; level 0 is the input itself.
  std::vector<std::vector<Vec3>> levels{};
  std::vector<double> shrinkage{};  ///< [a_t] per level, area-ratio mean; 1 at level 0.
  std::vector<ComponentContraction> components{};  ///< Ordered by lowest vertex index.
  std::vector<std::uint32_t>
      component_of_vertex{};  ///< |V| indices into `components`, or kIsolated.
  /// |V| points from which the skeleton is collapsed, or empty: those of the last level. Components
  /// that stopped shrinking as sheets stand as they do contracted further, all others as at the last
  /// level [ours: docs/contraction.md].
  std::vector<Vec3> thinned{};
  std::vector<std::string> warnings{};  ///< One sentence each.
  /// If some component was made of few huge faces.
  std::optional<ContractedRefinement> refinement{};
  SecondMesh second{};  ///< Empty for point clouds.
  /// If some component is large.
  std::optional<MergedSurface> merged{};

  /// Marks vertices that no face names; they stay where they are.
  static constexpr std::uint32_t kIsolated = 0xffffffffu;

  /// Where the surface is most like a curve: what the skeleton is collapsed from. \pre has levels
  [[nodiscard]] const std::vector<Vec3>& thinnest() const {
    return thinned.empty() ? levels.back() : thinned;
  }

  /// K, the number of accepted steps of the longest component.
  [[nodiscard]] std::size_t level_count() const { return levels.empty() ? 0 : levels.size() - 1; }
};

/// Contracts each connected component of `mesh` by itself, as options.method says.
/// Connectivity is unchanged: vertex i of every level is vertex i of the input. Commutes with
/// similarity transforms of the input up to rounding. Coincident vertices should be welded first.
///
/// \throw InvalidInput if an option is outside its range.
/// \throw Cancelled
/// \complexity One symbolic analysis per component, one sparse Cholesky factorisation per step.
ContractionHistory contract(const TriMesh& mesh, const ContractionOptions& options = {},
                            const RunContext& run = {});

/// A cloud's history, and the samples that were contracted in its place.
struct PointContraction {
  ContractionHistory history{};  ///< Of every point; outliers stay and are kIsolated.
  TriMesh samples{};             ///< What was contracted; the triangles their rings agree on.
  ContractionHistory sample_history{};           ///< Of the samples.
  std::vector<std::uint32_t> sample_of_point{};  ///< Nearest sample; kIsolated for outliers.
};

/// Marks statistical outliers: points whose mean distance to their k nearest exceeds 4 × the median
/// of what those have. Of a few points none is one.
/// \return one entry per point, 1 for outliers. \pre points pairwise different.
std::vector<std::uint8_t> find_outliers(std::span<const Vec3> points, const RunContext& run = {});

/// Contracts each component of the cloud's ring graph by itself.
/// \param points    pairwise different, finite.
/// \param left_out  one entry per point; 1 leaves it out (outliers).
/// \throw InvalidInput if an option is outside its range. \throw Cancelled
PointContraction contract_points(std::span<const Vec3> points,
                                 std::span<const std::uint8_t> left_out,
                                 const ContractionOptions& options = {},
                                 const RunContext& run = {});

}  // namespace vantage
