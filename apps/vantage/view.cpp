// SPDX-License-Identifier: MIT
#include <cmath>
#include <filesystem>

#include "vantage/core/error.h"
#include "vantage/io/write.h"
#include "vantage/pipeline/find_views.h"
#include "vantage/pipeline/measured_shape.h"
#include "vantage/pipeline/option_table.h"
#include "vantage/report/view_report.h"

#include "clock.h"
#include "commands.h"
#include "load_posed.h"
#include "look_flags.h"
#include "measure_flags.h"
#include "method_flags.h"
#include "notes.h"
#include "output_file.h"
#include "output_folder.h"
#include "preview_flag.h"
#include "terminal.h"
#include "view_outputs.h"
#include "view_set_flags.h"

namespace vantage::cli {
namespace {

std::string direction_text(const Vec3& d) {
  const auto part = [](double x) { return rounded(std::abs(x) < 5e-4 ? 0.0 : x, 3); };
  return "(" + part(d.x()) + ", " + part(d.y()) + ", " + part(d.z()) + ")";
}

std::string view_line(const ReportedView& view) {
  if (!std::isfinite(view.score_fraction)) {  // a measure that has no total
    return "from " + direction_text(view.direction) + ", score " + rounded(view.score, 5);
  }
  return "from " + direction_text(view.direction) + ", sees " +
         rounded(100.0 * view.score_fraction, 3) + " % of the significance, " +
         rounded(100.0 * view.visible_area_fraction, 3) + " % of the surface";
}

/// What the best view maximises, and what it gives up for that.
std::string objective_line(const ViewReport& report, const ViewOptions& options) {
  if (objective_of(options) == Objective::Significance) {
    return options.prior.is_uniform ? "significance" : "significance, by the prior";
  }
  if (!report.score_of_attainable) {
    return "people; no view sees anything significant";
  }
  return "people, with " + rounded(100.0 * *report.score_of_attainable, 3) +
         " % of the score of any view; the score alone takes " +
         direction_text(report.highest_direction);
}

/// \param above the dense search's lowest score, over the range of scores.
std::string worst_gap(double above) {
  const std::string share = rounded(100.0 * std::abs(above), 3) + " % of the range of scores ";
  return above > 0.0   ? share + "above the lowest it finds"
         : above < 0.0 ? share + "below the lowest it finds, so better"
                       : "the lowest it finds";
}

std::string timing_line(const StageSeconds& s) {
  return rounded(s.total, 3) + " s (load " + rounded(s.load, 2) + ", contract " +
         rounded(s.contract, 2) + ", skeleton " + rounded(s.skeleton, 2) + ", map " +
         rounded(s.map, 2) + ", search " + rounded(s.search, 2) + ", pictures " +
         rounded(s.render, 2) + ")";
}

struct ViewCommand {
  std::string model{};
  std::string folder{};
  std::string trace{};
  bool no_images = false;
  bool no_report = false;
  bool strict = false;
  MeasureFlags measure{};
  MethodFlags method{};
  ViewSetFlags several{};
  LookFlags look{};
  PreviewFlag preview{};

  void add_flags(CLI::App& app, Session& session) {
    app.add_option("MODEL", model, "file to read, or -")->required();
    app.add_option("-o,--output", folder, "folder for the results; default: NAME.vantage");
    app.add_option("--trace", trace, "also write each evaluated direction to this CSV file");
    app.add_flag("--no-images", no_images, "no pictures and no report");
    app.add_flag("--no-report", no_report, "no report.html, the page to explore the result in");
    app.add_flag("--strict", strict,
                 "exit code 1 if the answer should not be trusted; it is written all the same");
    measure.add_to(app);
    method.add_to(app, {.map = true,
                        .saliency = true,
                        .camera = true,
                        .search = true,
                        .picture = true,
                        .fits = true});
    several.add_to(app);
    look.add_to_several(app);
    preview.add_to(app);
    add_force_flag(app, session.flags);
    add_common_flags(app, session.flags);
  }

  void run(Session& session) {
    const auto start = Clock::now();
    ViewOptions options = resolved_options(session);
    StageSeconds seconds;
    check_files(session);
    const bool is_drawn = !no_images || preview.is_given() || several.has_tour();
    const Model loaded =
        load_posed(session, model, method.flags(), options, is_drawn ? &look : nullptr);
    seconds.load = seconds_since(start);
    OutputFolder output(folder.empty() ? folder_named(loaded.name, ".vantage") : folder,
                        kViewResults);
    check_folder(session, output);

    const RunContext run = session.run();
    const ShapeAnalysis shape = session.computing(
        [&] { return analyse_shape(loaded, options, run.part(0.02, 0.5), &seconds); });
    if (!sums_a_map(options.method)) {
      session.reading([&] { require_area(shape, model); });
    }
    const FrameChoice choice = choose_frame(loaded, shape, options);
    const auto search_start = Clock::now();
    ViewReport report =
        session.computing([&] { return find_views(shape, choice, options, run.part(0.5, 0.9)); });
    seconds.search += seconds_since(search_start);

    const auto render_start = Clock::now();
    const PictureLook shown = look.of(loaded, up_vector(choice.frame.up));
    ShapePictures pictures(shape, shown);
    if (!no_images) {
      add_pictures(output, OutputKinds::all(), pictures, report, options, run.part(0.9, 0.95));
    }
    output.add("view.json", view_json(loaded, shape, report, options));
    several.write(output, shape, pictures, report, choice.frame.up, options, run.part(0.95, 1.0));
    seconds.render = seconds_since(render_start);
    add_data(output, OutputKinds::all(), loaded, shape, report,
             std::filesystem::path(model).filename().string());
    seconds.total = seconds_since(start);
    output.add("timings.json", timings_json(seconds));
    if (!trace.empty()) {
      output.add_named(trace, trace_csv(report));
    }
    output.write();

    const bool has_report = reports(session, options);
    session.end_progress();
    if (session.flags.json) {
      write_output("-", view_json(loaded, shape, report, options, &seconds));
    } else {
      preview.show(session, shape, report.best.picture, with_size(options, report.best.size), shown,
                   session.run());
      summarise(session, loaded, shape, choice, report, options, output, seconds);
    }
    // Last: who waits for the pictures and the numbers has them.
    if (has_report) {
      write_report(session, output,
                   [&] { return report_html(loaded, shape, pictures, report, options, run); });
    }
    if (strict && !report.reliability_warnings.empty()) {
      throw Error(loaded.name + ": " + report.reliability_warnings.front() + " (--strict)");
    }
  }

 private:
  /// \throw CLI::ValidationError if flags do not go together.
  [[nodiscard]] ViewOptions resolved_options(Session& session) {
    ViewOptions options = session.read([&] { return method.resolve(session.flags.seed); });
    options.pictures = !no_images;
    options.margin_percent = look.margin_percent();
    refuse_near_eye(options);
    measure.apply(options);
    session.refuse_idle(idle_in_views({find_measure(options.method)}));
    several.require_use(sums_a_map(options.method));
    options.view_set = several.request();
    return options;
  }

  /// What can be told of the results' places before the model is read.
  void check_files(Session& session) const {
    require_distinct({{"--trace", trace}, {"--tour", several.tour()}});
    const std::string ending = std::filesystem::path(folder).extension().string();
    if (ending == ".png" || ending == ".webp" || ending == ".jpg") {
      throw CLI::ValidationError(
          "--output", "is a folder for all results; one picture is made by render and thumb");
    }
    session.leave_output_to(trace, "--trace");
    check_output(trace, OutputKind::Table, session.flags);
  }

  void check_folder(const Session& session, const OutputFolder& output) const {
    output.check(session.flags);
    output.refuse_own_name(trace, "--trace");
    several.check_names(output);
  }

  /// Whether report.html is written; says why not where it is asked for and cannot be.
  [[nodiscard]] bool reports(Session& session, const ViewOptions& options) const {
    if (no_images || no_report) {
      return false;
    }
    if (!sums_a_map(options.method)) {
      session.say(
          "note: report.html shows a map and what is seen of it: there is none for this --method");
      return false;
    }
    if (!has_report_page()) {
      session.say("note: this program was built without npm, so that there is no report.html");
      return false;
    }
    return true;
  }

  template <class MakePage>
  static void write_report(Session& session, OutputFolder& output, const MakePage& make_page) {
    const auto start = Clock::now();
    output.write_last("report.html", make_page());
    session.end_progress();
    if (!session.flags.json) {
      session.tell("  report      " + printable(output.path()) + "/report.html, " +
                   rounded(seconds_since(start), 2) + " s later");
    }
  }

  static std::string estimated(const ViewReport& report) {
    const std::size_t count = report.best_search.estimates + report.worst_search.estimates;
    return count > 0 ? ", " + grouped(count) + " estimated" : "";
  }

  void summarise(Session& session, const Model& loaded, const ShapeAnalysis& shape,
                 const FrameChoice& choice, const ViewReport& report, const ViewOptions& options,
                 const OutputFolder& output, const StageSeconds& seconds) const {
    const MeshReport& check = shape.check;
    std::string counts = plural(check.vertices, "point");
    if (!shape.cloud) {
      counts = plural(check.vertices, "vertex") + ", " + plural(check.faces, "face") + ", " +
               plural(check.components, "component") + (check.closed ? ", closed" : ", open");
    }
    if (check.genus) {
      counts += ", genus " + std::to_string(*check.genus);
    }
    session.tell(printable(loaded.name) + ": " + counts);
    session.tell("  skeleton    " + plural(shape.skeleton.graph.nodes.size(), "node") + ", " +
                 plural(cycle_count(shape.skeleton.graph), "cycle") + ", from " +
                 plural(shape.history.level_count(), "contraction level"));
    session.tell("  " + frame_summary(choice));
    session.tell("  best view   " + view_line(report.best));
    session.tell("  objective   " + objective_line(report, options));
    session.tell("  worst view  " + view_line(report.worst));
    if (report.set) {
      session.tell(view_set_table(*report.set));
    }
    session.tell("  search      " +
                 plural(report.best_search.evaluations + report.worst_search.evaluations, "view") +
                 " evaluated" + estimated(report));
    if (const auto& gap = report.dense_gap) {
      session.tell(
          "  certified   the best view has " + rounded(100.0 * gap->best_ratio, 5) +
          " % of the highest objective that a dense search finds; the worst view's score is " +
          worst_gap(gap->worst_above));
    }
    session.tell("  time        " + timing_line(seconds));
    session.tell("  results in  " + printable(output.path()) +
                 (output.path().ends_with('/') ? "" : "/"));
    for (const std::string& file : {several.tour(), trace}) {
      if (!file.empty()) {
        session.tell("              " + printable(file));
      }
    }
    if (session.flags.verbose) {
      for (const std::string& name : output.names()) {
        session.tell("              " + name);
      }
    }
    say_notes(session, loaded.notes);
    say_notes(session, shape);
    say_notes(session, report.warnings);
    say_warnings(session, report.reliability_warnings);
  }
};

}  // namespace

void add_view_command(CLI::App& program, Session& session) {
  add_command<ViewCommand>(
      program, session, "view", "best and worst view: pictures, cameras, map, skeleton, report",
      "Examples:\n"
      "  vantage view horse.ply\n"
      "  vantage view horse.ply --preview\n"
      "  vantage view part.stl -o out --size 1024 --up z\n"
      "  vantage view horse.ply --method viewpoint-entropy --objective significance\n"
      "  vantage view horse.ply --views 6 --tour horse.webp\n"
      "  vantage view scene.obj --focus lamp --coverage 0.95\n"
      "  vantage view horse.ply --preset paper --epsilon 1 --trace search.csv\n"
      "  vantage view horse.ply --json | jq .best.direction");
}

}  // namespace vantage::cli
