// SPDX-License-Identifier: MIT
#include <array>
#include <optional>
#include <utility>

#include "vantage/core/error.h"
#include "vantage/mesh/measures.h"
#include "vantage/pipeline/find_views.h"
#include "vantage/render/render.h"
#include "vantage/report/view_report.h"

#include "arguments.h"
#include "arrays.h"
#include "camera.h"
#include "released_run.h"
#include "subject.h"

namespace vantage::python {
namespace {

/// Where a picture is taken from: one of these.
struct Standpoint {
  std::optional<Vec3> direction{};
  std::optional<Camera> camera{};
  std::optional<bool> best{};  ///< Search for the best view, or the worst.
};

Standpoint standpoint_of(const py::object& direction, const py::object& camera,
                         const py::object& view) {
  const int given = static_cast<int>(!direction.is_none()) + static_cast<int>(!camera.is_none()) +
                    static_cast<int>(!view.is_none());
  if (given > 1) {
    throw InvalidInput("say where to look from by one of direction, camera and view");
  }
  Standpoint from;
  if (!direction.is_none()) {
    from.direction = unit_vector(vector_of(direction, "direction"));
    if (!from.direction) {
      throw InvalidInput("direction must not be zero, and of a finite length");
    }
  } else if (!camera.is_none()) {
    from.camera = camera_of(camera);
  } else {
    const std::string name = view.is_none() ? "best" : word_of(view, "view");
    if (name != "best" && name != "worst") {
      throw InvalidInput("view is '" + name + "' but must be best or worst");
    }
    from.best = name == "best";
  }
  return from;
}

Picture picture_of(const std::string& show) {
  if (show == "plain") {
    return Picture::Plain;
  }
  if (show == "kssm") {
    return Picture::Map;
  }
  if (show == "skeleton") {
    return Picture::Skeleton;
  }
  throw InvalidInput("show is '" + show + "' but must be plain, kssm or skeleton");
}

PictureFrame frame_from(const Standpoint& from, const Analysis& analysis,
                        const ViewOptions& options, const RunContext& run) {
  if (from.camera) {
    return {*from.camera, {options.width, options.height}};
  }
  const ShapeAnalysis& shape = analysis.shape;
  const FrameChoice choice = choose_frame(*analysis.model, shape, options);
  if (from.best) {
    const ViewReport report = find_views(shape, choice, options, run);
    const ReportedView& view = *from.best ? report.best : report.worst;
    return {view.picture, view.size};
  }
  return frame_picture(shape, *from.direction, choice.frame.up, options);
}

Image drawn(const Analysis& analysis, const Camera& camera, Picture picture,
            const Settings& settings, const RenderOptions& look,
            const std::optional<std::vector<Rgb8>>& colours, const RunContext& run) {
  if (colours && colours->size() != analysis.shape.surface_vertex.size()) {
    throw InvalidInput("colours has " + std::to_string(colours->size()) +
                       " rows, but the model has " +
                       std::to_string(analysis.shape.surface_vertex.size()) + " vertices");
  }
  if (colours && picture == Picture::Plain) {
    const Model given{.vertex_colours = *colours};  // no faces: of the shape's own vertices
    return draw_picture(analysis.shape, camera, picture, settings.view, look, run, &given);
  }
  const Model* asset = settings.look.style == Style::Asset ? &*analysis.model : nullptr;
  return draw_picture(analysis.shape, camera, picture, settings.view, look, run, asset);
}

py::array render_picture(const py::object& model, const py::object& F, const py::object& direction,
                         const py::object& camera, const py::object& view, const py::object& show,
                         const py::object& colours, const py::dict& options,
                         const py::object& progress, const py::object& threads) {
  const Subject subject(model, F);
  const Standpoint from = standpoint_of(direction, camera, view);
  const Picture picture = picture_of(word_of(show, "show"));
  Settings settings = subject.settings(options, [&](const Settings& all) {
    return idle_in_picture({.has_camera = from.camera.has_value(),
                            .is_searched = from.best.has_value(),
                            .shows_map = picture != Picture::Plain,
                            .has_ground = all.look.ground});
  });
  std::optional<std::vector<Rgb8>> given;
  if (!colours.is_none()) {
    given = colours_of(colours);
    if (picture != Picture::Plain) {
      throw InvalidInput("colours goes with show plain only: other pictures have their own");
    }
  }
  const bool needs_map = from.best || picture != Picture::Plain;
  Image image = released({progress, threads}, [&](const RunContext& run) {
    const auto analysis =
        subject.analysed(settings, needs_map ? with_map : surface_only, run.part(0.0, 0.5), true);
    const ShapeAnalysis& shape = analysis->shape;
    const PictureFrame taken = frame_from(from, *analysis, settings.view, run.part(0.5, 0.9));
    RenderOptions look = settings.look;
    if (look.ground) {
      look.up = up_vector(choose_frame(*analysis->model, shape, settings.view).frame.up);
    }
    settings.view = with_size(settings.view, taken.size);
    return drawn(*analysis, taken.camera, picture, settings, look, given, run.part(0.9, 1.0));
  });
  return owned_array<std::uint8_t>(std::move(image.rgba),
                                   {py::ssize_t{image.height}, py::ssize_t{image.width}, 4});
}

py::array colours_of_values(const py::object& values) {
  return owned_array(colour_map(numbers_of(values, "values")));
}

}  // namespace

void define_pictures(py::module_& module) {
  module.def("render", &render_picture, py::arg("model"), py::arg("F"), py::arg("direction"),
             py::arg("camera"), py::arg("view"), py::arg("show"), py::arg("colours"),
             py::arg("options"), py::arg("progress"), py::arg("threads"));
  module.def("colour_map", &colours_of_values, py::arg("values"));
}

}  // namespace vantage::python
