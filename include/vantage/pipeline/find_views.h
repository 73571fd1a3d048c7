// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "vantage/core/camera.h"
#include "vantage/core/run_context.h"
#include "vantage/core/vec3.h"
#include "vantage/io/camera_files.h"
#include "vantage/io/model.h"
#include "vantage/orientation/orientation.h"
#include "vantage/pipeline/shape_analysis.h"
#include "vantage/pipeline/view_options.h"
#include "vantage/spatial/mirror_symmetry.h"
#include "vantage/view/scoring.h"
#include "vantage/view/search.h"
#include "vantage/view/view_set.h"
#include "vantage/visibility/face_visibility.h"
#include "vantage/visibility/vertex_visibility.h"

/// \file
/// From an analysed shape to its best and worst view, and to sets of views.

namespace vantage {

/// One view and the picture's camera.
struct ReportedView {
  Vec3 direction = Vec3::UnitZ();  ///< From the centre to the eye.
  Vec3 eye = Vec3::UnitZ();        ///< Model units.
  Vec3 up = Vec3::UnitY();         ///< Unit, upright in the picture.
  /// Sum of the visible significance; by area its integral over what is seen, over the whole area; of a
  /// measure its value.
  double score = 0.0;
  double score_fraction = 0.0;         ///< score / total; 0 if total is 0, NaN of a measure.
  double objective = 0.0;              ///< What the search compared; the score, or see Objective.
  double visible_area_fraction = 0.0;  ///< Of the surface; each visible vertex counts its third.
  Camera picture{};                    ///< Same direction, in perspective same eye, framed tightly.
  PictureSize size{};                  ///< Of the picture it is framed for.
};

/// A closed way of the camera around the model.
struct CameraWay {
  std::vector<Vec3> stops{};  ///< Unit vectors from the centre to the eye, great circles between.
  double length_rad = 0.0;    ///< With the way back to the first.
  double coverage = 0.0;      ///< As Exploration has it.
};

/// Several views that together tell most, and the round over them.
struct ReportedViewSet {
  std::vector<ReportedView> views{};  ///< Of choice.views, in the same order.
  ViewSet choice{};                   ///< Gains, coverage and bounds.
  Tour tour{};                        ///< The shortest round over the views.
  std::optional<CameraWay> way{};     ///< The camera's, if it is not that round.

  /// Of what the camera does.
  [[nodiscard]] double way_rad() const { return way ? way->length_rad : tour.length_rad; }
};

/// The model's frame that a run uses, and why.
struct FrameChoice {
  ModelFrame frame{};                  ///< As used.
  Orientation orientation{};           ///< The same with sources, confidences and reasons.
  UpHabit up_habit = UpHabit::Format;  ///< Whose the usual up is.
  std::vector<std::string> notes{};    ///< One sentence for each guess, and for each unsure choice.
};

/// If options.up is Any: turns the model by standing_rotation(), adds a note with the quaternion, and
/// returns the rotation; else identity. All that follows, cameras too, is of the turned model.
Eigen::Matrix3d stand_along_axes(Model& model, const ViewOptions& options);

/// options.up and options.front where they are set; else what the shape says, or the convention of the
/// format or of land where that is unsure (glTF's up axis is a part of the format, and
/// always holds).
/// \throw InvalidInput if those given are along one axis.
FrameChoice choose_frame(const Model& model, const ShapeAnalysis& shape,
                         const ViewOptions& options);

/// "up: z, 97 % sure, by its flat base and its upright mirror plane; front: -y, 60 % sure, its format's".
std::string frame_summary(const FrameChoice& choice);

/// A view that a mirror plane of the model makes as good as the best.
struct TwinView {
  Vec3 direction = Vec3::UnitZ();  ///< From the centre to the eye.
  double score = 0.0;              ///< As the best view's.
  double objective = 0.0;          ///< As the best view's.
};

/// How far a search stayed behind the dense one, which is slow. [ours]
struct DenseGap {
  double best_ratio = 1.0;      ///< Objective of the best view found over the dense search's.
  double worst_above = 0.0;     ///< Worst score found above the dense search's, share of the range.
  std::size_t evaluations = 0;  ///< Directions that the dense search scored.
};

/// The result of the search.
struct ViewReport {
  ScoringCamera camera{};                  ///< What scored.
  UpAxis up = UpAxis::Y;                   ///< As used.
  UpAxis front = UpAxis::Z;                ///< As used.
  Orientation orientation{};               ///< Sources and confidences of both.
  ShapeProportions proportions{};          ///< In that frame.
  std::vector<TwinView> twins{};           ///< Of the best view.
  ReportedView best{};                     ///< Of the largest objective.
  ReportedView worst{};                    ///< Of the least score.
  double total = 0.0;                      ///< The score if everything were visible.
  Vec3 highest_direction = Vec3::UnitZ();  ///< The view that the score alone would take.
  double highest_score = 0.0;              ///< The best that any view attains.
  /// Of that, what the best view's score is; of measures of which less is better that over it. In
  /// [0, 1]; nothing where no view sees anything.
  std::optional<double> score_of_attainable{};
  FoundView best_search{};              ///< How it was found.
  FoundView worst_search{};             ///< Evaluations beyond the best view's.
  std::optional<DenseGap> dense_gap{};  ///< If options.certify.
  std::vector<std::string> warnings{};  ///< One sentence each.
  /// Why the answer should not be trusted, and what to do, one sentence each.
  /// Empty almost always. They are among the `warnings` of view.json.
  std::vector<std::string> reliability_warnings{};
  /// If several views were asked for.
  std::optional<ReportedViewSet> set{};
};

/// The scoring camera of a model.
ScoringCamera scoring_camera(const ShapeAnalysis& shape, const ViewOptions& options);

/// Scores views by the shape's map, as options.weight says.
class MapScorer {
 public:
  /// \param visibility of the shape's surface. Both must outlive this. \pre the map is there.
  MapScorer(const ShapeAnalysis& shape, const VertexVisibility& visibility,
            const ViewOptions& options)
      : MapScorer(shape, shape.significance, visibility, options) {}

  /// By another map of its surface, which must outlive this.
  MapScorer(const ShapeAnalysis& shape, std::span<const double> map,
            const VertexVisibility& visibility, const ViewOptions& options);
  MapScorer(const MapScorer&) = delete;
  MapScorer& operator=(const MapScorer&) = delete;

  [[nodiscard]] const ViewScorer& scorer() const { return scorer_; }  ///< Refers to this.

 private:
  std::optional<FaceVisibility> faces_;  // what scores by area ask about
  ViewScorer scorer_;
};

/// Finds the best and the worst view, and a set of views if options.view_set asks for one.
/// \throw InvalidInput if the method's map is not there. \throw Cancelled
ViewReport find_views(const ShapeAnalysis& shape, const ModelFrame& frame,
                      const ViewOptions& options, const RunContext& run = {});

/// The same as the program does it: how sure the choice is counts, where `frame` alone is taken to be
/// certain. Its notes join the warnings, last of them.
ViewReport find_views(const ShapeAnalysis& shape, const FrameChoice& choice,
                      const ViewOptions& options, const RunContext& run = {});

/// One of these two alone, for less work. \throw InvalidInput likewise, and if options.method sums no map:
/// best_view() in measured_shape.h finds the best by a measure; Cancelled
ReportedView find_view(const ShapeAnalysis& shape, Goal goal, const FrameChoice& choice,
                       const ViewOptions& options, const RunContext& run = {});

/// Why a best view should not be trusted that shows none of what counts, a sentence; empty where it shows
/// some of it, or nothing counts. \pre the map is there.
std::string blank_view_warning(const ShapeAnalysis& shape, const ReportedView& best,
                               const ViewOptions& options);

/// A view that is found for its picture.
struct PictureView {
  ReportedView view{};       ///< Framed on the whole surface, or its focus.
  FrameChoice choice{};      ///< As used.
  std::size_t vertices = 0;  ///< Of the surface that was analysed.
  std::string warning{};     ///< blank_view_warning().
};

/// The best view of a prepared surface, for a picture of it. A surface of more than 200 000 vertices
/// is decimated to half as many before it is analysed, so that the view may differ a little from
/// find_views(). \throw Cancelled
PictureView find_picture_view(const Model& model, const ShapeAnalysis& prepared,
                              const ViewOptions& options, const RunContext& run = {});

/// Describes the view from a given direction, of any length but 0. \pre the map is there.
/// \throw InvalidInput, Cancelled
ReportedView describe_view(const ShapeAnalysis& shape, const VertexVisibility& visibility,
                           const ScoringCamera& camera, const Vec3& direction, UpAxis up,
                           const ViewOptions& options, const RunContext& run = {});

/// Chooses several views as options.view_set asks. \pre the map is there, and options.view_set.
/// \param scorer by the shape's map and options.weight. \param best the best view, where the choice by
/// significance begins. \param warnings receives what did not go as asked for.
/// \throw InvalidInput, Cancelled
ReportedViewSet find_view_set(const ShapeAnalysis& shape, const VertexVisibility& visibility,
                              const ViewScorer& scorer, const Vec3& best, const ModelFrame& frame,
                              const ViewOptions& options, std::vector<std::string>& warnings,
                              const RunContext& run = {});

/// Cameras along the tour of a set, or its way, `count` at equal distances, all with the field of view that
/// shows the whole surface, or its focus, from every one of them. \pre at least two different views.
/// \param aspect width over height, > 0. \param margin_percent empty border, of the shorter side, in [0, 50).
/// \throw InvalidInput if an argument is outside its range, or the views are all the same; count is at least 3
std::vector<Camera> tour_cameras(const ShapeAnalysis& shape, const ReportedViewSet& set,
                                 const ScoringCamera& camera, UpAxis up, double aspect,
                                 std::size_t count, double margin_percent = 4.0);

/// What a picture shows, and its size.
struct PictureFrame {
  Camera camera{};     ///< Framed on the whole surface, or its focus.
  PictureSize size{};  ///< Of the picture that it is framed for.
};

/// The picture from a direction: of options.width × options.height, or, if options.fit_size, of as
/// many pixels and the aspect of what is seen, between 1:2 and 2:1. [ours] \throw InvalidInput if the
/// direction is zero or not finite, or no picture from so near could show all
PictureFrame frame_picture(const ShapeAnalysis& shape, const Vec3& direction, UpAxis up,
                           const ViewOptions& options);

/// Refuses an eye so near that no picture could show all of a ball, which a model may be; a focus may be
/// small. \throw InvalidInput
void check_framing(const ViewOptions& options);

/// A picture of about options.width × options.height pixels with that aspect (width over height),
/// no side longer than 16384.
PictureSize size_with_aspect(const ViewOptions& options, double aspect);

/// The same options for a picture of exactly that size.
ViewOptions with_size(ViewOptions options, PictureSize size);

/// A view's camera for a picture of another size: it shows all that the view's own picture does.
Camera camera_for(const ReportedView& view, PictureSize size);

}  // namespace vantage
