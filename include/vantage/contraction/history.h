// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "vantage/core/vec3.h"
#include "vantage/mesh/tri_mesh.h"

/// \file
/// What a contraction leaves: the surface at every level. contraction.h makes it.

namespace vantage {

/// What the weights are scaled against, so that results do not depend on the unit of length.
enum class ContractionScaling {
  Sphere,  ///< Enclosing sphere of each component to diameter 2 (ours: independent of rotation).
  Box,     ///< Longest side of each component's axis-aligned box to 1.6 (the paper's).
};

/// Why the contraction of a component ended. None of these is an error.
enum class ContractionStop {
  /// A step shrank the surface by less than the tolerance, or enlarged it; that step was discarded.
  Shrunk,
  /// The bounding box or a vertex left its bound; that step was discarded.
  Grew,
  Collapsed,      ///< A step would have run a curve to a point; that step was discarded.
  StepLimit,      ///< `max_steps` were taken.
  NothingToMove,  ///< No face with area: a point or a needle.
  SolverFailed,   ///< No regularisation gave a finite solution; that step was discarded.
};

/// Whether a surface that shrank to this share of its area [a_t] is not yet a curve. [ours: of 57 closed
/// models 51 are curves where Cao's rule stops; docs/lab]
inline bool is_sheet(double shrinkage) {
  return shrinkage > 0.04;
}

/// Whether a surface that shrank to this share of its area [a_t] is a plate if it shrinks no more: its
/// rim has become a line that holds it. [ours: of 67 closed models none keeps more than 0.07]
inline bool is_plate(double shrinkage) {
  return shrinkage > 0.1;
}

/// What happened to one connected component.
struct ComponentContraction {
  std::size_t vertices = 0;  ///< Of the component.
  int steps = 0;             ///< Accepted steps; later levels repeat the last one.
  ContractionStop stop = ContractionStop::NothingToMove;  ///< Why it ended.
  int regularised_steps = 0;  ///< Steps with the weights for slivers: once needed, they stay.
  std::vector<std::string> remedies{};  ///< What was not done as defined, a clause each.
  std::string strategy{"exact"};        ///< Which method contracted it.
  double shrinkage = 1.0;               ///< [a_t] of its last level.
};

/// A finer surface that was contracted in place of the input; the input's vertices come first.
struct ContractedRefinement {
  TriMesh mesh{};                                    ///< Model units; the new vertices come last.
  std::vector<std::vector<Vec3>> levels{};           ///< K + 1 levels of its vertices, model units.
  std::vector<std::uint32_t> component_of_vertex{};  ///< As in ContractionHistory.
  std::vector<Vec3> thinned{};                       ///< As in ContractionHistory.
};

/// The surface with some vertices merged: the same components, borders and genus, fewer faces. A skeleton that starts
/// from it need not collapse every edge of a large surface.
struct MergedSurface {
  std::size_t vertex_count = 0;            ///< Merged vertices.
  std::vector<Triangle> triangles{};       ///< Of merged vertices.
  std::vector<std::uint32_t> of_vertex{};  ///< Of each vertex, of `refinement` if there is one.
};

/// What a component's second mesh is.
enum class Remeshing : std::uint8_t {
  Coarser,  ///< Another mesh: where it contracts alike tells of the surface.
  None,     ///< The first mesh: that has fewer than 32 vertices, or took no step.
  Hardly,   ///< Nearly the first mesh: few edges could be collapsed.
};

/// A second mesh of the same surface, coarser, contracted by itself. Where the two contractions agree, they tell of
/// the surface; the rest hangs on how it is cut into triangles.
struct SecondMesh {
  TriMesh mesh{};                                    ///< Model units; vertices of its own.
  std::vector<std::vector<Vec3>> levels{};           ///< Of its vertices, model units.
  std::vector<std::uint32_t> component_of_vertex{};  ///< As in ContractionHistory.
  /// Points of the surface, next to each of its vertices, at the levels of the first contraction.
  std::vector<std::vector<Vec3>> here{};
  std::vector<std::vector<Vec3>> there{};  ///< The same points by the second contraction.
  /// Of each component; agreement tells nothing but of Coarser ones.
  std::vector<Remeshing> remeshing{};
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
  /// If some component was made of few huge faces, or holes were closed (ours).
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

}  // namespace vantage
