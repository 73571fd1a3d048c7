// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

#include "vantage/mesh/measures.h"
#include "vantage/mesh/tri_mesh.h"

namespace vantage {

/// What is wrong with a step.
enum class StepFlaw {
  None,
  Unsolved,   ///< No finite solution.
  Grew,       ///< A side of the box, or a vertex's way from the middle, outgrew its bound.
  Rose,       ///< The surface has more area than before [a_t].
  Collapsed,  ///< A curve, or a part of it, ran to a point.
};

/// What bounds how far a step may reach.
enum class StepBound {
  BoxAndSphere,  ///< Of a step as it is defined.
  Box,           ///< Of one that was made more safely, and of clouds.
};

/// Tells sound steps from others, which are not to be kept [ours; the paper discards only steps that
/// outgrow the box].
class Soundness {
 public:
  /// A vertex that a tree through the surface goes through.
  struct Sample {
    std::size_t vertex = 0;
    double spacing = 0.0;  ///< From those before it, at the start.
  };

  /// \param start a component of diameter about 2.
  explicit Soundness(const TriMesh& start);

  /// \param before, after what the step leads from and to. \param shrinkage_before,
  /// shrinkage_after their a_t.
  [[nodiscard]] StepFlaw flaw(const TriMesh& before, const std::vector<Vec3>& after,
                              double shrinkage_before, double shrinkage_after,
                              StepBound bound) const;

 private:
  [[nodiscard]] bool outgrown(const std::vector<Vec3>& now, StepBound bound) const;
  [[nodiscard]] bool collapsed(const TriMesh& before, const std::vector<Vec3>& after) const;

  Sphere sphere_;
  Vec3 largest_;
  std::vector<Sample> samples_;  ///< Vertices spread over the start.
};

}  // namespace vantage
