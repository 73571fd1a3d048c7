// SPDX-License-Identifier: MIT
#include "vantage/render/colour_map.h"
#include "vantage/render/render.h"
#include "vantage/report/view_report.h"

namespace vantage {
namespace {

/// Radius of the skeleton's tubes over D: thin enough for fingers, thick enough to see.
constexpr double kTubeRadius = 0.004;

}  // namespace

Image take_picture(const ShapeAnalysis& shape, const Camera& camera, Picture picture,
                   const ViewOptions& options, const std::optional<Rgb8>& background,
                   const RunContext& run) {
  RenderOptions look;
  set_quality(look, Quality::Normal);
  look.background = background;
  return draw_picture(shape, camera, picture, options, look, run);
}

Image draw_picture(const ShapeAnalysis& shape, const Camera& camera, Picture picture,
                   const ViewOptions& options, RenderOptions look, const RunContext& run,
                   std::span<const Rgb8> surface_colours) {
  look.width = options.width;
  look.height = options.height;
  std::vector<Rgb8> colours(surface_colours.begin(), surface_colours.end());
  TubeOverlay overlay;
  if (picture == Picture::Map) {
    colours = colour_map(shape.map.of_vertex);
  } else if (picture == Picture::Skeleton) {
    overlay.graph = &shape.skeleton.graph;
    overlay.radius = kTubeRadius * shape.sphere.diameter;
  }
  return render(shape.surface, camera, colours, overlay, look, run);
}

std::vector<Rgb8> asset_colours(const Model& model, const ShapeAnalysis& shape) {
  if (model.vertex_colours.empty()) {
    return {};
  }
  std::vector<Rgb8> colours(shape.surface.positions.size());
  for (std::size_t v = shape.surface_vertex.size(); v-- > 0;) {
    colours[shape.surface_vertex[v]] = model.vertex_colours[v];
  }
  return colours;
}

}  // namespace vantage
