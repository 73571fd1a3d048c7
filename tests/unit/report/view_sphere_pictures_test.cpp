// SPDX-License-Identifier: MIT
#include "report/view_sphere_pictures.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "vantage/view/measure.h"

#include "report/line_drawing.h"
#include "support/model_of.h"
#include "support/shapes.h"

namespace vantage::test {
namespace {

constexpr int kSide = 120;  // px

/// Views of a ball that are the better the higher they are, or the worse.
Comparison by_height(Better better) {
  Comparison comparison;
  comparison.set = direction_set(ViewSphereBase::Icosahedron, 2);
  ComparedMethod method{.measure = find_measure("projected-area")};
  method.measure.better = better;
  for (const Vec3& direction : comparison.set.directions) {
    method.values.push_back(direction.y());
  }
  comparison.methods = {method};
  return comparison;
}

bool is_blank(const Image& picture, int row) {
  const std::uint8_t* begin = picture.pixel(0, row);
  return std::all_of(begin, begin + 4 * static_cast<std::ptrdiff_t>(picture.width),
                     [](std::uint8_t value) { return value == 255; });
}

/// Red less blue, over a row of pixels.
double warmth(const Image& picture, int row) {
  double sum = 0.0;
  for (int x = 0; x < picture.width; ++x) {
    sum += static_cast<double>(picture.pixel(x, row)[0]) - picture.pixel(x, row)[2];
  }
  return sum;
}

/// Makes outliers of the points that no triangle joins, which are not drawn.
void leave_out_pole(ShapeAnalysis& shape) {
  for (std::size_t v = 0; v < shape.surface.positions.size(); ++v) {
    shape.cloud->outlier[v] = shape.surface.positions[v].y() > 1.5 ? 1 : 0;
  }
}

TEST(ViewSpherePictures, DrawGoodViewsFarOutAndWarm) {
  const ShapeAnalysis shape = prepare_surface(model_of(sphere(2)));
  for (const Better better : {Better::More, Better::Less}) {
    const Comparison comparison = by_height(better);
    const Image picture = ViewSpherePictures(shape, comparison, UpAxis::Y, kSide, kSide, {})
                              .of(comparison.methods[0]);
    ASSERT_EQ(picture.width, kSide);
    int top = 0;
    int bottom = 0;
    for (; is_blank(picture, top); ++top) {
    }
    for (; is_blank(picture, kSide - 1 - bottom); ++bottom) {
    }
    const double of_top = warmth(picture, top + 4);
    const double of_bottom = warmth(picture, kSide - 5 - bottom);
    if (better == Better::More) {
      EXPECT_LT(top + 10, bottom);
      EXPECT_GT(of_top, 0.0);
      EXPECT_LT(of_bottom, 0.0);
    } else {
      EXPECT_LT(bottom + 10, top);
      EXPECT_LT(of_top, 0.0);
      EXPECT_GT(of_bottom, 0.0);
    }
    // The ball is seen between the wires.
    const std::uint8_t* const middle = picture.pixel(kSide / 2, kSide / 2);
    EXPECT_LT(std::min({middle[0], middle[1], middle[2]}), 250);
  }
}

TEST(ViewSpherePictures, ShowThePointsThatNoTriangleJoins) {
  ShapeAnalysis shape = prepare_surface(model_of(points_of_ball_and_pole()));
  const Comparison comparison = by_height(Better::More);
  const auto picture = [&] {
    return ViewSpherePictures(shape, comparison, UpAxis::Y, kSide, kSide, {})
        .of(comparison.methods[0]);
  };
  const Image with_pole = picture();
  leave_out_pole(shape);
  EXPECT_NE(with_pole.rgba, picture().rgba);
}

TEST(ComparisonSheet, FramesThePointsThatNoTriangleJoins) {
  const ShapeAnalysis shape = prepare_surface(model_of(points_of_ball_and_pole()));
  Comparison comparison = by_height(Better::More);
  comparison.methods[0].views.best.direction = Vec3::UnitZ();
  comparison.methods[0].views.worst.direction = Vec3::UnitX();
  const Image sheet = comparison_sheet(shape, comparison, UpAxis::Y, {});
  // Tiles of 240 x 180 from (16, 68) on; a margin of 4 % is 7 pixels.
  for (int left : {16, 16 + 248}) {
    int drawn = 0;
    for (int x = left; x < left + 240; ++x) {
      for (int y = 68; y < 68 + 5; ++y) {
        drawn += sheet.pixel(x, y)[0] < 255 ? 1 : 0;
      }
    }
    EXPECT_EQ(drawn, 0) << left;
  }
}

TEST(ComparisonSheet, WritesWholeLetters) {
  const ShapeAnalysis shape = prepare_surface(model_of(sphere(1)));
  Comparison comparison = by_height(Better::More);
  comparison.methods[0].measure.name = "k";
  const Image sheet = comparison_sheet(shape, comparison, UpAxis::Y, {});
  LineDrawing letter(40, 40);
  letter.text("k", {10.0, 30.0}, 11.0, {40, 40, 44});
  const Image alone = letter.image();
  double drawn = 0.0;
  double expected = 0.0;
  for (int y = 0; y < 40; ++y) {
    for (int x = 0; x < 40; ++x) {
      expected += 255 - alone.pixel(x, y)[0];
      drawn += 255 - sheet.pixel(x, 34 + y)[0];  // below the titles, left of the first picture
    }
  }
  EXPECT_NEAR(drawn, expected, 0.03 * expected);
}

}  // namespace
}  // namespace vantage::test
