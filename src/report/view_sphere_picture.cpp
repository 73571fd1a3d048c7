// SPDX-License-Identifier: MIT
#include "report/view_sphere_picture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

#include "vantage/mesh/topology.h"
#include "vantage/render/render.h"

namespace vantage {
namespace {

// The wireframe's distance from the centre at the worst and at the best view, in radii of the
// enclosing sphere: the worst must not cut the model. [ours]
constexpr double kNear = 1.05;
constexpr double kFar = 1.75;
constexpr double kHalfWire = 0.009;  // half the width of a wire in radii [ours]
constexpr int kWireSides = 3;        // of a wire
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

/// Adds a thin prism from `a` to `b`.
void add_wire(TriMesh& mesh, const Vec3& a, const Vec3& b, double radius) {
  const Vec3 along = b - a;
  const Vec3 side = along.unitOrthogonal();
  const Vec3 other = along.normalized().cross(side);
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  for (const Vec3& end : {a, b}) {
    for (int k = 0; k < kWireSides; ++k) {
      const double angle = 2.0 * std::numbers::pi * k / kWireSides;
      mesh.positions.emplace_back(end +
                                  radius * (std::cos(angle) * side + std::sin(angle) * other));
    }
  }
  for (std::uint32_t k = 0; k < kWireSides; ++k) {
    const std::uint32_t here = first + k;
    const std::uint32_t next = first + (k + 1) % kWireSides;
    mesh.triangles.push_back({here, next, here + kWireSides});
    mesh.triangles.push_back({next, next + kWireSides, here + kWireSides});
  }
}

}  // namespace

Image view_sphere_picture(const ShapeAnalysis& shape, const Comparison& comparison,
                          const ComparedMethod& method, UpAxis up, int width, int height,
                          const RunContext& run) {
  const std::vector<double> good = goodness(method);
  const double radius = 0.5 * shape.sphere.diameter;
  const auto node = [&](std::uint32_t v) {
    return Vec3(shape.sphere.centre +
                radius * (kNear + (kFar - kNear) * good[v]) * comparison.set.directions[v]);
  };
  TriMesh mesh = shape.surface;
  std::vector<Rgb8> colours(mesh.positions.size(), kModelGrey);
  const EdgeTable table = build_edge_table({comparison.set.directions, comparison.set.triangles});
  for (const auto& [a, b] : table.edges) {
    add_wire(mesh, node(a), node(b), kHalfWire * radius);
    colours.insert(colours.end(), kWireSides, cool_warm(good[a]));
    colours.insert(colours.end(), kWireSides, cool_warm(good[b]));
  }
  // From a corner in front, always as near: pictures of methods are to be compared.
  const UprightFrame frame = upright_frame(up_vector(up));
  const double aspect = static_cast<double>(width) / height;
  const Vec3 towards = (0.5 * frame.side + 0.4 * frame.up + frame.front).normalized();
  const Vec3 centre = shape.sphere.centre;
  std::vector<Vec3> extent;
  for (const Vec3& d : comparison.set.directions) {
    extent.emplace_back(centre + kFar * radius * d);
  }
  constexpr double kDistance = 8.0;  // radii
  const Camera camera =
      frame_points(extent, {Projection::Perspective, centre + kDistance * radius * towards}, centre,
                   up_vector(up), aspect, 0.0);
  RenderOptions look;
  set_quality(look, Quality::Normal);
  look.width = width;
  look.height = height;
  look.ambient_rays = 0;
  look.background = Rgb8{255, 255, 255};
  return render(mesh, camera, colours, {}, look, run);
}

}  // namespace vantage
