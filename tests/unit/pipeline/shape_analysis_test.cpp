// SPDX-License-Identifier: MIT
#include "vantage/pipeline/shape_analysis.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "vantage/mesh/mesh_check.h"
#include "vantage/pipeline/find_views.h"

#include "support/model_of.h"
#include "support/shapes.h"
#include "support/unrefined.h"

namespace vantage::test {
namespace {

using testing::Contains;
using testing::HasSubstr;

TEST(PrepareSurface, WeldsASoupAndSaysSo) {
  const TriMesh ball = sphere(1);
  const ShapeAnalysis shape = prepare_surface(model_of(soup(ball)));
  EXPECT_EQ(shape.surface.positions.size(), ball.positions.size());
  EXPECT_TRUE(shape.check.closed);
  EXPECT_THAT(shape.warnings, Contains(HasSubstr("welded")));
}

TEST(PrepareSurface, TurnsAnInsideOutShellAndSaysSo) {
  const ShapeAnalysis shape = prepare_surface(model_of(inside_out(sphere(1))));
  EXPECT_EQ(shape.surface.triangles.size(), sphere(1).triangles.size());
  EXPECT_THAT(shape.warnings, Contains(HasSubstr("inside out")));
}

TEST(PrepareSurface, HasNothingToSayOfACleanModel) {
  EXPECT_TRUE(prepare_surface(model_of(torus(1.0, 0.3, 24, 12))).warnings.empty());
}

TEST(PrepareSurface, LeavesIsolatedVerticesOutOfTheSphere) {
  TriMesh mesh = sphere(2);
  mesh.positions.emplace_back(100.0, 0.0, 0.0);
  EXPECT_NEAR(prepare_surface(model_of(mesh)).sphere.diameter, 2.0, 1e-9);
}

TEST(AnalyseShape, IsTheSameWithAVertexOfNoFace) {
  const TriMesh mesh = y_of_tubes(0.2, 24);
  const ShapeAnalysis alone = analyse_shape(model_of(mesh), {});
  for (const double far : {0.0, 30.0, 1e9}) {
    TriMesh with_stray = mesh;
    with_stray.positions.emplace_back(far, -far, 0.0);
    const ShapeAnalysis other = analyse_shape(model_of(with_stray), {});
    std::vector<double> expected = alone.significance;
    expected.push_back(0.0);
    EXPECT_EQ(other.significance, expected) << far;
    EXPECT_EQ(other.skeleton.graph.nodes, alone.skeleton.graph.nodes) << far;
  }
}

TEST(PrepareSurface, JoinsPointsWithoutFacesByTheirNeighbourhoods) {
  const TriMesh points{.positions = sphere(3).positions, .triangles = {}};
  const ShapeAnalysis shape = prepare_surface(model_of(points));
  ASSERT_TRUE(shape.cloud.has_value());
  EXPECT_EQ(shape.surface.positions.size(), points.positions.size());
  EXPECT_FALSE(shape.surface.triangles.empty());
}

TEST(PrepareSurface, EnclosesThePointsThatNoTriangleJoinsAndNotesThem) {
  const ShapeAnalysis shape = prepare_surface(model_of(points_of_ball_and_pole()));
  EXPECT_NEAR(shape.sphere.diameter, 5.0, 1e-9);
  EXPECT_NEAR(shape.sphere.centre.y(), 1.5, 1e-9);
  EXPECT_EQ(shape.check.components, 1U);
  EXPECT_THAT(shape.warnings, Contains(HasSubstr("drawn but not counted")));
  const TriMesh ball{.positions = sphere(2).positions, .triangles = {}};
  EXPECT_TRUE(prepare_surface(model_of(ball)).warnings.empty());
}

TEST(AnalyseShape, IsTheSameWithACopyOfEachFace) {
  const TriMesh once = y_of_tubes(0.2, 24);
  ViewOptions by_area;
  by_area.weight = Weight::Area;
  const auto score = [&](const ShapeAnalysis& shape) {
    const VertexVisibility visibility(shape.surface, shape.sides);
    const MapScorer map(shape, visibility, by_area);
    return std::pair(map.scorer().score(Vec3(0.3, 0.4, 0.5)), map.scorer().total());
  };
  const ShapeAnalysis alone = analyse_shape(model_of(once), unrefined());
  for (const bool is_turned : {false, true}) {
    TriMesh twice = once;
    for (auto [a, b, c] : once.triangles) {
      twice.triangles.push_back(is_turned ? Triangle{a, c, b} : Triangle{b, c, a});
    }
    const ShapeAnalysis other = analyse_shape(model_of(twice), unrefined());
    EXPECT_EQ(other.significance, alone.significance) << is_turned;
    EXPECT_EQ(other.skeleton.graph.nodes, alone.skeleton.graph.nodes) << is_turned;
    EXPECT_EQ(other.skeleton.graph.edges, alone.skeleton.graph.edges) << is_turned;
    EXPECT_EQ(score(other), score(alone)) << is_turned;
    EXPECT_THAT(other.warnings,
                Contains(std::to_string(once.triangles.size()) +
                         " faces standing in the place of an earlier one left out"));
  }
}

TEST(AnalyseShape, IsTheSameForPointsInAnyOrder) {
  TriMesh cloud = y_of_tubes(0.2, 24);
  cloud.triangles.clear();
  cloud.positions.push_back(cloud.positions.front());  // is welded
  const ShapeAnalysis shape = analyse_shape(model_of(cloud), {});
  std::vector<std::uint32_t> old_of_new;
  const ShapeAnalysis other = analyse_shape(model_of(renumbered(cloud, 7, &old_of_new)), {});
  const std::vector<double> values = on_input_vertices(shape, shape.significance);
  const std::vector<double> other_values = on_input_vertices(other, other.significance);
  ASSERT_EQ(values.size(), old_of_new.size());
  for (std::size_t v = 0; v < values.size(); ++v) {
    EXPECT_EQ(other_values[v], values[old_of_new[v]]) << v;
  }
  EXPECT_EQ(other.skeleton.graph.nodes, shape.skeleton.graph.nodes);
}

TEST(PrepareSurface, RefusesPointsOnALine) {
  TriMesh points;
  for (int i = 0; i < 20; ++i) {
    points.positions.emplace_back(i, 0.0, 0.0);
  }
  EXPECT_THROW(prepare_surface(model_of(points)), InvalidInput);
}

TEST(PrepareSurface, RefusesWhatNothingCanBeComputedWith) {
  for (const auto& [factor, shift] :
       std::vector<std::array<double, 2>>{{1e61, 0.0}, {1e-62, 0.0}, {1.0, 1e15}}) {
    Model model = model_of(test::box(1, 1, 1, 1));
    Model cloud = model_of({model.mesh.positions, {}});
    for (Model* m : {&model, &cloud}) {
      for (Vec3& p : m->mesh.positions) {
        p = factor * p + Vec3::Constant(shift);
      }
      EXPECT_THROW(prepare_surface(*m), InvalidInput) << factor;
    }
  }
}

TEST(PrepareSurface, WarnsOfCoarseCoordinates) {
  Model model = model_of(test::box(1, 1, 1, 1));
  for (Vec3& p : model.mesh.positions) {
    p += Vec3::Constant(1e11);
  }
  EXPECT_THAT(prepare_surface(model).warnings, testing::Contains(testing::HasSubstr("coarse")));
}

TEST(PrepareSurface, NotesSmallComponentsThatMakeTheModelsBoxMuchLarger) {
  for (const double away : {0.1, 2.0}) {
    TriMesh mesh = test::sphere(2);
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    for (const Vec3& corner : {Vec3(0.0, 0.0, 0.0), Vec3(0.01, 0.0, 0.0), Vec3(0.0, 0.01, 0.0)}) {
      mesh.positions.emplace_back(corner + (1.0 + away) * Vec3::Ones());
    }
    mesh.triangles.push_back({first, first + 1, first + 2});
    EXPECT_THAT(prepare_surface(model_of(mesh)).warnings,
                testing::Contains(testing::HasSubstr("1 small component makes the box"))
                    .Times(away > 1.0 ? 1 : 0));
  }
}

TEST(AnalyseShape, RefusesCoordinatesThatAreNotFinite) {
  for (const double y :
       {std::numeric_limits<double>::quiet_NaN(), -std::numeric_limits<double>::infinity()}) {
    TriMesh nowhere = box(1.0, 2.0, 3.0, 1);
    nowhere.positions[2].y() = y;
    EXPECT_THROW(analyse_shape(model_of(nowhere), unrefined()), InvalidInput);
    EXPECT_THROW(contract(nowhere), InvalidInput);
    nowhere.triangles.clear();
    EXPECT_THROW(prepare_surface(model_of(nowhere)), InvalidInput);
  }
}

TEST(AnalyseShape, CarriesFieldsOfItsSurfaceOnly) {
  const ShapeAnalysis shape = prepare_surface(model_of(box(1.0, 2.0, 3.0, 1)));
  const std::vector<double> field(shape.surface.positions.size() + 1, 1.0);
  EXPECT_THROW(on_input_vertices(shape, field), InvalidInput);
}

TEST(AnalyseShape, ForViewsRefusesFacesWithoutArea) {
  TriMesh line;
  for (const double at : {0.0, 0.1, 0.3, 0.7}) {  // whose sums and products are rounded
    line.positions.emplace_back(at, 3.0 * at, 1.0 - at / 3.0);
  }
  line.triangles = {{0, 1, 2}, {1, 2, 3}};
  EXPECT_THROW(analyse_shape(model_of(line), unrefined()), InvalidInput);
  EXPECT_THROW(find_picture_view(model_of(line), prepare_surface(model_of(line)), {}),
               InvalidInput);
  line.positions.emplace_back(0.1, 0.3, 1.0);
  line.triangles.push_back({0, 3, 4});
  EXPECT_EQ(analyse_shape(model_of(line), unrefined()).check.zero_area_faces, 2U);
}

TEST(PrepareSurface, RefusesAModelWithoutExtent) {
  TriMesh dot;
  dot.positions.assign(3, Vec3(1.0, 2.0, 3.0));
  dot.triangles = {{0, 1, 2}};
  const auto problem_of = [&](const std::string& name) -> std::string {
    Model model = model_of(dot);
    model.name = name;
    try {
      prepare_surface(model);
    } catch (const InvalidInput& e) {
      return e.what();
    }
    return "none";
  };
  EXPECT_THAT(problem_of("dot"), testing::StartsWith("dot: all faces"));
  EXPECT_THAT(problem_of(""), testing::StartsWith("all faces"));
}

TEST(AnalyseShape, CountsAllLevelsWhereThereIsNoSecondCurve) {
  const Model model = model_of(y_of_tubes(0.2, 24));
  const auto used = [&](const ViewOptions& options) {
    const ShapeAnalysis shape = analyse_shape(model, unrefined(options));
    return std::pair(shape.kssm.levels_used.size(), shape.history.levels.size());
  };
  const auto [some, all] = used({.kssm = {.level_agreement = 0.9999}});
  EXPECT_LT(some, all);
  const auto [unfitted, all_unfitted] =
      used({.skeleton = {.fit = false}, .kssm = {.level_agreement = 0.9999}});
  EXPECT_EQ(unfitted, all_unfitted);
  const auto [finished, all_finished] =
      used({.kssm = {.level_agreement = 0.9999}, .kssm_to_finished_graph = true});
  EXPECT_EQ(finished, all_finished);
}

/// Cells in a cube of eight along each side; their walls are there once for each cell.
TriMesh cells_with_walls() {
  constexpr std::uint32_t kPoints = 9;
  TriMesh mesh;
  const auto quad = [&](std::uint32_t at, std::uint32_t along, std::uint32_t up, bool is_turned) {
    for (Triangle t : {Triangle{at, at + along, at + along + up}, {at, at + along + up, at + up}}) {
      if (is_turned) {
        std::swap(t[1], t[2]);
      }
      mesh.triangles.push_back(t);
    }
  };
  constexpr std::array<std::uint32_t, 3> kStep{1, kPoints, kPoints * kPoints};
  for (std::uint32_t v = 0; v < kPoints * kPoints * kPoints; ++v) {
    const std::array<std::uint32_t, 3> at{v % kPoints, v / kPoints % kPoints, v / kStep[2]};
    mesh.positions.emplace_back(at[0], at[1], at[2]);
    if (*std::max_element(at.begin(), at.end()) + 1 < kPoints) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        quad(v, kStep[(axis + 1) % 3], kStep[(axis + 2) % 3], true);
        quad(v + kStep[axis], kStep[(axis + 1) % 3], kStep[(axis + 2) % 3], false);
      }
    }
  }
  return mesh;
}

TEST(AnalyseShape, CountsNoFurtherLevelsWhereNoEdgeCanBeCollapsed) {
  const ShapeAnalysis shape = analyse_shape(model_of(cells_with_walls()), unrefined());
  EXPECT_GT(shape.history.levels.size(), 1U);
  EXPECT_THAT(shape.kssm.levels_used, testing::ElementsAre(0U));
  EXPECT_THAT(shape.warnings, Contains("2688 faces standing there twice"));  // both are kept
}

TEST(AnalyseShape, GivesEveryInputVertexItsValueAndNode) {
  TriMesh mesh = soup(torus(1.0, 0.3, 24, 12));
  mesh.positions.emplace_back(0.0, 0.0, 0.0);  // belongs to no face
  const ShapeAnalysis shape = analyse_shape(model_of(mesh), unrefined());
  const std::vector<double> map = on_input_vertices(shape, shape.significance);
  const std::vector<std::int64_t> nodes = nodes_of_input_vertices(shape);
  ASSERT_EQ(map.size(), mesh.positions.size());
  ASSERT_EQ(nodes.size(), mesh.positions.size());
  EXPECT_EQ(map.back(), 0.0);
  EXPECT_EQ(nodes.back(), -1);
  // Corners of a soup at one position share value and node.
  for (std::size_t i = 0; i + 1 < mesh.positions.size(); ++i) {
    for (std::size_t j = i + 1; j + 1 < std::min(mesh.positions.size(), i + 60); ++j) {
      if (mesh.positions[i] == mesh.positions[j]) {
        EXPECT_EQ(map[i], map[j]);
        EXPECT_EQ(nodes[i], nodes[j]);
      }
    }
  }
}

TEST(AnalyseShape, FindsTheLoopOfATorus) {
  const ShapeAnalysis shape = analyse_shape(model_of(torus(1.0, 0.3, 48, 20)), unrefined());
  EXPECT_EQ(cycle_count(shape.skeleton.graph), 1U);
  EXPECT_EQ(*shape.check.genus, 1U);
}

TEST(PrepareSurface, StopsWhenAskedWithAndWithoutFaces) {
  std::stop_source stop;
  stop.request_stop();
  const RunContext run{.report = {}, .stop = stop.get_token()};
  Model model = model_of(torus(1.0, 0.3, 24, 12));
  EXPECT_THROW(prepare_surface(model, run), Cancelled);
  model.mesh.triangles.clear();
  EXPECT_THROW(prepare_surface(model, run), Cancelled);
}

TEST(PrepareSurface, EachOfItsPartsStopsWhenAsked) {
  std::stop_source stop;
  stop.request_stop();
  const RunContext run{.report = {}, .stop = stop.get_token()};
  const TriMesh mesh = torus(1.0, 0.3, 24, 12);
  EXPECT_THROW(weld(mesh, run), Cancelled);
  EXPECT_THROW(check_mesh(mesh, run), Cancelled);
  EXPECT_THROW(orient_shells(mesh, run), Cancelled);
}

TEST(AnalyseShape, ForAPictureHasTheSameMapAndNoSkeletonUnlessTheMapMeasuresToThat) {
  const Model model = model_of(torus(1.0, 0.3, 48, 20));
  for (const bool to_finished : {false, true}) {
    const ViewOptions options = unrefined({.kssm_to_finished_graph = to_finished});
    const ShapeAnalysis whole = analyse_shape(model, options);
    const ShapeAnalysis for_picture =
        analyse_shape(model, options, {}, nullptr, AnalysisUse::Picture);
    EXPECT_EQ(for_picture.significance, whole.significance);
    EXPECT_TRUE(for_picture.views);
    EXPECT_FALSE(whole.skeleton.graph.nodes.empty());
    EXPECT_EQ(for_picture.skeleton.graph.nodes.empty(), !to_finished);
  }
}

TEST(AnalyseShape, StopsWhenAsked) {
  std::stop_source stop;
  RunContext run;
  run.stop = stop.get_token();
  run.report = [&](std::string_view, double fraction) {
    if (fraction > 0.1) {
      stop.request_stop();
    }
  };
  EXPECT_THROW(analyse_shape(model_of(torus(1.0, 0.3, 48, 20)), unrefined(), run), Cancelled);
}

TEST(AnalyseShape, ReportsProgressThatNeverGoesBack) {
  double last = 0.0;
  RunContext run;
  run.report = [&](std::string_view, double fraction) {
    EXPECT_GE(fraction, last);
    last = fraction;
  };
  analyse_shape(model_of(torus(1.0, 0.3, 48, 20)), unrefined(), run);
  EXPECT_EQ(last, 1.0);
}

}  // namespace
}  // namespace vantage::test
