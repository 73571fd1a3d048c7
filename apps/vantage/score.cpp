// SPDX-License-Identifier: MIT
#include <algorithm>
#include <fstream>
#include <iterator>
#include <optional>

#include "vantage/core/error.h"
#include "vantage/io/model.h"
#include "vantage/io/write.h"
#include "vantage/pipeline/measured_shape.h"
#include "vantage/pipeline/option_table.h"
#include "vantage/spatial/directions.h"

#include "batch/json_text.h"
#include "commands.h"
#include "input_text.h"
#include "measure_flags.h"
#include "method_flags.h"
#include "notes.h"
#include "output_file.h"
#include "terminal.h"
#include "value_checks.h"
#include "visible_table.h"

namespace vantage::cli {
namespace {

struct ScoreCommand {
  std::string model{};
  std::string directions{};
  std::string eyes{};
  std::string file = "-";
  std::string measure = "kssm";
  std::string visible{};
  int sphere = -1;
  int view_set = kMeasureSetLevel;
  MethodFlags method{};

  void add_flags(CLI::App& app, Session& session) {
    app.add_option("MODEL", model, "file to read, or -")->required();
    CLI::Option_group* what = app.add_option_group("Views", "what to score: one of");
    what->add_option("--directions", directions,
                     "CSV file dx,dy,dz: directions to the eye; - is standard input");
    what->add_option("--eyes", eyes, "CSV file x,y,z: positions of the eye, in model units");
    what->add_option("--sphere", sphere, "all directions of the icosahedron split this many times")
        ->check(within(0, 8));
    what->require_option(1);
    offer_measures(
        app.add_option(
               "--method", measure,
               "what to score by: one or several, joined by commas, of vantage measures, or all")
            ->capture_default_str(),
        /*joins=*/true, {"all"});
    app.add_option("--view-set", view_set,
                   "views that the measures built on a set are defined over: the icosahedron split "
                   "this many times")
        ->check(within(0, 5))
        ->capture_default_str();
    app.add_option("-o,--output", file, "CSV file to write; - is standard output")
        ->capture_default_str();
    app.add_option("--visible", visible,
                   "also write which direction sees which vertex to this .npy file (NumPy)");
    method.add_to(app, {.map = true, .saliency = true, .camera = true});
    add_force_flag(app, session.flags);
    add_common_flags(app, session.flags);
  }

  void run(Session& session) {
    session.leave_output_to(visible, "--visible");
    ViewOptions options = method.resolve();
    const std::vector<Measure> measures = parse_measures(measure, "--method");
    const RunContext run = session.run();
    const bool free_eyes = !eyes.empty();
    refuse_idle_flags(session, measures);
    refuse_any_up(options);
    if (free_eyes && !visible.empty()) {
      throw CLI::ValidationError("--visible", "needs directions: --sphere or --directions");
    }
    const std::vector<Vec3> points = session.read([&] { return points_to_score(); });
    require_distinct({{"-o", file}, {"--visible", visible}});
    check_output(file, OutputKind::Table, session.flags);
    check_output(visible, OutputKind::Shape, session.flags);
    const Model loaded = session.load(model);
    if (measures.size() > 1 || measures.front().name != "kssm") {
      score_measures(session, loaded, options, measures, points);
      return;
    }
    const ShapeAnalysis shape = session.computing([&] {
      return analyse_shape(loaded, options, run.part(0.0, 0.5), nullptr, AnalysisUse::Map);
    });
    const VertexVisibility visibility(shape.surface, shape.sides, points.size());
    const MapScorer by_map(shape, visibility, options);
    const ViewScorer& scorer = by_map.scorer();
    const std::vector<double> scores = session.computing([&] {
      return free_eyes ? score_eyes(scorer, points, run.part(0.5, 1.0))
                       : scorer.score_all(points, run.part(0.5, 1.0));
    });
    if (!visible.empty()) {
      const VisibleSets sets = visible_sets(visibility, scorer.camera(), points,
                                            shape.surface.positions.size(), session.run());
      write_output(visible, visible_table(sets, shape.significance));
    }
    session.end_progress();
    write(session, measures, points, {scores});
    say_notes(session, shape);
  }

 private:
  void refuse_idle_flags(const Session& session, const std::vector<Measure>& measures) const {
    session.refuse_idle(idle_in_scores(measures, !eyes.empty()));
    const bool is_of_set = std::any_of(measures.begin(), measures.end(),
                                       [](const Measure& m) { return m.is_of_set(); });
    session.refuse_idle(!is_of_set, {"--view-set"},
                        "goes with measures that are built on a set of views only, such as vmi");
  }

  /// Scores by any measures; the map is made only if one of them, or --visible, needs it.
  void score_measures(Session& session, const Model& loaded, const ViewOptions& options,
                      const std::vector<Measure>& measures, const std::vector<Vec3>& points) const {
    if (!visible.empty()) {
      throw CLI::ValidationError("--visible", "goes with --method kssm only");
    }
    const RunContext run = session.run();
    const ShapeAnalysis shape = session.computing(
        [&] { return analyse_for(loaded, options, measures, run.part(0.0, 0.4)); });
    session.reading([&] { require_area(shape, model); });
    ViewMeasurer measurer(measure_subject(shape, options), measures, view_set, run.part(0.4, 0.9));
    if (!eyes.empty()) {
      std::vector<Viewpoint> places;
      places.reserve(points.size());
      for (const Vec3& eye : points) {
        places.push_back({Projection::Perspective, eye});
      }
      write(session, measures, points, measurer.values(places, run.part(0.9, 1.0)));
    } else if (sphere == view_set) {
      write(session, measures, points, measurer.set_values(run.part(0.9, 1.0)));
    } else {
      write(session, measures, points, measurer.values(points, run.part(0.9, 1.0)));
    }
    say_notes(session, shape);
  }

  void write(Session& session, const std::vector<Measure>& measures,
             const std::vector<Vec3>& points, const MeasureValues& values) const {
    session.end_progress();
    if (session.flags.json) {
      write_output("-", json(measures, points, values));
    }
    if (!session.flags.json || file != "-") {
      write_output(file, csv(measures, points, values));
    }
  }

  [[nodiscard]] std::vector<Vec3> points_to_score() const {
    if (sphere >= 0) {
      return direction_set(ViewSphereBase::Icosahedron, sphere).directions;
    }
    const std::string& name = eyes.empty() ? directions : eyes;
    std::vector<Vec3> points = eyes.empty()
                                   ? parse_directions_csv(read_text(name), name, {"dx", "dy", "dz"})
                                   : parse_points_csv(read_text(name), name, {"x", "y", "z"});
    if (points.empty()) {
      throw FormatError(name, "", "holds no directions or eyes: one a line, x,y,z");
    }
    return points;
  }

  static std::vector<double> score_eyes(const ViewScorer& scorer, const std::vector<Vec3>& points,
                                        const RunContext& run) {
    std::vector<double> scores;
    for (const Vec3& eye : points) {
      run.advance("scoring",
                  static_cast<double>(scores.size()) / static_cast<double>(points.size()));
      scores.push_back(scorer.score_from({Projection::Perspective, eye}, run.quiet()));
    }
    return scores;
  }

  [[nodiscard]] std::string csv(const std::vector<Measure>& measures,
                                const std::vector<Vec3>& points,
                                const MeasureValues& values) const {
    std::string text = eyes.empty() ? "method,dx,dy,dz,score\n" : "method,x,y,z,score\n";
    for (std::size_t m = 0; m < measures.size(); ++m) {
      for (std::size_t i = 0; i < points.size(); ++i) {
        text += measures[m].name;
        for (const double value : {points[i].x(), points[i].y(), points[i].z(), values[m][i]}) {
          text += ',' + number_text(value);
        }
        text += '\n';
      }
    }
    return text;
  }

  [[nodiscard]] std::string json(const std::vector<Measure>& measures,
                                 const std::vector<Vec3>& points,
                                 const MeasureValues& values) const {
    auto rows = batch::Json::array();
    for (std::size_t m = 0; m < measures.size(); ++m) {
      for (std::size_t i = 0; i < points.size(); ++i) {
        rows.push_back({{"method", measures[m].name},
                        {eyes.empty() ? "direction" : "eye",
                         batch::Json::array({points[i].x(), points[i].y(), points[i].z()})},
                        {"score", values[m][i]}});
      }
    }
    return batch::json_text(rows, 2) + "\n";
  }
};

}  // namespace

void add_score_command(CLI::App& program, Session& session) {
  add_command<ScoreCommand>(
      program, session, "score", "score given views",
      "Examples:\n"
      "  vantage score horse.ply --sphere 3 -o scores.csv\n"
      "  vantage score horse.ply --directions views.csv --method kssm,vmi,silhouette-length\n"
      "  vantage score room.obj --eyes cameras.csv");
}

}  // namespace vantage::cli
