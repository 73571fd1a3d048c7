// SPDX-License-Identifier: MIT
#include "pipeline/survey_sight.h"

#include <cmath>
#include <cstdint>
#include <memory>

#include <gtest/gtest.h>

#include "vantage/pipeline/find_views.h"
#include "vantage/spatial/directions.h"

#include "pipeline/coarse_copies.h"
#include "pipeline/map_estimates.h"
#include "support/model_of.h"
#include "support/shapes.h"

namespace vantage::test {
namespace {

struct Surveyed {
  TriMesh mesh = box(2.0, 1.0, 0.5, 3);
  VertexVisibility visibility{mesh, {FaceSides::Front}};
  ScoringCamera camera{.sphere = enclosing_sphere(mesh.positions)};
  std::vector<double> shares{};

  Surveyed() {
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
      shares.push_back(1.0 / static_cast<double>(v + 3));
    }
  }
};

TEST(SurveySight, ScoresAsTheScorerDoesToTheLastBit) {
  const Surveyed shape;
  const SurveySight sight(shape.visibility, shape.camera, 4, {});
  const ViewScorer scorer(shape.visibility, shape.shares, shape.camera);
  for (const int level : {3, 4}) {  // the report's directions and the search's
    const DirectionSet set = direction_set(ViewSphereBase::Icosahedron, level);
    const std::vector<double> scores = scorer.score_all(set.directions);
    for (std::size_t i = 0; i < set.directions.size(); ++i) {
      ASSERT_EQ(sight.score(set.directions[i], shape.shares), scores[i]) << level << ' ' << i;
    }
  }
}

TEST(SurveySight, KnowsNoOtherDirectionsAndCameras) {
  const Surveyed shape;
  const SurveySight sight(shape.visibility, shape.camera, 4, {});
  EXPECT_FALSE(sight.score(Vec3(0.6, 0.48, 0.64), shape.shares).has_value());
  EXPECT_TRUE(is_same(sight.camera(), shape.camera));
  ScoringCamera other = shape.camera;
  other.distance_factor = 3.0;
  EXPECT_FALSE(is_same(sight.camera(), other));
  other = shape.camera;
  other.projection = Projection::Orthographic;
  EXPECT_FALSE(is_same(sight.camera(), other));
  other = shape.camera;
  other.sphere.diameter *= 1.5;
  EXPECT_FALSE(is_same(sight.camera(), other));
}

/// So many copies in rows.
TriMesh rows_of(const TriMesh& one, std::uint32_t count) {
  TriMesh many;
  for (std::uint32_t i = 0; i < count; ++i) {
    const auto first = static_cast<std::uint32_t>(many.positions.size());
    for (const Vec3& p : one.positions) {
      many.positions.emplace_back(p + 3.0 * Vec3(i % 10, i / 10 % 10, i / 100));
    }
    for (const auto& [a, b, c] : one.triangles) {
      many.triangles.push_back({first + a, first + b, first + c});
    }
  }
  return many;
}

/// It has no vertex to lose.
TriMesh tetrahedron() {
  return {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
          {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}}};
}

TEST(CoarseCopies, SampleASurfaceOfPartsThatCannotBeMadeCoarser) {
  const auto copies_of_rows = [&](std::uint32_t count) {
    const ShapeAnalysis shape = prepare_surface(model_of(rows_of(tetrahedron(), count)));
    return std::make_unique<const CoarseCopies>(shape);
  };
  const auto many = copies_of_rows(1100);
  EXPECT_FALSE(many->is_coarse());
  EXPECT_TRUE(many->is_sampled());
  EXPECT_EQ(many->survey_level(), 3);
  const auto few = copies_of_rows(400);
  EXPECT_FALSE(few->is_coarse());
  EXPECT_FALSE(few->is_sampled());
  EXPECT_EQ(few->survey_level(), 4);
}

TEST(MapEstimates, BySamplesAreNearTheScores) {
  const TriMesh many = renumbered(rows_of(tetrahedron(), 1100), 7);
  const ShapeAnalysis shape = prepare_surface(model_of(many));
  const std::vector<double> map(shape.surface.positions.size(), 1.0);
  ViewOptions options;
  options.objective = Objective::Significance;
  const MapEstimates estimates(shape, map, options);
  ASSERT_TRUE(estimates.copies().is_sampled());
  const VertexVisibility visibility(shape.surface, shape.sides);
  const ViewScorer scorer(visibility, map, scoring_camera(shape, options));
  const std::vector<Vec3> views = direction_set(ViewSphereBase::Icosahedron, 1).directions;
  const std::vector<double> exact = scorer.score_all(views);
  const std::vector<double> sampled = estimates.scores(views);
  for (std::size_t i = 0; i < views.size(); ++i) {
    EXPECT_NEAR(sampled[i], exact[i], 0.05 * scorer.total());  // four deviations of 1100 samples
  }
}

TEST(CoarseCopies, SurveysACopyThatRemainsLargeFromFewerDirections) {
  // Each of so many icosahedra becomes a tetrahedron.
  const TriMesh many = rows_of(sphere(0), CoarseCopies::kCoarseVertices + 1);
  const ShapeAnalysis large_shape = prepare_surface(model_of(many));
  const CoarseCopies large(large_shape);
  EXPECT_TRUE(large.is_coarse());
  EXPECT_EQ(large.survey_level(), 3);
  const ShapeAnalysis usual_shape = prepare_surface(model_of(sphere(4)));
  const CoarseCopies usual(usual_shape);
  EXPECT_TRUE(usual.is_coarse());
  EXPECT_EQ(usual.survey_level(), 4);
}

}  // namespace
}  // namespace vantage::test
