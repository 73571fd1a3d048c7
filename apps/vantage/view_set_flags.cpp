// SPDX-License-Identifier: MIT
#include "view_set_flags.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <string_view>

#include "vantage/core/error.h"
#include "vantage/io/camera_files.h"
#include "vantage/io/write.h"
#include "vantage/pipeline/find_views.h"
#include "vantage/render/render.h"
#include "vantage/report/figures.h"

#include "picture_file.h"
#include "settings.h"
#include "terminal.h"
#include "value_checks.h"

namespace vantage::cli {
namespace {

// Degrees a second that the eye travels unless --tour-seconds says otherwise. [ours]: a full turn
// in ten seconds, slow enough to see what passes.
constexpr double kDegPerSecond = 36.0;
constexpr double kDegPerRad = 180.0 / std::numbers::pi;
// Keys of the moving camera, one for this angle. Straight lines between them stay within 4e-5 of
// the view sphere's radius.
constexpr double kDegPerKey = 1.0;
// Rays of the moving pictures. [ours]: one occlusion ray leaves grain, which a lossy format pays for
// (fan.ply: 1.03 MB with it, 0.65 MB without), and enough of them to leave none take too long.
constexpr int kTourSamples = 9;
constexpr int kTourAmbientRays = 0;
constexpr int kMostFrames = 4000;
constexpr double kMostTourSeconds = 600.0;
constexpr int kViewsOfBatch = 6;  // with --write views alone: as many as a box has sides
constexpr const char* kGroup = "Several views";  // in the help

std::string numbered(std::size_t i) {
  return (i < 9 ? "view-0" : "view-") + std::to_string(i + 1);
}

std::string right_aligned(const std::string& text, std::size_t width) {
  return std::string(width > text.size() ? width - text.size() : 0, ' ') + text;
}

bool is_webp(const std::string& file) {
  return std::filesystem::path(file).extension() == ".webp";
}

std::string check_tour_name(const std::string& file) {
  const bool known = is_webp(file) || std::filesystem::path(file).extension() == ".png";
  return known ? "" : "the tour's file must end in .webp or .png (animated PNG)";
}

std::optional<ViewSetRequest> checked(const ViewOptions& options) {
  try {
    return checked_view_set(options);
  } catch (const InvalidInput& error) {
    throw refused(error);
  }
}

}  // namespace

void ViewSetFlags::add_set_to(CLI::App& app) {
  flags_.add_groups(app, {"set"});
}

void ViewSetFlags::add_to(CLI::App& app) {
  add_set_to(app);
  const std::string group = kGroup;
  CLI::Option* const tour =
      app.add_option("--tour", tour_, "moving picture of the round over the views: .webp or .png")
          ->check(check_tour_name)
          ->group(group);
  tour_option_ = tour;
  app.add_option("--tour-seconds", seconds_, "length of the tour; default: 36 degrees a second")
      ->check(within(0.1, kMostTourSeconds))
      ->needs(tour)
      ->group(group);
  app.add_option("--fps", fps_, "pictures a second of the tour")
      ->check(within(1, 60))
      ->capture_default_str()
      ->needs(tour)
      ->group(group);
  app.add_option_function<std::string>(
         "--tour-size",
         [this](const std::string& text) {
           std::tie(width_, height_) = parse_size(text, "--tour-size");
         },
         "size of the tour's pictures in pixels, like --size")
      ->default_str("480x360")
      ->needs(tour)
      ->group(group);
}

void ViewSetFlags::forget_settings() {
  flags_.forget("set");
  tour_.clear();
}

/// What was asked for, but for settings that have no effect beside the others.
ViewSetRequest ViewSetFlags::as_given() {
  AllOptions all;
  flags_.apply(all);
  const ViewSelection selection = all.view.view_set.value_or(ViewSetRequest{}).selection;
  if (selection == ViewSelection::Feixas) {
    flags_.insists_on("coverage");
  } else {
    flags_.insists_on("information");
  }
  if (selection != ViewSelection::Kssm) {
    flags_.insists_on("min-separation");
    flags_.insists_on("refine");
  }
  all = {};
  flags_.apply(all);
  return all.view.view_set.value_or(ViewSetRequest{});
}

std::optional<ViewSetRequest> ViewSetFlags::request() {
  const ViewSetRequest given = as_given();
  const bool is_tour_typed = !tour_.empty() && is_typed(*tour_option_);
  const std::string flag = is_tour_typed ? "--tour" : flags_.first_typed("set");
  const bool has_end = given.set.views || given.set.coverage || given.information > 0.0;
  if (!has_end && !flag.empty()) {
    throw CLI::ValidationError(flag,
                               "say how many views are wanted, with --views N or --coverage C");
  }
  if (!has_end) {
    forget_settings();
    return std::nullopt;
  }
  ViewOptions options;
  options.view_set = given;
  const std::optional<ViewSetRequest> request = checked(options);
  if (request->set.views == 1 && request->path == TourPath::Round) {
    if (is_tour_typed) {
      throw CLI::ValidationError("--tour",
                                 "goes over two views at least: ask for more with --views");
    }
    tour_.clear();
  }
  check_sides(tour_, width_, height_, "--tour-size");
  if (!tour_.empty() && std::round(seconds_ * fps_) > kMostFrames) {
    throw CLI::ValidationError("--tour-seconds", "makes " + rounded(seconds_ * fps_, 6) +
                                                     " pictures with --fps " + rounded(fps_) +
                                                     ", but at most " +
                                                     std::to_string(kMostFrames) + " are made");
  }
  return request;
}

ViewSetRequest ViewSetFlags::request_or(int views) {
  ViewOptions options;
  ViewSetRequest& request = options.view_set.emplace(as_given());
  if (!request.set.views && !request.set.coverage && !(request.information > 0.0)) {
    request.set.views = views;
  }
  return checked(options).value();
}

double ViewSetFlags::seconds(const ReportedViewSet& set) const {
  const double usual = std::max(1.0, set.way_rad() * kDegPerRad / kDegPerSecond);
  return seconds_ > 0.0 ? seconds_ : std::min(usual, static_cast<double>(kMostFrames) / fps_);
}

namespace {

/// The views on one sheet, small.
Image contact_sheet(const ShapeAnalysis& shape, const ReportedViewSet& set, ViewOptions options,
                    const PictureLook& look, const RunContext& run) {
  constexpr int kTileWidth = 320;  // px
  // Of higher pictures a tile shows more at the sides: a row of them would be no sheet.
  constexpr int kMostTileHeight = 2 * kTileWidth;
  options.height = std::clamp(kTileWidth * options.height / options.width, 1, kMostTileHeight);
  options.width = kTileWidth;
  return view_sheet(shape, set, options, run, look);
}

}  // namespace

void ViewSetFlags::write(OutputFolder& output, const ShapeAnalysis& shape, ShapePictures& pictures,
                         const ViewReport& report, UpAxis up, const ViewOptions& options,
                         const RunContext& run) const {
  if (!report.set) {
    return;
  }
  const std::vector<ReportedView>& views = report.set->views;
  std::vector<NamedCamera> cameras;
  const double sheet_end = tour_.empty() ? 1.0 : 0.3;
  const double stills_share = 0.8 * sheet_end;
  for (std::size_t i = 0; i < views.size(); ++i) {
    const std::string name = numbered(i);
    const double step = stills_share / static_cast<double>(views.size());
    if (options.pictures) {
      const RunContext part =
          run.part(static_cast<double>(i) * step, std::min(1.0, static_cast<double>(i + 1) * step));
      constexpr std::array kPlain{Picture::Plain};
      output.add(name + ".png", png_bytes(pictures
                                              .take(views[i].picture, kPlain,
                                                    with_size(options, views[i].size), {}, part)
                                              .front()));
    }
    output.add("camera-" + name + ".gltf",
               camera_gltf(views[i].picture, views[i].size, shape.sphere.diameter));
    cameras.push_back({views[i].picture, name + ".png", views[i].size});
  }
  output.add("views.transforms.json", views_transforms_json(cameras));
  if (options.pictures) {
    output.add("views.png", png_bytes(contact_sheet(shape, *report.set, options, pictures.look(),
                                                    run.part(stills_share, sheet_end))));
  }
  if (report.set->way_rad() > 0.0) {
    write_tour(output, shape, pictures, report, up, options.margin_percent,
               run.part(sheet_end, 1.0));
  } else if (!tour_.empty()) {
    throw InvalidInput(
        "one view sees everything asked for, so there is no tour; ask for more "
        "with --views, or leave --tour out");
  }
}

void ViewSetFlags::require_use(bool is_used) {
  if (is_used) {
    return;
  }
  const std::string flag = flags_.first_typed("set");
  if (!flag.empty()) {
    throw CLI::ValidationError(flag, "goes with --method kssm and mesh-saliency only");
  }
  forget_settings();
}

void ViewSetFlags::check_names(const OutputFolder& output) const {
  const std::string name = std::filesystem::path(tour_).filename().string();
  if (name != "tour.webp" && name != "tour.png") {  // which are left to it
    output.refuse_own_name(tour_, "--tour");
  }
}

void ViewSetFlags::write_tour(OutputFolder& output, const ShapeAnalysis& shape,
                              ShapePictures& pictures, const ViewReport& report, UpAxis up,
                              double margin_percent, const RunContext& run) const {
  const ReportedViewSet& set = *report.set;
  const double aspect = static_cast<double>(width_) / height_;
  const double length = seconds(set);
  const auto keys =
      static_cast<std::size_t>(std::max(12.0, std::ceil(set.way_rad() * kDegPerRad / kDegPerKey)));
  output.add("tour.gltf", camera_animation_gltf(tour_cameras(shape, set, report.camera, up, aspect,
                                                             keys, margin_percent),
                                                length, {width_, height_}, shape.sphere.diameter));
  if (tour_.empty()) {
    return;
  }
  const int frames = static_cast<int>(std::max(3.0, std::round(length * fps_)));
  RenderOptions look = pictures.look().render;
  look.width = width_;
  look.height = height_;
  look.samples = kTourSamples;
  look.ambient_rays = kTourAmbientRays;
  AnimationEncoder encoder(is_webp(tour_) ? AnimationFormat::WebP : AnimationFormat::Apng, width_,
                           height_, frames, fps_);
  double done = 0.0;
  for (const Camera& camera : tour_cameras(shape, set, report.camera, up, aspect,
                                           static_cast<std::size_t>(frames), margin_percent)) {
    const double next = std::min(1.0, done + 1.0 / frames);
    encoder.add(pictures.take_plain(camera, look, run.part(done, next)));
    done = next;
  }
  output.add_named(tour_, encoder.finish());
}

ViewOptions view_options_of(MethodFlags& method, ViewSetFlags& several, const LookFlags& look,
                            const OutputKinds& kinds, std::uint64_t seed) {
  ViewOptions options = method.resolve(seed);
  options.margin_percent = look.margin_percent();
  options.view_set = kinds.has("views") ? several.request_or(kViewsOfBatch) : several.request();
  refuse_near_eye(options);
  return options;
}

std::string view_set_table(const ReportedViewSet& set) {
  std::string text = "  view    direction                       gain  coverage";
  for (std::size_t i = 0; i < set.views.size(); ++i) {
    const Vec3& d = set.views[i].direction;
    const std::string direction =
        "(" + rounded(d.x(), 3) + ", " + rounded(d.y(), 3) + ", " + rounded(d.z(), 3) + ")";
    const ChosenView& chosen = set.choice.views[i];
    std::string row = "  " + right_aligned(std::to_string(i + 1), 4) + "    " + direction;
    row.resize(std::max<std::size_t>(row.size(), 36), ' ');
    text += "\n" + row + right_aligned(rounded(chosen.gain, 6), 10) +
            right_aligned(rounded(100.0 * chosen.coverage, 4), 8) + " %";
  }
  text += "\n  as much coverage needs at least " + plural(set.choice.least_views, "view");
  if (set.views.size() > 1) {
    text += "; tour of " + rounded(set.tour.length_rad * kDegPerRad, 4) + " degrees";
    text += set.tour.optimal ? "" : " (not proved shortest)";
  }
  if (set.way) {
    text += "\n  explored " + rounded(100.0 * set.way->coverage, 4) + " % on " +
            rounded(set.way->length_rad * kDegPerRad, 4) + " degrees";
  }
  return text;
}

}  // namespace vantage::cli
