// SPDX-License-Identifier: MIT
#include "vantage/skeleton/skeleton.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <optional>
#include <string_view>

#include "vantage/core/error.h"
#include "vantage/io/write.h"
#include "vantage/pipeline/shape_analysis.h"

#include "batch/json_text.h"
#include "commands.h"
#include "method_flags.h"
#include "notes.h"
#include "output_file.h"
#include "output_folder.h"
#include "terminal.h"

namespace vantage::cli {
namespace {

/// What the skeleton can be written as.
constexpr std::array<std::string_view, 5> kExtensions{".json", ".obj", ".ply", ".swc", ".graphml"};

struct SkeletonCommand {
  std::string model{};
  std::string file{};
  std::string levels{};
  std::string meso{};
  bool measure = false;
  MethodFlags method{};
  std::optional<SkeletonQuality> quality{};

  void add_flags(CLI::App& app, Session& session) {
    app.add_option("MODEL", model, "file to read, or -")->required();
    app.add_option("-o,--output", file,
                   "file to write: .json, .obj (lines), .ply (edges), .swc (loops cut) or "
                   ".graphml; - is standard output (JSON)")
        ->required()
        ->check([](const std::string& name) {
          const std::string extension = std::filesystem::path(name).extension().string();
          return name == "-" || std::find(kExtensions.begin(), kExtensions.end(), extension) !=
                                    kExtensions.end()
                     ? std::string()
                     : "the skeleton's file must end in .json, .obj, .ply, .swc or .graphml, not "
                       "'" +
                           extension + "'";
        });
    app.add_option("--meso", meso,
                   "file for the contracted surface that the skeleton is made from, .ply")
        ->check([](const std::string& name) {
          return std::filesystem::path(name).extension() == ".ply" ? "" : "must end in .ply";
        });
    app.add_option("--levels", levels,
                   "folder for the contracted surface of each level: level-00.ply, …");
    app.add_flag("--measure", measure,
                 "measure the skeleton against the surface: length outside, limbs, visibility");
    method.add_to(app, {});
    add_force_flag(app, session.flags);
    add_common_flags(app, session.flags);
  }

  void run(Session& session) {
    const ViewOptions options = method.resolve();
    const RunContext run = session.run();
    session.leave_output_to(file, "-o");
    require_distinct({{"-o", file}, {"--meso", meso}});
    check_output(file, OutputKind::Shape, session.flags);
    check_output(meso, OutputKind::Shape, session.flags);
    check_levels(levels, {{"-o", file}, {"--meso", meso}}, session.flags);
    const Model loaded = session.load(model);
    ShapeAnalysis shape = session.computing([&] {
      ShapeAnalysis result = prepare_surface(loaded, session.run());
      add_history(result, options, run.part(0.0, 0.8));
      add_skeleton(result, options, run.part(0.8, measure ? 0.9 : 1.0));
      return result;
    });
    write_output(file, bytes(shape));
    if (!levels.empty()) {
      write_levels(levels, level_files(loaded, shape));
    }
    if (!meso.empty()) {
      write_output(meso, level_bytes(loaded, shape, shape.history.thinnest()));
    }
    warn_of_cut_loops(shape);
    if (measure) {
      const double spacing = sample_spacing(shape.surface, options.skeleton);
      quality = session.computing([&] {
        return measure_skeleton(shape.surface, shape.history.component_of_vertex, shape.skeleton,
                                spacing, run.part(0.9, 1.0));
      });
    }
    report(session, loaded, shape);
  }

 private:
  [[nodiscard]] std::string bytes(const ShapeAnalysis& shape) const {
    const std::string extension = std::filesystem::path(file).extension().string();
    if (extension == ".obj") {
      return skeleton_obj(shape.skeleton.graph);
    }
    if (extension == ".ply") {
      return skeleton_ply(shape.skeleton.graph);
    }
    const std::vector<std::int64_t> vertex_node = nodes_of_input_vertices(shape);
    const SkeletonFile content{.graph = &shape.skeleton.graph,
                               .radius = shape.skeleton.radius,
                               .vertex_node = vertex_node};
    if (extension == ".swc") {
      return skeleton_swc(content);
    }
    return extension == ".graphml" ? skeleton_graphml(content) : skeleton_json(content);
  }

  static std::string level_bytes(const Model& loaded, const ShapeAnalysis& shape,
                                 const std::vector<Vec3>& positions) {
    TriMesh level{.positions = {}, .triangles = loaded.mesh.triangles};
    for (const std::uint32_t v : shape.surface_vertex) {
      level.positions.push_back(positions[v]);
    }
    return ply_bytes(level, {}, {}, loaded.double_precision);
  }

  static std::vector<std::string> level_files(const Model& loaded, const ShapeAnalysis& shape) {
    std::vector<std::string> files;
    for (const std::vector<Vec3>& positions : shape.history.levels) {
      files.push_back(level_bytes(loaded, shape, positions));
    }
    return files;
  }

  /// SWC holds trees only: says how many loops its file lacks.
  void warn_of_cut_loops(ShapeAnalysis& shape) const {
    const std::size_t cycles = cycle_count(shape.skeleton.graph);
    if (std::filesystem::path(file).extension() == ".swc" && cycles > 0) {
      shape.warnings.push_back(plural(cycles, "loop") + " cut: SWC holds trees only");
    }
  }

  [[nodiscard]] batch::Json quality_json(const ShapeAnalysis& shape) const {
    const double whole = quality->length > 0.0 ? quality->length : 1.0;
    const double diameter = shape.sphere.diameter;
    return {{"ends", quality->ends},
            {"outside_fraction", quality->outside_length / whole},
            {"thin_outside_fraction", quality->thin_outside / whole},
            {"farthest_over_radius", quality->farthest_ratio},
            {"farthest_over_diameter", quality->farthest / diameter},
            {"off_centre", quality->off_centre},
            {"seen_fraction", quality->seen_fraction}};
  }

  [[nodiscard]] std::string measured_text() const {
    const double whole = quality->length > 0.0 ? quality->length : 1.0;
    return rounded(100.0 * quality->outside_length / whole) + " % of the length outside, " +
           rounded(100.0 * quality->seen_fraction) +
           " % of the surface seen, every vertex within " + rounded(quality->farthest_ratio) +
           " radii of its node";
  }

  void report(Session& session, const Model& loaded, const ShapeAnalysis& shape) const {
    const CurveGraph& graph = shape.skeleton.graph;
    if (session.flags.json) {
      batch::Json json = {{"file", file},
                          {"nodes", graph.nodes.size()},
                          {"edges", graph.edges.size()},
                          {"components", component_count(graph)},
                          {"cycles", cycle_count(graph)},
                          {"length", total_length(graph)},
                          {"levels", shape.history.level_count()},
                          {"shrinkage", shape.history.shrinkage},
                          {"warnings", shape.warnings},
                          {"doubts", skeleton_warnings(shape)}};
      json["closed"] = shape.check.closed;
      json["genus"] = shape.check.genus ? batch::Json(*shape.check.genus) : nullptr;
      if (quality) {
        json["quality"] = quality_json(shape);
      }
      write_output("-", batch::json_text(json, 2) + "\n");
      return;
    }
    session.tell(printable(loaded.name) + ": " + plural(graph.nodes.size(), "node") + ", " +
                 plural(graph.edges.size(), "edge") + ", " +
                 plural(component_count(graph), "component") + ", " +
                 plural(cycle_count(graph), "cycle") + ", length " + rounded(total_length(graph)) +
                 " → " + printable(file));
    if (quality) {
      session.tell(measured_text());
    }
    say_notes(session, shape);
    say_warnings(session, skeleton_warnings(shape));
  }
};

}  // namespace

void add_skeleton_command(CLI::App& program, Session& session) {
  add_command<SkeletonCommand>(program, session, "skeleton", "the curve skeleton of a model",
                               "Examples:\n"
                               "  vantage skeleton horse.ply -o horse.json\n"
                               "  vantage skeleton horse.ply -o horse.obj --levels levels");
}

}  // namespace vantage::cli
