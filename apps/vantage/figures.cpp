// SPDX-License-Identifier: MIT
#include "vantage/report/figures.h"

#include <chrono>
#include <filesystem>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

#include "vantage/core/error.h"
#include "vantage/io/write.h"

#include "commands.h"
#include "method_flags.h"
#include "output_file.h"
#include "output_folder.h"
#include "terminal.h"
#include "view_set_flags.h"

namespace vantage::cli {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// Views on the sheet unless said otherwise. [ours]
constexpr int kSheetViews = 6;

struct FiguresCommand {
  std::vector<std::string> models{};
  std::string folder{};
  MethodFlags method{};
  ViewSetFlags several{};
  std::set<std::string> folders{};
  nlohmann::ordered_json files = nlohmann::ordered_json::array();

  void add_flags(CLI::App& app, Session& session) {
    app.add_option("MODEL", models, "files to read, or -; several get a folder each")->required();
    app.add_option("-o,--output", folder, "folder for the figures")->required();
    method.add_to(app, {.map = true, .camera = true, .search = true, .picture = true});
    several.add_set_to(app);
    add_force_flag(app, session.flags);
    add_common_flags(app, session.flags);
  }

  void run(Session& session) {
    ViewOptions options = session.read([&] { return method.resolve(session.flags.seed); });
    options.objective = Objective::Significance;  // the paper's
    options.view_set = several.request_or(kSheetViews);
    for (const char* const name : {"table-1-times.csv", "table-1-times.md"}) {
      check_result((std::filesystem::path(folder) / name).string(), OutputKind::Table,
                   session.flags);
    }
    std::vector<StageTimes> times;
    for (const std::string& model : models) {
      times.push_back(draw(session, model, options));
    }
    write(session, std::filesystem::path(folder) / "table-1-times.csv", times_csv(times));
    write(session, std::filesystem::path(folder) / "table-1-times.md", times_markdown(times));
    session.end_progress();
    if (session.flags.json) {
      write_output("-", nlohmann::ordered_json{{"files", files}}.dump(2) + "\n");
    }
  }

 private:
  StageTimes draw(Session& session, const std::string& model, const ViewOptions& options) {
    const RunContext run = session.run();
    const auto start = Clock::now();
    StageTimes times;
    Model loaded = session.load(model);
    session.computing([&] { return stand_along_axes(loaded, options); });
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
    times.seconds.search = seconds_since(search);
    report.set = find_view_set(shape, VertexVisibility(shape.surface, shape.sides, 1000),
                               report.camera, report.best.direction, choice.frame, options,
                               report.warnings, run.part(0.5, 0.6));
    const std::vector<Figure> figures = paper_figures(shape, report, options, run.part(0.6, 1.0));
    const std::filesystem::path place = models.size() == 1
                                            ? std::filesystem::path(folder)
                                            : std::filesystem::path(folder) / own_folder(loaded);
    make_folder(folder);
    make_folder(place.string());
    for (const Figure& figure : figures) {
      write(session, place / (figure.name + ".png"), png_bytes(figure.image));
      if (!figure.svg.empty()) {
        write(session, place / (figure.name + ".svg"), figure.svg);
      }
    }
    times.model = loaded.name;
    times.vertices = shape.check.vertices;
    times.faces = shape.check.faces;
    return times;
  }

  /// The folder of one model of several. \throw InvalidInput if another model has it.
  std::string own_folder(const Model& loaded) {
    const bool climbs = loaded.name == "." || loaded.name == "..";  // of a file "...ply"
    std::string name = folder_named(loaded.name, climbs ? "_" : "");
    if (!folders.insert(name).second) {
      throw InvalidInput("two models are called '" + name +
                         "'; give each a folder of its own with -o");
    }
    return name;
  }

  void write(Session& session, const std::filesystem::path& path, std::string_view bytes) {
    write_file(path.string(), bytes);
    files.push_back(path.string());
    session.tell(printable(path.string()));
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
