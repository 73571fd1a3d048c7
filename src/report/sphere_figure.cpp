// SPDX-License-Identifier: MIT
#include "report/sphere_figure.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <memory>
#include <numbers>
#include <vector>

#include <Eigen/Geometry>

#include "vantage/pipeline/find_views.h"
#include "vantage/render/render.h"
#include "vantage/spatial/directions.h"

#include "pipeline/view_preparation.h"
#include "report/cloud_picture.h"
#include "report/legend.h"

namespace vantage {
namespace {

/// Directions of the wireframe: icosahedron level 3, 642.
constexpr int kLevel = 3;
/// Lengths over the radius of the enclosing sphere. [ours]
constexpr double kSphere = 1.12;  ///< Of the worst direction.
constexpr double kRaise = 0.32;   ///< How much further out the best one is.
constexpr double kWire = 0.0065;  ///< Half the thickness of a wire.
constexpr double kDistance = 7.0;
constexpr std::size_t kSides = 5;  ///< Of a wire.

/// Adds a prism from a to b, coloured from one end to the other.
void add_wire(TriMesh& mesh, std::vector<Rgb8>& colours, const std::array<Vec3, 2>& ends,
              const std::array<Rgb8, 2>& colour, double radius) {
  const Vec3 along = ends[1] - ends[0];
  if (!(along.norm() > 0.0)) {
    return;
  }
  const Vec3 side = along.unitOrthogonal();
  const Vec3 other = along.normalized().cross(side);
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  for (std::size_t s = 0; s < kSides; ++s) {
    const double angle = 2.0 * std::numbers::pi * static_cast<double>(s) / kSides;
    const Vec3 out = radius * (std::cos(angle) * side + std::sin(angle) * other);
    for (std::size_t end = 0; end < 2; ++end) {
      mesh.positions.push_back(ends[end] + out);
      colours.push_back(colour[end]);
    }
    const auto a = first + static_cast<std::uint32_t>(2 * s);
    const auto b = first + static_cast<std::uint32_t>(2 * ((s + 1) % kSides));
    mesh.triangles.push_back({a, b, b + 1});
    mesh.triangles.push_back({a, b + 1, a + 1});
  }
}

}  // namespace

Image sphere_panel(const ShapeAnalysis& shape, std::span<const double> shown, const Vec3& from,
                   UpAxis up, const ViewOptions& options, const RenderOptions& look,
                   const RunContext& run) {
  const std::shared_ptr<const VertexVisibility> visibility = visibility_of(shape, 200);
  const MapScorer by_map(shape, *visibility, options);
  const DirectionSet set = direction_set(ViewSphereBase::Icosahedron, kLevel);
  const std::vector<double> scores = by_map.scorer().score_all(set.directions, run);
  const auto [low, high] = std::minmax_element(scores.begin(), scores.end());
  const double span = *high - *low;
  const double radius = 0.5 * shape.sphere.diameter;
  std::vector<Vec3> nodes;
  for (std::size_t i = 0; i < scores.size(); ++i) {
    const double height = span > 0.0 ? (scores[i] - *low) / span : 0.0;
    nodes.push_back(shape.sphere.centre + radius * (kSphere + kRaise * height) * set.directions[i]);
  }
  const std::shared_ptr<const CloudPicture> cloud = cloud_picture(shape);
  TriMesh mesh = cloud ? cloud->mesh : shape.surface;
  std::vector<Rgb8> colours = cloud ? colour_map(cloud->spread(shown)) : colour_map(shown);
  const std::vector<Rgb8> of_node = colour_map(scores);
  for (const Triangle& t : set.triangles) {
    for (std::size_t c = 0; c < 3; ++c) {
      const std::uint32_t a = t[c];
      const std::uint32_t b = t[(c + 1) % 3];
      if (a < b) {  // each edge once
        add_wire(mesh, colours, {nodes[a], nodes[b]}, {of_node[a], of_node[b]}, kWire * radius);
      }
    }
  }
  const Viewpoint eye{Projection::Perspective,
                      shape.sphere.centre + kDistance * radius * from.normalized()};
  const Camera framed =
      frame_points(nodes, eye, shape.sphere.centre, up_vector(up),
                   static_cast<double>(look.width) / look.height, options.margin_percent / 100.0);
  Image picture = render(mesh, framed, colours, {}, look, run);
  draw_legend(picture);
  return picture;
}

}  // namespace vantage
