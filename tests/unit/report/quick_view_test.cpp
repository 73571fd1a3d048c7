// SPDX-License-Identifier: MIT
#include "vantage/report/quick_view.h"

#include <cmath>

#include <gtest/gtest.h>

#include "vantage/core/error.h"

#include "support/shapes.h"
#include "unit/report/model_of.h"

namespace vantage::test {
namespace {

/// Three unequal tubes, large enough to be made coarser.
TriMesh branches() {
  TriMesh mesh = y_of_tubes(0.2, 96);
  for (Vec3& p : mesh.positions) {
    p.y() *= 1.5;
    p.x() += 0.3 * p.y() * p.y();
  }
  return mesh;
}

QuickView quick_view_of(const Model& model, const ViewOptions& options = {}, int threads = 0) {
  RunContext run;
  run.max_threads = threads;
  return find_quick_view(model, prepare_surface(model), options, run);
}

TEST(QuickView, OfALargeShapeScoresNearlyAsMuchAsTheBest) {
  const Model model = model_of(branches());
  const ViewOptions options;
  const QuickView quick = quick_view_of(model, options);
  ASSERT_GT(model.mesh.positions.size(), 2 * quick.vertices) << "the shape must be made coarser";
  const ShapeAnalysis shape = analyse_shape(model, options);
  const ViewReport report = find_views(shape, quick.up, options);
  const VertexVisibility visibility(shape.surface, shape.sides);
  const ReportedView seen =
      describe_view(shape, visibility, report.camera, quick.direction, quick.up.axis, options);
  const UprightFrame frame = upright_frame(up_vector(quick.up.axis));
  EXPECT_GT(seen.score * options.prior.factor(frame, quick.direction),
            0.97 * report.best.objective);
}

TEST(QuickView, IsTheSameForAnyNumberOfThreads) {
  const Model model = model_of(branches());
  const QuickView one = quick_view_of(model, {}, 1);
  for (const int threads : {2, 3}) {
    EXPECT_EQ(quick_view_of(model, {}, threads).direction, one.direction);
  }
}

TEST(QuickView, DoesNotDependOnTheUnitOfLength) {
  const TriMesh mesh = branches();
  const Vec3 direction = quick_view_of(model_of(mesh)).direction;
  // Powers of two, which never round: the grid of the shape is full of ties.
  for (const double scale : {0x1p27, 0x1p-27}) {
    const Model scaled = model_of(moved(mesh, scale, 0.0, Vec3::UnitX(), Vec3::Zero()));
    EXPECT_LT((quick_view_of(scaled).direction - direction).norm(), 1e-9) << scale;
  }
}

TEST(QuickView, ItsPictureHoldsEveryPoint) {
  const Model model = model_of(branches());
  const QuickView quick = quick_view_of(model);
  const Vec3 sight = (quick.picture.target - quick.picture.eye).normalized();
  const double half = std::tan(quick.picture.fov_y_deg * std::acos(-1.0) / 360.0);
  const Vec3 up = quick.picture.up;
  double highest = 0.0;
  for (const Vec3& p : model.mesh.positions) {
    const Vec3 offset = p - quick.picture.eye;
    highest = std::max(highest, std::abs(offset.dot(up)) / offset.dot(sight));
  }
  EXPECT_LE(highest, half * (1.0 - 2 * 0.04) * (1.0 + 1e-9));
}

TEST(QuickView, AShapeWithoutSignificanceIsSeenAsThePriorLikes) {
  ViewOptions options;
  options.up = UpAxis::Y;
  const QuickView quick = quick_view_of(model_of(sphere(4)), options);
  EXPECT_GT(quick.direction.y(), 0.0);
  EXPECT_LT(quick.direction.y(), 0.7);
}

TEST(QuickView, OfACloudOfPoints) {
  Model model = model_of(branches());
  model.mesh.triangles.clear();
  const QuickView quick = quick_view_of(model);
  EXPECT_NEAR(quick.direction.norm(), 1.0, 1e-12);
}

TEST(QuickView, StopsWhenAskedTo) {
  const Model model = model_of(branches());
  std::stop_source source;
  source.request_stop();
  RunContext run;
  run.stop = source.get_token();
  EXPECT_THROW(find_quick_view(model, prepare_surface(model), {}, run), Cancelled);
}

}  // namespace
}  // namespace vantage::test
