// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "vantage/io/model.h"
#include "vantage/orientation/orientation.h"
#include "vantage/pipeline/shape_analysis.h"
#include "vantage/spatial/mirror_symmetry.h"
#include "vantage/view/channel.h"
#include "vantage/view/measure.h"
#include "vantage/view/scoring.h"
#include "vantage/visibility/vertex_visibility.h"

#include "pipeline/coarse_surface.h"
#include "pipeline/survey_sight.h"

/// \file
/// What views of a surface are looked for with, whatever its map: made beside the contraction.

namespace vantage {

/// What views will be looked for by, if that is known.
struct PreparedFor {
  std::optional<ScoringCamera> survey{};    ///< The camera of a survey of the coarse copy.
  std::optional<ScoringCamera> measures{};  ///< That of measures of a set of views.
  bool channel = false;                     ///< Whether these need terms of the channel.
};

/// What a set of views sees through a camera.
struct SeenBySet {
  ScoringCamera camera{};
  ViewChannel channel{};
  std::optional<ChannelTerms> terms{};  ///< If a measure needs them.
};

/// What is seen of the shape's faces from such directions. \throw Cancelled
ViewChannel channel_of(const ShapeAnalysis& shape, const ScoringCamera& camera,
                       std::span<const Vec3> directions, const RunContext& run);

/// \throw InvalidInput if one of the measures looks at a set of views, and what that sees of so many
/// faces takes more memory than there is.
void require_memory(std::span<const Measure> measures, std::size_t faces,
                    std::uint64_t memory_bytes = usable_memory_bytes());

/// Immutable; copies of an analysis share it.
struct ViewPreparation {
  /// Vertices of the coarse copy; fewer lose fingers and tails. [ours; docs/lab]
  static constexpr std::size_t kCoarseVertices = 1000;
  /// Vertices of the proxy, and above which a surface has one. [ours; docs/lab]
  static constexpr std::size_t kProxyVertices = 8000;
  static constexpr std::size_t kLargeSurface = 2 * kProxyVertices;

  /// Of the shape's surface; its history, skeleton and map are not looked at.
  /// \throw Cancelled
  explicit ViewPreparation(const ShapeAnalysis& shape, const RunContext& run = {},
                           const PreparedFor& use = {});

  VertexVisibility visibility;
  std::vector<MirrorPlane> planes;   ///< mirror_planes().
  OrientationEvidence evidence;      ///< For up and front.
  std::vector<double> vertex_areas;  ///< vertex_areas().
  /// What a search climbs on where the surface is large; empty where it is not.
  CoarseSurface proxy;
  VertexVisibility proxy_visibility;   ///< Of its mesh.
  CoarseSurface coarse;                ///< What estimates of scores look at.
  VertexVisibility coarse_visibility;  ///< Of its mesh.
  std::optional<SurveySight> survey;   ///< Of the coarse copy.
  std::optional<SeenBySet> set;        ///< Of the surface, by kMeasureSetLevel.

  /// Whether the coarse copy is so much smaller than the surface that estimates on it gain.
  [[nodiscard]] bool is_coarse() const;

  /// Whether there is a proxy, and it is so much smaller too.
  [[nodiscard]] bool has_proxy() const;
};

/// That of the shape, or one made now.
std::shared_ptr<const ViewPreparation> preparation_of(const ShapeAnalysis& shape,
                                                      const RunContext& run);

/// The visibility of the shape's, or one made now for about so many eyes.
std::shared_ptr<const VertexVisibility> visibility_of(const ShapeAnalysis& shape, std::size_t eyes);

/// The mirror planes of the shape's, or found now.
std::vector<MirrorPlane> planes_of(const ShapeAnalysis& shape);

/// What the set of views sees through this camera, if the shape's knows it; else null.
const SeenBySet* seen_by_set(const ShapeAnalysis& shape, const ScoringCamera& camera);

/// The evidence of the shape's, or gathered now.
OrientationEvidence evidence_of(const ShapeAnalysis& shape);

}  // namespace vantage
