// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "vantage/contraction/contraction.h"
#include "vantage/core/run_context.h"
#include "vantage/mesh/tri_mesh.h"

namespace vantage {

/// Which method contracted a component.
struct ContractionStrategy {
  std::string method{"exact"};  ///< Or "direct", "points", "proxy" and its vertices.
  std::size_t refined_to = 0;   ///< Vertices of the finer surface that the method began with, or 0.
  std::size_t finer_copy = 0;   ///< Vertices of the one that was contracted instead at last, or 0.
  bool is_thinned = false;      ///< Contracted further for the skeleton alone.
};

/// The levels of one connected surface without isolated vertices, in its own scaled frame.
struct ComponentHistory {
  std::vector<std::vector<Vec3>> levels{};  ///< Scaled positions; level 0 is the input.
  std::vector<double> shrinkage{};          ///< [a_t] per level.
  std::vector<Vec3>
      thinned{};  ///< What ContractionHistory::thinned has of it; empty: the last level.
  ComponentContraction summary{};  ///< summarise() fills in its `strategy` and `shrinkage`.
  ContractionStrategy strategy{};
  bool is_stuck = false;     ///< Ended far from a curve because no way to take a step was sound.
  bool was_unsound = false;  ///< An early step was not sound as it is defined.
};

/// W_L of the first step for faces of this mean area (Cao 2010).
inline double first_contraction(double mean_face_area) {
  return 1.0 / (10.0 * std::sqrt(mean_face_area));
}

/// What makes the steps those of the surface, however it is cut into triangles: vertices count by
/// the area around them, as if there were a given number of even ones [ours: docs/contraction.md].
/// Empty: each vertex counts alike, as Cao has it.
struct EvenShares {
  std::vector<double> count{};  ///< Even vertices that each vertex stands for; > 0.
  double mean_face_area = 0.0;  ///< Of the faces of so many even vertices.
  double first_pull = 1.0;      ///< Factor on the first W_L.
  double least_progress = 0.0;  ///< A step that takes off a smaller share of a plate ends it.

  [[nodiscard]] bool empty() const { return count.empty(); }

  [[nodiscard]] double first_contraction() const {
    return first_pull * vantage::first_contraction(mean_face_area);
  }
};

class StepSolver;

/// The shares of a surface; empty if it has no area.
EvenShares even_shares(const TriMesh& mesh);

/// What all steps of a component begin with.
enum class StepWeights {
  AsDefined,
  ForSlivers,  ///< Safer ones, which others resort to.
};

/// Contracts one component already scaled as options.scaling says (docs/contraction.md).
/// \param weights those that all steps begin with.
/// \pre every vertex belongs to a face, no face names a vertex twice. \throw Cancelled
ComponentHistory contract_component(const TriMesh& scaled, const ContractionOptions& options,
                                    const RunContext& run, const EvenShares& shares = {},
                                    StepWeights weights = StepWeights::AsDefined);

/// The same. \param solver of `scaled` with shares of the same counts: several contractions share what it finds.
ComponentHistory contract_component(const TriMesh& scaled, const ContractionOptions& options,
                                    const RunContext& run, const EvenShares& shares,
                                    StepWeights weights, StepSolver& solver);

}  // namespace vantage
