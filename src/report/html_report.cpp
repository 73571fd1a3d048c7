// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <optional>

#include "vantage/core/error.h"
#include "vantage/io/camera_files.h"
#include "vantage/io/write.h"
#include "vantage/render/render.h"
#include "vantage/report/view_report.h"
#include "vantage/spatial/directions.h"

#include "core/json_text.h"
#include "core/parallel.h"
#include "pipeline/map_estimates.h"
#include "pipeline/preference.h"
#include "pipeline/view_preparation.h"
#include "render/colour_scale.h"
#include "report/asset_part.h"
#include "report/cloud_picture.h"
#include "report/display_mesh.h"
#include "report/page_data.h"
#include "report/report_page.h"

namespace vantage {
namespace {

using Json = OrderedJson;

/// Past this many faces the page shows a simplified copy.
constexpr std::size_t kDisplayFaces = 300000;
/// The contraction is played on at most this many vertices: each level costs 6 bytes a vertex.
constexpr std::size_t kHistoryVertices = 30000;
/// The heat map's set: icosahedron level 3, 642 directions.
constexpr int kSphereLevel = 3;
constexpr std::size_t kSphereEyes = 642;
/// Directions of it whose preference one task works out.
constexpr std::size_t kPreferenceGrain = 32;
/// Most views of a set in the filmstrip: each adds a picture of about 40 KB. [ours]
constexpr std::size_t kMostStripViews = 24;
/// Cameras of the tour stand so far apart, degrees; between them the page mixes. [ours]
constexpr double kTourStepDeg = 4.0;
/// Size of the pictures in the filmstrip, px.
constexpr int kStripWidth = 288;
constexpr int kStripHeight = 216;
/// Formats that f3d reads, from 1.3 on.
constexpr std::array<std::string_view, 13> kOfF3d{
    "3ds", "dae", "dxf", "fbx", "glb", "gltf", "iges", "obj", "off", "ply", "pts", "step", "stl"};
/// From there and so high a parallel projection shows the whole unit sphere.
constexpr double kParallelDistance = 2.0;
constexpr double kParallelHeight = 2.1;

Json numbers(const Vec3& p) {
  return Json::array({p.x(), p.y(), p.z()});
}

std::string packed_significance(const std::vector<double>& map,
                                const std::vector<std::uint32_t>& rows) {
  const std::vector<float> shares = shares_of_range(map);
  std::vector<std::uint8_t> packed;
  packed.reserve(rows.size());
  for (const std::uint32_t v : rows) {
    const bool has_place = !shares.empty() && !std::isnan(shares[v]);
    packed.push_back(static_cast<std::uint8_t>(has_place ? std::lround(255.0F * shares[v]) : 0));
  }
  return base64_of(packed);
}

Json surface_part(const DisplayMesh& display, const std::vector<double>& significance) {
  return {{"faces", display.triangles.size()},
          {"indices", base64_of(display.triangles)},
          {"significance", packed_significance(significance, display.vertex_of_row)}};
}

/// Adds the solids that show the points of a cloud.
void add_points(DisplayMesh& display, const CloudPicture& cloud, const TriMesh& surface) {
  const auto first = static_cast<std::uint32_t>(surface.positions.size());
  const std::size_t rows = display.vertex_of_row.size();
  for (std::uint32_t v = first; v < cloud.mesh.positions.size(); ++v) {
    display.vertex_of_row.push_back(v);
  }
  for (std::size_t f = surface.triangles.size(); f < cloud.mesh.triangles.size(); ++f) {
    Triangle t = cloud.mesh.triangles[f];
    for (std::uint32_t& v : t) {
      v = static_cast<std::uint32_t>(v - first + rows);
    }
    display.triangles.push_back(t);
  }
}

/// What is displayed of a cloud, in the colours of its points.
Model coloured_points(const DisplayMesh& display, const std::vector<Vec3>& positions,
                      const std::vector<Rgb8>& colours) {
  Model points;
  points.mesh.triangles = display.triangles;
  for (const std::uint32_t v : display.vertex_of_row) {
    points.mesh.positions.push_back(positions[v]);
    if (!colours.empty()) {
      points.vertex_colours.push_back(colours[v]);
    }
  }
  return points;
}

/// The surface with a cloud's points, what of it is contracted, and the model in its own colours.
void add_surfaces(Json& data, const Model& model, const ShapeAnalysis& shape,
                  const PageFrame& frame, const RunContext& run) {
  std::vector<DisplayMesh> displays = display_meshes(
      shape.surface, shape.significance, shape.sides,
      {{{kDisplayFaces, 2 * kDisplayFaces}, {kDisplayFaces, kHistoryVertices}}}, run);
  const std::shared_ptr<const CloudPicture> cloud = cloud_picture(shape);
  if (cloud) {
    add_points(displays[0], *cloud, shape.surface);
  }
  const std::vector<Vec3>& positions = cloud ? cloud->mesh.positions : shape.surface.positions;
  const std::vector<double> spread =
      cloud ? cloud->spread(std::span<const double>(shape.significance)) : shape.significance;
  data["mesh"] = surface_part(displays[0], spread);
  data["mesh"]["positions"] = packed_positions(positions, displays[0].vertex_of_row, frame);
  data["history"] = surface_part(displays[1], shape.significance);
  data["history"]["levels"] = Json::array();
  for (const auto& level : shape.history.levels) {
    data["history"]["levels"].push_back(packed_positions(level, displays[1].vertex_of_row, frame));
  }
  if (shape.cloud) {
    const std::vector<Rgb8> colours = colours_shown(shape, cloud.get(), model.vertex_colours);
    data["asset"] = asset_part(coloured_points(displays[0], positions, colours),
                               displays[0].triangles.size(), frame, run);
  } else {
    data["asset"] = asset_part(model, kDisplayFaces, frame, run);
  }
}

Json skeleton_part(const CurveGraph& graph, const PageFrame& frame) {
  Json nodes = Json::array();
  for (const Vec3& p : graph.nodes) {
    nodes.push_back(numbers(frame.to(p)));
  }
  return {{"nodes", nodes}, {"edges", graph.edges}};
}

/// \param objective what the best view maximises there; empty if it is the score.
Json sphere_part(const DirectionSet& set, const std::vector<double>& scores,
                 const std::vector<double>& objective) {
  Json directions = Json::array();
  for (const Vec3& d : set.directions) {
    directions.push_back(numbers(d));
  }
  return {{"directions", directions},
          {"triangles", set.triangles},
          {"scores", scores},
          {"objective", objective}};
}

/// The paper's search, to its end: the page stops it where a chosen ε would.
Json rapid_part(const ScoreBatch& score, double total, Goal goal, const RunContext& run) {
  SearchOptions options = preset_options(Preset::Paper).search;
  options.epsilon = 0.0;
  const FoundView found = search_view({score, total}, goal, options, run);
  Json steps = Json::array();
  for (const SearchStep& step : found.trace) {
    steps.push_back(
        {{"level", step.level}, {"direction", numbers(step.direction)}, {"score", step.score}});
  }
  return steps;
}

/// A camera in the page's lengths. It has `height` where lines of sight are parallel, else `fov_y_deg`.
Json camera_part(const Camera& camera, double aspect, const PageFrame& frame) {
  Json json = {{"eye", numbers(frame.to(camera.eye))},
               {"target", numbers(frame.to(camera.target))},
               {"up", numbers(camera.up)},
               {"aspect", aspect}};
  if (camera.projection == Projection::Orthographic) {
    json["height"] = camera.height / frame.radius;
  } else {
    json["fov_y_deg"] = camera.fov_y_deg;
  }
  return json;
}

/// How the page looks from a direction of the sphere that nothing was framed for.
Json lens_part(const ScoringCamera& camera, const PageFrame& frame) {
  if (camera.projection == Projection::Orthographic) {
    return {{"distance", kParallelDistance}, {"height", kParallelHeight}, {"aspect", 1.0}};
  }
  const double distance = camera.distance() / frame.radius;
  return {{"distance", distance},
          {"fov_y_deg", 2.0 * std::asin(1.0 / distance) * 180.0 / std::numbers::pi},
          {"aspect", 1.0}};
}

/// What commands call the model by.
const std::string& file_of(const Model& model) {
  return model.file_name.empty() ? model.name : model.file_name;
}

Json view_part(const char* name, const ReportedView& view, const ShapeAnalysis& shape,
               ShapePictures& pictures, const Model& model, const ViewOptions& options,
               const PageFrame& frame, const RunContext& run) {
  const PictureSize size = view.size;
  const double scale = std::min(static_cast<double>(kStripWidth) / size.width,
                                static_cast<double>(kStripHeight) / size.height);
  const auto side = [scale](int pixels) {
    return std::max(1, static_cast<int>(std::lround(scale * pixels)));
  };
  const std::string png = png_bytes(
      pictures.take_small(view.picture, side(size.width), side(size.height), options, run));
  Json json = {{"name", name},
               {"direction", numbers(view.direction)},
               {"score", view.score},
               {"score_fraction", view.score_fraction}};
  json.update(camera_part(view.picture, static_cast<double>(size.width) / size.height, frame));
  json["picture"] = "data:image/png;base64," + base64(png);
  json["cameras"] = {{"glTF", camera_gltf(view.picture, size, shape.sphere.diameter)},
                     {"NeRF transforms.json",
                      camera_transforms_json(view.picture, size, std::string(name) + ".png")}};
  if (std::find(kOfF3d.begin(), kOfF3d.end(), format_name(model)) != kOfF3d.end()) {
    json["cameras"]["f3d"] = camera_f3d(camera_of_file(view.picture, model.turn), size,
                                        file_of(model), shape.cloud.has_value());
  }
  return json;
}

/// The views of a set after the first, which is the best one, and the round over all of them.
void add_set(Json& data, const ViewReport& report, const ShapeAnalysis& shape,
             ShapePictures& pictures, const Model& model, const ViewOptions& options,
             const PageFrame& frame, const RunContext& run) {
  const std::vector<ReportedView>& views = report.set->views;
  const std::size_t shown = std::min(views.size(), kMostStripViews);
  for (std::size_t i = 1; i < shown; ++i) {
    const std::string name = std::to_string(i + 1);
    data["views"].push_back(
        view_part(name.c_str(), views[i], shape, pictures, model, options, frame, run));
  }
  if (shown < views.size()) {
    data["warnings"].push_back("Of the " + std::to_string(views.size()) + " views the first " +
                               std::to_string(shown) + " are shown here.");
  }
  if (!(report.set->way_rad() > 0.0)) {
    return;
  }
  const double degrees = report.set->way_rad() * 180.0 / std::numbers::pi;
  const auto count = static_cast<std::size_t>(std::max(12.0, std::ceil(degrees / kTourStepDeg)));
  Json poses = Json::array();
  for (const Camera& camera : tour_cameras(shape, *report.set, report.camera, report.up, 1.0, count,
                                           options.margin_percent)) {
    poses.push_back(camera_part(camera, 1.0, frame));
  }
  data["tour"] = {{"degrees", degrees}, {"views", views.size()}, {"poses", poses}};
}

/// The element for web pages, which show glTF alone, beside the other cameras of a view.
void add_web_camera(Json& view, const ReportedView& of, const ViewReport& report,
                    const Model& model) {
  if (of.picture.projection == Projection::Perspective &&
      (model.format == ModelFormat::Gltf || model.format == ModelFormat::Glb)) {
    view["cameras"]["model-viewer"] =
        camera_model_viewer(camera_of_file(of.picture, model.turn),
                            model.turn.transpose() * up_vector(report.up), file_of(model));
  }
}

std::string colour_table() {
  std::vector<Rgb8> table;
  table.reserve(256);
  for (int i = 0; i < 256; ++i) {
    table.push_back(cool_warm(i / 255.0));
  }
  return base64_of(table);
}

/// Text that may stand inside a script element: no "<" can end it.
std::string script_safe(const Json& json) {
  std::string safe = json_text(json);
  for (std::size_t at = safe.find('<'); at != std::string::npos; at = safe.find('<', at)) {
    safe.replace(at, 1, "\\u003c");
  }
  return safe;
}

/// Scores estimated on a coarse surface, shifted and stretched so that they meet the largest and the
/// least, and none is beyond these. Exact ones of a large model would take most of the time of a result.
ScoreBatch estimated_scores(const std::shared_ptr<const MapEstimates>& map,
                            const ViewReport& report) {
  const std::vector<Vec3> ends{report.worst.direction, report.highest_direction};
  const std::vector<double> known = map->scores(ends);
  const double range = known[1] - known[0];
  const double exact = report.highest_score - report.worst.score;
  constexpr double kLeastRange = 1e-3;  // of all: less is the estimates' own error
  const double stretch = std::min(range, exact) > kLeastRange * report.total ? exact / range : 1.0;
  const double shift = report.worst.score - stretch * known[0];
  return [map, stretch, shift, least = report.worst.score,
          most = report.highest_score](const std::vector<Vec3>& directions) {
    std::vector<double> scores = map->scores(directions);
    for (double& score : scores) {
      score = std::clamp(stretch * score + shift, least, most);
    }
    return scores;
  };
}

/// The scores on the page: exact of a surface that estimates would hardly be sooner of.
ScoreBatch page_scores(const ShapeAnalysis& shape, const ViewReport& report,
                       const ViewOptions& options, const RunContext& run) {
  const auto estimates =
      std::make_shared<const MapEstimates>(shape, shape.significance, options, run);
  if (estimates->are_sooner()) {
    return estimated_scores(estimates, report);
  }
  const std::shared_ptr<const VertexVisibility> visibility = visibility_of(shape, kSphereEyes);
  const auto map = std::make_shared<const MapScorer>(shape, *visibility, options);
  return [visibility, map, run](const std::vector<Vec3>& directions) {
    return map->scorer().score_all(directions, run);
  };
}

/// What the best view maximises, by the page's scores; empty if that is the score. Estimates make none
/// better than the best view, unless that was given.
std::vector<double> objectives(const ShapeAnalysis& shape, const ViewReport& report,
                               const ViewOptions& options, const std::vector<Vec3>& directions,
                               const std::vector<double>& scores, const RunContext& run) {
  FrameChoice choice;
  choice.frame = {report.up, report.front};
  choice.orientation = report.orientation;
  const Preference preference(shape, choice, options, report.total);
  if (preference.is_score()) {
    return {};
  }
  const double most =
      options.best_view ? std::numeric_limits<double>::infinity() : report.best.objective;
  std::vector<double> values(directions.size());
  parallel_for(run, values.size(), kPreferenceGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      values[i] = std::min(preference(directions[i], scores[i]), most);
    }
  });
  return values;
}

}  // namespace

bool has_report_page() {
  return !report_page().empty();
}

std::string report_html(const Model& model, const ShapeAnalysis& shape, ShapePictures& pictures,
                        const ViewReport& report, const ViewOptions& options,
                        const RunContext& run) {
  if (!has_report_page()) {
    throw InvalidInput("this build has no 3D page; build it where npm is installed");
  }
  const PageFrame frame{report.camera.sphere.centre, 0.5 * report.camera.sphere.diameter};
  const DirectionSet set = direction_set(ViewSphereBase::Icosahedron, kSphereLevel);
  const RunContext quiet = run.quiet();
  const ScoreBatch score = page_scores(shape, report, options, quiet);

  Json data = {{"view", parsed_json(view_json(model, shape, report, options))},
               {"up", numbers(up_vector(report.up))},
               {"frame", {{"centre", numbers(frame.centre)}, {"radius", frame.radius}}},
               {"turn", Json::array({numbers(model.turn.row(0)), numbers(model.turn.row(1)),
                                     numbers(model.turn.row(2))})},
               {"lens", lens_part(report.camera, frame)},
               {"colours", colour_table()},
               {"crease_deg", pictures.look().render.crease_deg}};
  run.advance("report", 0.0);
  add_surfaces(data, model, shape, frame, quiet);
  data["skeleton"] = skeleton_part(shape.skeleton.graph, frame);
  run.advance("report", 0.2);
  const std::vector<double> scores = score(set.directions);
  data["sphere"] =
      sphere_part(set, scores, objectives(shape, report, options, set.directions, scores, quiet));
  run.advance("report", 0.7);
  data["rapid"] = {{"best", rapid_part(score, report.total, Goal::Best, quiet)},
                   {"worst", rapid_part(score, report.total, Goal::Worst, quiet)}};
  run.advance("report", 0.8);
  data["views"] = {view_part("best", report.best, shape, pictures, model, options, frame, quiet),
                   view_part("worst", report.worst, shape, pictures, model, options, frame, quiet)};
  data["warnings"] = data["view"]["warnings"];
  if (has_look(model) && data["asset"].is_null()) {
    data["warnings"].push_back("The model's colours are left out here: it has too many faces.");
  }
  if (report.set) {
    add_set(data, report, shape, pictures, model, options, frame, quiet);
  }
  for (std::size_t i = 0; i < data["views"].size(); ++i) {
    const ReportedView& of = i == 0   ? report.best
                             : i == 1 ? report.worst
                                      : report.set->views[i - 1];  // its first is the best
    add_web_camera(data["views"][i], of, report, model);
  }

  constexpr std::string_view kMark = "<!--VANTAGE-DATA-->";
  std::string page(report_page());
  const std::size_t at = page.find(kMark);
  if (at == std::string::npos) {
    throw InvalidInput("the 3D page of this build has no place for the data; build it again");
  }
  page.replace(at, kMark.size(), script_safe(data));
  run.advance("report", 1.0);
  return page;
}

}  // namespace vantage
