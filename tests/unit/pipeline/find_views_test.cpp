// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "vantage/mesh/measures.h"
#include "vantage/report/view_report.h"

#include "pipeline/frame_choice.h"
#include "pipeline/preference.h"
#include "pipeline/view_preparation.h"
#include "support/model_of.h"
#include "support/same_picture.h"
#include "support/shapes.h"
#include "support/unrefined.h"
#include "support/worst.h"

namespace vantage::test {
namespace {

const ModelFrame kYUp;

ViewOptions quick_search() {
  ViewOptions options = unrefined();
  options.search.strategy = SearchStrategy::Exhaustive;
  options.search.subdivisions = 2;
  options.objective = Objective::Significance;
  return options;
}

/// A Y of tubes with what is found of it by default. Found once a process.
struct FoundY {
  ViewOptions options = unrefined();
  Model model = model_of(y_of_tubes(0.2, 24));
  ShapeAnalysis shape = analyse_shape(model, options);
  FrameChoice frame = choose_frame(model, shape, options);
  ViewReport report = find_views(shape, frame, options);

  static const FoundY& once() {
    static const FoundY found;
    return found;
  }
};

/// A box of 98 vertices. Analysed once a process.
const ShapeAnalysis& analysed_box() {
  static const ShapeAnalysis shape = analyse_shape(model_of(box(1.0, 2.0, 3.0, 4)), quick_search());
  return shape;
}

ShapeAnalysis without_significance(ShapeAnalysis shape) {
  shape.significance.assign(shape.significance.size(), 0.0);
  return shape;
}

class ReportOfAY : public testing::Test {
 protected:
  ReportOfAY() : options_(quick_search()), shape_(known().first), report_(known().second) {}

  /// Found once a process.
  static const std::pair<ShapeAnalysis, ViewReport>& known() {
    static const auto found = [] {
      const ShapeAnalysis shape = analyse_shape(model_of(y_of_tubes(0.2, 24)), quick_search());
      return std::pair(shape, find_views(shape, kYUp, quick_search()));
    }();
    return found;
  }

  ViewOptions options_;
  ShapeAnalysis shape_;
  ViewReport report_;
};

TEST_F(ReportOfAY, ScoresAreSumsOverTheVisibleVertices) {
  const VertexVisibility visibility(shape_.surface, shape_.sides);
  for (const ReportedView* view : {&report_.best, &report_.worst}) {
    const auto visible = visibility.visible_vertices(report_.camera.viewpoint(view->direction));
    double sum = 0.0;
    for (std::size_t v = 0; v < visible.size(); ++v) {
      sum += visible[v] != 0 ? shape_.significance[v] : 0.0;
    }
    EXPECT_EQ(view->score, sum);
    EXPECT_EQ(view->objective, sum);
    EXPECT_DOUBLE_EQ(view->score_fraction, sum / report_.total);
  }
}

TEST_F(ReportOfAY, UnderAPriorTheObjectiveIsScoreTimesPriorAndTheRestIsPure) {
  options_.prior = upright_prior();
  const ViewReport found = find_views(shape_, kYUp, options_);
  const UprightFrame frame = upright_frame(Vec3::UnitY());
  EXPECT_EQ(found.best.objective,
            found.best.score * upright_prior().factor(frame, found.best.direction));
  for (const SearchStep& step : found.best_search.trace) {
    EXPECT_LE(step.score * upright_prior().factor(frame, step.direction), found.best.objective);
  }
  EXPECT_EQ(found.worst.direction, report_.worst.direction);
  EXPECT_EQ(found.worst.score, report_.worst.score);
  EXPECT_EQ(found.worst.objective, report_.worst.score);
}

TEST_F(ReportOfAY, WhatPeopleTakeIsComparedOnlyForTheBestView) {
  options_.objective = Objective::People;
  const ViewReport found = find_views(shape_, kYUp, options_);
  const Preference preference(shape_, {}, options_, found.total);
  EXPECT_EQ(found.best.objective, preference(found.best.direction, found.best.score));
  for (const SearchStep& step : found.best_search.trace) {
    EXPECT_LE(preference(step.direction, step.score), found.best.objective);
  }
  EXPECT_EQ(found.worst.direction, report_.worst.direction);
  EXPECT_EQ(found.worst.objective, report_.worst.score);
  // The view of the largest score stays known.
  EXPECT_EQ(found.highest_score, report_.best.score);
  EXPECT_EQ(found.highest_direction, report_.best.direction);
  EXPECT_LT(found.best.score, found.highest_score);
}

TEST_F(ReportOfAY, SearchesOfPapersKnowNothingButTheScore) {
  options_.objective = Objective::People;
  for (const SearchStrategy strategy : {SearchStrategy::Rapid, SearchStrategy::Gradient}) {
    options_.search.strategy = strategy;
    const ViewReport found = find_views(shape_, kYUp, options_);
    EXPECT_EQ(found.best.objective, found.best.score);
  }
}

TEST_F(ReportOfAY, TotalIsTheSumOfTheMap) {
  EXPECT_EQ(report_.total,
            std::accumulate(shape_.significance.begin(), shape_.significance.end(), 0.0));
}

TEST_F(ReportOfAY, NoDirectionOfTheSetBeatsTheBestOrUndercutsTheWorst) {
  for (const SearchStep& step : report_.best_search.trace) {
    EXPECT_LE(step.score, report_.best.score);
    EXPECT_GE(step.score, report_.worst.score);
  }
  EXPECT_EQ(report_.best_search.trace.size(), 162U + 1U);  // and the mirror image of the best
}

TEST_F(ReportOfAY, TheEyeStandsWhereTheEnclosingSphereFillsTheView) {
  const double R = 0.5 * shape_.sphere.diameter / std::sin(15.0 * M_PI / 180.0);
  EXPECT_NEAR((report_.best.eye - shape_.sphere.centre).norm(), R, 1e-9 * R);
}

TEST_F(ReportOfAY, ThePictureKeepsTheEyeAndAnUprightUp) {
  EXPECT_EQ(report_.best.picture.eye, report_.best.eye);
  EXPECT_NEAR(report_.best.up.dot(report_.best.direction), 0.0, 1e-12);
  EXPECT_GT(report_.best.up.y(), 0.0);
}

TEST_F(ReportOfAY, APictureShowsTheModelOnTransparentGround) {
  options_.width = 64;
  options_.height = 48;
  const Image image = take_picture(shape_, report_.best.picture, Picture::Map, options_);
  ASSERT_EQ(image.rgba.size(), 4U * 64U * 48U);
  std::size_t covered = 0;
  for (std::size_t i = 3; i < image.rgba.size(); i += 4) {
    covered += image.rgba[i] > 0 ? 1 : 0;
  }
  EXPECT_GT(covered, 64U * 48U / 20U);
  EXPECT_LT(covered, 64U * 48U);
}

/// What is said of a call that a step is missing for; empty if nothing is.
template <class Call>
std::string refusal_of(const Call& call) {
  try {
    call();
  } catch (const InvalidInput& error) {
    return error.what();
  }
  return {};
}

TEST(FindViews, NamesTheStepThatIsMissing) {
  ShapeAnalysis shape = prepare_surface(model_of(box(1.0, 2.0, 3.0, 1)));
  const FrameChoice choice{};
  const std::string words = "the shape has no significance map: call add_map() or ";
  const auto both = [&] { find_views(shape, choice, quick_search()); };
  const auto one = [&] { find_view(shape, Goal::Best, choice, quick_search()); };
  EXPECT_EQ(refusal_of(both).find(words), 0U);
  EXPECT_EQ(refusal_of(one).find(words), 0U);
  add_history(shape, quick_search());
  EXPECT_EQ(refusal_of(both).find(words), 0U);
}

TEST(FindViews, ByAreasNeedNoMap) {
  ViewOptions options = quick_search();
  options.method = "projected-area";
  const ShapeAnalysis shape = prepare_surface(model_of(box(1.0, 2.0, 3.0, 1)));
  EXPECT_GT(find_views(shape, kYUp, options).best.score, 0.0);
}

TEST(DrawPicture, NamesTheStepThatIsMissing) {
  const ShapeAnalysis shape = prepare_surface(model_of(box(1.0, 2.0, 3.0, 1)));
  ViewOptions options;
  options.width = options.height = 16;
  Camera camera;
  camera.eye = Vec3(0.0, 0.0, 9.0);
  const auto draw = [&](Picture picture) {
    return refusal_of([&] { draw_picture(shape, camera, picture, options, {}); });
  };
  EXPECT_EQ(draw(Picture::Plain), "");
  EXPECT_EQ(draw(Picture::Map).find("the shape has no significance map: call add_map() "), 0U);
  EXPECT_EQ(draw(Picture::Skeleton).find("the shape has no skeleton: call add_skeleton() "), 0U);
}

TEST(FindViews, CertifiesTheViewThatIsReportedWhereTiesWereSettled) {
  // Mirror images see as much; the prior is larger at the back by less than a tie, so that the front
  // is shown, and what is certified must be the front's objective.
  ViewOptions options = quick_search();
  options.certify = true;
  options.prior = parse_prior(
      R"({"vantage_prior": 1, "lobes": [{"direction": [0, 0, -1], "weight": 0.006, "width_deg": 60}]})",
      "back.json");
  const ShapeAnalysis shape = analyse_shape(model_of(box(1.0, 2.0, 3.0, 6)), options);
  const ViewReport report = find_views(shape, kYUp, options);
  const UprightFrame frame = upright_frame(Vec3::UnitY());
  ASSERT_GT(frame.front.dot(report.best.direction), 0.1);
  options.search.strategy = SearchStrategy::Dense;
  double highest = 0.0;
  for (const SearchStep& step : find_views(shape, kYUp, options).best_search.trace) {
    highest = larger(highest, step.score * options.prior.factor(frame, step.direction));
  }
  ASSERT_TRUE(report.dense_gap.has_value());
  EXPECT_NEAR(report.dense_gap->best_ratio, report.best.objective / highest, 1e-12);
  EXPECT_TRUE(std::any_of(report.twins.begin(), report.twins.end(), [&](const TwinView& twin) {
    return twin.objective > 1.004 * report.best.objective;
  }));
}

/// The notes of a box whose front, z, and back are said to differ.
std::vector<std::string> notes_seen_from(bool is_front, const DirectionChoice& front) {
  ViewOptions options = quick_search();
  options.objective = Objective::People;
  FrameChoice choice;
  choice.orientation.up.direction = Vec3::UnitY();
  choice.orientation.front = front;
  choice.orientation.front_odds = {is_front ? 1.0 : 0.0, 0.0, is_front ? 0.0 : 1.0, 0.0};
  choice.notes = {"a note on up"};
  if (const std::string note = note_on_front(choice, options); !note.empty()) {
    choice.notes.push_back(note);
  }
  const ViewReport report = find_views(analysed_box(), choice, options);
  EXPECT_TRUE(report.proportions.mirrors_front);
  return report.warnings;
}

std::size_t count_of(std::string_view part, const std::vector<std::string>& notes) {
  return static_cast<std::size_t>(
      std::count_if(notes.begin(), notes.end(),
                    [&](const std::string& note) { return note.find(part) != std::string::npos; }));
}

TEST(FindViews, SaysWhereTheBestViewIsFromBehind) {
  DirectionChoice front{.direction = Vec3::UnitZ(),
                        .source = "format",
                        .confidence = 0.62,
                        .likeliest = Vec3::UnitZ()};
  EXPECT_EQ(notes_seen_from(true, front), std::vector<std::string>{"a note on up"});
  const std::vector<std::string> behind = notes_seen_from(false, front);
  ASSERT_EQ(behind.size(), 2U);
  EXPECT_TRUE(
      behind.back().starts_with("the best view is from behind, if the front is z (62 % sure)"));
  front.alike = {-Vec3::UnitZ()};
  EXPECT_EQ(count_of("behind", notes_seen_from(false, front)), 0U);
}

TEST(FindViews, SaysOneThingOfAFrontThatIsUnsure) {
  DirectionChoice front{.direction = Vec3::UnitZ(),
                        .source = "format",
                        .confidence = 0.3,
                        .likeliest = Vec3::UnitZ()};
  for (const char* source : {"format", "shape"}) {
    front.source = source;
    EXPECT_EQ(count_of("front", notes_seen_from(true, front)), 1U);
    const std::vector<std::string> behind = notes_seen_from(false, front);
    EXPECT_EQ(count_of("front", behind), 1U);
    EXPECT_TRUE(behind.back().starts_with("front is unsure: z is taken")) << behind.back();
    // The odds have the back likelier than z.
    EXPECT_EQ(count_of("from behind", behind), 0U) << behind.back();
    EXPECT_EQ(count_of("weighs all sides", behind), 1U) << behind.back();
    DirectionChoice aside = front;
    aside.likeliest = Vec3::UnitX();
    aside.likeliest_confidence = 0.4;
    const std::vector<std::string> from_aside = notes_seen_from(false, aside);
    EXPECT_EQ(count_of("front", from_aside), 1U);
    EXPECT_EQ(count_of("sides, and is from the side that the shape suggests", from_aside), 1U);
  }
}

/// Four octahedra around an opening: each touches the next in one vertex.
TriMesh ring_of_octahedra() {
  TriMesh one;
  for (const double end : {1.0, -1.0}) {
    for (const Vec3& axis : {Vec3(Vec3::UnitX()), Vec3(Vec3::UnitY()), Vec3(Vec3::UnitZ())}) {
      one.positions.push_back(end * axis);
    }
  }
  one.triangles = {{0, 1, 2}, {1, 3, 2}, {3, 4, 2}, {4, 0, 2},
                   {1, 0, 5}, {3, 1, 5}, {4, 3, 5}, {0, 4, 5}};
  TriMesh ring;
  for (const Vec3& centre : {Vec3(1, 1, 0), Vec3(-1, 1, 0), Vec3(-1, -1, 0), Vec3(1, -1, 0)}) {
    ring = together(ring, one, centre);
  }
  return ring;
}

TEST(FindViews, SaysWhyASkeletonHasMoreCyclesThanTheGenus) {
  const ViewOptions options = quick_search();
  const ShapeAnalysis shape = analyse_shape(model_of(ring_of_octahedra()), options);
  EXPECT_EQ(shape.check.genus, 0U);
  EXPECT_EQ(cycle_count(shape.skeleton.graph), 1U);
  EXPECT_EQ(count_of("sheets touch at 4 vertices", find_views(shape, kYUp, options).warnings), 1U);
}

/// A box with this share of its significance inside the bottom, the rest everywhere.
ShapeAnalysis with_significance_below(double share) {
  ShapeAnalysis shape = analysed_box();
  const std::vector<Vec3>& at = shape.surface.positions;
  const auto is_below = [](const Vec3& p) {
    return p.y() == 0.0 && p.x() > 0.0 && p.x() < 1.0 && p.z() > 0.0 && p.z() < 3.0;
  };
  const auto below = static_cast<double>(std::count_if(at.begin(), at.end(), is_below));
  for (std::size_t v = 0; v < at.size(); ++v) {
    shape.significance[v] =
        (1.0 - share) / static_cast<double>(at.size()) + (is_below(at[v]) ? share / below : 0.0);
  }
  return shape;
}

bool says(const std::vector<std::string>& warnings, std::string_view text) {
  return std::any_of(warnings.begin(), warnings.end(), [&](const std::string& warning) {
    return warning.find(text) != std::string::npos;
  });
}

TEST(FindViews, FollowsTheHabitUnlessItShowsNextToNothing) {
  ViewOptions options = quick_search();
  options.objective = Objective::People;
  const ViewReport usual = find_views(with_significance_below(0.2), kYUp, options);
  EXPECT_GT(usual.best.direction.y(), 0.2);
  EXPECT_FALSE(says(usual.reliability_warnings, "of what another shows"));
  const ViewReport little = find_views(with_significance_below(0.5), kYUp, options);
  EXPECT_GT(little.best.direction.y(), 0.0);
  EXPECT_TRUE(says(little.reliability_warnings, "of what another shows"));
  const ViewReport hardly_any = find_views(with_significance_below(0.8), kYUp, options);
  EXPECT_LT(hardly_any.best.direction.y(), 0.0);
  EXPECT_GT(hardly_any.score_of_attainable.value_or(0.0), 0.9);
}

TEST(FindViews, SaysWhereMostIsHiddenFromEverywhere) {
  const ViewReport open = find_views(analysed_box(), kYUp, quick_search());
  EXPECT_FALSE(says(open.warnings, "no view shows more than"));
  const TriMesh boxes = together(box(3.0, 3.0, 3.0, 2), box(1.0, 1.0, 1.0, 2), Vec3::Ones());
  ShapeAnalysis nested = analyse_shape(model_of(boxes), quick_search());
  for (std::size_t v = 0; v < nested.significance.size(); ++v) {
    nested.significance[v] =
        (nested.surface.positions[v].array() - 1.5).abs().maxCoeff() < 1.0 ? 1.0 : 0.01;
  }
  const ViewReport hidden = find_views(nested, kYUp, quick_search());
  EXPECT_TRUE(says(hidden.warnings, "no view shows more than"));
}

TEST(FindViews, OfAMapThatIsZeroGivesTheFirstDirectionAndAWarning) {
  const ViewOptions options = quick_search();
  const ViewReport report = find_views(without_significance(analysed_box()), kYUp, options);
  const Vec3 first =
      direction_set(ViewSphereBase::Icosahedron, options.search.subdivisions).directions.front();
  EXPECT_EQ(report.best.direction, first);
  EXPECT_EQ(report.worst.direction, first);
  EXPECT_EQ(report.best.score_fraction, 0.0);
  ASSERT_EQ(report.reliability_warnings.size(), 1U);
  EXPECT_NE(report.reliability_warnings.front().find("zero everywhere"), std::string::npos);
}

TEST(FindViews, OfAMapThatIsZeroTakesWhatPeopleChooseAndTheFirstForTheWorst) {
  ViewOptions options = quick_search();
  options.objective = Objective::People;
  const Vec3 with_map = find_views(analysed_box(), kYUp, options).best.direction;
  const ViewReport report = find_views(without_significance(analysed_box()), kYUp, options);
  const Vec3 first =
      direction_set(ViewSphereBase::Icosahedron, options.search.subdivisions).directions.front();
  EXPECT_EQ(report.worst.direction, first);
  EXPECT_GT(report.best.direction.dot(with_map), 0.9) << "proportions decide as before";
  EXPECT_EQ(report.best.score_fraction, 0.0);
}

TEST(FindViews, CountsAndTracesTheSearchForTheHighestScore) {
  const ViewReport& report = FoundY::once().report;
  const std::vector<SearchStep>& trace = report.best_search.trace;
  EXPECT_EQ(report.best_search.evaluations, trace.size());
  double largest = 0.0;
  for (const SearchStep& step : trace) {
    largest = larger(largest, step.score);
  }
  EXPECT_EQ(largest, report.highest_score);
}

TEST(FindViews, TracesTheMirrorImageThatItTakesForTheBest) {
  ViewOptions options = quick_search();
  options.objective = Objective::People;
  for (const UpAxis front : {UpAxis::X, UpAxis::MinusX}) {  // from one the search's own is taken
    const ModelFrame frame{UpAxis::Y, front};
    const ViewReport report = find_views(analysed_box(), frame, options);
    ASSERT_FALSE(report.twins.empty());
    std::vector<SearchStep> scored = report.best_search.trace;
    EXPECT_EQ(report.best_search.evaluations, scored.size());
    scored.insert(scored.end(), report.worst_search.trace.begin(), report.worst_search.trace.end());
    const auto times = [&](const Vec3& direction) {
      return std::count_if(scored.begin(), scored.end(),
                           [&](const SearchStep& step) { return step.direction == direction; });
    };
    EXPECT_EQ(times(report.best.direction), 1);
    for (const TwinView& twin : report.twins) {
      EXPECT_EQ(times(twin.direction), 1);
    }
  }
}

TEST(FindViews, FindsTheSameWhereNothingWasPrepared) {
  const auto& [options, model, shape, frame, report] = FoundY::once();
  ASSERT_NE(shape.views, nullptr);
  ShapeAnalysis bare = shape;
  for (const auto& prepared :
       {std::shared_ptr<const ViewPreparation>(), std::make_shared<const ViewPreparation>(shape)}) {
    bare.views = prepared;
    const FrameChoice again = choose_frame(model, bare, options);
    EXPECT_EQ(again.frame.up, frame.frame.up);
    EXPECT_EQ(again.frame.front, frame.frame.front);
    EXPECT_EQ(view_json(model, bare, find_views(bare, frame, options), options),
              view_json(model, shape, report, options));
  }
}

TEST(AnalyseShape, MakesCoarseCopiesForSearchesThatEstimateAlone) {
  EXPECT_NE(FoundY::once().shape.views->copies, nullptr);
  EXPECT_EQ(analysed_box().views->copies, nullptr);
  const ViewOptions by_area = unrefined({.method = "projected-area"});
  EXPECT_EQ(analyse_shape(model_of(box(1.0, 2.0, 3.0, 4)), by_area).views->copies, nullptr);
}

TEST(FindView, IsTheOneThatBothAreFoundWith) {
  const FoundY& both = FoundY::once();
  for (const Goal goal : {Goal::Best, Goal::Worst}) {
    const ReportedView& expected = goal == Goal::Best ? both.report.best : both.report.worst;
    const ReportedView found = find_view(both.shape, goal, both.frame, both.options);
    EXPECT_EQ(found.direction, expected.direction);
    EXPECT_EQ(found.score, expected.score);
    EXPECT_EQ(found.objective, expected.objective);
    expect_same_picture(found, expected);
  }
}

TEST(FindView, RefusesWhatSumsNoMap) {
  ViewOptions by_area = quick_search();
  by_area.method = "projected-area";
  EXPECT_THROW((void)find_view(analysed_box(), Goal::Best, FoundY::once().frame, by_area),
               InvalidInput);
}

TEST(FindPictureView, IsTheBestView) {
  const FoundY& found = FoundY::once();
  const auto view = find_picture_view(found.model, prepare_surface(found.model), found.options);
  EXPECT_EQ(view.view.direction, found.report.best.direction);
  EXPECT_EQ(view.vertices, found.shape.surface.positions.size());
}

TEST(FindPictureView, LooksAtTheSideThatWasScanned) {
  const TriMesh scan = y_of_tubes(0.25, 20);
  for (const Vec3& side : {Vec3(-Vec3::UnitZ()), Vec3(Vec3::UnitX())}) {
    TriMesh half = scan;
    std::erase_if(half.triangles, [&](const Triangle& face) {
      const Vec3 normal = area_vector(half, face);
      return !(normal.dot(side) > 0.15 * normal.norm());
    });
    const Model model = model_of(half);
    const PictureView found = find_picture_view(model, prepare_surface(model), unrefined());
    EXPECT_GT(found.view.direction.dot(side), 0.3) << side.transpose();
  }
}

TEST(FindViews, SeesAsMuchOfAnInsideOutModel) {
  const ViewOptions options = quick_search();
  const TriMesh mesh = y_of_tubes(0.25, 20);
  const ShapeAnalysis right = analyse_shape(model_of(mesh), options);
  const ShapeAnalysis turned = analyse_shape(model_of(inside_out(mesh)), options);
  EXPECT_NEAR(find_views(right, kYUp, options).best.score_fraction,
              find_views(turned, kYUp, options).best.score_fraction, 1e-9);
}

}  // namespace
}  // namespace vantage::test
