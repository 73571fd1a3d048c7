// SPDX-License-Identifier: MIT
#include <array>
#include <utility>

#include <gtest/gtest.h>

#include "vantage/pipeline/find_views.h"

#include "support/model_of.h"
#include "support/shapes.h"

namespace vantage::test {
namespace {

TEST(FindViews, OfFewVerticesFindsWhatTheDenseSearchFinds) {
  // Each vertex that comes into view is a step of the score: peaks and pits are narrow.
  const std::array shapes{
      together(box(1.0, 2.0, 3.0, 1), torus(1.0, 0.3, 7, 5), Vec3(0.4, 0.3, 0.2)),
      wall_with_window(), y_of_tubes(0.25, 8),
      together(sphere(1), box(0.5, 3.0, 0.7, 2), Vec3(0.9, -1.0, 0.4))};
  for (const TriMesh& shape : shapes) {
    ViewOptions options;
    options.prior = {};
    options.objective = Objective::Significance;
    options.certify = true;
    const ViewReport report =
        find_views(analyse_shape(model_of(shape), options), ModelFrame(UpAxis::Y), options);
    ASSERT_TRUE(report.dense_gap.has_value());
    EXPECT_GE(report.dense_gap->best_ratio, 0.999) << shape.positions.size();
    EXPECT_LE(report.dense_gap->worst_above, 0.005) << shape.positions.size();
  }
}

TEST(FindViews, ShowsALyingSignFromTheFrontThatWasGiven) {
  TriMesh sign = box(40.0, 20.0, 2.0, 2);  // the letters L and F on it, read from -y
  sign = together(sign, box(3.0, 14.0, 2.0, 1), Vec3(5.0, 3.0, 2.0));
  sign = together(sign, box(7.0, 3.0, 2.0, 1), Vec3(8.0, 3.0, 2.0));
  sign = together(sign, box(3.0, 14.0, 2.0, 1), Vec3(20.0, 3.0, 2.0));
  sign = together(sign, box(9.0, 3.0, 2.0, 1), Vec3(23.0, 14.0, 2.0));
  sign = together(sign, box(6.0, 3.0, 2.0, 1), Vec3(23.0, 8.5, 2.0));
  const Model model = model_of(sign);
  ViewOptions options;
  options.up = UpAxis::Z;
  const ShapeAnalysis shape = analyse_shape(model, options);
  for (const auto& [front, side] : {std::pair(UpAxis::Y, 1.0), std::pair(UpAxis::MinusY, -1.0)}) {
    options.front = front;
    const ViewReport report = find_views(shape, choose_frame(model, shape, options), options);
    EXPECT_GT(side * report.best.direction.y(), 0.2);
  }
}

}  // namespace
}  // namespace vantage::test
