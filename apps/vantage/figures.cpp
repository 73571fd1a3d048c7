// SPDX-License-Identifier: MIT
#include "vantage/report/figures.h"

#include <filesystem>
#include <string>

#include <nlohmann/json.hpp>

#include "vantage/io/write.h"
#include "vantage/report/view_report.h"

#include "commands.h"
#include "method_flags.h"
#include "output_folder.h"
#include "terminal.h"

namespace vantage::cli {
namespace {

struct FiguresCommand {
  std::string model{};
  std::string folder{};
  MethodFlags method{};

  void add_flags(CLI::App& app, Session& session) {
    app.add_option("MODEL", model, "file to read, or -")->required();
    app.add_option("-o,--output", folder, "folder for the figures")->required();
    method.add_to(app, {.map = true, .camera = true, .search = true, .picture = true});
    add_common_flags(app, session.flags);
  }

  void run(Session& session) const {
    const ViewOptions options = session.reading([&] { return method.resolve(session.flags.seed); });
    const RunContext run = session.run();
    const Model loaded = session.load(model);
    const ShapeAnalysis shape = analyse_shape(loaded, options, run.part(0.0, 0.4));
    const ViewReport report =
        find_views(shape, choose_up(loaded, shape, options), options, run.part(0.4, 0.6));
    const std::vector<Figure> figures = paper_figures(shape, report, options, run.part(0.6, 1.0));
    make_folder(folder);
    nlohmann::ordered_json files = nlohmann::ordered_json::array();
    for (const Figure& figure : figures) {
      const std::string file = (std::filesystem::path(folder) / (figure.name + ".png")).string();
      write_file(file, png_bytes(figure.image));
      files.push_back(file);
      session.tell(printable(file));
    }
    session.end_progress();
    if (session.flags.json) {
      write_file("-", nlohmann::ordered_json{{"files", files}}.dump(2) + "\n");
    }
  }
};

}  // namespace

void add_figures_command(CLI::App& program, Session& session) {
  add_command<FiguresCommand>(
      program, session, "figures", "the paper's figures for this model",
      "Examples:\n"
      "  vantage figures horse.ply -o figures\n"
      "  vantage figures horse.ply -o figures --preset paper --size 400x300");
}

}  // namespace vantage::cli
