// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "vantage/core/error.h"
#include "vantage/pipeline/find_views.h"
#include "vantage/pipeline/shape_analysis.h"

#include "support/model_of.h"
#include "support/shapes.h"

namespace vantage {
namespace {

/// Two unit boxes, five apart along x; 12 triangles and 8 vertices each.
Model two_boxes() {
  const TriMesh box = test::box(1.0, 1.0, 1.0, 1);
  return test::model_of(test::together(box, box, Vec3(5, 0, 0)));
}

Model named_boxes() {
  Model model = two_boxes();
  model.parts = {{"left", 0, 12}, {"right", 12, 12}};
  return model;
}

ViewOptions focus_on(const char* name) {
  ViewOptions options;
  options.focus = name;
  return options;
}

/// The box at the right alone. Analysed once a process.
const ShapeAnalysis& right_box() {
  static const ShapeAnalysis shape = analyse_shape(named_boxes(), focus_on("right"));
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
  const ShapeAnalysis all = analyse_shape(named_boxes(), {});
  for (std::size_t v = 0; v < 16; ++v) {
    EXPECT_EQ(right_box().significance[v], v < 8 ? 0.0 : all.significance[v]) << v;
  }
}

TEST(FocusOn, TheBestViewIsNotBlockedByTheOtherBox) {
  // Along −x the left box hides the right one; from the right it is in front.
  const ShapeAnalysis& shape = right_box();
  const ViewOptions options = focus_on("right");
  const VertexVisibility visibility(shape.surface, shape.sides);
  const ViewScorer scorer(visibility, shape.significance, scoring_camera(shape, options));
  EXPECT_LT(scorer.score(-Vec3::UnitX()), scorer.score(Vec3::UnitX()));
  const ViewReport report = find_views(shape, UpAxis::Y, options);
  EXPECT_GE(report.best.score, scorer.score(Vec3::UnitX()));
}

TEST(FocusOn, AnEyeBetweenTwoBoxesSeesTheSidesThatFaceIt) {
  const ShapeAnalysis left_box = analyse_shape(named_boxes(), focus_on("left"));
  for (const ShapeAnalysis& shape : {left_box, right_box()}) {
    const VertexVisibility visibility(shape.surface, shape.sides);
    const auto visible = visibility.visible_vertices({.position = Vec3(3.0, 0.5, 0.5)});
    double facing = 0.0;
    for (std::size_t v = 0; v < 16; ++v) {
      const double x = shape.surface.positions[v].x();
      facing += x == 1.0 || x == 5.0 ? shape.significance[v] : 0.0;
    }
    EXPECT_EQ(visible_sum(shape.significance, visible), facing);
  }
}

}  // namespace
}  // namespace vantage
