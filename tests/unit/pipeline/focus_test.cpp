// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <span>
#include <string>

#include <gtest/gtest.h>

#include "vantage/core/error.h"
#include "vantage/pipeline/find_views.h"
#include "vantage/pipeline/shape_analysis.h"

#include "core/degrees.h"
#include "support/model_of.h"
#include "support/shapes.h"
#include "support/unrefined.h"

namespace vantage {
namespace {

/// Two unit boxes, five apart along x; of one cell a side 12 triangles and 8 vertices each.
Model two_boxes(int cells = 1) {
  const TriMesh box = test::box(1.0, 1.0, 1.0, cells);
  return test::model_of(test::together(box, box, Vec3(5, 0, 0)));
}

Model named_boxes(int cells = 1) {
  Model model = two_boxes(cells);
  const std::size_t faces = model.mesh.triangles.size() / 2;
  model.parts = {{"left", 0, faces}, {"right", faces, faces}};
  return model;
}

ViewOptions focus_on(const char* name) {
  return test::unrefined({.focus = name});
}

/// Cells a side of boxes that are analysed: as they are, those of one have no significance.
constexpr int kCells = 2;

/// The box at the right alone. Analysed once a process.
const ShapeAnalysis& right_box() {
  static const ShapeAnalysis shape = analyse_shape(named_boxes(kCells), focus_on("right"));
  return shape;
}

TEST(ListObjects, AreTheComponentsWhereTheFileNamesNone) {
  const Model model = two_boxes();
  const auto objects = list_objects(model, prepare_surface(model));
  ASSERT_EQ(objects.size(), 2U);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(objects[i].name, "");
    EXPECT_EQ(objects[i].faces, 12U);
    EXPECT_EQ(objects[i].vertices.size(), 8U);
  }
  EXPECT_EQ(objects[0].vertices.front(), 0U);
}

TEST(ListObjects, AreThePartsThatTheFileNames) {
  const Model model = named_boxes();
  const auto objects = list_objects(model, prepare_surface(model));
  ASSERT_EQ(objects.size(), 2U);
  EXPECT_EQ(objects[0].name, "left");
  EXPECT_EQ(objects[1].name, "right");
}

TEST(ListObjects, RefusesPartsBeyondTheFaces) {
  Model model = named_boxes();
  model.mesh.triangles.resize(12);  // as somebody leaves it who forgets the parts
  const ShapeAnalysis shape = prepare_surface(model);
  EXPECT_THROW(list_objects(model, shape), InvalidInput);
  EXPECT_THROW(prepare_surface(model, focus_on("left")), InvalidInput);
  model.parts[1] = {"right", 3, ~std::size_t{0}};
  EXPECT_THROW(list_objects(model, shape), InvalidInput);
  model.parts[1] = {"right", 12, 0};
  EXPECT_EQ(list_objects(model, shape).size(), 1U);
}

TEST(ListObjects, PutsPartsOfOneNameTogether) {
  Model model = two_boxes();
  model.parts = {{"wall", 0, 6}, {"door", 6, 6}, {"wall", 12, 12}};
  const auto objects = list_objects(model, prepare_surface(model));
  ASSERT_EQ(objects.size(), 2U);
  EXPECT_EQ(objects[0].faces, 18U);
  EXPECT_EQ(objects[1].faces, 6U);
}

TEST(ListObjects, KeepsFacesBeforeTheFirstName) {
  Model model = two_boxes();
  model.parts = {{"second", 12, 12}};
  const auto objects = list_objects(model, prepare_surface(model));
  ASSERT_EQ(objects.size(), 2U);
  EXPECT_EQ(objects[0].name, "");
  EXPECT_EQ(objects[0].faces, 12U);
}

TEST(FindObject, TakesANameOrANumber) {
  const Model model = named_boxes();
  const auto objects = list_objects(model, prepare_surface(model));
  EXPECT_EQ(&find_object(objects, "right"), &objects[1]);
  EXPECT_EQ(&find_object(objects, "0"), &objects[0]);
}

TEST(FindObject, PrefersTheNameToTheNumber) {
  Model model = named_boxes();
  model.parts[0].name = "1";
  const auto objects = list_objects(model, prepare_surface(model));
  EXPECT_EQ(&find_object(objects, "1"), &objects[0]);
}

TEST(FindObject, SaysWhatThereIs) {
  const Model model = named_boxes();
  const auto objects = list_objects(model, prepare_surface(model));
  try {
    find_object(objects, "middle");
    FAIL();
  } catch (const InvalidInput& error) {
    EXPECT_NE(std::string(error.what()).find("left', 'right'"), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("0 to 1"), std::string::npos) << error.what();
  }
  EXPECT_THROW(find_object(objects, "2"), InvalidInput);
  EXPECT_THROW(find_object(objects, "-1"), InvalidInput);
}

TEST(FocusOn, LeavesTheSignificanceOfTheObjectAlone) {
  const ShapeAnalysis all = analyse_shape(named_boxes(kCells), test::unrefined());
  const std::size_t count = all.significance.size();
  double sum = 0.0;
  for (std::size_t v = 0; v < count; ++v) {
    EXPECT_EQ(right_box().significance[v], v < count / 2 ? 0.0 : all.significance[v]) << v;
    sum += right_box().significance[v];
  }
  EXPECT_GT(sum, 0.0);
}

TEST(FocusOn, TheBestViewIsNotBlockedByTheOtherBox) {
  // Along −x the left box hides the right one; from the right it is in front.
  const ShapeAnalysis& shape = right_box();
  const ViewOptions options = focus_on("right");
  const VertexVisibility visibility(shape.surface, shape.sides);
  const ViewScorer scorer(visibility, shape.significance, scoring_camera(shape, options));
  EXPECT_LT(scorer.score(-Vec3::UnitX()), scorer.score(Vec3::UnitX()));
  const ViewReport report = find_views(shape, ModelFrame(UpAxis::Y), options);
  EXPECT_GE(report.best.score, scorer.score(Vec3::UnitX()));
}

/// Where a camera shows a point: across and up, in halves of the picture's height; towards the eye its depth.
Vec3 in_picture(const Camera& camera, const Vec3& point) {
  const Vec3 back = (camera.eye - camera.target).normalized();
  const Vec3 offset = point - camera.eye;
  const double depth = -offset.dot(back);
  const double half = camera.projection == Projection::Perspective
                          ? depth * std::tan(camera.fov_y_deg * kRadPerDeg / 2)
                          : camera.height / 2;
  return {offset.dot(camera.up.cross(back)) / half, offset.dot(camera.up) / half, depth};
}

/// How far from the middle of the picture the farthest of some points is.
double reach_in_picture(const Camera& camera, std::span<const Vec3> points) {
  double reach = 0.0;
  for (const Vec3& p : points) {
    reach = std::max(reach, in_picture(camera, p).head<2>().cwiseAbs().maxCoeff());
  }
  return reach;
}

std::span<const Vec3> box_of(const ShapeAnalysis& shape, std::size_t number) {
  return std::span(shape.surface.positions).subspan(8 * number, 8);
}

TEST(FocusOn, PicturesAreFramedOnTheObjectFromTheSameEye) {
  ViewOptions options = focus_on("right");
  const ShapeAnalysis shape = prepare_surface(named_boxes(), options);
  const Vec3 direction = Vec3(-0.6, 0.48, 0.64);
  for (const Projection projection : {Projection::Perspective, Projection::Orthographic}) {
    options.projection = projection;
    for (const char* size : {"100x100", "auto"}) {
      set_size(options, size);
      const PictureFrame frame = frame_picture(shape, direction, UpAxis::Y, options);
      const Camera whole =
          frame_picture(prepare_surface(named_boxes()), direction, UpAxis::Y, options).camera;
      const Camera& camera = frame.camera;
      // The box touches a border of 4 %, and of a quarter of what that leaves, in one direction.
      const double border = 2.0 * (0.04 + 0.25 * 0.46);
      const double aspect = static_cast<double>(frame.size.width) / frame.size.height;
      const double least = std::min(1.0, aspect);
      const double most = std::max(1.0, aspect);
      const double reach = reach_in_picture(camera, box_of(shape, 1));
      EXPECT_GT(reach, 0.99 * (1.0 - border) * least) << size;
      EXPECT_LT(reach, 1.01 * (most - border * least)) << size;
      // What hides the object is drawn.
      for (const Vec3& p : shape.surface.positions) {
        EXPECT_GT(in_picture(camera, p).z(), 0.0);
      }
      const Vec3 back = (camera.eye - camera.target).normalized();
      EXPECT_LT(std::abs((camera.target - Vec3(5.5, 0.5, 0.5)).dot(back)), 0.1);
      if (projection == Projection::Perspective) {
        EXPECT_EQ(camera.eye, whole.eye);
      } else {
        EXPECT_NEAR((back - direction).norm(), 0.0, 1e-12);
      }
      EXPECT_NEAR(camera.up.dot(back), 0.0, 1e-12);
    }
  }
}

TEST(FocusOn, ARoundOfCamerasKeepsTheObjectInItsMiddle) {
  for (const Projection projection : {Projection::Perspective, Projection::Orthographic}) {
    ViewOptions options = focus_on("right");
    options.projection = projection;
    const ShapeAnalysis shape = prepare_surface(named_boxes(), options);
    ReportedViewSet set;
    set.choice.views = {{Vec3::UnitX()}, {Vec3(-0.6, 0.0, 0.8)}, {Vec3(-0.6, 0.64, -0.48)}};
    set.tour.order = {0, 1, 2};
    double reach = 0.0;
    for (const Camera& camera :
         tour_cameras(shape, set, scoring_camera(shape, options), UpAxis::Y, 1.0, 20)) {
      reach = std::max(reach, reach_in_picture(camera, box_of(shape, 1)));
      for (const Vec3& p : shape.surface.positions) {
        EXPECT_GT(in_picture(camera, p).z(), 0.0);
      }
      EXPECT_NEAR(camera.up.dot((camera.eye - camera.target).normalized()), 0.0, 1e-12);
    }
    EXPECT_NEAR(reach, 1.0 - 2.0 * (0.04 + 0.25 * 0.46), 1e-9);
  }
}

TEST(FocusOn, PicturesAreNoCloserThanCoordinatesAreExact) {
  Model model = named_boxes();
  for (std::size_t v = 8; v < 16; ++v) {
    model.mesh.positions[v] = Vec3(5, 0, 0) + 1e-9 * model.mesh.positions[v];
  }
  const ViewOptions options = focus_on("right");
  const ShapeAnalysis shape = prepare_surface(model, options);
  const Camera camera = frame_picture(shape, Vec3::UnitZ(), UpAxis::Y, options).camera;
  const double height =
      2.0 * (camera.eye - camera.target).norm() * std::tan(camera.fov_y_deg * kRadPerDeg / 2);
  EXPECT_GT(height, 1e-4 * shape.sphere.diameter);
  EXPECT_LT(height, 2e-4 * shape.sphere.diameter);
}

TEST(FocusOn, AnObjectThatNoViewShowsIsDoubted) {
  Model model =
      test::model_of(test::together(test::box(5, 5, 5, 1), test::box(1, 1, 1, 1), Vec3(2, 2, 2)));
  model.parts = {{"shell", 0, 12}, {"core", 12, 12}};
  for (const char* name : {"core", "shell"}) {
    ViewOptions options = focus_on(name);
    options.search = {.strategy = SearchStrategy::Exhaustive, .subdivisions = 1};
    const ShapeAnalysis shape = analyse_shape(model, options);
    const ViewReport report = find_views(shape, ModelFrame(UpAxis::Y), options);
    const bool is_hidden = options.focus == "core";
    EXPECT_EQ(report.best.score == 0.0, is_hidden);
    EXPECT_EQ(blank_view_warning(shape, report.best, options).empty(), !is_hidden);
    const auto doubts = std::count_if(
        report.reliability_warnings.begin(), report.reliability_warnings.end(),
        [](const std::string& doubt) { return doubt.starts_with("nothing significant is seen"); });
    EXPECT_EQ(doubts, is_hidden ? 1 : 0);
  }
}

TEST(FocusOn, AnEyeBetweenTwoBoxesSeesTheSidesThatFaceIt) {
  const ShapeAnalysis left_box = analyse_shape(named_boxes(kCells), focus_on("left"));
  for (const ShapeAnalysis& shape : {left_box, right_box()}) {
    const VertexVisibility visibility(shape.surface, shape.sides);
    const auto visible = visibility.visible_vertices({.position = Vec3(3.0, 0.5, 0.5)});
    double facing = 0.0;
    for (std::size_t v = 0; v < shape.significance.size(); ++v) {
      const double x = shape.surface.positions[v].x();
      facing += x == 1.0 || x == 5.0 ? shape.significance[v] : 0.0;
    }
    EXPECT_GT(facing, 0.0);
    EXPECT_EQ(visible_sum(shape.significance, visible), facing);
  }
}

}  // namespace
}  // namespace vantage
