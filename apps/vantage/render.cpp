// SPDX-License-Identifier: MIT
#include "vantage/render/render.h"

#include <map>

#include "vantage/core/error.h"
#include "vantage/io/camera_files.h"
#include "vantage/io/write.h"
#include "vantage/pipeline/find_views.h"
#include "vantage/pipeline/option_table.h"
#include "vantage/report/view_report.h"

#include "batch/json_text.h"
#include "commands.h"
#include "input_text.h"
#include "load_posed.h"
#include "look_flags.h"
#include "method_flags.h"
#include "notes.h"
#include "output_file.h"
#include "picture_file.h"
#include "terminal.h"

namespace vantage::cli {
namespace {

struct RenderCommand {
  std::string model{};
  std::string file{};
  std::string direction_text{};
  std::string camera_file{};
  std::string view{};
  std::string show = "plain";
  LookFlags look{};
  MethodFlags method{};

  void add_flags(CLI::App& app, Session& session) {
    app.add_option("MODEL", model, "file to read, or -")->required();
    app.add_option_function<std::string>(
           "-o,--output",
           [this](const std::string& path) { file = checked_picture_name(path, "--output"); },
           "picture to write: WebP if it ends in .webp, else PNG; names of other formats are "
           "refused")
        ->required();
    CLI::Option_group* from = app.add_option_group("From", "where to look from: one of");
    from->add_option("--direction", direction_text, "x,y,z: from the model's centre to the eye");
    from->add_option(
        "--camera", camera_file,
        "a camera: glTF, transforms.json, or view.json (its best view); the picture is "
        "of its aspect, unless --size says another");
    from->add_option("--view", view, "best or worst: search for it")
        ->check(CLI::IsMember({"best", "worst"}));
    from->require_option(1);
    app.add_option("--show", show, "plain surface, KSSM colours, or the skeleton through it")
        ->check(CLI::IsMember({"plain", "kssm", "skeleton"}))
        ->capture_default_str()
        ->group("Pictures");
    look.add_to(app, Quality::Normal);
    method.add_to(app, {.map = true, .camera = true, .search = true, .picture = true});
    add_force_flag(app, session.flags);
    add_common_flags(app, session.flags);
  }

  void run(Session& session) {
    session.leave_output_to(file, "-o");
    check_output(file, OutputKind::Picture, session.flags);
    ViewOptions options = session.read([&] { return method.resolve(session.flags.seed); });
    look.check(file, options);
    refuse_idle_flags(session);
    options.margin_percent = look.margin_percent();
    const RunContext run = session.run();
    std::optional<Vec3> direction;
    if (!direction_text.empty()) {
      direction = unit(parse_vector(direction_text, "--direction"));
    }
    std::optional<PictureFrame> frame;
    if (!camera_file.empty()) {
      options.fit_size |= !method.has("size");
      frame = session.read([&] { return given_camera(options); });
    }
    const Model loaded = load_posed(session, model, method.flags(), options, &look);
    const bool is_sought = !view.empty() && !(view == "best" && options.best_view);
    const bool needs_map = is_sought || show != "plain";
    const ShapeAnalysis shape = session.computing([&] {
      const AnalysisUse use = !is_sought           ? AnalysisUse::Map
                              : show == "skeleton" ? AnalysisUse::Views
                                                   : AnalysisUse::Picture;
      return needs_map ? analyse_shape(loaded, options, run.part(0.0, 0.5), nullptr, use)
                       : prepare_surface(loaded, options, run);
    });
    std::optional<FrameChoice> choice;
    if (!frame || look.look().ground) {
      choice = session.computing([&] { return choose_frame(loaded, shape, options); });
    }
    std::vector<std::string> warnings;
    if (!frame) {
      frame = session.computing([&] {
        return !is_sought
                   ? frame_picture(shape,
                                   direction.value_or(options.best_view.value_or(Vec3::UnitZ())),
                                   choice->frame.up, options)
                   : found(shape, *choice, options, warnings, run.part(0.5, 0.9));
      });
    }
    const Vec3 up = look.look().ground ? up_vector(choice->frame.up) : RenderOptions{}.up;
    const std::map<std::string, Picture> pictures{
        {"plain", Picture::Plain}, {"kssm", Picture::Map}, {"skeleton", Picture::Skeleton}};
    warnings.push_back(look.write(file, loaded, shape, frame->camera, pictures.at(show),
                                  with_size(options, frame->size), up, run.part(0.9, 1.0)));
    std::erase(warnings, "");
    std::vector<std::string> all = warnings;
    all.insert(all.end(), loaded.notes.begin(), loaded.notes.end());
    if (is_sought) {
      all.insert(all.end(), choice->notes.begin(), choice->notes.end());
    }
    report(session, *frame, options, all);
    say_warnings(session, warnings);
    if (look.of_asset()) {
      say_notes(session, loaded.notes);
    }
    if (is_sought) {
      say_notes(session, choice->notes);
    }
  }

 private:
  void refuse_idle_flags(const Session& session) const {
    session.refuse_idle(idle_in_picture({.has_camera = !camera_file.empty(),
                                         .is_searched = !view.empty(),
                                         .shows_map = show != "plain",
                                         .has_ground = look.look().ground}));
  }

  static Vec3 unit(const Vec3& v) {
    const std::optional<Vec3> direction = unit_vector(v);
    if (!direction) {
      throw CLI::ValidationError("--direction",
                                 "must be three finite numbers, not all of them zero");
    }
    return *direction;
  }

  /// The camera of the file, for a picture of the aspect that the file says if none is wanted.
  [[nodiscard]] PictureFrame given_camera(const ViewOptions& options) const {
    const std::string text = read_text(camera_file);
    PictureFrame frame{parse_camera(text, camera_file), {options.width, options.height}};
    const std::optional<double> aspect =
        options.fit_size ? parse_camera_aspect(text, camera_file) : std::nullopt;
    if (aspect) {
      frame.size = size_with_aspect(options, *aspect);
    }
    return frame;
  }

  [[nodiscard]] PictureFrame found(const ShapeAnalysis& shape, const FrameChoice& choice,
                                   const ViewOptions& options, std::vector<std::string>& warnings,
                                   const RunContext& run) const {
    const Goal goal = view == "best" ? Goal::Best : Goal::Worst;
    const ReportedView of = find_view(shape, goal, choice, options, run);
    if (goal == Goal::Best) {
      warnings.push_back(blank_view_warning(shape, of, options));
    }
    return {of.picture, of.size};
  }

  void report(Session& session, const PictureFrame& frame, const ViewOptions& options,
              const std::vector<std::string>& warnings) const {
    const auto& [camera, size] = frame;
    const auto point = [](const Vec3& p) { return batch::Json::array({p.x(), p.y(), p.z()}); };
    if (session.flags.json) {
      session.end_progress();
      batch::Json json = {
          {"file", file},
          {"width", size.width},
          {"height", size.height},
          {"eye", point(camera.eye)},
          {"target", point(camera.target)},
          {"up", point(camera.up)},
          {"fov_y_deg", camera.fov_y_deg},
          {"options", batch::parsed_json(options_json({.view = options, .look = look.look()}))},
          {"warnings", warnings}};
      if (camera.projection == Projection::Orthographic) {
        json["orthographic_height"] = camera.height;  // of what is seen, as in transforms.json
      }
      write_output("-", batch::json_text(json, 2) + "\n");
      return;
    }
    session.tell(printable(file) + ": " + std::to_string(size.width) + " × " +
                 std::to_string(size.height));
  }
};

}  // namespace

void add_render_command(CLI::App& program, Session& session) {
  add_command<RenderCommand>(
      program, session, "render", "one picture of a model",
      "Examples:\n"
      "  vantage render horse.ply -o horse.png --direction 1,0.6,1\n"
      "  vantage render horse.ply -o map.png --view best --show kssm\n"
      "  vantage render horse.ply -o again.png --camera horse.vantage/view.json");
}

}  // namespace vantage::cli
