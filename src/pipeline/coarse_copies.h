// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>

#include "vantage/core/run_context.h"
#include "vantage/pipeline/shape_analysis.h"
#include "vantage/view/scoring.h"
#include "vantage/visibility/vertex_visibility.h"

#include "pipeline/coarse_surface.h"
#include "pipeline/survey_sight.h"

namespace vantage {

/// The proxy of a large surface: what a search climbs on, and a copy is moved of. Empty for others.
/// \throw Cancelled
CoarseSurface proxy_of_large(const ShapeAnalysis& shape, const RunContext& run);

/// What estimates of a surface's scores look at. Immutable.
struct CoarseCopies {
  /// Vertices of the coarse copy; fewer lose fingers and tails. [ours; docs/lab]
  static constexpr std::size_t kCoarseVertices = 1000;
  /// Vertices of the proxy, and above which a surface has one. [ours; docs/lab]
  static constexpr std::size_t kProxyVertices = 8000;
  static constexpr std::size_t kLargeSurface = 2 * kProxyVertices;

  /// \param survey_by the camera of a survey of the coarse copy, if there will be one.
  /// \throw Cancelled
  explicit CoarseCopies(const ShapeAnalysis& shape, const RunContext& run = {},
                        const std::optional<ScoringCamera>& survey_by = {});

  CoarseSurface proxy;                  ///< proxy_of_large().
  VertexVisibility proxy_visibility;    ///< Of its mesh.
  CoarseSurface coarse;                 ///< Of the proxy if there is one.
  VertexVisibility coarse_visibility;   ///< Of its mesh.
  std::optional<SurveySight> survey{};  ///< Of the coarse copy.

  /// Whether the coarse copy is so much smaller than the surface that estimates on it gain.
  [[nodiscard]] bool is_coarse() const;

  /// Whether there is a proxy, and it is so much smaller too.
  [[nodiscard]] bool has_proxy() const;

  /// Whether the surface is much larger than a coarse copy, but cannot be made so much coarser.
  [[nodiscard]] bool is_sampled() const;

  /// Icosahedron level of a survey: lower where a look costs ten times as much as at surfaces of one skin,
  /// or the coarse copy remained several times as large as it was to become.
  [[nodiscard]] int survey_level() const;
};

}  // namespace vantage
