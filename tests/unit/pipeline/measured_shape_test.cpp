// SPDX-License-Identifier: MIT
#include "vantage/pipeline/measured_shape.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>

#include "vantage/core/error.h"
#include "vantage/pipeline/find_views.h"

#include "pipeline/view_preparation.h"
#include "support/model_of.h"
#include "support/shapes.h"
#include "support/unrefined.h"

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
  const ShapeAnalysis shape = analyse_for(model, unrefined(), measures);
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
  const Model model = model_of(y_of_tubes(0.25, 10));
  for (const char* const name : {"projected-area", "instability"}) {
    const ViewOptions options = unrefined({.method = name});
    const ShapeAnalysis shape = analyse_shape(model, options);
    const ViewReport report = find_views(shape, ModelFrame(UpAxis::Y), options);
    const double own = report.best.score;
    const double best = report.highest_score;
    const bool is_less = find_measure(name).better == Better::Less;
    EXPECT_TRUE(is_less ? best <= own : best >= own) << name;
    ASSERT_TRUE(report.score_of_attainable.has_value()) << name;
    EXPECT_LE(*report.score_of_attainable, 1.0) << name;
    EXPECT_NEAR(*report.score_of_attainable, is_less ? best / own : own / best, 1e-12) << name;
  }
}

TEST(ExtremeViews, OfACountAreLookedForByEstimatesWhereTheSetIsKnownToo) {
  const Model model = model_of(y_of_tubes(0.25, 10));
  const std::vector<Measure> measures{find_measure("visible-triangles")};
  const ShapeAnalysis shape = analyse_for(model, unrefined(), measures);
  ViewMeasurer estimated(measure_subject(shape, {}), measures);
  const MeasuredViews by_estimates = extreme_views(estimated, 0);
  ViewMeasurer known(measure_subject(shape, {}), measures);
  const std::vector<double> of_set = known.set_values()[0];
  const MeasuredViews of_known = extreme_views(known, 0);
  EXPECT_LE(of_known.evaluations - of_set.size(), 2 * by_estimates.evaluations);
  EXPECT_GE(of_known.best.value, 0.999 * by_estimates.best.value);
  EXPECT_LE(of_known.worst.value, 1.001 * by_estimates.worst.value);
  EXPECT_GE(of_known.best.value, 0.999 * *std::max_element(of_set.begin(), of_set.end()));
}

TEST(ExtremeViews, AreOfAMeasureThatIsThere) {
  const Model model = model_of(box(1.0, 2.0, 3.0, 1));
  const std::vector<Measure> measures{moved_area(Better::More, 0.0)};
  const ShapeAnalysis shape = analyse_for(model, unrefined(), measures);
  ViewMeasurer measurer(measure_subject(shape, {}), measures, 0);
  EXPECT_THROW(extreme_views(measurer, 5), InvalidInput);
  EXPECT_THROW(best_view(measurer, 1), InvalidInput);
  const std::vector<Vec3> above{Vec3::UnitZ()};
  EXPECT_THROW((void)measurer.values_of(1, above), InvalidInput);
  EXPECT_THROW(measurer.kept_values_of(1, above), InvalidInput);
  EXPECT_THROW((void)measurer.estimates_of(1, above), InvalidInput);
  EXPECT_THROW((void)measurer.has_estimates(1), InvalidInput);
  EXPECT_THROW((void)measurer.survey_of(1), InvalidInput);
}

TEST(ExtremeViews, AreNotOfWhatIsNoNumber) {
  EXPECT_THROW(extremes(moved_area(Better::More, std::numeric_limits<double>::quiet_NaN()), 0),
               InvalidInput);
}

TEST(ExtremeViews, AreFoundFromACoarserSetToo) {
  const MeasuredViews coarse = extremes(find_measure("projected-area"), 2);
  const MeasuredViews usual = extremes(find_measure("projected-area"));
  EXPECT_NEAR(coarse.best.value, usual.best.value, 1e-3 * usual.best.value);
}

TEST(ExtremeViews, TellTheirProgressUpToOne) {
  const Model model = model_of(box(1.0, 2.0, 3.0, 2));
  const std::vector<Measure> measures{find_measure("silhouette-length")};
  const ShapeAnalysis shape = analyse_for(model, unrefined(), measures);
  std::size_t told = 0;
  double last = 0.0;
  const RunContext run{.report = [&](std::string_view, double fraction) {
    EXPECT_GE(fraction, last);
    last = fraction;
    ++told;
  }};
  ViewMeasurer measurer(measure_subject(shape, {}), measures, 2);
  extreme_views(measurer, 0, {}, run);
  EXPECT_EQ(last, 1.0);
  EXPECT_GT(told, 10U);
  ViewMeasurer again(measure_subject(shape, {}), measures, 2);
  last = 0.0;
  best_view(again, 0, run);
  EXPECT_EQ(last, 1.0);
}

/// find_views() of the box 1 × 2 × 3 by the area seen of each face.
ViewReport views_of_a_box(ViewOptions options) {
  options.method = "viewpoint-entropy";
  options.search.subdivisions = 2;
  const std::vector<Measure> measures{find_measure(options.method)};
  const ShapeAnalysis shape = analyse_for(model_of(box(1.0, 2.0, 3.0, 2)), options, measures);
  return find_views(shape, ModelFrame(UpAxis::Y), options);
}

TEST(FindViewsByAMeasure, TakesOfMirrorImagesTheOneTowardTheFront) {
  const ViewReport report = views_of_a_box({});
  ASSERT_EQ(report.twins.size(), 7U);
  const UprightFrame frame = upright_frame(Vec3::UnitY());
  EXPECT_GT(frame.front.dot(report.best.direction), 0.0);
  EXPECT_GT(frame.side.dot(report.best.direction), 0.0);
  for (const TwinView& twin : report.twins) {
    EXPECT_NEAR(twin.score, report.best.score, 0.02 * report.best.score);
  }
}

TEST(FindViewsByAMeasure, SaysHowFarItIsFromTheDenseSearch) {
  const ViewReport report = views_of_a_box({.certify = true});
  ASSERT_TRUE(report.dense_gap.has_value());
  EXPECT_GT(report.dense_gap->evaluations, 10'000U);
  EXPECT_GT(report.dense_gap->best_ratio, 0.99);
  EXPECT_LT(report.dense_gap->best_ratio, 1.01);
}

TEST(RequireMemory, CountsTheViewsThatMeasuresOfASetCompare) {
  const std::vector<Measure> alone{find_measure("viewpoint-entropy")};
  const std::vector<Measure> of_set{find_measure("viewpoint-entropy"), find_measure("vmi")};
  constexpr std::size_t kFaces = 1'000'000;
  constexpr std::uint64_t kGigabyte = 1'000'000'000;
  EXPECT_NO_THROW(require_memory(alone, 1000 * kFaces, kGigabyte));
  EXPECT_NO_THROW(require_memory(of_set, kFaces, 6 * kGigabyte));
  EXPECT_THROW(require_memory(of_set, kFaces, 5 * kGigabyte), InvalidInput);
}

TEST(AnalyseShape, KeepsTheTermsOfASetForTheMapAndTheSearch) {
  const Model model = model_of(box(1.0, 2.0, 3.0, 2));
  ViewOptions options = unrefined({.method = "pmi-saliency"});
  const ShapeAnalysis shape = analyse_shape(model, options);
  const MeasureSubject subject = measure_subject(shape, options);
  ASSERT_NE(subject.terms_of_set, nullptr);
  ShapeAnalysis bare = shape;
  bare.views.reset();
  EXPECT_EQ(shape.significance, vertex_map(bare, options, "pmi-saliency"));
  options.method = "instability";
  EXPECT_EQ(measure_subject(analyse_shape(model, options), options).terms_of_set, nullptr);
}

TEST(FindViewsByAMeasure, RefusesAnObjectThatItCannotLookAtAlone) {
  Model model = model_of(together(box(1.0, 1.0, 1.0, 2), box(0.5, 1.0, 1.0, 2), {3.0, 0.0, 0.0}));
  model.parts = {{"left", 0, 48}, {"right", 48, 48}};
  const ViewOptions options = unrefined({.method = "viewpoint-entropy", .focus = "right"});
  const std::vector<Measure> areas{find_measure("viewpoint-entropy")};
  EXPECT_THROW((void)analyse_for(model, options, areas), InvalidInput);
  const std::vector<Measure> with_map{find_measure("viewpoint-entropy"), find_measure("kssm")};
  EXPECT_NO_THROW((void)analyse_for(model, options, with_map));
}

TEST(FindViewsByAMeasure, DoNotHangOnTheUnit) {
  ViewOptions options;
  options.method = "vmi";
  options.search.subdivisions = 1;
  const std::vector<Measure> measures{find_measure("vmi")};
  std::vector<ViewReport> found;
  for (const double scale : {1.0, 0x1p70, 0x1p-70}) {
    const Model model =
        model_of(moved(y_of_tubes(0.2, 10), scale, 0.0, Vec3::UnitX(), Vec3::Zero()));
    found.push_back(
        find_views(analyse_for(model, options, measures), ModelFrame(UpAxis::Y), options));
  }
  for (const ViewReport& report : found) {
    EXPECT_NEAR(report.best.score, found[0].best.score, 1e-6 * found[0].best.score);
    EXPECT_NEAR(report.worst.score, found[0].worst.score, 1e-6 * found[0].worst.score);
  }
}

}  // namespace
}  // namespace vantage::test
