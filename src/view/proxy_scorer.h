// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "vantage/core/run_context.h"
#include "vantage/mesh/tri_mesh.h"
#include "vantage/view/scoring.h"
#include "vantage/visibility/vertex_visibility.h"

/// \file
/// Scores estimated on a coarser surface.

namespace vantage {

/// A coarser copy of a surface whose vertices carry the significance of those merged in them, seen
/// by the same camera. Its scores follow those of the surface closely and cost a fraction.
class ProxyScorer {
 public:
  /// Nothing if the surface is so small that exact scores cost hardly more, or cannot be made much
  /// coarser. \param significance one value per vertex. \throw Cancelled
  static std::optional<ProxyScorer> make(const TriMesh& surface,
                                         const std::vector<FaceSides>& sides,
                                         std::span<const double> significance,
                                         const ScoringCamera& camera, const RunContext& run);

  /// Estimated scores, in parallel over directions. \throw Cancelled
  [[nodiscard]] std::vector<double> score_all(std::span<const Vec3> directions,
                                              const RunContext& run) const;

 private:
  struct Parts;
  explicit ProxyScorer(std::unique_ptr<Parts> parts);

  std::shared_ptr<const Parts> parts_;
};

}  // namespace vantage
