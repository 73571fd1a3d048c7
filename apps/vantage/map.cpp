// SPDX-License-Identifier: MIT
#include <algorithm>
#include <filesystem>

#include "vantage/io/write.h"
#include "vantage/pipeline/measured_shape.h"
#include "vantage/pipeline/option_table.h"
#include "vantage/render/render.h"

#include "batch/json_text.h"
#include "commands.h"
#include "method_flags.h"
#include "notes.h"
#include "output_file.h"
#include "output_folder.h"
#include "terminal.h"

namespace vantage::cli {
namespace {

std::string map_bytes(const Model& loaded, const ShapeAnalysis& shape,
                      std::span<const double> field) {
  const std::vector<double> values = on_input_vertices(shape, field);
  return ply_bytes(loaded.mesh, values, colour_map(values), loaded.double_precision);
}

struct MapCommand {
  std::string model{};
  std::string file{};
  std::string levels{};
  std::string name = "kssm";
  MethodFlags method{};

  void add_flags(CLI::App& app, Session& session) {
    app.add_option("MODEL", model, "file to read, or -")->required();
    app.add_option("-o,--output", file, "PLY file to write, with property quality and colours")
        ->required()
        ->check([](const std::string& path) {
          const std::string extension = std::filesystem::path(path).extension().string();
          return path == "-" || extension == ".ply"
                     ? std::string()
                     : "the map's file must end in .ply, not '" + extension + "'";
        });
    app.add_option(
           "--method", name,
           "kssm: significance; mesh-saliency, pmi-saliency: other measures' maps; thickness: "
           "distance to the skeleton, in the model's units")
        ->check(CLI::IsMember({"kssm", "mesh-saliency", "pmi-saliency", "thickness"}))
        ->capture_default_str();
    app.add_option("--levels", levels,
                   "folder for the displacement of each contraction level: level-00.ply, …");
    method.add_to(app, {.map = true, .saliency = true, .camera = true});
    add_force_flag(app, session.flags);
    add_common_flags(app, session.flags);
  }

  void run(Session& session) {
    ViewOptions options = method.resolve();
    const bool by_skeleton = name == "kssm" || name == "thickness";
    session.refuse_idle(idle_in_map(name));
    refuse_any_up(options);
    if (!by_skeleton && !levels.empty()) {
      throw CLI::ValidationError("--levels", "goes with --method kssm or thickness only");
    }
    session.leave_output_to(file, "-o");
    check_output(file, OutputKind::Shape, session.flags);
    check_levels(levels, {{"-o", file}}, session.flags);
    const Model loaded = session.load(model);
    const ShapeAnalysis shape = session.computing([&] {
      return by_skeleton ? analyse_shape(loaded, options, session.run(), nullptr, AnalysisUse::Map)
                         : prepare_surface(loaded, session.run());
    });
    if (name == "pmi-saliency") {
      session.reading([&] { require_area(shape, model); });
    }
    const std::vector<double> field = name == "thickness"
                                          ? shape.kssm.thickness()
                                          : vertex_map(shape, options, name, session.run());
    write_output(file, map_bytes(loaded, shape, field));
    if (!levels.empty()) {
      std::vector<std::string> files;
      for (const std::vector<double>& displacement : shape.kssm.displacement) {
        files.push_back(map_bytes(loaded, shape, displacement));
      }
      write_levels(levels, std::move(files));
    }
    report(session, loaded, shape, field);
  }

 private:
  void report(Session& session, const Model& loaded, const ShapeAnalysis& shape,
              const std::vector<double>& field) const {
    const auto [low, high] = std::minmax_element(field.begin(), field.end());
    if (session.flags.json) {
      const batch::Json json = {{"file", file},
                                {"method", name},
                                {"min", *low},
                                {"max", *high},
                                {"levels", shape.history.level_count()},
                                {"level_factors", shape.kssm.level_factor},
                                {"warnings", shape.warnings},
                                {"doubts", skeleton_warnings(shape)}};
      write_output("-", batch::json_text(json, 2) + "\n");
      return;
    }
    session.tell(
        printable(loaded.name) + ": " + name + " from " + rounded(*low) + " to " + rounded(*high) +
        " over " + plural(field.size(), "vertex") +
        (shape.history.levels.empty() ? "" : ", " + plural(shape.history.level_count(), "level")) +
        " → " + printable(file));
    say_notes(session, shape);
    say_warnings(session, skeleton_warnings(shape));
  }
};

}  // namespace

void add_map_command(CLI::App& program, Session& session) {
  add_command<MapCommand>(program, session, "map", "the significance map of a model",
                          "Examples:\n"
                          "  vantage map horse.ply -o map.ply\n"
                          "  vantage map horse.ply -o thick.ply --method thickness\n"
                          "  vantage map horse.ply -o saliency.ply --method mesh-saliency\n"
                          "  vantage map horse.ply -o map.ply --levels levels");
}

}  // namespace vantage::cli
