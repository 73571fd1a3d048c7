// SPDX-License-Identifier: MIT
#include <algorithm>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "vantage/io/model.h"
#include "vantage/report/view_report.h"

#include "core/json_text.h"
#include "report/asset_part.h"
#include "support/model_of.h"
#include "support/shapes.h"

namespace vantage::test {
namespace {

using json = OrderedJson;

/// What the page of a result has in its data block.
json page_data(const Model& model, const ShapeAnalysis& shape, const ViewReport& report,
               const ViewOptions& options) {
  ShapePictures pictures(shape);
  const std::string page = report_html(model, shape, pictures, report, options);
  const std::string mark = R"(<script type="application/json" id="data">)";
  const std::size_t begin = page.find(mark) + mark.size();
  return parsed_json(page.substr(begin, page.find("</script>", begin) - begin));
}

/// A result whose map is a few spikes: the scores of a coarse copy differ from the surface's.
struct Spiky {
  explicit Spiky(const TriMesh& mesh) : model(model_of(mesh)) {
    options.width = options.height = 32;
    shape = analyse_shape(model, options);
    for (std::size_t v = 0; v < shape.significance.size(); ++v) {
      shape.significance[v] = v % 53 == 0 ? 1.0 : 0.0;
    }
    report = find_views(shape, ModelFrame(UpAxis::Y), options);
  }

  [[nodiscard]] json page() const { return page_data(model, shape, report, options); }

  Model model;
  ViewOptions options{};
  ShapeAnalysis shape{};
  ViewReport report{};
};

TEST(ReportPage, ShowsNoEstimateBeyondWhatWasFound) {
  if (!has_report_page()) {
    GTEST_SKIP() << "NOTHING WAS TESTED: built without npm, so there is no page";
  }
  const Spiky spiky(y_of_tubes(0.3, 28));  // 3348 vertices: the page estimates
  const json data = spiky.page();
  const auto scores = data["sphere"]["scores"].get<std::vector<double>>();
  const auto objectives = data["sphere"]["objective"].get<std::vector<double>>();
  ASSERT_EQ(scores.size(), 642U);
  ASSERT_EQ(objectives.size(), 642U);
  EXPECT_LE(*std::max_element(scores.begin(), scores.end()), spiky.report.highest_score);
  EXPECT_GE(*std::min_element(scores.begin(), scores.end()), spiky.report.worst.score);
  EXPECT_LE(*std::max_element(objectives.begin(), objectives.end()), spiky.report.best.objective);
  for (const char* goal : {"best", "worst"}) {
    for (const json& step : data["rapid"][goal]) {
      EXPECT_LE(step["score"].get<double>(), spiky.report.highest_score);
      EXPECT_GE(step["score"].get<double>(), spiky.report.worst.score);
    }
  }
}

TEST(ReportPage, HasTheVeryScoresOfASmallModel) {
  if (!has_report_page()) {
    GTEST_SKIP() << "NOTHING WAS TESTED: built without npm, so there is no page";
  }
  const Spiky spiky(y_of_tubes(0.3, 20));
  ASSERT_LT(spiky.shape.surface.positions.size(), 2000U);
  ASSERT_GT(spiky.shape.surface.positions.size(), 1000U);
  const json sphere = spiky.page()["sphere"];
  const VertexVisibility visibility(spiky.shape.surface, spiky.shape.sides);
  const MapScorer map(spiky.shape, visibility, spiky.options);
  for (std::size_t i = 0; i < sphere["directions"].size(); i += 7) {
    const auto d = sphere["directions"][i].get<std::vector<double>>();
    EXPECT_DOUBLE_EQ(sphere["scores"][i].get<double>(), map.scorer().score(Vec3(d[0], d[1], d[2])));
  }
}

TEST(ReportPage, HasTheColoursOfThePictures) {
  if (!has_report_page()) {
    GTEST_SKIP() << "NOTHING WAS TESTED: built without npm, so there is no page";
  }
  Spiky spiky(y_of_tubes(0.3, 10));
  const json mesh = spiky.page()["mesh"];
  // From the lowest value to the highest, wherever they are.
  for (double& value : spiky.shape.significance) {
    value = 0.75 + 0.25 * value;
  }
  EXPECT_EQ(spiky.page()["mesh"]["significance"], mesh["significance"]);
}

/// A triangle of each of some materials, all with one wide red and blue texture of this opacity.
Model textured(const std::vector<AlphaMode>& modes, std::uint8_t alpha) {
  constexpr int kWidth = 1100;  // more than the page shows
  Model model;
  model.mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  Texture texture{Image{kWidth, 1, {}}};
  for (int x = 0; x < kWidth; ++x) {
    const auto blue = static_cast<std::uint8_t>(x < 500 ? 0 : 255);
    const auto red = static_cast<std::uint8_t>(255 - blue);
    texture.image.rgba.insert(texture.image.rgba.end(), {red, 0, blue, alpha});
  }
  model.appearance.textures.push_back(texture);
  model.appearance.uvs = {{0, 0}, {1, 0}, {0, 1}};
  for (const AlphaMode mode : modes) {
    Material material;
    material.alpha = mode;
    material.texture = 0;
    model.appearance.material_of_triangle.push_back(
        static_cast<std::uint32_t>(model.appearance.materials.size()));
    model.appearance.materials.push_back(material);
    model.mesh.triangles.push_back({0, 1, 2});
    model.appearance.uv_of_triangle.push_back({0, 1, 2});
  }
  return model;
}

json page_look(const Model& model) {
  return asset_part(model, model.mesh.triangles.size(), {}, {});
}

TEST(ReportPage, OpacityThatMeansNothingHidesNoColours) {
  EXPECT_EQ(page_look(textured({AlphaMode::Opaque}, 0)),
            page_look(textured({AlphaMode::Opaque}, 255)));
  const json clear = page_look(textured({AlphaMode::Blend}, 0));
  EXPECT_NE(clear["textures"], page_look(textured({AlphaMode::Blend}, 255))["textures"]);
  // Materials that share it get a copy each, whatever comes first.
  const json both = page_look(textured({AlphaMode::Opaque, AlphaMode::Blend}, 0));
  ASSERT_EQ(both["textures"].size(), 2U);
  const auto texture_of = [&](std::size_t group) {
    return both["textures"][both["groups"][group]["texture"].get<std::size_t>()];
  };
  EXPECT_EQ(texture_of(0), page_look(textured({AlphaMode::Opaque}, 255))["textures"][0]);
  EXPECT_EQ(texture_of(1), clear["textures"][0]);
}

}  // namespace
}  // namespace vantage::test
