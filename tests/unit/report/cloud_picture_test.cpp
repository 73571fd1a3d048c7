// SPDX-License-Identifier: MIT
#include "report/cloud_picture.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "vantage/report/view_report.h"

#include "support/model_of.h"
#include "support/shapes.h"

namespace vantage::test {
namespace {

/// Points along a circle of radius 1.
Model circle(int count) {
  Model model;
  model.name = "circle";
  for (int i = 0; i < count; ++i) {
    const double angle = 2.0 * std::acos(-1.0) * i / count;
    model.mesh.positions.emplace_back(std::cos(angle), std::sin(angle), 0.0);
  }
  return model;
}

std::size_t pixels_shown(const Image& image) {
  std::size_t count = 0;
  for (std::size_t i = 3; i < image.rgba.size(); i += 4) {
    count += image.rgba[i] > 127 ? 1 : 0;
  }
  return count;
}

TEST(CloudPicture, ShowsThePointsOfACurveAsSolids) {
  const ShapeAnalysis shape = prepare_surface(circle(200));
  const auto picture = cloud_picture(shape);
  ASSERT_NE(picture, nullptr);
  // An octahedron a point after the surface's own vertices.
  EXPECT_EQ(picture->mesh.positions.size(), shape.surface.positions.size() + 6 * 200);
  EXPECT_EQ(picture->vertex_of.size(), picture->mesh.positions.size());
  std::vector<double> place;
  for (const Vec3& p : shape.surface.positions) {
    place.push_back(p.x());
  }
  const std::vector<double> spread = picture->spread(std::span<const double>(place));
  for (std::size_t v = 0; v < spread.size(); ++v) {
    EXPECT_NEAR(spread[v], picture->mesh.positions[v].x(), 0.011) << v;  // a radius of 0.005 D
  }
  EXPECT_TRUE(picture->spread(std::span<const double>()).empty());
}

TEST(CloudPicture, OfACurveIsNotBlank) {
  const ShapeAnalysis shape = prepare_surface(circle(200));
  ViewOptions options;
  options.width = options.height = 200;
  const Camera camera{.projection = Projection::Orthographic, .eye = Vec3(0, 0, 5), .height = 2.2};
  const Image image = take_picture(shape, camera, Picture::Plain, options);
  // 200 diamonds of half diagonals 0.01, in pixels of 0.011 a side.
  EXPECT_NEAR(static_cast<double>(pixels_shown(image)), 200 * 2 * 0.01 * 0.01 / (0.011 * 0.011),
              100.0);
}

TEST(CloudPicture, OfASurfaceIsItsTriangles) {
  Model cloud;
  cloud.name = "sphere";
  cloud.mesh.positions = sphere(3).positions;
  EXPECT_EQ(cloud_picture(prepare_surface(cloud)), nullptr);
  EXPECT_EQ(cloud_picture(prepare_surface(model_of(sphere(2)))), nullptr);
}

}  // namespace
}  // namespace vantage::test
