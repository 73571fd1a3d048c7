// SPDX-License-Identifier: MIT
#include "view_outputs.h"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>

#include "vantage/io/camera_files.h"
#include "vantage/io/write.h"
#include "vantage/pipeline/find_views.h"
#include "vantage/render/render.h"
#include "vantage/report/view_report.h"

#include "picture_check.h"

namespace vantage::cli {
namespace {

struct PictureKind {
  const char* kind;
  bool of_best;
  Picture shows;
};

constexpr std::array<PictureKind, 6> kPictures{{{"best", true, Picture::Plain},
                                                {"worst", false, Picture::Plain},
                                                {"best-kssm", true, Picture::Map},
                                                {"worst-kssm", false, Picture::Map},
                                                {"best-skeleton", true, Picture::Skeleton},
                                                {"worst-skeleton", false, Picture::Skeleton}}};
constexpr std::array<const char*, 3> kData{"map", "skeleton", "camera"};
constexpr const char* kReport = "report";
constexpr const char* kViews = "views";

}  // namespace

OutputKinds OutputKinds::all() {
  OutputKinds kinds;
  for (const PictureKind& picture : kPictures) {
    kinds.kinds_.insert(picture.kind);
  }
  kinds.kinds_.insert(kData.begin(), kData.end());
  kinds.kinds_.insert(kViews);
  if (has_report_page()) {
    kinds.kinds_.insert(kReport);
  }
  return kinds;
}

OutputKinds OutputKinds::parse(const std::string& text) {
  const OutputKinds known = all();
  OutputKinds kinds;
  std::size_t from = 0;
  while (from <= text.size()) {
    const std::size_t comma = std::min(text.find(',', from), text.size());
    const std::string kind = text.substr(from, comma - from);
    if (kind == kReport && !has_report_page()) {
      throw CLI::ValidationError("--write", "this program was built without npm: no report");
    }
    if (!known.has(kind) && kind != "json") {
      throw CLI::ValidationError("--write", "'" + kind + "' is none of json," + known.text());
    }
    if (kind != "json") {
      kinds.kinds_.insert(kind);
    }
    from = comma + 1;
  }
  return kinds;
}

bool OutputKinds::has_pictures() const {
  return has(kReport) || has(kViews) ||
         std::any_of(kPictures.begin(), kPictures.end(),
                     [&](const PictureKind& picture) { return has(picture.kind); });
}

std::string OutputKinds::text() const {
  std::string text;
  for (const std::string& kind : kinds_) {
    text += (text.empty() ? "" : ",") + kind;
  }
  return text;
}

std::optional<Image> add_pictures(OutputFolder& output, const OutputKinds& kinds,
                                  ShapePictures& pictures, ViewReport& report,
                                  const ViewOptions& options, const RunContext& run) {
  std::vector<std::string> names;
  std::vector<Image> images;
  for (const bool of_best : {true, false}) {
    std::vector<Picture> wanted;
    for (const PictureKind& picture : kPictures) {
      if (picture.of_best == of_best && kinds.has(picture.kind)) {
        names.emplace_back(picture.kind);
        wanted.push_back(picture.shows);
      }
    }
    if (wanted.empty()) {
      continue;
    }
    const ReportedView& view = of_best ? report.best : report.worst;
    for (Image& image : pictures.take(view.picture, wanted, with_size(options, view.size), {},
                                      of_best ? run.part(0.0, 0.5) : run.part(0.5, 1.0))) {
      images.push_back(std::move(image));
    }
  }
  std::vector<std::string> files = png_files(images, run);
  std::optional<Image> best;
  for (std::size_t i = 0; i < images.size(); ++i) {
    output.add(names[i] + ".png", std::move(files[i]));
    if (names[i] == "best") {
      best = std::move(images[i]);
    } else if (names[i] == "worst" && !emptiness_warning(images[i]).empty()) {
      report.warnings.emplace_back(
          "worst.png is next to empty: the model is too thin to show from there");
    }
  }
  if (std::string warning = best ? emptiness_warning(*best) : ""; !warning.empty()) {
    report.reliability_warnings.push_back(std::move(warning));
  }
  return best;
}

void add_report(OutputFolder& output, const OutputKinds& kinds, const Model& loaded,
                const ShapeAnalysis& shape, ShapePictures& pictures, const ViewReport& report,
                const ViewOptions& options, const RunContext& run) {
  if (kinds.has(kReport)) {
    output.add("report.html", report_html(loaded, shape, pictures, report, options, run));
  }
}

void add_data(OutputFolder& output, const OutputKinds& kinds, const Model& loaded,
              const ShapeAnalysis& shape, const ViewReport& report, const std::string& file) {
  if (kinds.has("map")) {
    const std::vector<double> map = on_input_vertices(shape, shape.significance);
    output.add("map.ply", ply_bytes(loaded.mesh, map, colour_map(map), loaded.double_precision));
  }
  if (kinds.has("skeleton")) {
    output.add("skeleton.json", skeleton_json({.graph = &shape.skeleton.graph,
                                               .radius = shape.skeleton.radius,
                                               .vertex_node = nodes_of_input_vertices(shape)}));
  }
  if (!kinds.has("camera")) {
    return;
  }
  const std::pair<const char*, const ReportedView*> views[] = {{"best", &report.best},
                                                               {"worst", &report.worst}};
  for (const auto& [name, view] : views) {
    const std::string stem = std::string("camera-") + name;
    output.add(stem + ".gltf", camera_gltf(view->picture, view->size, shape.sphere.diameter));
    output.add(stem + ".transforms.json",
               camera_transforms_json(view->picture, view->size, std::string(name) + ".png"));
    // These two name the file.
    const Camera camera = camera_of_file(view->picture, loaded.turn);
    output.add(stem + ".f3d.txt", camera_f3d(camera, view->size, file, shape.cloud.has_value()));
    if (view->picture.projection == Projection::Perspective) {
      output.add(stem + ".model-viewer.html",
                 camera_model_viewer(camera, loaded.turn.transpose() * up_vector(report.up), file));
    }
  }
}

}  // namespace vantage::cli
