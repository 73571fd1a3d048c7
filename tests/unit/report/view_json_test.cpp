// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "vantage/report/view_report.h"

#include "core/json_text.h"
#include "support/model_of.h"
#include "support/shapes.h"

namespace vantage::test {
namespace {

using json = OrderedJson;

std::string report_text(const Model& model, const StageSeconds* seconds = nullptr) {
  ViewOptions options = preset_options(Preset::Paper);
  const ShapeAnalysis shape = analyse_shape(model, options);
  return view_json(model, shape, find_views(shape, ModelFrame(UpAxis::Y), options), options,
                   seconds);
}

TEST(ViewJson, HasNoNumberThatIsNotFinite) {
  for (const TriMesh& mesh : {sheet(1.0, 1.0, 4), sphere(1), y_of_tubes(0.3, 12)}) {
    const std::string text = report_text(model_of(mesh));
    EXPECT_FALSE(parsed_json(text).is_discarded());  // which takes neither nan nor inf as a number
    for (const char* word : {"\"nan\"", "\"-nan\"", "\"inf\"", "\"-inf\""}) {
      EXPECT_EQ(text.find(word), std::string::npos);
    }
  }
}

TEST(ViewJson, GivesNoShareOfATotalThatAMeasureDoesNotHave) {
  const Model model = model_of(box(1.0, 2.0, 3.0, 2));
  const ViewOptions options{.method = "viewpoint-entropy"};
  const ShapeAnalysis shape = analyse_shape(model, options);
  const json report = parsed_json(
      view_json(model, shape, find_views(shape, ModelFrame(UpAxis::Y), options), options, nullptr));
  EXPECT_TRUE(report["best"]["score_fraction"].is_null());
  ASSERT_FALSE(report["twins"].empty());
  for (const json& twin : report["twins"]) {
    EXPECT_GT(twin["score"].get<double>(), 0.0);
    EXPECT_TRUE(twin["score_fraction"].is_null());
  }
}

TEST(ViewJson, GenusIsNullForAnOpenSurface) {
  const json report = parsed_json(report_text(model_of(sheet(1.0, 1.0, 4))));
  EXPECT_TRUE(report["model"]["genus"].is_null());
  EXPECT_FALSE(report["model"]["closed"].get<bool>());
}

TEST(ViewJson, HoldsSecondsOnlyWhenAsked) {
  const Model model = model_of(sphere(1));
  StageSeconds seconds;
  seconds.total = 2.5;
  EXPECT_FALSE(parsed_json(report_text(model)).contains("seconds"));
  EXPECT_EQ(parsed_json(report_text(model, &seconds))["seconds"]["total"], 2.5);
}

TEST(ViewJson, NameThatIsNoUtf8StaysValidJson) {
  Model model = model_of(sphere(1));
  model.name = "br\xFFken";
  EXPECT_FALSE(parsed_json(report_text(model)).is_discarded());
}

TEST(ViewJson, NamesAStrategyForEachComponent) {
  const json report =
      parsed_json(report_text(model_of(together(sphere(1), sphere(1), Vec3(3.0, 0.0, 0.0)))));
  EXPECT_EQ(report["model"]["components"], 2);
  EXPECT_EQ(report["contraction"]["strategy"], json({"exact", "exact"}));
}

}  // namespace
}  // namespace vantage::test
