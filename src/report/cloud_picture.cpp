// SPDX-License-Identifier: MIT
#include "report/cloud_picture.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "vantage/mesh/measures.h"

#include "report/point_balls.h"

namespace vantage {
namespace {

/// A triangle that is lower than this, over its longest side, is a sliver, as those that join the points
/// of a curve: nobody sees it. [ours]
constexpr double kSliver = 0.05;

/// Points that a triangle joins to others, so that it is seen.
std::vector<bool> points_shown(const TriMesh& surface) {
  std::vector<bool> is_shown(surface.positions.size(), false);
  for (const Triangle& t : surface.triangles) {
    double longest = 0.0;  // squared
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 side = surface.positions[t[(k + 1) % 3]] - surface.positions[t[k]];
      longest = std::max(longest, side.squaredNorm());
    }
    if (area_vector(surface, t).norm() >
        kSliver * longest) {  // twice the area is height times side
      for (const std::uint32_t v : t) {
        is_shown[v] = true;
      }
    }
  }
  return is_shown;
}

}  // namespace

std::shared_ptr<const CloudPicture> cloud_picture(const ShapeAnalysis& shape) {
  if (!shape.cloud) {
    return nullptr;
  }
  const std::vector<bool> is_shown = points_shown(shape.surface);
  std::vector<Vec3> points;
  std::vector<std::uint32_t> vertex_of_point;
  for (std::uint32_t v = 0; v < is_shown.size(); ++v) {
    if (!is_shown[v] && shape.cloud->outlier[v] == 0) {
      points.push_back(shape.surface.positions[v]);
      vertex_of_point.push_back(v);
    }
  }
  if (points.empty()) {
    return nullptr;
  }
  CloudPicture picture{.mesh = shape.surface};
  picture.vertex_of.resize(shape.surface.positions.size());
  std::iota(picture.vertex_of.begin(), picture.vertex_of.end(), 0U);
  const PointBalls balls = point_balls(points, kPointRadius * shape.sphere.diameter);
  const auto first = static_cast<std::uint32_t>(picture.mesh.positions.size());
  picture.mesh.positions.insert(picture.mesh.positions.end(), balls.mesh.positions.begin(),
                                balls.mesh.positions.end());
  for (const Triangle& t : balls.mesh.triangles) {
    picture.mesh.triangles.push_back({first + t[0], first + t[1], first + t[2]});
  }
  for (const std::uint32_t point : balls.point_of_vertex) {
    picture.vertex_of.push_back(vertex_of_point[point]);
  }
  return std::make_shared<const CloudPicture>(std::move(picture));
}

std::vector<Rgb8> colours_shown(const ShapeAnalysis& shape, const CloudPicture* picture,
                                const std::vector<Rgb8>& of_input) {
  if (of_input.empty()) {
    return {};
  }
  std::vector<Rgb8> colours(shape.surface.positions.size());
  for (std::size_t v = of_input.size(); v-- > 0;) {
    colours[shape.surface_vertex[v]] = of_input[v];
  }
  return picture != nullptr ? picture->spread(std::span<const Rgb8>(colours)) : colours;
}

}  // namespace vantage
