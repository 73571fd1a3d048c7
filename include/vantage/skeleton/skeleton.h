// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <tuple>
#include <vector>

#include "vantage/contraction/history.h"
#include "vantage/core/fields.h"
#include "vantage/core/run_context.h"
#include "vantage/mesh/curve_graph.h"
#include "vantage/mesh/tri_mesh.h"

/// \file
/// From a contracted surface to a graph, and how good that is, measured against the surface: the
/// properties of Cornea et al. (2007) that can be. docs/skeleton.md explains steps and choices.

namespace vantage {

/// Options of extract_skeleton().
struct SkeletonOptions {
  ContractionScaling scaling = ContractionScaling::Sphere;  ///< What `spacing` is relative to.
  double spacing = 0.02;     ///< [r] distance of samples over D, or over the box diagonal (Cao).
  double prune_ratio = 1.0;  ///< Ends shorter than this times the radius at their root are cut.
  bool centre = true;        ///< Move nodes to the middle of the surface they stand for.
  bool prune = true;         ///< Cut spurious ends.
  bool fit = true;           ///< Lead Skeleton::curve through the contracted surface (ours).
};

/// The table of SkeletonOptions.
inline constexpr auto kSkeletonFields = std::tuple{
    Choice{"skeleton-scaling", &SkeletonOptions::scaling, "sphere|box", kNoFlag},
    Field{"skeleton-spacing", &SkeletonOptions::spacing, 1e-4, 0.5,
          "distance of skeleton samples as a fraction of the model's diameter (Cao 2010: 0.02)"},
    Field{"prune-ratio", &SkeletonOptions::prune_ratio, 0.0, 100.0,
          "cut ends shorter than this times the local thickness"},
    Switch{"prune", &SkeletonOptions::prune,
           "cut ends of the skeleton shorter than the local thickness",
           "keep ends shorter than the local thickness"},
    Switch{"centre", &SkeletonOptions::centre,
           "move skeleton nodes to the middle of what they stand for",
           "leave skeleton nodes where the contraction put them"},
    Switch{"fit", &SkeletonOptions::fit,
           "the map measures to a curve through the middle of the contracted surface",
           "the map measures to the skeleton's raw samples (the paper)"},
};

/// A curve skeleton and what each node stands for.
struct Skeleton {
  CurveGraph graph{};            ///< Finished: centred and pruned as asked.
  std::vector<double> radius{};  ///< |N| mean distance of a node to its vertices (of the
                                 ///< refined surface, if that was contracted), level 0.
  std::vector<std::uint32_t>
      node_of_vertex{};  ///< |V| nodes of `graph`; kNone where none stands for it.
  CurveGraph raw{};      ///< Before centring and pruning.
  /// What KSSM measures to: `raw`, in pieces of half the spacing that follow the contracted surface,
  /// as fine as what is left of that; or `raw` itself. Its first nodes are those of `raw`.
  CurveGraph curve{};
  /// The same of ContractionHistory::second, or empty.
  CurveGraph other_curve{};
  std::vector<std::uint32_t> raw_node_of_vertex{};  ///< |V| nodes of `raw`; kNone likewise.
  double outside_share = 0.0;  ///< Of the length of `graph` in closed components, what is outside
                               ///< their shells.
  std::vector<std::string> warnings{};  ///< One sentence each.

  /// Node of a vertex that belongs to no face.
  static constexpr std::uint32_t kNone = 0xffffffffu;
};

/// [r] in model units: a fraction of D (ours) or of the box diagonal (Cao 2010, section 4).
double sample_spacing(const TriMesh& mesh, const SkeletonOptions& options);

/// Extracts the curve skeleton of `mesh` from ContractionHistory::thinnest() of its contraction.
/// \pre `history` was computed from `mesh`. \throw InvalidInput, also beyond 1e60, Cancelled
Skeleton extract_skeleton(const TriMesh& mesh, const ContractionHistory& history,
                          const SkeletonOptions& options = {}, const RunContext& run = {});

/// As much of extract_skeleton() as KSSM measures to: Skeleton::raw, curve and other_curve. The finished
/// graph stays empty, which on parts of thin walls is most of the time. \throw InvalidInput, Cancelled
Skeleton extract_curve(const TriMesh& mesh, const ContractionHistory& history,
                       const SkeletonOptions& options = {}, const RunContext& run = {});

/// Measures of a finished skeleton. Lengths are in model units.
struct SkeletonQuality {
  double length = 0.0;          ///< Of all edges of closed components.
  double outside_length = 0.0;  ///< Of these, what is outside the own component's shell.
  double thin_outside = 0.0;    ///< Of that, on edges whose wall is thinner than r.
  std::size_t ends = 0;         ///< Nodes of one edge.
  double farthest_ratio =
      0.0;                  ///< Largest distance of a vertex to the graph over its node's radius.
  double farthest = 0.0;    ///< Largest distance of a vertex to the graph.
  double off_centre = 0.0;  ///< Mean over nodes: 1 − nearest / mean distance of its vertices.
  double seen_fraction = 0.0;  ///< Share of sampled vertices that the graph sees; 1 if all open.
};

/// Measures `skeleton.graph`. Where a component is open nothing is inside or outside: it counts in
/// `ends` and in the distances only.
/// \param component_of_vertex |V| labels. \throw InvalidInput if there are more or fewer.
/// \param thin walls below this, in model units, count as thin: r, the distance of samples.
SkeletonQuality measure_skeleton(const TriMesh& mesh,
                                 std::span<const std::uint32_t> component_of_vertex,
                                 const Skeleton& skeleton, double thin, const RunContext& run = {});

}  // namespace vantage
