// SPDX-License-Identifier: MIT
#include "pipeline/self_check.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <string>
#include <tuple>
#include <vector>

#include <gtest/gtest.h>

#include "pipeline/scene_notes.h"
#include "support/model_of.h"
#include "support/shapes.h"
#include "support/unrefined.h"

namespace vantage::test {
namespace {

/// A sphere of radius 1 and one of radius `small` beside it.
TriMesh two_spheres(double small) {
  TriMesh mesh = sphere(2);
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  const TriMesh other = sphere(2);
  for (const Vec3& p : other.positions) {
    mesh.positions.emplace_back(small * p + Vec3(3.0, 0.0, 0.0));
  }
  for (const Triangle& t : other.triangles) {
    mesh.triangles.push_back({first + t[0], first + t[1], first + t[2]});
  }
  return mesh;
}

/// Of few views.
ViewOptions quick_check() {
  return unrefined({.search = {.strategy = SearchStrategy::Exhaustive, .subdivisions = 1}});
}

TEST(DoubtsAbout, PartsThatDidNotBecomeCurvesHangOnHowLargeTheyAre) {
  const ViewOptions options = quick_check();
  // As many vertices in both: what counts is how large a part is, not how finely it is cut.
  const ShapeAnalysis shape = analyse_shape(model_of(two_spheres(0.4)), options);
  const ViewReport report = find_views(shape, ModelFrame(UpAxis::Y), options);
  const auto doubts_where_left = [&](std::size_t vertex, double shrinkage) {
    ShapeAnalysis other = shape;
    other.views.reset();  // so that only the contraction is looked at
    const std::uint32_t component = other.history.component_of_vertex[vertex];
    other.history.components[component].shrinkage = shrinkage;
    return reliability_warnings(other, report, options, checked_moved_map(other, options, {}), {});
  };
  const std::size_t of_the_small = shape.surface.positions.size() - 1;
  EXPECT_TRUE(doubts_where_left(0, 0.01).empty());
  EXPECT_TRUE(doubts_where_left(of_the_small, 0.5).empty());
  const std::vector<std::string> warnings = doubts_where_left(0, 0.5);
  ASSERT_EQ(warnings.size(), 1U);
  // The large one holds 1 / (1 + 0.4²) of the area.
  EXPECT_EQ(warnings[0].rfind("parts with 86 % of the area and ", 0), 0U) << warnings[0];
}

TEST(DoubtsAbout, PartsThatDidNotBecomeCurvesAreNoneWhereTheyOnlyHideTheFocus) {
  ViewOptions options = quick_check();
  options.focus = "1";
  ShapeAnalysis shape = analyse_shape(model_of(two_spheres(0.4)), options);
  shape.views.reset();
  const ViewReport report = find_views(shape, ModelFrame(UpAxis::Y), options);
  const auto is_doubted = [&](std::size_t vertex) {
    ShapeAnalysis other = shape;
    other.history.components[other.history.component_of_vertex[vertex]].shrinkage = 0.5;
    return !reliability_warnings(other, report, options, {}, {}).empty();
  };
  EXPECT_FALSE(is_doubted(0));
  EXPECT_TRUE(is_doubted(shape.surface.positions.size() - 1));
}

TEST(DoubtsAbout, ASkeletonPartlyOutsideIsTheSkeletonsUntilTheViewsHangOnIt) {
  const ViewOptions options = quick_check();
  ShapeAnalysis shape = analyse_shape(model_of(box(1.0, 2.0, 3.0, 2)), options);
  const auto is_said = [](const std::vector<std::string>& warnings) {
    return std::any_of(warnings.begin(), warnings.end(), [](const std::string& warning) {
      return warning.find("of the skeleton's length is outside") != std::string::npos;
    });
  };
  for (const auto& [share, note, skeletons, views] : {std::tuple{0.01, false, false, false},
                                                      {0.1, true, true, false},
                                                      {0.3, false, true, true}}) {
    shape.skeleton.outside_share = share;
    const ViewReport report = find_views(shape, ModelFrame(UpAxis::Y), options);
    EXPECT_EQ(is_said(report.warnings), note) << share;
    EXPECT_EQ(is_said(skeleton_warnings(shape)), skeletons) << share;
    EXPECT_EQ(is_said(report.reliability_warnings), views) << share;
  }
}

TEST(NotesOn, PartsThatAreHiddenOrSpecksAreGiven) {
  const auto notes_on = [](const TriMesh& mesh, Weight weight = Weight::Vertex) {
    ShapeAnalysis shape = prepare_surface(model_of(mesh));
    shape.significance.assign(shape.surface.positions.size(), 1.0);
    std::vector<std::string> notes;
    ViewOptions options;
    options.weight = weight;
    note_parts_hardly_shown(shape, options, notes, {});
    return notes;
  };
  const TriMesh hall = box(5.0, 5.0, 5.0, 1);
  const TriMesh plate = box(300.0, 300.0, 1.0, 1);
  const TriMesh ball = sphere(2);
  const std::vector<std::string> inside = notes_on(together(hall, ball, Vec3(2.5, 2.5, 2.5)));
  ASSERT_EQ(inside.size(), 1U);
  EXPECT_TRUE(inside[0].starts_with("1 of 2 separate parts show no vertex from any of 162"));
  EXPECT_TRUE(notes_on(together(hall, ball, Vec3(2.5, 2.5, 2.5)), Weight::Area)[0].starts_with(
      "1 of 2 separate parts show nothing from any of 162"));
  EXPECT_EQ(notes_on(together(hall, ball, Vec3(8.0, 0.0, 0.0))).size(), 0U);
  // A spoke through the hall: both of its ends are within caps.
  TriMesh caps = together(hall, hall, Vec3(20.0, 0.0, 0.0));
  const TriMesh spoke = box(20.0, 1.0, 1.0, 1);
  const TriMesh wheel =
      together(together(caps, spoke, Vec3(2.5, 2.0, 2.0)), spoke, Vec3(2.5, 0.5, 0.5));
  const std::vector<std::string> ends = notes_on(wheel);
  ASSERT_EQ(ends.size(), 1U);
  EXPECT_TRUE(ends[0].ends_with(
      "so that no view counts them: others hide them or their ends; --weight area counts faces"));
  EXPECT_EQ(notes_on(wheel, Weight::Area).size(), 0U);
  const std::vector<std::string> speck = notes_on(together(plate, ball, Vec3(50.0, 50.0, 2.0)));
  ASSERT_EQ(speck.size(), 1U);
  // The ball has 162 vertices of 170.
  EXPECT_TRUE(
      speck[0].starts_with("95 % of the significance is in a place that spans less than 2 %"));
  // Leaves of a tree are specks, but not in one place.
  const TriMesh two = together(plate, ball, Vec3(50.0, 50.0, 2.0));
  EXPECT_EQ(notes_on(together(two, ball, Vec3(250.0, 250.0, 2.0))).size(), 0U);
}

TEST(DoubtsAbout, TangledSkeletonsAreThoseOfCloudsWithManyCyclesForTheirNodes) {
  const ViewOptions options = quick_check();
  ShapeAnalysis shape = analyse_shape(model_of(sphere(2)), options);
  shape.views.reset();
  const ViewReport report = find_views(shape, ModelFrame(UpAxis::Y), options);
  // A chain of squares: each adds three edges and two nodes, and so a cycle.
  CurveGraph& graph = shape.skeleton.graph;
  graph = {.nodes = {Vec3::Zero(), Vec3::UnitX()}, .edges = {{0, 1}}};
  const auto is_doubted = [&] {
    const std::vector<std::string> warnings =
        reliability_warnings(shape, report, options, checked_moved_map(shape, options, {}), {});
    return std::any_of(warnings.begin(), warnings.end(),
                       [](const std::string& d) { return d.find("tangle") != std::string::npos; });
  };
  shape.cloud.emplace();
  for (std::uint32_t squares = 1; squares <= 9; ++squares) {
    const std::uint32_t last = 2 * squares;
    graph.nodes.insert(graph.nodes.end(), 2, Vec3::Zero());
    for (const std::array<std::uint32_t, 2>& edge :
         {std::array{last - 2, last}, std::array{last - 1, last + 1}, std::array{last, last + 1}}) {
      graph.edges.push_back(edge);
    }
    EXPECT_EQ(is_doubted(), squares > 8) << squares;
  }
  graph.nodes.resize(60, Vec3::Zero());  // nine cycles are what a larger graph may have
  EXPECT_FALSE(is_doubted());
  graph.nodes.resize(20);
  shape.cloud.reset();  // of a surface they are its handles
  EXPECT_FALSE(is_doubted());
}

}  // namespace
}  // namespace vantage::test
