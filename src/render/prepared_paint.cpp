// SPDX-License-Identifier: MIT
#include "render/prepared_paint.h"

#include "core/srgb.h"
#include "render/colour_scale.h"
#include "render/shading.h"

namespace vantage {

PreparedPaint::PreparedPaint(const Paint& paint, const DrawnSurface& surface,
                             const PictureRays& rays, const RenderOptions& options)
    : surface_(&surface),
      colour_(linear_of_srgb(options.colour)),
      share_of_vertex_(shares_of_range(paint.vertex_values)),
      materials_(paint.appearance != nullptr ? surface.materials() : nullptr),
      is_drawing_(options.style == Style::Technical),
      tube_colour_(linear_of_srgb(paint.overlay.colour)) {
  colour_of_vertex_.reserve(paint.vertex_colours.size());
  for (const Rgb8& colour : paint.vertex_colours) {
    colour_of_vertex_.emplace_back(linear_of_srgb(colour).cast<float>());
  }
  if (paint.overlay.graph != nullptr) {
    CurveGraph graph = *paint.overlay.graph;
    for (Vec3& node : graph.nodes) {
      node = surface.frame().to_frame(node);
    }
    tubes_.emplace(graph, paint.overlay.radius * surface.frame().scale, rays, options.width,
                   options.height);
  }
}

SurfaceMaterials::Shown PreparedPaint::shown(const RayHit& hit, double width) const {
  SurfaceMaterials::Shown shown;
  const Triangle& t = surface_->mesh().triangles[hit.face];
  const auto mixed = [&](const auto& of_vertex) {
    return (1.0F - hit.u - hit.v) * of_vertex[t[0]] + hit.u * of_vertex[t[1]] +
           hit.v * of_vertex[t[2]];
  };
  if (!share_of_vertex_.empty()) {
    shown.colour = linear_cool_warm(mixed(share_of_vertex_));
    return shown;
  }
  if (materials_ != nullptr) {
    shown = materials_->at(hit.face, hit.u, hit.v, width);
  }
  if (!colour_of_vertex_.empty()) {
    const Vec3f colour = mixed(colour_of_vertex_);
    shown.colour = shown.colour.cwiseProduct(colour.cast<double>().cwiseMax(0.0).cwiseMin(1.0));
  } else if (!shown.has_material) {
    shown.colour = colour_;
  }
  if (!is_drawing_ && !shown.unlit) {
    shown.colour = lifted_from_black(shown.colour);
  }
  return shown;
}

}  // namespace vantage
