// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <tuple>

#include "vantage/contraction/contraction.h"
#include "vantage/core/camera.h"
#include "vantage/core/fields.h"
#include "vantage/core/vec3.h"
#include "vantage/io/model.h"
#include "vantage/significance/kssm.h"
#include "vantage/significance/mesh_saliency.h"
#include "vantage/skeleton/skeleton.h"
#include "vantage/view/prior.h"
#include "vantage/view/scoring.h"
#include "vantage/view/search.h"
#include "vantage/view/view_set.h"

/// \file
/// Everything that shapes the result of a view, and its table.

namespace vantage {

/// A named set of choices.
enum class Preset {
  Default,  ///< Ours wherever it differs from the paper's.
  Paper,    ///< The paper's: box scaling, cube of 8, rapid search, ε = 0.1 as a raw sum.
};

/// Longest side of a picture, px.
inline constexpr int kLargestSide = 16384;

/// What the best view maximises.
enum class Objective {
  Significance,  ///< The score alone [paper].
  People,        ///< How likely a person would show this shape from there; docs/people.md.
};

/// The model's up axis. Any: it may be off the axes; stand_along_axes() turns the model, then it is sought.
enum class UpAxis { X, Y, Z, MinusX, MinusY, MinusZ, Any };

/// Unit vector of an axis. \pre it is not Any.
Vec3 up_vector(UpAxis axis);
/// Names of UpAxis, and of none.
inline constexpr const char* kUpWords = "x|y|z|-x|-y|-z|any|auto";
inline constexpr const char* kFrontWords = "x|y|z|-x|-y|-z|auto";  ///< The same of a front.
/// "x", "-y", …
std::string_view up_name(UpAxis axis);
/// The axis a format implies when nothing is said: z for STL, 3MF and AMF, y otherwise.
UpAxis default_up(ModelFormat format);
/// The same for a model, which may say it itself, or be land, whose height is up.
UpAxis default_up(const Model& model);
/// Where a usual up comes from: the format or the file, or that the model is land in coordinates of a map, or a
/// height field.
enum class UpHabit { Format, MapCoordinates, HeightField };
/// What most files of that up axis mean by the front: upright_frame()'s.
UpAxis default_front(UpAxis up);
/// The axis nearest to a direction. \throw InvalidInput if that is zero or not finite
UpAxis axis_nearest(const Vec3& direction);

/// Two axes of a model's own frame; the third is to the right of a viewer in front.
struct ModelFrame {
  UpAxis up = UpAxis::Y;     ///< Against gravity.
  UpAxis front = UpAxis::Z;  ///< Toward a viewer in front; at right angles to up.

  ModelFrame() = default;

  /// With the front that most files of that up axis mean: default_front(). \throw InvalidInput for Any
  explicit ModelFrame(UpAxis its_up);
  /// \throw InvalidInput unless they are axes at right angles.
  ModelFrame(UpAxis its_up, UpAxis its_front);
};

/// The same as unit vectors. \throw InvalidInput if they are not at right angles
UprightFrame upright_frame(const ModelFrame& frame);

/// How several views are chosen.
enum class ViewSelection {
  Kssm,     ///< The best view, then greedy by newly seen significance.
  Vazquez,  ///< Greedy by the entropy of faces not yet seen.
  Feixas,   ///< Greedy merge by viewpoint mutual information.
};

/// Names of ViewSelection.
inline constexpr const char* kSelectionWords = "kssm|vazquez|feixas";
/// "kssm", "vazquez" or "feixas".
std::string_view selection_name(ViewSelection selection);

/// Which way the camera takes around the model.
enum class TourPath {
  Round,    ///< The shortest closed path over the views.
  Explore,  ///< explore_by_entropy() from the best view, and back to it.
};

/// Several views: how many, and chosen how.
struct ViewSetRequest {
  ViewSetOptions set{};                           ///< Number, coverage, separation.
  ViewSelection selection = ViewSelection::Kssm;  ///< The others look at `set.views` alone.
  double information = 0.0;         ///< Feixas: stop at this share of I(V;Z); 0: by number alone.
  TourPath path = TourPath::Round;  ///< Of the camera.
};

/// The table of ViewSetRequest.
inline constexpr auto kViewSetRequestFields = std::tuple{
    Part{&ViewSetRequest::set, kViewSetFields},
    Choice{"select", &ViewSetRequest::selection, kSelectionWords,
           "kssm: newly seen significance; vazquez: entropy of unseen faces; feixas: merging by "
           "mutual information"},
    Field{"information", &ViewSetRequest::information, 0.0, 1.0,
          "feixas: stop when the merged view's information falls to this share of the channel's"},
    Choice{"tour-path", &ViewSetRequest::path, "round|explore",
           "round: the shortest over the views; explore: from the best view always to where most "
           "entropy of unseen faces is, until the coverage, or 0.95, is seen"},
};

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
  Objective objective = Objective::People;  ///< Of the best view; see objective_of().
  ViewPrior prior = no_prior();             ///< Multiplies the score if the objective is that.
  Projection projection = Projection::Perspective;  ///< Of the scoring camera.
  double fov_y_deg = 30.0;                          ///< Of the scoring camera, in [1, 170].
  std::optional<double> distance_factor{};          ///< Eye distance over D/2, in [1.001, 1e6].
  std::optional<UpAxis> up{};                       ///< Unset: choose_frame().
  std::optional<UpAxis> front{};                    ///< Unset: choose_frame().
  int width = 800;                                  ///< Of pictures, px.
  int height = 600;                                 ///< Of pictures, px.
  bool fit_size = false;        ///< Pictures of a view take its aspect, and width × height pixels.
  double margin_percent = 4.0;  ///< Of pictures, of the shorter side, in [0, 45].
  bool pictures = true;         ///< Whether view.json names pictures.
  /// From the centre to the eye, of any length but 0: taken for the best view, as a sidecar may say.
  std::optional<Vec3> best_view{};
  /// Several views besides best and worst.
  std::optional<ViewSetRequest> view_set{};
  /// Object whose significance alone counts and on which pictures are framed, see find_object();
  /// empty: all.
  std::string focus{};
};

/// Sets both sides of pictures from "800x600" or "600"; from "auto" or "auto:800x600" their aspect is
/// that of what is seen. \throw InvalidInput
void set_size(ViewOptions& options, std::string_view text);
/// "800x600", "auto" or "auto:801x600".
std::string size_text(const ViewOptions& options);
/// options.objective, but for the paper's and Lee's searches, which know only the score.
Objective objective_of(const ViewOptions& options);

/// Sets the prior, and Objective::Significance, from "none", "upright" or the name of a file; from
/// "people" Objective::People. \throw IoError, FormatError
void set_prior(ViewOptions& options, std::string_view text);
/// The name of the prior, or "people".
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
         "only this object's significance counts, and pictures are framed on it; the others still "
         "hide it: name or number as listed by info",
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
           "up axis of the model; auto: what its shape says, or if that is unsure its format's: z "
           "for STL, 3MF and AMF, y otherwise; any: it may also be off the axes: the model is "
           "turned first"},
    Choice{"front", &ViewOptions::front, kFrontWords,
           "axis that points from the model to a viewer in front; auto: what its shape says, or if "
           "that is unsure z, where z is up -y"},
    Group{"search", "Search"},
    Part{&ViewOptions::search, kSearchFields},
    Choice{"objective", &ViewOptions::objective, "significance|people",
           "what the best view maximises: the score alone, or how likely people would show a thing "
           "of this shape from there, given what is seen"},
    Text{"prior", set_prior, prior_text,
         "former name of an objective, for one more version: none (significance), upright (the "
         "score times a fixed function of the direction), or a JSON file with such a function",
         TextForm::File},
    Switch{"certify", &ViewOptions::certify,
           "search densely as well, and report how far the views found are behind; slow"},
    Group{"size", "Pictures"},
    Text{"size", set_size, size_text,
         "size of pictures in pixels: WIDTHxHEIGHT, or one number for a square; auto: as wide or "
         "tall as what is seen, with as many pixels as 800x600; auto:SIZE: as many as SIZE",
         TextForm::Size},
    Switch{"pictures", &ViewOptions::pictures, kNoFlag},
    Group{"look", "Pictures"},
    Field{"margin", &ViewOptions::margin_percent, 0.0, 45.0, "empty border around the model",
          "per cent of the picture's shorter side"},
    Group{"set", "Several views"},
    Part{&ViewOptions::view_set, kViewSetRequestFields},
};

/// The options a preset stands for.
ViewOptions preset_options(Preset preset);

/// Sixteen hex digits that change when an option that shapes the result does.
std::string options_hash(const ViewOptions& options);

}  // namespace vantage
