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

#include "pipeline/coarse_copies.h"

/// \file
/// What views of a surface are looked for with, whatever its map: made beside the contraction.

namespace vantage {

/// What views will be looked for by, if that is known.
struct PreparedFor {
  std::optional<ScoringCamera> survey{};    ///< The camera of a search that estimates scores.
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
  /// Eyes that a search asks the surface about, more or less.
  static constexpr std::size_t kEyes = 300;

  /// Of the shape's surface; its history, skeleton and map are not looked at.
  /// \throw Cancelled
  explicit ViewPreparation(const ShapeAnalysis& shape, const RunContext& run = {},
                           const PreparedFor& use = {});

  VertexVisibility visibility;
  std::vector<MirrorPlane> planes;               ///< mirror_planes().
  OrientationEvidence evidence;                  ///< For up and front.
  std::vector<double> vertex_areas;              ///< vertex_areas().
  std::shared_ptr<const CoarseCopies> copies{};  ///< Null unless a search will estimate scores.
  std::optional<SeenBySet> set{};                ///< Of the surface, by kMeasureSetLevel.
};

/// The copies of the shape's, or made now. \throw Cancelled
std::shared_ptr<const CoarseCopies> copies_of(const ShapeAnalysis& shape, const RunContext& run);

/// The proxy alone.
CoarseSurface proxy_of(const ShapeAnalysis& shape, const RunContext& run);

/// The visibility of the shape's, or one made now for about so many eyes.
std::shared_ptr<const VertexVisibility> visibility_of(const ShapeAnalysis& shape, std::size_t eyes);

/// The mirror planes of the shape's, or found now.
std::vector<MirrorPlane> planes_of(const ShapeAnalysis& shape);

/// What the set of views sees through this camera, if the shape's knows it; else null.
const SeenBySet* seen_by_set(const ShapeAnalysis& shape, const ScoringCamera& camera);

/// The evidence of the shape's, or gathered now.
OrientationEvidence evidence_of(const ShapeAnalysis& shape);

}  // namespace vantage
