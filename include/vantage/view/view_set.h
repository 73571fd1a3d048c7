// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <tuple>
#include <vector>

#include "vantage/core/fields.h"
#include "vantage/core/run_context.h"
#include "vantage/core/vec3.h"
#include "vantage/view/scoring.h"
#include "vantage/visibility/face_visibility.h"
#include "vantage/visibility/vertex_visibility.h"

/// \file
/// Several views that together tell most, greedy by newly seen significance; what each of many views
/// sees, a bit a vertex; and a closed path over views on the view sphere. docs/view_sets.md.

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
  Count,        ///< There are as many as were asked for.
  Coverage,     ///< What was to be seen is seen, and not a number alone was asked for.
  Exhausted,    ///< No candidate far enough from the others sees anything new.
  Information,  ///< The views merged hold no more of the information than was asked for.
};

/// Result of select_views().
struct ViewSet {
  std::vector<ChosenView> views{};  ///< In the order of choice; never empty.
  double reachable = 0.0;           ///< Significance seen from any candidate or given view.
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
/// \param significance |V| finite values ≥ 0. \param first direction.
/// \throw InvalidInput, Cancelled
ViewSet select_views(const VertexVisibility& visibility, std::span<const double> significance,
                     const ScoringCamera& camera, const Vec3& first,
                     const ViewSetOptions& options = {}, const RunContext& run = {});

/// Gains, coverage and bounds of views that were chosen in some other way, in their order, up to the
/// one that reaches `options.coverage` if that is set. Of the rest uses only `options.level`.
/// \param directions at least one, of any length but 0. \throw InvalidInput, Cancelled
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

/// A closed round over directions.
struct Tour {
  std::vector<std::size_t> order{};  ///< Every index once, 0 first; of both senses the one whose
                                     ///< second index is less than its last.
  double length_rad = 0.0;           ///< Sum of the great-circle arcs, the way back included.
  bool optimal = false;              ///< Whether no shorter round exists.
};

/// The shortest round over the directions. Up to 12: exact (Held & Karp, 1962). More: nearest
/// neighbour from index 0, then 2-opt moves and moves of runs of up to three until neither shortens
/// it. \param directions at least one, of any length but 0. \throw InvalidInput, Cancelled
Tour shortest_tour(std::span<const Vec3> directions, const RunContext& run = {});

/// Where the eye stands at one moment.
struct TourPose {
  Vec3 direction = Vec3::UnitZ();  ///< Unit vector from the centre to the eye.
  Vec3 up = Vec3::UnitY();         ///< Unit, orthogonal to `direction`.
};

/// Poses at equal distances on the round: pose i is where the eye is after i / count of the way, and
/// after the last comes the first again. Arcs are great circles; opposite stops are joined along the
/// equator. The picture stays upright except near the poles, where upright turns ever faster: there
/// the roll is smoothed over the way, so that it never jumps, also for a path straight over a pole.
/// \param stops directions in order, at least two different ones. \param model_up direction.
/// \param count at least 3. \throw InvalidInput
std::vector<TourPose> tour_path(std::span<const Vec3> stops, const Vec3& model_up,
                                std::size_t count);

/// A table of bits: row i tells which vertices view i sees.
class VisibleSets {
 public:
  /// All bits clear. Takes view_count · vertex_count / 8 bytes.
  VisibleSets(std::size_t view_count, std::size_t vertex_count)
      : views_(view_count),
        vertices_(vertex_count),
        words_((vertex_count + 63) / 64),
        bits_(view_count * words_, 0) {}

  [[nodiscard]] std::size_t view_count() const { return views_; }  ///< Rows.

  [[nodiscard]] std::size_t vertex_count() const { return vertices_; }  ///< Bits in a row.

  /// Replaces the row of a view; different rows may be set on different threads.
  /// \param visible |V| values, 0 for unseen. \throw InvalidInput if that is not the size.
  void set(std::size_t view, std::span<const std::uint8_t> visible);

  /// Whether a view sees a vertex.
  [[nodiscard]] bool sees(std::size_t view, std::size_t vertex) const {
    return ((row(view)[vertex / 64] >> (vertex % 64)) & 1U) != 0;
  }

  /// Bits of a view, 64 to a word, the first vertex lowest; bits beyond |V| are 0.
  [[nodiscard]] std::span<const std::uint64_t> row(std::size_t view) const {
    return {bits_.data() + view * words_, words_};
  }

 private:
  std::size_t views_;
  std::size_t vertices_;
  std::size_t words_;
  std::vector<std::uint64_t> bits_;
};

/// What the scoring camera sees from each direction, in parallel over directions.
/// \param vertex_count |V| of the surface that `visibility` was made of.
/// \throw InvalidInput if that is not the number, or a direction points nowhere; Cancelled
VisibleSets visible_sets(const VertexVisibility& visibility, const ScoringCamera& camera,
                         std::span<const Vec3> directions, std::size_t vertex_count,
                         const RunContext& run = {});

/// By area a face has so many bits: as many of the first are set as eighths of it are seen, so that
/// several views together see of it what the one does that sees most.
inline constexpr std::size_t kBitsAFace = 8;

/// The same with kBitsAFace bits a face in place of one a vertex. \throw InvalidInput, Cancelled
VisibleSets visible_sets(const FaceVisibility& faces, const ScoringCamera& camera,
                         std::span<const Vec3> directions, const RunContext& run = {});

}  // namespace vantage
