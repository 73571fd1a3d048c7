// SPDX-License-Identifier: MIT
#include <algorithm>

#include "vantage/core/error.h"
#include "vantage/io/model.h"
#include "vantage/io/write.h"
#include "vantage/pipeline/find_views.h"
#include "vantage/render/render.h"
#include "vantage/report/view_report.h"

#include "batch/json_text.h"
#include "commands.h"
#include "load_posed.h"
#include "look_flags.h"
#include "method_flags.h"
#include "notes.h"
#include "output_file.h"
#include "picture_file.h"
#include "preview_flag.h"
#include "terminal.h"

namespace vantage::cli {
namespace {

constexpr int kLargestThumbnail = 4096;  // px a side
constexpr const char* kUsualSize = "256";

/// Options with the size that a flag says. \throw CLI::ValidationError
ViewOptions sized(const std::string& text) {
  const std::string flag = "--size";
  ViewOptions options;
  try {
    set_size(options, text == "auto" ? text + ":" + kUsualSize : text);
  } catch (const InvalidInput& error) {
    throw refused(error, flag);
  }
  if (std::max(options.width, options.height) > kLargestThumbnail) {
    throw CLI::ValidationError(
        flag, "must be at most " + std::to_string(kLargestThumbnail) + " pixels a side");
  }
  return options;
}

struct ThumbCommand {
  std::string model{};
  std::string file{};
  std::string named_by{};  // FILE or --output
  ViewOptions size = sized(kUsualSize);
  OptionFlags frame{};
  LookFlags look{};
  PreviewFlag preview{};

  void add_flags(CLI::App& app, Session& session) {
    app.add_option("MODEL", model, "file to read, or -")->required();
    const auto takes_name = [this](const char* option) {
      return [this, option](const std::string& path) {
        file = checked_picture_name(path, option);
        named_by = option;
      };
    };
    CLI::Option* place = app.add_option_function<std::string>(
        "FILE", takes_name("FILE"), "picture to write, unless named by -o");
    app.add_option_function<std::string>("-o,--output", takes_name("--output"),
                                         "the same; WebP if it ends in .webp, else PNG (names of "
                                         "other formats are refused), - for "
                                         "standard output")
        ->excludes(place);
    app.add_option_function<std::string>(
           "-s,--size", [this](const std::string& text) { size = sized(text); },
           "width and height, pixels; auto: as wide or tall as what is seen, with as many pixels "
           "as 256x256; auto:SIZE: as many as SIZE")
        ->default_str(kUsualSize);
    frame.add(app, find_option("up"));
    frame.add(app, find_option("front"));
    look.add_to(app, Quality::Draft);
    preview.add_to(app);
    add_force_flag(app, session.flags);
    add_common_flags(app, session.flags);
  }

  void run(Session& session) {
    if (file.empty()) {
      throw CLI::RequiredError("FILE or --output");
    }
    session.leave_output_to(file, named_by);
    check_output(file, OutputKind::Picture, session.flags);
    AllOptions given;
    frame.apply(given);
    ViewOptions& options = given.view;
    options.width = size.width;
    options.height = size.height;
    options.fit_size = size.fit_size;
    look.check(file, options);
    options.margin_percent = look.margin_percent();
    const RunContext run = session.run();
    const Model loaded = load_posed(session, model, frame, options, &look);
    const ShapeAnalysis shape = session.computing([&] { return prepare_surface(loaded, run); });
    const PictureView found = session.computing(
        [&] { return find_picture_view(loaded, shape, options, run.part(0.1, 0.7)); });
    const Camera& camera = found.view.picture;
    const Vec3 above = up_vector(found.choice.frame.up);
    options = with_size(options, found.view.size);
    std::vector<std::string> warnings{
        found.warning, look.write(file, loaded, shape, camera, Picture::Plain, options, above,
                                  run.part(0.7, 1.0))};
    std::erase(warnings, "");
    if (file != "-") {
      preview.show(session, shape, camera, options, look.of(loaded, above), run);
    }
    std::vector<std::string> notes = loaded.notes;
    notes.insert(notes.end(), found.choice.notes.begin(), found.choice.notes.end());
    std::vector<std::string> all = warnings;
    all.insert(all.end(), notes.begin(), notes.end());
    report(session, found, all);
    say_warnings(session, warnings);
    for (const std::string& note : notes) {
      if (session.flags.verbose || note == kMadeOpaque) {
        session.say("note: " + note);
      }
    }
  }

 private:
  void report(Session& session, const PictureView& found,
              const std::vector<std::string>& warnings) const {
    session.end_progress();
    if (session.flags.json) {
      const Vec3& d = found.view.direction;
      const PictureSize& of = found.view.size;
      const batch::Json json = {{"file", file},
                                {"size", std::max(of.width, of.height)},
                                {"width", of.width},
                                {"height", of.height},
                                {"direction", {d.x(), d.y(), d.z()}},
                                {"up", up_name(found.choice.frame.up)},
                                {"front", up_name(found.choice.frame.front)},
                                {"vertices", found.vertices},
                                {"warnings", warnings}};
      write_output("-", batch::json_text(json, 2) + "\n");
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
