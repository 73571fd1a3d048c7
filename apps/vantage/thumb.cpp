// SPDX-License-Identifier: MIT
#include <nlohmann/json.hpp>

#include "vantage/core/error.h"
#include "vantage/io/model.h"
#include "vantage/io/write.h"
#include "vantage/mesh/measures.h"
#include "vantage/pipeline/find_views.h"
#include "vantage/pipeline/sidecar.h"
#include "vantage/render/render.h"
#include "vantage/report/view_report.h"

#include "commands.h"
#include "look_flags.h"
#include "method_flags.h"
#include "output_file.h"
#include "picture_file.h"
#include "preview_flag.h"
#include "terminal.h"

namespace vantage::cli {
namespace {

constexpr int kLargestThumbnail = 4096;

struct ThumbCommand {
  std::string model{};
  std::string file{};
  int size = 256;
  OptionFlags frame{};
  LookFlags look{};
  PreviewFlag preview{};

  void add_flags(CLI::App& app, Session& session) {
    app.add_option("MODEL", model, "file to read, or -")->required();
    const auto name = [this](const std::string& path) { file = checked_picture_name(path); };
    CLI::Option* place =
        app.add_option_function<std::string>("FILE", name, "picture to write, unless named by -o");
    app.add_option_function<std::string>(
           "-o,--output", name,
           "the same; WebP if it ends in .webp, else PNG, - for standard output")
        ->excludes(place);
    app.add_option("-s,--size", size, "width and height, pixels")
        ->check(CLI::Range(1, kLargestThumbnail))
        ->capture_default_str();
    frame.add(app, find_option("up"));
    frame.add(app, find_option("front"));
    look.add_to(app, Quality::Draft);
    preview.add_to(app);
    add_force_flag(app, session.flags);
    add_common_flags(app, session.flags);
  }

  void run(Session& session) {
    if (file.empty()) {
      throw CLI::RequiredError("FILE");
    }
    look.check(file);
    check_output(file, OutputKind::Picture, session.flags);
    AllOptions given;
    frame.apply(given);
    ViewOptions& options = given.view;
    options.width = options.height = size;
    options.margin_percent = look.margin_percent();
    const RunContext run = session.run();
    const Sidecar sidecar = session.read([&] { return sidecar_of(model); });
    sidecar.apply(options);
    look.suggest(sidecar.style);
    Model loaded = session.load(model, look.reading(size, size));
    session.computing([&] { return stand_along_axes(loaded, options); });
    const ShapeAnalysis shape = session.computing([&] { return prepare_surface(loaded, run); });
    const PictureView found = session.computing([&] {
      return sidecar.view ? framed(loaded, shape, *sidecar.view, options)
                          : find_picture_view(loaded, shape, options, run.part(0.1, 0.7));
    });
    const Camera& camera = found.view.picture;
    const Vec3 above = up_vector(found.choice.frame.up);
    look.write(file, loaded, shape, camera, Picture::Plain, options, above, run.part(0.7, 1.0));
    if (file != "-") {
      preview.show(session, shape, camera, options, look.of(loaded, above), run);
    }
    report(session, found);
    for (const std::string& note : loaded.notes) {
      if (session.flags.verbose || note == kMadeOpaque) {
        session.say("note: " + note);
      }
    }
  }

 private:
  /// The view that a sidecar names.
  static PictureView framed(const Model& loaded, const ShapeAnalysis& shape, const Vec3& direction,
                            const ViewOptions& options) {
    PictureView found;
    found.choice = choose_frame(loaded, shape, options);
    found.vertices = shape.surface.positions.size();
    found.view.direction = direction;
    found.view.picture = frame_points(
        referenced_points(shape.surface), scoring_camera(shape, options).viewpoint(direction),
        shape.sphere.centre, up_vector(found.choice.frame.up), 1.0, options.margin_percent / 100.0);
    return found;
  }

  void report(Session& session, const PictureView& found) const {
    session.end_progress();
    if (session.flags.json && file != "-") {
      const Vec3& d = found.view.direction;
      const nlohmann::ordered_json json = {{"file", file},
                                           {"size", size},
                                           {"direction", {d.x(), d.y(), d.z()}},
                                           {"up", up_name(found.choice.frame.up)},
                                           {"front", up_name(found.choice.frame.front)},
                                           {"vertices", found.vertices}};
      write_output("-", json.dump(2) + "\n");
    }
  }
};

}  // namespace

void add_thumb_command(CLI::App& program, Session& session) {
  add_command<ThumbCommand>(program, session, "thumb",
                            "a thumbnail of the best view, fast; for file managers and catalogues",
                            "Examples:\n"
                            "  vantage thumb horse.ply horse.png\n"
                            "  vantage thumb part.stl -o part.webp --size 512 --background white");
}

}  // namespace vantage::cli
