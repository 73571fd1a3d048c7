// SPDX-License-Identifier: MIT
// Camera and size of a picture of the whole surface.
#include <algorithm>
#include <cmath>
#include <iomanip>
#include <span>
#include <sstream>
#include <string>

#include "vantage/core/error.h"
#include "vantage/mesh/measures.h"
#include "vantage/pipeline/find_views.h"
#include "vantage/render/render.h"

#include "core/degrees.h"
#include "pipeline/drawn_points.h"

namespace vantage {
namespace {

/// Longer pictures would be awkward beside text and in rows. [ours]
constexpr double kWidest = 2.0;

int side(double pixels) {
  return static_cast<int>(std::clamp(std::round(pixels), 1.0, static_cast<double>(kLargestSide)));
}

/// Brings the target to the depth of the focus, and a parallel camera's eye to where nothing of the shape
/// is behind it: what hides the focus is drawn.
void settle_on_focus(Camera& camera, std::span<const Vec3> focus, const ShapeAnalysis& shape) {
  const Vec3 back = (camera.eye - camera.target).normalized();
  camera.target += (enclosing_sphere(focus).centre - camera.target).dot(back) * back;
  if (camera.projection == Projection::Orthographic) {
    const double nearest = (shape.sphere.centre - camera.target).dot(back);
    camera.eye = camera.target + (nearest + shape.sphere.diameter) * back;
  }
}

std::string in_radii(double distance) {
  std::ostringstream text;
  text << std::fixed << std::setprecision(4) << distance << " radii";
  return text.str();
}

double aspect_of(PictureSize size) {
  return static_cast<double>(size.width) / size.height;
}

}  // namespace

PictureFrame frame_picture(const ShapeAnalysis& shape, const Vec3& direction, UpAxis up,
                           const ViewOptions& options) {
  const ScoringCamera camera = scoring_camera(shape, options);
  const auto [points, margin] = framed_points(shape, options.margin_percent);
  const Viewpoint eye = camera.viewpoint(direction);
  const Vec3 above = up_vector(up);
  PictureSize size{options.width, options.height};
  if (options.fit_size) {
    const double aspect = fitting_aspect(points, eye, camera.sphere.centre, above, margin);
    size = size_with_aspect(options, std::clamp(aspect, 1.0 / kWidest, kWidest));
  }
  PictureFrame frame{
      frame_points(points, eye, camera.sphere.centre, above, aspect_of(size), margin), size};
  if (!shape.focus.empty()) {
    settle_on_focus(frame.camera, points, shape);
  }
  return frame;
}

void check_framing(const ViewOptions& options) {
  if (options.projection == Projection::Orthographic || !options.focus.empty()) {
    return;
  }
  const double distance = ScoringCamera{.sphere = {Vec3::Zero(), 2.0},
                                        .projection = options.projection,
                                        .fov_y_deg = options.fov_y_deg,
                                        .distance_factor = options.distance_factor}
                              .distance();
  const double least = least_distance(options.margin_percent / 100.0);
  if (distance < least) {
    throw InvalidInput("option " + std::string(options.distance_factor ? "distance" : "fov") +
                       " puts the eye " + in_radii(distance) +
                       " from the centre; with this margin a picture shows all of a ball from " +
                       in_radii(std::ceil(1e4 * least) / 1e4) + " on");
  }
}

PictureSize size_with_aspect(const ViewOptions& options, double aspect) {
  const double area = static_cast<double>(options.width) * options.height;
  // The shorter side first: so the aspect of a size that was found is again of that size.
  const int shorter = side(std::sqrt(area / std::max(aspect, 1.0 / aspect)));
  const int longer = side(area / shorter);
  return aspect >= 1.0 ? PictureSize{longer, shorter} : PictureSize{shorter, longer};
}

ViewOptions with_size(ViewOptions options, PictureSize size) {
  options.width = size.width;
  options.height = size.height;
  options.fit_size = false;
  return options;
}

Camera camera_for(const ReportedView& view, PictureSize size) {
  Camera camera = view.picture;
  const double wider = std::max(1.0, aspect_of(view.size) / aspect_of(size));
  if (wider > 1.0) {
    const double half = std::tan(0.5 * camera.fov_y_deg * kRadPerDeg);
    camera.fov_y_deg = 2.0 * std::atan(wider * half) / kRadPerDeg;
    camera.height *= wider;
  }
  return camera;
}

}  // namespace vantage
