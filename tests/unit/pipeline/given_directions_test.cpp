// SPDX-License-Identifier: MIT
// Wherever a direction is asked for, only where it points counts; one that points nowhere is refused.
#include <algorithm>
#include <array>
#include <functional>
#include <limits>
#include <vector>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "vantage/core/error.h"
#include "vantage/mesh/measures.h"
#include "vantage/pipeline/measured_shape.h"
#include "vantage/render/render.h"
#include "vantage/view/view_set.h"

#include "support/model_of.h"
#include "support/shapes.h"
#include "support/unrefined.h"

namespace vantage::test {
namespace {

/// A box whose map is 1 everywhere.
ShapeAnalysis box_of_equals() {
  ShapeAnalysis shape = prepare_surface(model_of(box(1.0, 2.0, 3.0, 3)));
  shape.significance.assign(shape.surface.positions.size(), 1.0);
  return shape;
}

/// Such a box, seen from so near that the eye's distance matters.
class GivenDirections : public testing::Test {
 protected:
  GivenDirections() {
    options_.distance_factor = 1.3;
    camera_ = scoring_camera(shape_, options_);
  }

  ShapeAnalysis shape_ = box_of_equals();
  VertexVisibility visibility_{shape_.surface, shape_.sides};
  ViewOptions options_ = unrefined();
  ScoringCamera camera_{};
};

const Vec3 kUnit = Vec3(3.0, 2.0, 1.0).normalized();
const std::array<Vec3, 3> kLengthened{7.0 * kUnit, 1e-200 * kUnit, 1e200 * kUnit};

std::vector<Vec3> without_a_way() {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  constexpr double kFar = std::numeric_limits<double>::infinity();
  return {Vec3::Zero(), Vec3(kNan, 0.0, 1.0), Vec3(0.0, kFar, 0.0)};
}

/// What a call gives for a direction is what it gives for the unit vector, and it refuses what points nowhere.
void expect_only_where_it_points(const std::function<Vec3(const Vec3&)>& result) {
  const Vec3 expected = result(kUnit);
  for (const Vec3& direction : kLengthened) {
    EXPECT_LE((result(direction) - expected).norm(), 1e-12 * expected.norm()) << direction.norm();
  }
  for (const Vec3& direction : without_a_way()) {
    EXPECT_THROW(result(direction), InvalidInput) << direction.transpose();
  }
}

Vec3 along_x(double value) {
  return {value, 0.0, 0.0};
}

TEST_F(GivenDirections, PlaceTheEyeOfTheScoringCameraAtItsDistance) {
  expect_only_where_it_points([&](const Vec3& d) { return camera_.eye(d); });
  expect_only_where_it_points([&](const Vec3& d) { return camera_.viewpoint(d).position; });
  expect_only_where_it_points([&](const Vec3& d) {
    return camera_.viewpoints(std::vector<Vec3>{Vec3::UnitZ(), d}).back().position;
  });
  camera_.projection = Projection::Orthographic;
  expect_only_where_it_points([&](const Vec3& d) { return camera_.viewpoint(d).position; });
}

TEST_F(GivenDirections, AreScoredFromThere) {
  const ViewScorer scorer(visibility_, shape_.significance, camera_);
  expect_only_where_it_points([&](const Vec3& d) { return along_x(scorer.score(d)); });
  expect_only_where_it_points([&](const Vec3& d) {
    return along_x(scorer.score_all(std::vector<Vec3>{Vec3::UnitZ(), d}).back());
  });
}

TEST_F(GivenDirections, AreMeasuredFromThere) {
  ViewMeasurer measurer(measure_subject(shape_, options_), {find_measure("projected-area")}, 0);
  using Views = std::vector<Vec3>;
  expect_only_where_it_points(
      [&](const Vec3& d) { return along_x(measurer.values(Views{d}).front().front()); });
  expect_only_where_it_points(
      [&](const Vec3& d) { return along_x(measurer.values_of(0, Views{d}).front()); });
  expect_only_where_it_points(
      [&](const Vec3& d) { return along_x(measurer.kept_values_of(0, Views{d}).front()); });
  expect_only_where_it_points(
      [&](const Vec3& d) { return along_x(measurer.estimates_of(0, Views{d}).front()); });
}

TEST_F(GivenDirections, AreDescribedFromThere) {
  const auto described = [&](const Vec3& d) {
    return describe_view(shape_, visibility_, camera_, d, UpAxis::Y, options_);
  };
  expect_only_where_it_points([&](const Vec3& d) { return described(d).direction; });
  expect_only_where_it_points([&](const Vec3& d) { return described(d).eye; });
  expect_only_where_it_points([&](const Vec3& d) { return described(d).up; });
  expect_only_where_it_points([&](const Vec3& d) { return described(d).picture.eye; });
  expect_only_where_it_points([&](const Vec3& d) { return along_x(described(d).score); });
}

TEST_F(GivenDirections, FramePicturesFromThere) {
  expect_only_where_it_points(
      [&](const Vec3& d) { return frame_picture(shape_, d, UpAxis::Y, options_).camera.eye; });
  expect_only_where_it_points([&](const Vec3& d) { return upright(d, Vec3::UnitY()); });
  expect_only_where_it_points([&](const Vec3& d) { return upright(Vec3::UnitX(), d); });
  expect_only_where_it_points([&](const Vec3& d) {
    return frame_points(shape_.surface.positions, camera_.viewpoint(Vec3::UnitX()),
                        camera_.sphere.centre, d, 1.0)
        .up;
  });
}

TEST_F(GivenDirections, BeginASetOfViewsOrAreOne) {
  const ViewSetOptions two{.views = 2, .level = 1};
  const auto chosen = [&](const Vec3& d) {
    return select_views(visibility_, shape_.significance, camera_, d, two).views;
  };
  expect_only_where_it_points([&](const Vec3& d) { return chosen(d).front().direction; });
  expect_only_where_it_points([&](const Vec3& d) { return chosen(d).back().direction; });
  expect_only_where_it_points([&](const Vec3& d) {
    return measure_views(visibility_, shape_.significance, camera_, std::vector<Vec3>{d}, two)
        .views.front()
        .direction;
  });
  expect_only_where_it_points([&](const Vec3& d) {
    const std::size_t count = shape_.surface.positions.size();
    const VisibleSets sets = visible_sets(visibility_, camera_, std::vector<Vec3>{d}, count);
    double seen = 0.0;
    for (std::size_t v = 0; v < count; ++v) {
      seen += sets.sees(0, v) ? 1.0 : 0.0;
    }
    return along_x(seen);
  });
}

TEST_F(GivenDirections, AreStopsOfATour) {
  using Views = std::vector<Vec3>;
  expect_only_where_it_points([&](const Vec3& d) {
    return along_x(shortest_tour(Views{Vec3::UnitZ(), d}).length_rad);
  });
  expect_only_where_it_points([&](const Vec3& d) {
    return tour_path(Views{Vec3::UnitZ(), d}, Vec3::UnitY(), 5)[1].direction;
  });
  expect_only_where_it_points([&](const Vec3& d) {
    return tour_path(Views{Vec3::UnitZ(), Vec3::UnitX()}, d, 5)[1].up;
  });
}

TEST_F(GivenDirections, AreTakenForTheBestViewWhereOptionsSaySo) {
  options_.search.strategy = SearchStrategy::Exhaustive;
  options_.search.subdivisions = 0;
  expect_only_where_it_points([&](const Vec3& d) {
    options_.best_view = d;
    return find_views(shape_, ModelFrame{}, options_).best.direction;
  });
}

TEST_F(GivenDirections, OfATourGoRoundInPicturesOfSomeSize) {
  ReportedViewSet set;
  set.way = CameraWay{.stops = {Vec3::UnitX(), 3.0 * Vec3::UnitZ()}};
  const auto first_eye = [&](double aspect, double margin, std::size_t count = 4) {
    return tour_cameras(shape_, set, camera_, UpAxis::Y, aspect, count, margin).front().eye;
  };
  EXPECT_LE((first_eye(1.5, 4.0) - camera_.eye(Vec3::UnitX())).norm(), 1e-12);
  EXPECT_THROW(first_eye(0.0, 4.0), InvalidInput);
  EXPECT_THROW(first_eye(std::numeric_limits<double>::infinity(), 4.0), InvalidInput);
  EXPECT_THROW(first_eye(1.5, 50.0), InvalidInput);
  EXPECT_THROW(first_eye(1.5, 4.0, 2), InvalidInput);
  set.way->stops = {Vec3::UnitX(), 3.0 * Vec3::UnitX()};
  EXPECT_THROW(first_eye(1.5, 4.0), InvalidInput);
}

TEST(Directions, OfOtherFunctionsCountByWhereTheyPointToo) {
  const UprightFrame frame = upright_frame(Vec3::UnitY());
  expect_only_where_it_points(
      [&](const Vec3& d) { return along_x(upright_prior().factor(frame, d)); });
  expect_only_where_it_points([&](const Vec3& d) { return upright_frame(d).front; });
  const Vec3 across = kUnit.unitOrthogonal();
  expect_only_where_it_points([&](const Vec3& d) { return upright_frame(d, across).side; });
  expect_only_where_it_points([&](const Vec3& d) { return upright_frame(across, d).side; });
  expect_only_where_it_points(
      [&](const Vec3& d) { return along_x(static_cast<double>(axis_nearest(d))); });
  const std::array planes{MirrorPlane{}};
  expect_only_where_it_points([&](const Vec3& d) { return mirror_images(d, planes, 0.1).back(); });
  expect_only_where_it_points([&](const Vec3& d) {
    return silhouette_disc({Vec3::Zero(), 1.0}, {Projection::Orthographic, d}).towards;
  });
}

}  // namespace
}  // namespace vantage::test
