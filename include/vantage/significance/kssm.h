// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <tuple>
#include <vector>

#include "vantage/contraction/history.h"
#include "vantage/core/fields.h"
#include "vantage/core/run_context.h"
#include "vantage/mesh/curve_graph.h"
#include "vantage/mesh/tri_mesh.h"
#include "vantage/skeleton/skeleton.h"

/// \file
/// The Kinematics Significance based Skeleton Map of the paper that docs/references.md names first: with
/// d^(j)(v) the distance of vertex v at contraction level j to the skeleton, D^(j) that scaled to [0, 1]
/// over the vertices, and m̄ the mean of D^(j) without its maximum,
///
///     KSSM(v) = Σ_j (1 − m̄(D^(j)))² D^(j)(v),   j = 0 … K.
///
/// Ours: where a second mesh of the surface was contracted, d^(0) is the mean of the distances to the
/// curves of both.
/// docs/kssm.md has what is ours.

namespace vantage {

/// How a level's share in the sum is lowered when its displacement is even ("Φ").
enum class Suppression {
  Mean,         ///< (1 − mean without the maximum)² (the paper).
  LocalMaxima,  ///< (1 − mean of the local maxima other than the global one)² (Itti 1998).
};

/// What is measured at each level.
enum class Kinematics {
  Displacement,  ///< d^(j), distance to the skeleton (the paper).
  Velocity,      ///< d^(j−1) − d^(j), j = 1..K, may be negative.
};

/// Options of compute_kssm().
struct KssmOptions {
  Suppression suppression = Suppression::Mean;       ///< How even levels are lowered.
  Kinematics kinematics = Kinematics::Displacement;  ///< What is summed.
  bool area_weighted_mean = false;                   ///< Weight m̄ by vertex area.
  /// Levels after the input whose displacement spans at most this fraction of D contribute nothing;
  /// 0 keeps all that span more than 1e-6 D.
  double flat_level = 0.0;
  /// Levels after the input whose displacements correlate below this with those of the surface meshed
  /// anew (ContractionHistory::second) contribute nothing, those just above it less (docs/lab has the
  /// trials). 0 keeps all (the paper).
  double level_agreement = 0.95;
};

/// The table of KssmOptions.
inline constexpr auto kKssmFields = std::tuple{
    Choice{"suppression", &KssmOptions::suppression, "mean|local-maxima",
           "what lowers the share of an even level: its mean, or its local maxima"},
    Choice{"kinematics", &KssmOptions::kinematics, "displacement|velocity",
           "what is summed: the distance to the skeleton, or its change a step"},
    Switch{"area-weighted-mean", &KssmOptions::area_weighted_mean, kNoFlag},
    Field{
        "flat-level", &KssmOptions::flat_level, 0.0, 1.0,
        "leave out levels whose displacement spans at most this fraction of the model's diameter"},
    Field{"level-agreement", &KssmOptions::level_agreement, 0.0, 1.0,
          "leave out levels on which another mesh of the surface agrees less (correlation)"},
};

/// The map and what it was made of.
struct KssmMap {
  std::vector<double> of_vertex{};                  ///< |V| values ≥ 0; 0 for isolated vertices.
  std::vector<std::vector<double>> displacement{};  ///< d^(j) per level, model units.
  /// (1 − m̄)² per level, times how much of the level counts; 0 where it is left out, and of velocities
  /// for level 0, which no step led to.
  std::vector<double> level_factor{};
  std::vector<std::size_t> levels_used{};  ///< Ascending; those that contribute.

  /// d^(0), the distance of the surface itself to the skeleton, or, of displacements, its mean to both
  /// curves; model units. \pre compute_kssm() made the map
  [[nodiscard]] const std::vector<double>& thickness() const { return displacement.front(); }
};

/// Computes the map of `mesh` from its contraction and the graph it contracts to.
/// \param other the curve of `history.second`. The input is measured to it, too, if displacements are
/// summed, and it tells which levels are the surface's and which hang on how it is meshed; without nodes
/// all count and the skeleton alone is measured to. Skeleton::curve and Skeleton::other_curve.
/// \throw InvalidInput if a coordinate is beyond 1e60 or no number, if `history` has no level or not one point a
/// vertex at each, if the skeleton has no nodes, or an option is outside its range. \throw Cancelled
/// \complexity levels · |V| · log of the skeleton's edges.
KssmMap compute_kssm(const TriMesh& mesh, const ContractionHistory& history,
                     const CurveGraph& skeleton, const KssmOptions& options = {},
                     const RunContext& run = {}, const CurveGraph& other = {});

/// The same from a skeleton: to its curve and its other_curve, as the program does it.
/// \param skeleton of extract_skeleton() or extract_curve() from the same history.
KssmMap compute_kssm(const TriMesh& mesh, const ContractionHistory& history,
                     const Skeleton& skeleton, const KssmOptions& options = {},
                     const RunContext& run = {});

/// What one level adds to the map: its displacement, or its velocity, normalised to [0, 1], times the
/// level's factor. Over all levels the summands make KssmMap::of_vertex.
/// \param map what compute_kssm() made of `mesh`, by the same kinematics.
/// \return |V| values ≥ 0; all 0 for a level that is left out.
/// \throw InvalidInput if the map has no such level or is of another mesh.
std::vector<double> level_summand(const TriMesh& mesh, const KssmMap& map, std::size_t level,
                                  Kinematics kinematics);

}  // namespace vantage
