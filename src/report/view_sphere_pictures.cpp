// SPDX-License-Identifier: MIT
#include "report/view_sphere_pictures.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <vector>

#include <Eigen/Geometry>

#include "vantage/render/render.h"

#include "report/cloud_picture.h"
#include "report/line_drawing.h"

namespace vantage {
namespace {

// The wireframe's distance from the centre at the worst and at the best view, in radii of the
// enclosing sphere: the worst must not cut the model. [ours]
constexpr double kNear = 1.05;
constexpr double kFar = 1.75;
// All by looking. [ours]
constexpr double kWireRadii = 0.02;  // width of a wire, in radii
constexpr double kBorder = 1.02;     // half the picture, over the distance of the farthest wire
constexpr double kBehind = 0.45;     // what is left of the colour of a wire behind the centre
constexpr double kEyeRadii = 8.0;    // distance of the eye, in radii
constexpr Rgb8 kModelGrey{168, 168, 168};

/// How good each view is, from 0 to 1; all 0 where they are alike.
std::vector<double> goodness(const ComparedMethod& method) {
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  for (const double value : method.values) {
    if (std::isfinite(value)) {
      low = std::min(low, value);
      high = std::max(high, value);
    }
  }
  std::vector<double> good;
  for (const double value : method.values) {
    const double share = high > low ? (std::min(value, high) - low) / (high - low) : 0.0;
    good.push_back(high > low && method.measure.better == Better::Less ? 1.0 - share : share);
  }
  return good;
}

/// What is left of a colour on white.
Rgb8 paler(const Rgb8& colour, double share) {
  Rgb8 mixed{};
  for (std::size_t c = 0; c < 3; ++c) {
    mixed[c] = static_cast<std::uint8_t>(std::lround(share * colour[c] + (1.0 - share) * 255.0));
  }
  return mixed;
}

/// Puts a picture without background over another of its size.
void put_over(const Image& picture, Image& below) {
  for (std::size_t i = 0; i < below.rgba.size(); i += 4) {
    const double share = picture.rgba[i + 3] / 255.0;
    for (std::size_t c = i; c < i + 3; ++c) {
      below.rgba[c] = static_cast<std::uint8_t>(
          std::lround(share * picture.rgba[c] + (1.0 - share) * below.rgba[c]));
    }
  }
}

struct Wire {
  double depth = 0.0;  // towards the eye, in radii
  std::vector<PixelPoint> ends{};
  Rgb8 colour{};
};

}  // namespace

ViewSpherePictures::ViewSpherePictures(const ShapeAnalysis& shape, const Comparison& comparison,
                                       UpAxis up, int width, int height, const RunContext& run)
    : comparison_(&comparison),
      wires_(build_edge_table({comparison.set.directions, comparison.set.triangles})) {
  const UprightFrame frame = upright_frame(up_vector(up));
  towards_ = (0.5 * frame.side + 0.4 * frame.up + frame.front).normalized();
  right_ = frame.up.cross(towards_).normalized();
  up_ = towards_.cross(right_);
  const double radius = 0.5 * shape.sphere.diameter;
  radius_px_ = 0.5 * std::min(width, height) / (kBorder * kFar);
  const Camera camera{.projection = Projection::Orthographic,
                      .eye = shape.sphere.centre + kEyeRadii * radius * towards_,
                      .target = shape.sphere.centre,
                      .up = up_,
                      .height = height * radius / radius_px_};
  RenderOptions look;
  set_quality(look, Quality::Normal);
  look.width = width;
  look.height = height;
  look.ambient_rays = 0;
  look.colour = kModelGrey;
  const std::shared_ptr<const CloudPicture> cloud = cloud_picture(shape);
  model_ = render(cloud ? cloud->mesh : shape.surface, camera, {}, {}, look, run);
}

Image ViewSpherePictures::of(const ComparedMethod& method) const {
  const std::vector<double> good = goodness(method);
  const auto node = [&](std::uint32_t v) {
    return Vec3((kNear + (kFar - kNear) * good[v]) * comparison_->set.directions[v]);
  };
  const auto place = [&](const Vec3& p) {
    return PixelPoint{0.5 * model_.width + radius_px_ * p.dot(right_),
                      0.5 * model_.height - radius_px_ * p.dot(up_)};
  };
  std::vector<Wire> wires;
  wires.reserve(wires_.edges.size());
  for (const auto& [a, b] : wires_.edges) {
    const Vec3 from = node(a);
    const Vec3 to = node(b);
    wires.push_back({0.5 * (from + to).dot(towards_),
                     {place(from), place(to)},
                     cool_warm(0.5 * (good[a] + good[b]))});
  }
  std::stable_sort(wires.begin(), wires.end(),
                   [](const Wire& a, const Wire& b) { return a.depth < b.depth; });
  LineDrawing behind(model_.width, model_.height);
  LineDrawing before(model_.width, model_.height);
  for (Wire& wire : wires) {
    const bool is_behind = wire.depth < 0.0;
    (is_behind ? behind : before)
        .line(std::move(wire.ends), kWireRadii * radius_px_,
              is_behind ? paler(wire.colour, kBehind) : wire.colour);
  }
  Image picture = behind.image();
  put_over(model_, picture);
  before.draw_on(picture);
  return picture;
}

}  // namespace vantage
