// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

#include "vantage/core/version.h"
#include "vantage/io/camera_files.h"
#include "vantage/io/write.h"
#include "vantage/report/view_report.h"

#include "core/degrees.h"
#include "core/json_text.h"
#include "pipeline/describe_view.h"
#include "pipeline/option_echo.h"

namespace vantage {
namespace {

using Json = OrderedJson;

constexpr int kSchema = 1;

Json point(const Vec3& p) {
  return Json::array({p.x(), p.y(), p.z()});
}

/// Confidences are no better than that.
double in_thousandths(double share) {
  return std::round(1000.0 * share) / 1000.0;
}

Json frame_of(const Camera& picture) {
  Json frame = {{"target", point(picture.target)}, {"fov_y_deg", picture.fov_y_deg}};
  if (picture.projection == Projection::Orthographic) {
    frame["height"] = picture.height;
  }
  return frame;
}

/// How the file lies that the model is of.
struct Pose {
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();  ///< From there to the model.
  Vec3 up = Vec3::UnitY();
};

/// Attributes of <model-viewer>, which shows the file; null for a camera that it does not have.
Json model_viewer_of(const Camera& picture, const Pose& pose) {
  Json attributes;
  for (const auto& [name, value] :
       model_viewer_attributes(camera_of_file(picture, pose.turn), pose.up)) {
    attributes[name] = value;
  }
  return attributes;
}

Json view_of(const ReportedView& view, const Json& image, const Pose& pose) {
  return {{"direction", point(view.direction)},
          {"eye", point(view.eye)},
          {"up", point(view.up)},
          {"score", view.score},
          {"score_fraction", view.score_fraction},
          {"objective", view.objective},
          {"visible_area_fraction", view.visible_area_fraction},
          {"image", image},
          {"size", {view.size.width, view.size.height}},
          {"frame", frame_of(view.picture)},
          {"model_viewer", model_viewer_of(view.picture, pose)}};
}

/// As the best view's: its score over the largest, or where less is better the least over it.
Json share_of_attainable(const ReportedView& view, const ViewReport& report) {
  if (!report.score_of_attainable || view.score < 0.0) {
    return nullptr;
  }
  const bool is_less = report.worst.score > report.highest_score;
  const double most = is_less ? view.score : report.highest_score;
  const double least = is_less ? report.highest_score : view.score;
  return most > 0.0 ? std::min(1.0, least / most) : 1.0;  // 0 as it can be
}

/// A view of a report, and what `picture` is of.
Json reported(const ReportedView& view, const std::string& picture, const ViewReport& report,
              const ViewOptions& options, const Pose& pose) {
  Json json = view_of(view, options.pictures ? Json(picture) : Json(nullptr), pose);
  json["score_of_attainable"] = share_of_attainable(view, report);
  return json;
}

Json camera_of(const ScoringCamera& camera, const Json& projection) {
  return {{"projection", projection},
          {"fov_y_deg", camera.fov_y_deg},
          {"target", point(camera.sphere.centre)},
          {"distance", camera.distance()}};
}

Json contraction_of(const ContractionHistory& history, const KssmMap& map) {
  Json strategies = Json::array();
  for (const ComponentContraction& component : history.components) {
    strategies.push_back(component.strategy);
  }
  return {{"strategy", strategies},
          {"levels", history.level_count()},
          {"levels_used", map.levels_used},
          {"shrinkage", history.shrinkage},
          {"warnings", history.warnings}};
}

Json seconds_of(const StageSeconds& seconds) {
  return {{"load", seconds.load},  {"contract", seconds.contract}, {"skeleton", seconds.skeleton},
          {"map", seconds.map},    {"search", seconds.search},     {"render", seconds.render},
          {"total", seconds.total}};
}

Json views_of(const ViewReport& report, const ViewOptions& options, const Pose& pose) {
  const ReportedViewSet& set = *report.set;
  Json views = Json::array();
  for (std::size_t i = 0; i < set.views.size(); ++i) {
    const std::string number = (i < 9 ? "0" : "") + std::to_string(i + 1);
    Json view = reported(set.views[i], "view-" + number + ".png", report, options, pose);
    view["gain"] = set.choice.views[i].gain;
    view["coverage"] = set.choice.views[i].coverage;
    views.push_back(view);
  }
  return views;
}

Json set_of(const ReportedViewSet& set, ViewSelection selection) {
  constexpr std::array<std::string_view, 4> kStops{"count", "coverage", "exhausted", "information"};
  Json json = {{"selection", selection_name(selection)},
               {"stop", kStops[static_cast<std::size_t>(set.choice.stop)]},
               {"candidates", set.choice.candidates},
               {"evaluations", set.choice.evaluations},
               {"reachable", set.choice.reachable},
               {"least_views", set.choice.least_views},
               {"most_coverage", set.choice.most_coverage},
               {"tour",
                {{"order", set.tour.order},
                 {"length_deg", set.tour.length_rad * kDegPerRad},
                 {"optimal", set.tour.optimal}}}};
  if (set.way) {
    json["way"] = {{"length_deg", set.way->length_rad * kDegPerRad},
                   {"coverage", set.way->coverage},
                   {"stops", Json::array()}};
    for (const Vec3& stop : set.way->stops) {
      json["way"]["stops"].push_back(point(stop));
    }
  }
  return json;
}

Json model_of(const Model& model, const MeshReport& check) {
  return {{"name", model.name},
          {"format", format_name(model)},
          {"vertices", check.vertices},
          {"faces", check.faces},
          {"components", check.components},
          {"closed", check.closed},
          {"genus", check.genus ? Json(*check.genus) : Json(nullptr)}};
}

/// The objective and the model's frame.
void add_frame(Json& json, const ViewReport& report, const ViewOptions& options) {
  json["objective"] = objective_of(options) == Objective::People ? "people" : "significance";
  ViewOptions as_searched = options;
  as_searched.objective = objective_of(options);
  json["prior"] = prior_text(as_searched);
  json["up"] = up_name(report.up);
  json["up_source"] = report.orientation.up.source;
  json["up_confidence"] = in_thousandths(report.orientation.up.confidence);
  json["front"] = up_name(report.front);
  json["front_source"] = report.orientation.front.source;
  json["front_confidence"] = in_thousandths(report.orientation.front.confidence);
  const ShapeProportions& box = report.proportions;
  json["proportions"] = {{"height", in_thousandths(box.height)},
                         {"width", in_thousandths(box.width)},
                         {"mirrors_side", box.mirrors_side},
                         {"mirrors_front", box.mirrors_front},
                         {"mirrors_up", box.mirrors_up}};
}

void add_best_and_worst(Json& json, const ViewReport& report, const ViewOptions& options,
                        const Pose& pose) {
  json["best"] = reported(report.best, "best.png", report, options, pose);
  json["highest_score"] = {{"direction", point(report.highest_direction)},
                           {"score", report.highest_score}};
  json["worst"] = reported(report.worst, "worst.png", report, options, pose);
}

Json twins_of(const ViewReport& report) {
  Json twins = Json::array();
  for (const TwinView& twin : report.twins) {
    twins.push_back({{"direction", point(twin.direction)},
                     {"score", twin.score},
                     {"score_fraction", score_fraction(twin.score, report.total)},
                     {"objective", twin.objective}});
  }
  return twins;
}

Json search_of(const ViewReport& report, const SearchOptions& search, const Json& echo) {
  Json json = {
      {"strategy", echo["search"]},
      {"base", echo["base"]},
      {"subdivisions", search.subdivisions},
      {"epsilon", search.epsilon_is_fraction ? search.epsilon * report.total : search.epsilon},
      {"evaluations", report.best_search.evaluations},
      {"worst_evaluations", report.worst_search.evaluations},
      {"estimates", report.best_search.estimates + report.worst_search.estimates}};
  if (search.strategy == SearchStrategy::Gradient) {
    json["starts"] = search.starts;
    json["seed"] = search.seed;
  }
  if (report.dense_gap) {
    json["dense"] = {{"best_ratio", report.dense_gap->best_ratio},
                     {"worst_above", report.dense_gap->worst_above},
                     {"evaluations", report.dense_gap->evaluations}};
  }
  return json;
}

void add_trace(std::string& csv, std::string_view goal, const FoundView& found) {
  std::size_t step = 0;
  for (const SearchStep& s : found.trace) {
    csv += std::string(goal) + ',' + std::to_string(step++) + ',' + std::to_string(s.level);
    for (const double value : {s.direction.x(), s.direction.y(), s.direction.z(), s.score}) {
      csv += ',' + number_text(value + 0.0);  // 0 has no sign
    }
    csv += '\n';
  }
}

}  // namespace

std::string view_json(const Model& model, const ShapeAnalysis& shape, const ViewReport& report,
                      const ViewOptions& options, const StageSeconds* seconds) {
  Json echo = option_echo(options);
  Json json;
  json["vantage"] = version();
  json["schema"] = kSchema;
  json["options_hash"] = options_hash(options);
  json["model"] = model_of(model, shape.check);
  if (!options.focus.empty()) {
    json["focus"] = options.focus;
  }
  json["method"] = options.method;
  json["preset"] = echo["preset"];
  json["weight"] = echo["weight"];
  add_frame(json, report, options);
  json["camera"] = camera_of(report.camera, echo["projection"]);
  const Pose pose{model.turn, model.turn.transpose() * up_vector(report.up)};
  add_best_and_worst(json, report, options, pose);
  if (report.set && options.view_set) {
    json["views"] = views_of(report, options, pose);
    json["view_set"] = set_of(*report.set, options.view_set->selection);
  }
  json["twins"] = twins_of(report);
  json["total"] = report.total;
  json["search"] = search_of(report, options.search, echo);
  json["skeleton"] = {{"nodes", shape.skeleton.graph.nodes.size()},
                      {"edges", shape.skeleton.graph.edges.size()},
                      {"components", component_count(shape.skeleton.graph)},
                      {"cycles", cycle_count(shape.skeleton.graph)}};
  json["contraction"] = contraction_of(shape.history, shape.kssm);
  json["warnings"] = warnings_of(model, shape, report);
  json["doubts"] = report.reliability_warnings;
  json["options"] = std::move(echo);
  if (seconds != nullptr) {
    json["seconds"] = seconds_of(*seconds);
  }
  return json_text(json, 2) + "\n";
}

std::vector<std::string> warnings_of(const Model& model, const ShapeAnalysis& shape,
                                     const ViewReport& report) {
  std::vector<std::string> warnings = model.notes;
  for (const auto* const further :
       {&shape.warnings, &report.warnings, &report.reliability_warnings}) {
    warnings.insert(warnings.end(), further->begin(), further->end());
  }
  return warnings;
}

std::string timings_json(const StageSeconds& seconds) {
  return json_text({{"seconds", seconds_of(seconds)}}, 2) + "\n";
}

std::string trace_csv(const ViewReport& report) {
  std::string csv = "goal,step,level,dx,dy,dz,score\n";
  add_trace(csv, "best", report.best_search);
  add_trace(csv, "worst", report.worst_search);
  return csv;
}

}  // namespace vantage
