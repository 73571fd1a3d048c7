// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "vantage/contraction/contraction.h"
#include "vantage/contraction/point_contraction.h"
#include "vantage/core/camera.h"
#include "vantage/core/image.h"
#include "vantage/core/run_context.h"
#include "vantage/io/model.h"
#include "vantage/mesh/mesh_check.h"
#include "vantage/mesh/tri_mesh.h"
#include "vantage/render/render.h"
#include "vantage/report/view_set_request.h"
#include "vantage/significance/kssm.h"
#include "vantage/significance/mesh_saliency.h"
#include "vantage/skeleton/skeleton.h"
#include "vantage/view/prior.h"
#include "vantage/view/scoring.h"
#include "vantage/view/search.h"
#include "vantage/view/tour.h"
#include "vantage/view/view_set.h"
#include "vantage/visibility/vertex_visibility.h"

/// \file
/// The whole method, from a model to its best and worst view. Each step is also a function of its
/// own module; this is the order in which the program runs them.

namespace vantage {

/// A named set of choices.
enum class Preset {
  Default,  ///< Ours wherever the specification gives two.
  Paper,    ///< The paper's: box scaling, cube of 8, rapid search, ε = 0.1 as a raw sum.
};

/// The model's up axis.
enum class UpAxis { X, Y, Z, MinusX, MinusY, MinusZ };

/// Unit vector of an axis.
Vec3 up_vector(UpAxis axis);
/// Names of UpAxis, and of none.
inline constexpr const char* kUpWords = "x|y|z|-x|-y|-z|auto";
/// "x", "-y", …
std::string_view up_name(UpAxis axis);
/// The axis a format implies when nothing is said: z for STL and 3MF, y otherwise.
UpAxis default_up(ModelFormat format);

/// Everything that shapes the result of a view.
struct ViewOptions {
  Preset preset = Preset::Default;      ///< What the options began as.
  ContractionOptions contraction{};     ///< Of the surface.
  SkeletonOptions skeleton{};           ///< Of the graph.
  KssmOptions kssm{};                   ///< Of the map.
  MeshSaliencyOptions saliency{};       ///< Of the map, if `method` is mesh-saliency.
  std::string method = "kssm";          ///< The measure of a view: see find_measure().
  Weight weight = Weight::Vertex;       ///< What scores add up; Area also sets kssm's mean.
  bool kssm_to_finished_graph = false;  ///< Measure to the centred, pruned graph (not the raw one).
  SearchOptions search{};               ///< Of the view sphere.
  bool certify = false;                 ///< Also search densely and report the gap to that.
  ViewPrior prior = upright_prior();    ///< Multiplies the best view's score in the search.
  Projection projection = Projection::Perspective;  ///< Of the scoring camera.
  double fov_y_deg = 30.0;                          ///< Of the scoring camera, in (0, 180).
  std::optional<double> distance_factor{};          ///< Eye distance over D/2, > 1.
  std::optional<UpAxis> up{};                       ///< Unset: choose_up().
  int width = 800;                                  ///< Of pictures, px.
  int height = 600;                                 ///< Of pictures, px.
  double margin_percent = 4.0;                      ///< Of pictures, of the shorter side, [0, 50).
  bool pictures = true;                             ///< Whether view.json names pictures.
  /// Several views besides best and worst.
  std::optional<ViewSetRequest> view_set{};
  /// Object whose significance alone counts, see focus.h; empty: all.
  std::string focus{};
};

/// Sets both sides of pictures from "800x600" or "600". \throw InvalidInput
void set_size(ViewOptions& options, std::string_view text);
/// "800x600".
std::string size_text(const ViewOptions& options);
/// Sets the prior from "none", "upright" or the name of a file. \throw IoError, FormatError
void set_prior(ViewOptions& options, std::string_view text);
/// The name of the prior.
std::string prior_text(const ViewOptions& options);

/// The table of ViewOptions. Presets come first: they set what the others then change.
inline constexpr auto kViewFields = std::tuple{
    Group{"method", "Method"},
    Choice{"preset", &ViewOptions::preset, "default|paper",
           "default: our choices; paper: the paper's"},
    Word{"method", &ViewOptions::method, kNoFlag},
    Group{"method", "Details of contraction and skeleton"},
    Part{&ViewOptions::contraction, kContractionFields},
    Part{&ViewOptions::skeleton, kSkeletonFields},
    Group{"map", "Method"},
    Word{"focus", &ViewOptions::focus,
         "only this object's significance counts, the others still hide it: name or number as "
         "listed by info",
         TextForm::Name},
    Choice{"weight", &ViewOptions::weight, "vertex|area",
           "what counts: vertices, or the surface they stand for, however it is cut into faces"},
    Part{&ViewOptions::kssm, kKssmFields},
    Choice{"graph", &ViewOptions::kssm_to_finished_graph, "raw|finished",
           "skeleton that distances are taken to: before or after centring and pruning"},
    Group{"saliency", "Mesh saliency"},
    Part{&ViewOptions::saliency, kMeshSaliencyFields},
    Group{"camera", "Camera"},
    Choice{"projection", &ViewOptions::projection, "perspective|orthographic",
           "of the scoring camera"},
    Field{"distance", &ViewOptions::distance_factor, 1.001, 1e6,
          "eye to centre, in radii of the enclosing sphere; unset: the sphere fills the view"},
    Field{"fov", &ViewOptions::fov_y_deg, 1.0, 170.0,
          "vertical field of view of the scoring camera", "degrees"},
    Choice{"up", &ViewOptions::up, kUpWords,
           "up axis of the model; auto: z for STL, y otherwise, unless the model clearly stands on "
           "the other"},
    Group{"search", "Search"},
    Part{&ViewOptions::search, kSearchFields},
    Text{"prior", set_prior, prior_text,
         "what the best view's score is multiplied by: none (as preset paper has it), upright (how "
         "people look at things), or a JSON file",
         TextForm::File},
    Switch{"certify", &ViewOptions::certify,
           "search densely as well, and report how far the views found are behind; slow"},
    Group{"size", "Pictures"},
    Text{"size", set_size, size_text,
         "size of pictures in pixels: WIDTHxHEIGHT, or one number for a square", TextForm::Size},
    Switch{"pictures", &ViewOptions::pictures, kNoFlag},
    Group{"look", "Pictures"},
    Field{"margin", &ViewOptions::margin_percent, 0.0, 45.0, "empty border around the model",
          "per cent of the picture's shorter side"},
    Group{"set", "Several views"},
    Part{&ViewOptions::view_set, kViewSetRequestFields},
};

/// The options a preset stands for.
ViewOptions preset_options(Preset preset);

/// Wall-clock seconds of each stage.
struct StageSeconds {
  double load = 0.0;      ///< Reading the file.
  double contract = 0.0;  ///< Repairs and contraction.
  double skeleton = 0.0;  ///< Surgery, centring, pruning; and what views still wait for then.
  double map = 0.0;       ///< Distances and their sum.
  double search = 0.0;    ///< Both views.
  double render = 0.0;    ///< Pictures.
  double total = 0.0;     ///< Of everything.
};

/// What a point cloud needs besides a surface.
struct CloudAnalysis {
  std::vector<std::uint8_t> outlier{};  ///< One entry per vertex of the surface.
  PointContraction contraction{};       ///< Its history of all points moves to the analysis.
};

/// What views of a surface are looked for with, whatever its map; not for callers to look into.
struct ViewPreparation;

/// The surface as the method works on it, and what it found out about its shape.
struct ShapeAnalysis {
  TriMesh surface{};                            ///< Welded, closed shells turned outwards.
  std::vector<FaceSides> sides{};               ///< One per component of `surface`.
  std::vector<std::uint32_t> surface_vertex{};  ///< For each input vertex its one in `surface`.
  MeshReport check{};                           ///< Of the welded surface.
  Sphere sphere{};                              ///< Smallest around all referenced vertices.
  ContractionHistory history{};                 ///< Filled by add_history().
  Skeleton skeleton{};                          ///< Filled by add_skeleton().
  KssmMap map{};                                ///< Filled by add_map().
  std::vector<std::string> warnings{};   ///< Every repair and uncertainty, one sentence each.
  std::optional<CloudAnalysis> cloud{};  ///< Set if the model has no faces.
  /// Of `surface`, filled by analyse_shape() for views. Where it is missing, what looks for views
  /// makes it; whoever changes `surface` resets it.
  std::shared_ptr<const ViewPreparation> views{};
};

/// Welds and orients the model's surface; the only place that repairs, and it lists every repair.
/// Leaves history, skeleton and map empty.
/// The points of a model without faces are joined by their local Delaunay rings.
/// \throw InvalidInput if the model has no extent; Cancelled
ShapeAnalysis prepare_surface(const Model& model, const RunContext& run = {});

/// Adds the contraction history to a prepared surface. \throw Cancelled
void add_history(ShapeAnalysis& shape, const ViewOptions& options, const RunContext& run = {});
/// Adds the skeleton. \pre history is there. \throw Cancelled
void add_skeleton(ShapeAnalysis& shape, const ViewOptions& options, const RunContext& run = {});
/// Adds the significance map. \pre skeleton is there. \throw Cancelled
void add_map(ShapeAnalysis& shape, const ViewOptions& options, const RunContext& run = {});

/// What an analysis is made for.
enum class AnalysisUse {
  Views,  ///< Views will be looked for: what that needs is made beside the contraction.
  Map,    ///< The map and the skeleton are all that is wanted.
};

/// All of the above; `seconds` receives the stage times if not null.
ShapeAnalysis analyse_shape(const Model& model, const ViewOptions& options,
                            const RunContext& run = {}, StageSeconds* seconds = nullptr,
                            AnalysisUse use = AnalysisUse::Views);

/// All of it but prepare_surface(), whose result it takes.
ShapeAnalysis analyse_surface(ShapeAnalysis prepared, const ViewOptions& options,
                              const RunContext& run = {}, StageSeconds* seconds = nullptr,
                              AnalysisUse use = AnalysisUse::Views);

/// A per-vertex field of the surface carried to the input's vertices; isolated ones get 0.
std::vector<double> on_input_vertices(const ShapeAnalysis& shape, std::span<const double> field);

/// Skeleton node of each input vertex; −1 for vertices without faces.
std::vector<std::int64_t> nodes_of_input_vertices(const ShapeAnalysis& shape);

/// One view and the picture's camera.
struct ReportedView {
  Vec3 direction = Vec3::UnitZ();      ///< From the centre to the eye.
  Vec3 eye = Vec3::UnitZ();            ///< Model units.
  Vec3 up = Vec3::UnitY();             ///< Unit, upright in the picture.
  double score = 0.0;                  ///< Pure sum of the visible significance.
  double score_fraction = 0.0;         ///< score / total; 0 if total is 0.
  double objective = 0.0;              ///< What the search compared: score times the prior.
  double visible_area_fraction = 0.0;  ///< Of the surface; each visible vertex counts its third.
  Camera picture{};                    ///< Same eye, framed tightly.
};

/// Several views that together tell most, and the round over them.
struct ReportedViewSet {
  std::vector<ReportedView> views{};  ///< Of choice.views, in the same order.
  ViewSet choice{};                   ///< Gains, coverage and bounds.
  Tour tour{};                        ///< The shortest round over the views.
};

/// The up axis that a run uses, and why.
struct UpChoice {
  UpAxis axis = UpAxis::Y;        ///< As used.
  std::string source = "format";  ///< "given", "format", or "stance": how the model stands.
  std::string note{};             ///< One sentence if it is a guess, else empty.
};

/// options.up if set; else default_up(), unless the model clearly stands with the other of y and z
/// up and not with that one (never for glTF, whose up axis is a part of the format).
UpChoice choose_up(const Model& model, const ShapeAnalysis& shape, const ViewOptions& options);

/// A view that a mirror plane of the model makes as good as the best.
struct TwinView {
  Vec3 direction = Vec3::UnitZ();  ///< From the centre to the eye.
  double score = 0.0;              ///< Pure sum of the visible significance.
  double objective = 0.0;          ///< Times the prior.
};

/// How far a search stayed behind the dense one, which is slow. [ours]
struct DenseGap {
  double best_ratio = 1.0;      ///< Objective of the best view found over the dense search's.
  double worst_above = 0.0;     ///< Worst score found above the dense search's, share of the range.
  std::size_t evaluations = 0;  ///< Directions that the dense search scored.
};

/// The result of the search.
struct ViewReport {
  ScoringCamera camera{};               ///< What scored.
  UpAxis up = UpAxis::Y;                ///< As used.
  std::string up_source = "given";      ///< As in UpChoice.
  std::vector<TwinView> twins{};        ///< Of the best view.
  ReportedView best{};                  ///< Of the largest score.
  ReportedView worst{};                 ///< Of the least score.
  double total = 0.0;                   ///< The score if everything were visible.
  FoundView best_search{};              ///< How it was found.
  FoundView worst_search{};             ///< Evaluations beyond the best view's.
  std::optional<DenseGap> dense_gap{};  ///< If options.certify.
  std::vector<std::string> warnings{};  ///< One sentence each.
  /// If several views were asked for.
  std::optional<ReportedViewSet> set{};
};

/// The scoring camera of a model.
ScoringCamera scoring_camera(const ShapeAnalysis& shape, const ViewOptions& options);

/// The samples that scores by area need; nothing for other weights.
std::optional<FaceVisibility> faces_to_score(const ShapeAnalysis& shape,
                                             const ViewOptions& options);

/// Finds the best and the worst view, and a set of views if options.view_set asks for one.
/// \pre the map is there. \throw Cancelled
ViewReport find_views(const ShapeAnalysis& shape, UpAxis up, const ViewOptions& options,
                      const RunContext& run = {});

/// The same with an up axis that was chosen; its note joins the warnings.
ViewReport find_views(const ShapeAnalysis& shape, const UpChoice& up, const ViewOptions& options,
                      const RunContext& run = {});

/// One of these two alone, for less work. \throw Cancelled
ReportedView find_view(const ShapeAnalysis& shape, Goal goal, const UpChoice& up,
                       const ViewOptions& options, const RunContext& run = {});

/// A view that is found for its picture.
struct PictureView {
  ReportedView view{};       ///< Framed on the whole surface.
  UpChoice up{};             ///< As used.
  std::size_t vertices = 0;  ///< Of the surface that was analysed.
};

/// The best view of a prepared surface, for a picture of it. A surface of more than 200 000 vertices
/// is decimated to half as many before it is analysed, so that the view may differ a little from
/// find_views(). \throw Cancelled
PictureView find_picture_view(const Model& model, const ShapeAnalysis& prepared,
                              const ViewOptions& options, const RunContext& run = {});

/// Describes the view from a given direction. \pre the map is there.
ReportedView describe_view(const ShapeAnalysis& shape, const VertexVisibility& visibility,
                           const ScoringCamera& camera, const Vec3& direction, UpAxis up,
                           const ViewOptions& options);

/// Chooses several views as options.view_set asks. \pre the map is there, and options.view_set.
/// \param best the best view, where the choice by significance begins.
/// \param warnings receives what did not go as asked for. \throw InvalidInput, Cancelled
ReportedViewSet find_view_set(const ShapeAnalysis& shape, const VertexVisibility& visibility,
                              const ScoringCamera& camera, const Vec3& best, UpAxis up,
                              const ViewOptions& options, std::vector<std::string>& warnings,
                              const RunContext& run = {});

/// The same with a scorer that is there already. \pre it adds up options.weight.
ReportedViewSet find_view_set(const ShapeAnalysis& shape, const VertexVisibility& visibility,
                              const ViewScorer& scorer, const Vec3& best, UpAxis up,
                              const ViewOptions& options, std::vector<std::string>& warnings,
                              const RunContext& run = {});

/// Cameras along the tour of a set, `count` at equal distances, all with the field of view that
/// shows the whole surface from every one of them. \pre at least two different views.
/// \param aspect width over height.
std::vector<Camera> tour_cameras(const ShapeAnalysis& shape, const ReportedViewSet& set,
                                 const ScoringCamera& camera, UpAxis up, double aspect,
                                 std::size_t count);

/// What a picture of a view shows.
enum class Picture { Plain, Map, Skeleton };

/// Takes a picture with `camera`. \throw Cancelled
/// \param background unset: transparent.
Image take_picture(const ShapeAnalysis& shape, const Camera& camera, Picture picture,
                   const ViewOptions& options, const std::optional<Rgb8>& background = {},
                   const RunContext& run = {});

/// Takes a picture with any look; its size is that of `options`. \throw Cancelled
/// \param asset what the shape was made from: a plain picture shows it in its own colours and
/// materials; null for clay.
Image draw_picture(const ShapeAnalysis& shape, const Camera& camera, Picture picture,
                   const ViewOptions& options, RenderOptions look, const RunContext& run = {},
                   const Model* asset = nullptr);

/// The same in 16 bit a channel. \throw Cancelled
DeepImage draw_picture_deep(const ShapeAnalysis& shape, const Camera& camera, Picture picture,
                            const ViewOptions& options, RenderOptions look,
                            const RunContext& run = {}, const Model* asset = nullptr);

/// view.json: the same bytes for the same input, options and version.
/// \param seconds adds the times, for `--json`; null for the file.
std::string view_json(const Model& model, const ShapeAnalysis& shape, const ViewReport& report,
                      const ViewOptions& options, const StageSeconds* seconds = nullptr);

/// timings.json: the stage seconds alone.
std::string timings_json(const StageSeconds& seconds);

/// The search's evaluated directions as CSV: goal,step,level,dx,dy,dz,score.
std::string trace_csv(const ViewReport& report);

/// Sixteen hex digits that change when an option that shapes the result does.
std::string options_hash(const ViewOptions& options);

}  // namespace vantage
