// SPDX-License-Identifier: MIT
#include "vantage/report/figures.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "vantage/core/error.h"
#include "vantage/mesh/measures.h"

#include "report/point_balls.h"
#include "report/sphere_figure.h"
#include "support/model_of.h"
#include "support/shapes.h"
#include "support/unrefined.h"

namespace vantage::test {
namespace {

Image of_colour(std::uint8_t value, int width, int height) {
  return {width, height,
          std::vector<std::uint8_t>(4 * static_cast<std::size_t>(width * height), value)};
}

/// Pictures of 48 × 36 pixels, of the views that an icosahedron once divided has.
ViewOptions small_and_quick() {
  ViewOptions options = unrefined();
  options.width = 48;
  options.height = 36;
  options.search.strategy = SearchStrategy::Exhaustive;
  options.search.subdivisions = 1;
  return options;
}

/// A Y of tubes. Analysed once a process.
const ShapeAnalysis& analysed_y() {
  static const ShapeAnalysis shape = analyse_shape(model_of(y_of_tubes(0.2, 16)), unrefined());
  return shape;
}

/// A cloud, some points of which no triangle joins. Analysed once a process.
const ShapeAnalysis& analysed_ball_and_pole() {
  static const ShapeAnalysis shape = analyse_shape(model_of(points_of_ball_and_pole()), {});
  return shape;
}

TEST(SideBySide, PutsPanelsInOrderOnWhite) {
  const Image figure = side_by_side({of_colour(10, 5, 3), of_colour(20, 5, 3)});
  EXPECT_EQ(figure.width, 2 * 5 + 3 * 8);
  EXPECT_EQ(figure.height, 3 + 2 * 8);
  EXPECT_EQ(figure.pixel(8, 8)[0], 10);
  EXPECT_EQ(figure.pixel(12, 10)[0], 10);
  EXPECT_EQ(figure.pixel(13, 10)[0], 255);
  EXPECT_EQ(figure.pixel(8 + 5 + 8, 8)[0], 20);
  EXPECT_EQ(figure.pixel(0, 0)[0], 255);
}

TEST(SideBySide, RefusesPanelsOfDifferentSizesAndNone) {
  EXPECT_THROW(side_by_side({of_colour(1, 5, 3), of_colour(1, 5, 4)}), InvalidInput);
  EXPECT_THROW(side_by_side({}), InvalidInput);
}

/// The pixels of a panel of 48 × 36.
std::vector<std::uint8_t> panel_of(const Image& figure, int panel) {
  std::vector<std::uint8_t> pixels;
  for (int y = 8; y < 8 + 36; ++y) {
    const std::uint8_t* const row = figure.pixel(8 + panel * 56, y);
    pixels.insert(pixels.end(), row, row + std::ptrdiff_t{4} * 48);
  }
  return pixels;
}

/// How many of them are red or blue.
int coloured_pixels(const Image& figure, int panel) {
  const std::vector<std::uint8_t> pixels = panel_of(figure, panel);
  int count = 0;
  for (std::size_t at = 0; at < pixels.size(); at += 4) {
    count += std::abs(pixels[at] - pixels[at + 2]) > 60 ? 1 : 0;
  }
  return count;
}

TEST(PaperFigures, ShowEachLevelAndEndWithTheMap) {
  const ViewOptions options = small_and_quick();
  const ShapeAnalysis& shape = analysed_y();
  const ViewReport report = find_views(shape, ModelFrame(UpAxis::Y), options);
  const std::vector<Figure> figures = paper_figures(shape, report, options);
  ASSERT_EQ(figures.size(), 8U);
  const auto panels = [](const Image& image) { return (image.width - 8) / (48 + 8); };
  const int levels = std::min<int>(6, static_cast<int>(shape.history.level_count()) + 1);
  EXPECT_EQ(panels(figures[0].image), levels);
  EXPECT_EQ(panels(figures[2].image), levels + 1);
  EXPECT_EQ(panels(figures[4].image), 3);
  EXPECT_EQ(panels(figures[5].image), 2);
  EXPECT_EQ(panels(figures[6].image), 4);
  // The first panel of the contraction is the model as figure 5 shows it, the last of figure 3 its map.
  EXPECT_EQ(panel_of(figures[0].image, 0), panel_of(figures[4].image, 0));
  EXPECT_EQ(panel_of(figures[2].image, levels), panel_of(figures[4].image, 1));
  EXPECT_EQ(coloured_pixels(figures[0].image, levels - 1), 0);
  EXPECT_GT(coloured_pixels(figures[1].image, 1), 10);
  EXPECT_GT(coloured_pixels(figures[2].image, 1), 10);
  EXPECT_GT(coloured_pixels(figures[2].image, levels), 10);
}

TEST(PaperFigures, DrawTheSearchAsLinesAndAsPixels) {
  ViewOptions options;
  options.width = 48;
  options.height = 36;
  options.search.strategy = SearchStrategy::Rapid;
  const ShapeAnalysis& shape = analysed_y();
  for (const Figure& figure :
       paper_figures(shape, find_views(shape, ModelFrame(UpAxis::Y), options), options)) {
    EXPECT_EQ(figure.svg.empty(), figure.name != "figure-4-search") << figure.name;
    if (!figure.svg.empty()) {  // at least a panel a level of the sphere, and the closer look
      EXPECT_GE(figure.image.width, 2 * 36);
      EXPECT_NE(figure.svg.find("<svg"), std::string::npos);
    }
  }
}

TEST(SpherePanel, IsRaisedByTheScoreThatTheWeightAsksFor) {
  ViewOptions options;
  const ShapeAnalysis& shape = analysed_y();
  const auto panel = [&](Weight weight) {
    options.weight = weight;
    return sphere_panel(shape, shape.significance, Vec3::UnitX(), UpAxis::Y, options,
                        {.width = 64, .height = 48}, {});
  };
  EXPECT_EQ(panel(Weight::Vertex).rgba, panel(Weight::Vertex).rgba);
  EXPECT_NE(panel(Weight::Vertex).rgba, panel(Weight::Area).rgba);
}

/// Rows of a picture from the first to the last in which a pixel is `wanted`.
template <typename Wanted>
std::pair<int, int> rows_of(const Image& picture, const Wanted& wanted) {
  std::pair<int, int> rows{picture.height, -1};
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) {
      if (wanted(x, y)) {
        rows = {std::min(rows.first, y), y};
      }
    }
  }
  return rows;
}

/// Red less blue, over a row of pixels.
double warmth_of_row(const Image& picture, int row) {
  double sum = 0.0;
  for (int x = 0; x < picture.width; ++x) {
    sum += static_cast<double>(picture.pixel(x, row)[0]) - picture.pixel(x, row)[2];
  }
  return sum;
}

TEST(SpherePanel, IsFarOutAndWarmWhereMuchIsSeen) {
  ShapeAnalysis shape = prepare_surface(model_of(sphere(3)));
  std::vector<double> height;
  std::vector<double> depth;
  for (const Vec3& p : shape.surface.positions) {
    height.push_back(p.y());
    depth.push_back(-p.y());
  }
  for (const double top : {1.0, -1.0}) {
    shape.significance.clear();
    for (const double y : height) {
      shape.significance.push_back(std::max(0.0, top * y));
    }
    const auto panel = [&](const std::vector<double>& shown) {
      return sphere_panel(shape, shown, Vec3::UnitZ(), UpAxis::Y, unrefined(),
                          {.width = 120, .height = 120}, {});
    };
    const Image wires = panel(height);
    const Image turned = panel(depth);
    const auto [first, last] =
        rows_of(wires, [&](int x, int y) { return wires.pixel(x, y)[3] > 0; });
    // What changes with the values that are shown is the ball between the wires.
    const auto [first_of_ball, last_of_ball] = rows_of(wires, [&](int x, int y) {
      return !std::equal(wires.pixel(x, y), wires.pixel(x, y) + 4, turned.pixel(x, y));
    });
    const int above = first_of_ball - first;
    const int below = last - last_of_ball;
    const double of_top = warmth_of_row(wires, first + 3);
    const double of_bottom = warmth_of_row(wires, last - 3);
    EXPECT_GT(top > 0.0 ? above : below, 2 * (top > 0.0 ? below : above));
    EXPECT_GT(top * of_top, 0.0);
    EXPECT_LT(top * of_bottom, 0.0);
  }
}

TEST(SpherePanel, ColoursThePointsThatNoTriangleJoins) {
  const ViewOptions options;
  const ShapeAnalysis& shape = analysed_ball_and_pole();
  std::vector<double> shown(shape.surface.positions.size(), 0.0);
  const auto panel = [&] {
    return sphere_panel(shape, shown, Vec3::UnitX(), UpAxis::Y, options,
                        {.width = 64, .height = 48}, {});
  };
  shown[0] = 1.0;
  const Image before = panel();
  for (std::size_t v = 0; v < shown.size(); ++v) {
    shown[v] = shape.surface.positions[v].y() > 2.0 ? 1.0 : shown[v];
  }
  EXPECT_NE(before.rgba, panel().rgba);
}

TEST(TimesTable, HasOneRowAModelAndAddsUp) {
  StageTimes row{"a|b", 10, 16, {}};
  row.seconds.contract = 1.25;
  row.seconds.search = 0.5;
  EXPECT_EQ(times_csv({row}),
            "model,vertices,faces,load_s,contract_s,skeleton_s,map_s,search_s,sum_s\n"
            "\"a|b\",10,16,0,1.25,0,0,0.5,1.75\n");
  EXPECT_NE(times_markdown({row}).find("| a\\|b | 10 | 16 | 0 | 1.25 | 0 | 0 | 0.5 | 1.75 |\n"),
            std::string::npos);
}

/// Pixels of a panel of 48 × 36 that are not white.
int ink(const Image& figure, int panel) {
  const std::vector<std::uint8_t> pixels = panel_of(figure, panel);
  int count = 0;
  for (std::size_t at = 0; at < pixels.size(); at += 4) {
    count += pixels[at] < 250 || pixels[at + 2] < 250 ? 1 : 0;
  }
  return count;
}

TEST(PaperFigures, OfACloudShowItsPointsAsTheyContractAndNoSaliency) {
  const ViewOptions options = small_and_quick();
  Model model = model_of(y_of_tubes(0.25, 24));
  model.mesh.triangles.clear();
  const ShapeAnalysis shape = analyse_shape(model, options);
  ASSERT_TRUE(shape.cloud.has_value());
  const std::vector<Figure> figures =
      paper_figures(shape, find_views(shape, ModelFrame(UpAxis::Y), options), options);
  ASSERT_EQ(figures.size(), 8U);
  const auto panels = [](const Image& image) { return (image.width - 8) / (48 + 8); };
  const int levels = std::min<int>(6, static_cast<int>(shape.history.level_count()) + 1);
  ASSERT_GT(levels, 1);
  EXPECT_EQ(panels(figures[0].image), levels);
  EXPECT_EQ(panels(figures[5].image), 1);
  EXPECT_EQ(panels(figures[6].image), 2);
  EXPECT_EQ(panels(figures[7].image), 2);
  // Points cover the limbs of the Y, and have become curves at the end.
  EXPECT_GT(ink(figures[0].image, 0), 100);
  EXPECT_GT(ink(figures[0].image, levels - 1), 5);
  EXPECT_LT(ink(figures[0].image, levels - 1), ink(figures[0].image, 0) * 7 / 10);
}

TEST(PaperFigures, OfACloudShowInFigure3ThePointsThatNoTriangleJoins) {
  const ViewOptions options = small_and_quick();
  const ShapeAnalysis& shape = analysed_ball_and_pole();
  ViewReport report = find_views(shape, ModelFrame(UpAxis::Y), options);
  // From y = 2.25 to 3.75, where there is nothing else.
  report.best.picture = {.projection = Projection::Orthographic,
                         .eye = Vec3(0.0, 3.0, 10.0),
                         .target = Vec3(0.0, 3.0, 0.0),
                         .height = 1.5};
  EXPECT_GT(ink(paper_figures(shape, report, options)[2].image, 0), 20);
}

TEST(PointBalls, StandAtTheirPointsAndAreAtMostSoMany) {
  const std::vector<Vec3> points{Vec3(0, 0, 0), Vec3(1, 2, 3)};
  const PointBalls balls = point_balls(points, 0.5);
  ASSERT_EQ(balls.mesh.positions.size(), 12U);
  EXPECT_EQ(balls.mesh.triangles.size(), 16U);
  for (std::size_t v = 0; v < 12; ++v) {
    EXPECT_NEAR((balls.mesh.positions[v] - points[balls.point_of_vertex[v]]).norm(), 0.5, 1e-15);
  }
  EXPECT_NEAR(signed_volume(balls.mesh), 2.0 * 4.0 / 3.0 * 0.125, 1e-12);  // wound outwards
  const std::vector<Vec3> many(3 * kMostBalls + 1, Vec3::Zero());
  EXPECT_LE(point_balls(many, 0.5).mesh.positions.size(), 6 * kMostBalls);
  EXPECT_TRUE(point_balls({}, 0.5).mesh.positions.empty());
}

}  // namespace
}  // namespace vantage::test
