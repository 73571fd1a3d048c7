// SPDX-License-Identifier: MIT
#include "vantage/pipeline/measured_shape.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "vantage/pipeline/find_views.h"

#include "support/model_of.h"
#include "support/shapes.h"

namespace vantage::test {
namespace {

/// How much of the box 1 × 2 × 3 an eye sees, moved by a constant.
Measure moved_area(Better better, double by) {
  return {.name = "moved",
          .meaning = "the area seen and a constant",
          .source = "this test",
          .better = better,
          .needs = {.faces = true},
          .value = [by](const MeasuredModel&, const SightTable& sight) {
            return sight.projected_area + by;
          }};
}

MeasuredViews extremes(const Measure& measure, int level = 3) {
  const Model model = model_of(box(1.0, 2.0, 3.0, 2));
  const std::vector<Measure> measures{measure};
  const ShapeAnalysis shape = analyse_for(model, {}, measures);
  ViewMeasurer measurer(measure_subject(shape, {}), measures, level);
  return extreme_views(measurer, 0);
}

TEST(ExtremeViews, AreTheSameWhereverTheMeasureHasItsZero) {
  const MeasuredViews plain = extremes(moved_area(Better::More, 0.0));
  EXPECT_GT(plain.best.value, 1.5 * plain.worst.value);
  const MeasuredViews negative = extremes(moved_area(Better::More, -100.0));
  EXPECT_NEAR(negative.best.value + 100.0, plain.best.value, 1e-3 * plain.best.value);
  EXPECT_NEAR(negative.worst.value + 100.0, plain.worst.value, 1e-3 * plain.best.value);
  const MeasuredViews falling = extremes(moved_area(Better::Less, -100.0));
  EXPECT_NEAR(falling.worst.value + 100.0, plain.best.value, 1e-3 * plain.best.value);
  EXPECT_NEAR(falling.best.value + 100.0, plain.worst.value, 1e-3 * plain.best.value);
}

TEST(FindViews, SayWhatShareOfTheBestScoreTheViewHasWhereLessIsBetterToo) {
  const Model model = model_of(y_of_tubes(0.25, 16));
  for (const char* const name : {"projected-area", "instability"}) {
    ViewOptions options;
    options.method = name;
    const ShapeAnalysis shape = analyse_shape(model, options);
    const ViewReport report = find_views(shape, UpAxis::Y, options);
    const double own = report.best.score;
    const double best = report.highest_score;
    const bool is_less = find_measure(name).better == Better::Less;
    EXPECT_TRUE(is_less ? best <= own : best >= own) << name;
    ASSERT_TRUE(report.score_of_attainable.has_value()) << name;
    EXPECT_LE(*report.score_of_attainable, 1.0) << name;
    EXPECT_NEAR(*report.score_of_attainable, is_less ? best / own : own / best, 1e-12) << name;
  }
}

TEST(ExtremeViews, AreFoundFromACoarserSetToo) {
  const MeasuredViews coarse = extremes(find_measure("projected-area"), 2);
  const MeasuredViews usual = extremes(find_measure("projected-area"));
  EXPECT_NEAR(coarse.best.value, usual.best.value, 1e-3 * usual.best.value);
}

}  // namespace
}  // namespace vantage::test
