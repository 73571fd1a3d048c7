// SPDX-License-Identifier: MIT
#include "vantage/report/figures.h"

#include <filesystem>
#include <fstream>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "vantage/core/error.h"
#include "vantage/io/write.h"

#include "batch/json_text.h"
#include "clock.h"
#include "commands.h"
#include "load_posed.h"
#include "look_flags.h"
#include "method_flags.h"
#include "output_file.h"
#include "output_folder.h"
#include "terminal.h"
#include "view_set_flags.h"

namespace vantage::cli {
namespace {

/// Views on the sheet unless said otherwise. [ours]
constexpr int kSheetViews = 6;
/// Eyes that the choice of a set asks about, more or less.
constexpr std::size_t kEyesOfASet = 1000;

struct FiguresCommand {
  std::vector<std::string> models{};
  std::string folder{};
  MethodFlags method{};
  ViewSetFlags several{};
  LookFlags look{};
  std::set<std::string> folders{};

  void add_flags(CLI::App& app, Session& session) {
    app.add_option("MODEL", models, "files to read, or -; several get a folder each")->required();
    app.add_option("-o,--output", folder, "folder for the figures")->required();
    method.add_to(app, {.map = true, .camera = true, .search = true, .picture = true});
    several.add_set_to(app);
    look.add_to_several(app, Style::Clay);
    add_force_flag(app, session.flags);
    add_common_flags(app, session.flags);
  }

  void run(Session& session) {
    ViewOptions options = session.read([&] { return method.resolve(session.flags.seed); });
    if (options.fit_size) {
      throw CLI::ValidationError(
          "--size", "must be WIDTHxHEIGHT like 800x600: the panels of a figure are of one size");
    }
    session.refuse_idle(true, {"--objective", "--prior", "--certify"},
                        "has no effect on figures: they are of the score alone");
    options.objective = Objective::Significance;  // the paper's
    options.view_set = several.request_or(kSheetViews);
    options.margin_percent = look.margin_percent();
    for (const char* const name : {"table-1-times.csv", "table-1-times.md"}) {
      check_result((std::filesystem::path(folder) / name).string(), OutputKind::Table,
                   session.flags);
    }
    OutputFolder output(folder, kFigureResults);
    std::vector<StageTimes> times;
    refuse_equal_names();
    for (const std::string& model : models) {
      try {
        times.push_back(draw(session, model, options, output));
      } catch (const Cancelled&) {
        throw;
      } catch (const Error&) {
        if (times.empty() && &model == &models.back()) {
          throw;  // of one, or the last of several of which none could be drawn
        }
        session.report_failure();
        session.exit_code = kSomeFailed;
      }
    }
    for (const std::string& former : former_folders()) {
      output.replace_below(former);
    }
    output.add("table-1-times.csv", times_csv(times));
    output.add("table-1-times.md", times_markdown(times));
    output.write();
    session.end_progress();
    batch::Json files = batch::Json::array();
    for (const std::string& name : output.names()) {
      const std::string path = (std::filesystem::path(folder) / name).string();
      files.push_back(path);
      session.tell(printable(path));
    }
    if (session.flags.json) {
      write_output("-", batch::json_text(batch::Json{{"files", files}}, 2) + "\n");
    }
  }

 private:
  StageTimes draw(Session& session, const std::string& model, ViewOptions options,
                  OutputFolder& output) {
    const RunContext run = session.run();
    const auto start = Clock::now();
    StageTimes times;
    LookFlags own_look = look;
    const Model loaded = load_posed(session, model, method.flags(), options, &own_look);
    options.best_view.reset();  // figures show what was found
    times.seconds.load = seconds_since(start);
    const ShapeAnalysis shape = session.computing(
        [&] { return analyse_shape(loaded, options, run.part(0.0, 0.4), &times.seconds); });
    const FrameChoice choice = choose_frame(loaded, shape, options);
    // The times are those of the best and the worst view, as the paper's are.
    ViewOptions alone = options;
    alone.view_set.reset();
    const auto search = Clock::now();
    ViewReport report =
        session.computing([&] { return find_views(shape, choice, alone, run.part(0.4, 0.5)); });
    times.seconds.search += seconds_since(search);
    const VertexVisibility visibility(shape.surface, shape.sides, kEyesOfASet);
    const MapScorer by_map(shape, visibility, options);
    report.set = find_view_set(shape, visibility, by_map.scorer(), report.best.direction,
                               choice.frame, options, report.warnings, run.part(0.5, 0.6));
    const std::vector<Figure> figures =
        paper_figures(shape, report, options, run.part(0.6, 1.0),
                      own_look.of(loaded, up_vector(choice.frame.up)));
    const std::string place = models.size() == 1 ? "" : own_folder(loaded) + "/";
    for (const Figure& figure : figures) {
      output.add(place + figure.name + ".png", png_bytes(figure.image));
      if (!figure.svg.empty()) {
        output.add(place + figure.name + ".svg", figure.svg);
      }
    }
    times.model = loaded.name;
    times.vertices = shape.check.vertices;
    times.faces = shape.check.faces;
    return times;
  }

  /// Before the work: two files that would have one folder. \throw InvalidInput
  void refuse_equal_names() const {
    std::set<std::string> names;
    for (const std::string& model : models) {
      if (const std::string name = folder_of(std::filesystem::path(model).stem().string());
          models.size() > 1 && !names.insert(name).second) {
        refuse_name(name);
      }
    }
  }

  [[noreturn]] static void refuse_name(const std::string& name) {
    throw InvalidInput("two models are called '" + name +
                       "'; give each a folder of its own with -o");
  }

  static std::string folder_of(const std::string& name) {
    const bool climbs = name == "." || name == "..";  // of a file "...ply"
    return folder_named(name, climbs ? "_" : "");
  }

  /// The folder of one model of several. \throw InvalidInput if another model has it.
  std::string own_folder(const Model& loaded) {
    std::string name = folder_of(loaded.name);
    if (!folders.insert(name).second) {
      refuse_name(name);
    }
    return name;
  }

  /// The first field of a row of ours; empty if it is none.
  static std::string quoted_field(const std::string& row) {
    std::string field;
    for (std::size_t i = 1; row.starts_with('"') && i < row.size(); ++i) {
      if (row[i] == '"' && (i + 1 == row.size() || row[++i] != '"')) {
        return field;
      }
      field += row[i];
    }
    return {};
  }

  /// Folders of the models of an earlier run, as its table lists them, and those of this one.
  [[nodiscard]] std::set<std::string> former_folders() const {
    std::set<std::string> former = folders;
    std::ifstream table(std::filesystem::path(folder) / "table-1-times.csv");
    std::string line;
    std::getline(table, line);  // the head
    while (std::getline(table, line)) {
      const std::string name = folder_of(quoted_field(line));
      const std::filesystem::path below = std::filesystem::path(folder) / name;
      if (!name.empty() && name.find('/') == std::string::npos &&
          std::filesystem::exists(below / "figure-1-contraction.png")) {
        former.insert(name);
      }
    }
    return former;
  }
};

}  // namespace

void add_figures_command(CLI::App& program, Session& session) {
  add_command<FiguresCommand>(
      program, session, "figures", "the paper's figures for this model",
      "Examples:\n"
      "  vantage figures horse.ply -o figures\n"
      "  vantage figures models/*.ply -o figures --views 9\n"
      "  vantage figures horse.ply -o figures --preset paper --size 400x300");
}

}  // namespace vantage::cli
