// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <tuple>
#include <vector>

#include "vantage/core/fields.h"
#include "vantage/core/run_context.h"
#include "vantage/core/vec3.h"
#include "vantage/view/scoring.h"
#include "vantage/visibility/vertex_visibility.h"

/// \file
/// Several views that together tell most: greedy by newly seen significance. docs/view_sets.md.

namespace vantage {

/// Options of select_views().
struct ViewSetOptions {
  std::optional<int> views{};  ///< At most this many; unset: as many as `coverage` needs.
  /// Stop at this share of what any candidate sees, in (0, 1]; unset: 1.
  std::optional<double> coverage{};
  double min_separation_deg = 0.0;  ///< Between any two views, degrees, in [0, 180].
  bool refine = true;               ///< Move each view after the first to a local peak of its gain.
  int level = 4;                    ///< Candidates: the icosahedron split this often, 0–6.
};

/// The table of ViewSetOptions.
inline constexpr auto kViewSetFields = std::tuple{
    Field{"views", &ViewSetOptions::views, 1, 1000, "this many views that together see most"},
    Field{"coverage", &ViewSetOptions::coverage, 0.0, 1.0,
          "views until this share of what can be seen at all is seen, above 0"},
    Field{"min-separation", &ViewSetOptions::min_separation_deg, 0.0, 180.0,
          "least angle between two of the views", "degrees"},
    Switch{"refine", &ViewSetOptions::refine, "move views away from the 2562 candidate directions",
           "leave the views on the 2562 candidate directions"},
    Field{"view-set-level", &ViewSetOptions::level, 0, 6, kNoFlag},
};

/// One view of a set.
struct ChosenView {
  Vec3 direction = Vec3::UnitZ();  ///< Unit vector from the centre to the eye.
  double gain = 0.0;               ///< Significance that no view before it sees.
  double coverage = 0.0;           ///< Share of `reachable` seen by it and all before, in [0, 1].
};

/// Why no further view was added. None of these is an error.
enum class ViewSetStop {
  Count,      ///< There are as many as were asked for.
  Coverage,   ///< What was to be seen is seen.
  Exhausted,  ///< No candidate far enough from the others sees anything new.
};

/// Result of select_views().
struct ViewSet {
  std::vector<ChosenView> views{};  ///< In the order of choice; never empty.
  double reachable = 0.0;           ///< Significance seen from any candidate or the first view.
  ViewSetStop stop = ViewSetStop::Exhausted;  ///< Why it ended.
  int level = 4;                ///< Of the candidates; lower than asked for if memory said so.
  std::size_t candidates = 0;   ///< Directions chosen from.
  std::size_t evaluations = 0;  ///< Views looked at, candidates included.
  std::size_t least_views = 0;  ///< No set of candidates covers as much with fewer.
  double most_coverage = 1.0;   ///< No set of as many candidates covers a larger share.
};

/// Chooses views: `first`, then the candidate that sees most new significance, again and again.
/// Of equals the candidate of lowest index. With `refine` the view then moves by rings of six
/// directions that halve from 2° to 0.1°, as long as that sees strictly more and the separation
/// holds. Significance that neither a candidate nor `first` sees does not count in gains and coverage.
/// The table of candidates takes |V|/8 bytes each; where that passes 1 GiB, `level` is lowered.
/// \param significance |V| finite values ≥ 0. \param first unit vector.
/// \throw InvalidInput, Cancelled
ViewSet select_views(const VertexVisibility& visibility, std::span<const double> significance,
                     const ScoringCamera& camera, const Vec3& first,
                     const ViewSetOptions& options = {}, const RunContext& run = {});

/// Gains, coverage and bounds of views that were chosen in some other way, in their order, up to the
/// one that reaches `options.coverage` if that is set. Of the rest uses only `options.level`.
/// \param directions at least one unit vector. \throw InvalidInput, Cancelled
ViewSet measure_views(const VertexVisibility& visibility, std::span<const double> significance,
                      const ScoringCamera& camera, std::span<const Vec3> directions,
                      const ViewSetOptions& options = {}, const RunContext& run = {});

/// select_views() and measure_views() by area: what is seen are eighths of faces.
/// \param of_face face_count() finite values ≥ 0. \throw InvalidInput, Cancelled
ViewSet select_views(const FaceVisibility& faces, std::span<const double> of_face,
                     const ScoringCamera& camera, const Vec3& first,
                     const ViewSetOptions& options = {}, const RunContext& run = {});
/// As above. \throw InvalidInput, Cancelled
ViewSet measure_views(const FaceVisibility& faces, std::span<const double> of_face,
                      const ScoringCamera& camera, std::span<const Vec3> directions,
                      const ViewSetOptions& options = {}, const RunContext& run = {});

}  // namespace vantage
