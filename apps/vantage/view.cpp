// SPDX-License-Identifier: MIT
#include <chrono>
#include <cmath>
#include <filesystem>

#include <nlohmann/json.hpp>

#include "vantage/io/camera_files.h"
#include "vantage/io/write.h"
#include "vantage/render/colour_map.h"
#include "vantage/report/view_report.h"

#include "commands.h"
#include "method_flags.h"
#include "output_folder.h"
#include "terminal.h"

namespace vantage::cli {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

std::string direction_text(const Vec3& d) {
  return "(" + rounded(d.x(), 3) + ", " + rounded(d.y(), 3) + ", " + rounded(d.z(), 3) + ")";
}

std::string view_line(const ReportedView& view) {
  return "from " + direction_text(view.direction) + ", sees " +
         rounded(100.0 * view.score_fraction, 3) + " % of the significance, " +
         rounded(100.0 * view.visible_area_fraction, 3) + " % of the surface";
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
  MethodFlags method{};

  void add_flags(CLI::App& app, Session& session) {
    app.add_option("MODEL", model, "file to read, or -")->required();
    app.add_option("-o,--output", folder, "folder for the results; default: NAME.vantage");
    app.add_option("--trace", trace, "also write each evaluated direction to this CSV file");
    app.add_flag("--no-images", no_images, "no pictures");
    method.add_to(app, {.map = true, .camera = true, .search = true, .picture = true});
    add_common_flags(app, session.flags);
  }

  void run(Session& session) {
    const auto start = Clock::now();
    ViewOptions options = session.reading([&] { return method.resolve(); });
    options.pictures = !no_images;
    const RunContext run = session.run();

    StageSeconds seconds;
    const Model loaded = session.load(model);
    seconds.load = seconds_since(start);
    OutputFolder output(folder.empty() ? loaded.name + ".vantage" : folder);
    output.check();
    const ShapeAnalysis shape = analyse_shape(loaded, options, run.part(0.02, 0.5), &seconds);
    const UpChoice up = choose_up(loaded, shape, options);
    const auto search_start = Clock::now();
    const ViewReport report = find_views(shape, up, options, run.part(0.5, 0.9));
    seconds.search = seconds_since(search_start);

    const auto render_start = Clock::now();
    output.add("view.json", view_json(loaded, shape, report, options));
    if (!no_images) {
      add_pictures(output, shape, report, options, run.part(0.9, 1.0));
    }
    seconds.render = seconds_since(render_start);
    add_data(output, loaded, shape, report, options);
    seconds.total = seconds_since(start);
    output.add("timings.json", timings_json(seconds));
    output.write();
    if (!trace.empty()) {
      write_file(trace, trace_csv(report));
    }
    session.end_progress();
    if (session.flags.json) {
      write_file("-", view_json(loaded, shape, report, options, &seconds));
    } else {
      summarise(session, loaded, shape, report, output, seconds);
    }
  }

 private:
  static void add_pictures(OutputFolder& output, const ShapeAnalysis& shape,
                           const ViewReport& report, const ViewOptions& options,
                           const RunContext& run) {
    struct Shot {
      const char* name;
      const ReportedView& view;
      Picture picture;
    };

    const Shot shots[] = {{"best.png", report.best, Picture::Plain},
                          {"worst.png", report.worst, Picture::Plain},
                          {"best-kssm.png", report.best, Picture::Map},
                          {"worst-kssm.png", report.worst, Picture::Map},
                          {"best-skeleton.png", report.best, Picture::Skeleton},
                          {"worst-skeleton.png", report.worst, Picture::Skeleton}};
    double done = 0.0;
    const double share = 1.0 / std::size(shots);
    for (const Shot& shot : shots) {
      const Image image = take_picture(shape, shot.view.picture, shot.picture, options, {},
                                       run.part(done, std::min(1.0, done + share)));
      output.add(shot.name, png_bytes(image));
      done = std::min(1.0 - share, done + share);
    }
  }

  void add_data(OutputFolder& output, const Model& loaded, const ShapeAnalysis& shape,
                const ViewReport& report, const ViewOptions& options) const {
    const std::vector<double> map = on_input_vertices(shape, shape.map.of_vertex);
    output.add("map.ply", ply_bytes(loaded.mesh, map, colour_map(map), loaded.double_precision));
    output.add("skeleton.json", skeleton_json({.graph = &shape.skeleton.graph,
                                               .radius = shape.skeleton.radius,
                                               .vertex_node = nodes_of_input_vertices(shape)}));
    const PictureSize size{options.width, options.height};
    const std::pair<const char*, const ReportedView*> views[] = {{"best", &report.best},
                                                                 {"worst", &report.worst}};
    for (const auto& [name, view] : views) {
      const std::string stem = std::string("camera-") + name;
      output.add(stem + ".gltf", camera_gltf(view->picture, size, shape.sphere.diameter));
      output.add(stem + ".transforms.json",
                 camera_transforms_json(view->picture, size, std::string(name) + ".png"));
      output.add(stem + ".f3d.txt",
                 camera_f3d(view->picture, std::filesystem::path(model).filename().string()));
    }
  }

  static void summarise(Session& session, const Model& loaded, const ShapeAnalysis& shape,
                        const ViewReport& report, const OutputFolder& output,
                        const StageSeconds& seconds) {
    const MeshReport& check = shape.check;
    std::string kind = check.closed ? "closed" : "open";
    if (check.genus) {
      kind += ", genus " + std::to_string(*check.genus);
    }
    session.tell(printable(loaded.name) + ": " + plural(check.vertices, "vertex") + ", " +
                 plural(check.faces, "face") + ", " + plural(check.components, "component") + ", " +
                 kind);
    session.tell("  skeleton    " + plural(shape.skeleton.graph.nodes.size(), "node") + ", " +
                 plural(cycle_count(shape.skeleton.graph), "cycle") + ", from " +
                 plural(shape.history.level_count(), "contraction level"));
    session.tell("  best view   " + view_line(report.best));
    session.tell("  worst view  " + view_line(report.worst));
    session.tell("  search      " +
                 plural(report.best_search.evaluations + report.worst_search.evaluations, "view") +
                 " evaluated");
    session.tell("  time        " + timing_line(seconds));
    session.tell("  results in  " + printable(output.path()) + "/");
    if (session.flags.verbose) {
      for (const std::string& name : output.names()) {
        session.tell("              " + name);
      }
    }
    for (const auto* list : {&loaded.notes, &shape.warnings, &report.warnings}) {
      for (const std::string& warning : *list) {
        session.say("note: " + warning);
      }
    }
  }
};

}  // namespace

void add_view_command(CLI::App& program, Session& session) {
  add_command<ViewCommand>(
      program, session, "view", "best and worst view: pictures, cameras, map, skeleton, report",
      "Examples:\n"
      "  vantage view horse.ply\n"
      "  vantage view part.stl -o out --size 1024 --up z\n"
      "  vantage view horse.ply --preset paper --epsilon 1 --trace search.csv\n"
      "  vantage view horse.ply --json | jq .best.direction");
}

}  // namespace vantage::cli
