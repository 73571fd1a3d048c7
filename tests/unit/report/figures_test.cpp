// SPDX-License-Identifier: MIT
#include "vantage/report/figures.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "vantage/core/error.h"
#include "vantage/mesh/measures.h"

#include "report/point_balls.h"
#include "report/sphere_figure.h"
#include "support/model_of.h"
#include "support/shapes.h"

namespace vantage::test {
namespace {

Image of_colour(std::uint8_t value, int width, int height) {
  return {width, height,
          std::vector<std::uint8_t>(4 * static_cast<std::size_t>(width * height), value)};
}

/// Pictures of 48 × 36 pixels, of the views that an icosahedron once divided has.
ViewOptions small_and_quick() {
  ViewOptions options;
  options.width = 48;
  options.height = 36;
  options.search.strategy = SearchStrategy::Exhaustive;
  options.search.subdivisions = 1;
  return options;
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

TEST(PaperFigures, ShowEachLevelAndEndWithTheMap) {
  const ViewOptions options = small_and_quick();
  const ShapeAnalysis shape = analyse_shape(model_of(y_of_tubes(0.2, 24)), options);
  const ViewReport report = find_views(shape, UpAxis::Y, options);
  const std::vector<Figure> figures = paper_figures(shape, report, options);
  ASSERT_EQ(figures.size(), 8U);
  const auto panels = [](const Image& image) { return (image.width - 8) / (48 + 8); };
  const int levels = std::min<int>(6, static_cast<int>(shape.history.level_count()) + 1);
  EXPECT_EQ(panels(figures[0].image), levels);
  EXPECT_EQ(panels(figures[2].image), levels + 1);
  EXPECT_EQ(panels(figures[4].image), 3);
  EXPECT_EQ(panels(figures[5].image), 2);
  EXPECT_EQ(panels(figures[6].image), 4);
  // The first panel of the contraction is the model as figure 5 shows it.
  for (int y = 8; y < 8 + 36; ++y) {
    EXPECT_TRUE(std::equal(figures[0].image.pixel(8, y), figures[0].image.pixel(8 + 48, y),
                           figures[4].image.pixel(8, y)));
  }
}

TEST(PaperFigures, DrawTheSearchAsLinesAndAsPixels) {
  ViewOptions options;
  options.width = 48;
  options.height = 36;
  options.search.strategy = SearchStrategy::Rapid;
  const ShapeAnalysis shape = analyse_shape(model_of(y_of_tubes(0.2, 16)), options);
  for (const Figure& figure :
       paper_figures(shape, find_views(shape, UpAxis::Y, options), options)) {
    EXPECT_EQ(figure.svg.empty(), figure.name != "figure-4-search") << figure.name;
    if (!figure.svg.empty()) {  // at least a panel a level of the sphere, and the closer look
      EXPECT_GE(figure.image.width, 2 * 36);
      EXPECT_NE(figure.svg.find("<svg"), std::string::npos);
    }
  }
}

TEST(SpherePanel, IsRaisedByTheScoreThatTheWeightAsksFor) {
  ViewOptions options;
  const ShapeAnalysis shape = analyse_shape(model_of(y_of_tubes(0.2, 16)), options);
  const auto panel = [&](Weight weight) {
    options.weight = weight;
    return sphere_panel(shape, shape.significance, Vec3::UnitX(), UpAxis::Y, options,
                        {.width = 64, .height = 48}, {});
  };
  EXPECT_EQ(panel(Weight::Vertex).rgba, panel(Weight::Vertex).rgba);
  EXPECT_NE(panel(Weight::Vertex).rgba, panel(Weight::Area).rgba);
}

TEST(SpherePanel, ColoursThePointsThatNoTriangleJoins) {
  const ViewOptions options;
  const ShapeAnalysis shape = analyse_shape(model_of(points_of_ball_and_pole()), options);
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
            "model,vertices,faces,load_s,contract_s,skeleton_s,map_s,search_s,total_s\n"
            "\"a|b\",10,16,0,1.25,0,0,0.5,1.75\n");
  EXPECT_NE(times_markdown({row}).find("| a\\|b | 10 | 16 | 0 | 1.25 | 0 | 0 | 0.5 | 1.75 |\n"),
            std::string::npos);
}

/// Pixels of a panel of 48 × 36 that are not white.
int ink(const Image& figure, int panel) {
  int count = 0;
  for (int y = 8; y < 8 + 36; ++y) {
    for (int x = 8 + panel * 56; x < 8 + panel * 56 + 48; ++x) {
      count += figure.pixel(x, y)[0] < 250 || figure.pixel(x, y)[2] < 250 ? 1 : 0;
    }
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
      paper_figures(shape, find_views(shape, UpAxis::Y, options), options);
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
  const ShapeAnalysis shape = analyse_shape(model_of(points_of_ball_and_pole()), options);
  ViewReport report = find_views(shape, UpAxis::Y, options);
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
