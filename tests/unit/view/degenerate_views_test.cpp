// SPDX-License-Identifier: MIT
// What each measure gives where there is nothing, or next to nothing, to look at: the table of
// tests/golden/views_of_next_to_nothing.md is what this test finds.
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <numbers>
#include <string>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>

#include "vantage/view/measure.h"

#include "support/shapes.h"

namespace vantage {
namespace {

/// A surface, its maps of one value everywhere, and a skeleton of one node, looked at from one eye.
struct Scene {
  const char* name;
  TriMesh mesh;
  FaceSides sides;
  double map;
  Viewpoint eye;

  [[nodiscard]] std::vector<double> values() const {
    const std::vector<FaceSides> both{sides};
    const std::vector<double> flat(mesh.positions.size(), map);
    const std::vector<std::uint32_t> nodes(mesh.positions.size(), 0);
    CurveGraph graph;
    graph.nodes = {mesh.positions.front()};
    MeasureSubject subject;
    subject.surface = &mesh;
    subject.sides = both;
    subject.camera = {.sphere = enclosing_sphere(mesh.positions), .projection = eye.projection};
    subject.kssm = subject.saliency = flat;
    subject.skeleton = &graph;
    subject.node_of_vertex = nodes;
    const ViewMeasurer measurer(subject, builtin_measures(), 1);
    std::vector<double> row;
    for (const std::vector<double>& of_measure : measurer.values(std::vector<Viewpoint>{eye})) {
      row.push_back(of_measure.front());
    }
    return row;
  }
};

std::vector<Scene> scenes() {
  const auto from = [](const Vec3& towards) {
    return Viewpoint{Projection::Orthographic, towards};
  };
  const auto at = [](const Vec3& place) { return Viewpoint{Projection::Perspective, place}; };
  TriMesh face;
  face.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  face.triangles = {{0, 1, 2}};
  TriMesh square = face;
  square.positions.emplace_back(1, 1, 0);
  square.triangles.push_back({1, 3, 2});
  TriMesh corner = test::box(1, 1, 1, 1);  // without its floor
  std::erase_if(corner.triangles, [&](const Triangle& t) {
    return corner.positions[t[0]].z() == 0.0 && corner.positions[t[1]].z() == 0.0 &&
           corner.positions[t[2]].z() == 0.0;
  });
  return {{"no face seen", test::box(1, 1, 1, 2), FaceSides::Front, 1.0, at(Vec3(0.4, 0.5, 0.6))},
          {"one face", face, FaceSides::Both, 1.0, from(Vec3::UnitZ())},
          {"one face on edge", face, FaceSides::Both, 1.0, from(Vec3::UnitX())},
          {"flat square, maps 0", square, FaceSides::Both, 0.0, from(Vec3::UnitZ())},
          {"inside an open box", corner, FaceSides::Both, 1.0, at(Vec3(0.5, 0.5, 0.3))},
          {"in its middle", corner, FaceSides::Both, 1.0, at(Vec3(0.5, 0.5, 0.5))}};
}

std::string text_of(double value) {
  if (std::isinf(value)) {
    return "∞";
  }
  std::array<char, 40> text{};
  std::snprintf(text.data(), text.size(), "%.3g", std::abs(value) < 1e-6 ? 0.0 : value);
  return text.data();
}

/// The table in Markdown.
std::string table() {
  const std::vector<Scene> all = scenes();
  std::string text = "| measure |";
  std::string rule = "| --- |";
  std::vector<std::vector<double>> columns;
  for (const Scene& scene : all) {
    text += std::string(" ") + scene.name + " |";
    rule += " ---: |";
    columns.push_back(scene.values());
  }
  text += "\n" + rule + "\n";
  for (std::size_t m = 0; m < builtin_measures().size(); ++m) {
    text += "| `" + builtin_measures()[m].name + "` |";
    for (const std::vector<double>& column : columns) {
      text += " " + text_of(column[m]) + " |";
    }
    text += "\n";
  }
  return text;
}

TEST(DegenerateViews, GiveWhatTheDocumentationSays) {
  const auto page =
      std::filesystem::path(__FILE__).parent_path() / "../../golden/views_of_next_to_nothing.md";
  std::ifstream file(page);
  ASSERT_TRUE(file) << page;
  const std::string text{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  const std::string begin = "<!-- degenerate views begin -->\n";
  const std::size_t start = text.find(begin);
  const std::size_t end = text.find("<!-- degenerate views end -->");
  ASSERT_TRUE(start != std::string::npos && end != std::string::npos && start < end);
  EXPECT_EQ(text.substr(start + begin.size(), end - start - begin.size()), table());
}

TEST(DegenerateViews, AreNoNumberForNoMeasure) {
  for (const Scene& scene : scenes()) {
    const std::vector<double> values = scene.values();
    for (std::size_t m = 0; m < values.size(); ++m) {
      const Measure& measure = builtin_measures()[m];
      EXPECT_TRUE(std::isfinite(values[m]) || values[m] == measure.worst())
          << measure.name << ", " << scene.name;
    }
  }
}

TEST(DegenerateViews, OfNothingAreTheWorstOfEachMeasure) {
  const std::vector<double> values = scenes().front().values();
  for (std::size_t m = 0; m < values.size(); ++m) {
    EXPECT_EQ(values[m], builtin_measures()[m].worst()) << builtin_measures()[m].name;
  }
}

TEST(DegenerateViews, OfOneFaceAreThoseOfACertainty) {
  // One triangle with legs of 1: the disc is that around its hypotenuse, of area π/2, and the square
  // around it has area 2.
  const std::vector<double> values = scenes()[1].values();
  const auto value = [&](std::string_view name) {
    for (std::size_t m = 0; m < values.size(); ++m) {
      if (builtin_measures()[m].name == name) {
        return values[m];
      }
    }
    return std::nan("");
  };
  EXPECT_EQ(value("visible-triangles"), 1.0);
  EXPECT_NEAR(value("projected-area"), 1.0 / std::numbers::pi, 1e-6);
  EXPECT_NEAR(value("plemenos"), 1.0 + 0.25, 1e-6);
  for (const char* name : {"viewpoint-entropy", "kullback-leibler", "vmi", "i2", "i3",
                           "instability", "pmi-saliency", "evmi"}) {
    EXPECT_NEAR(value(name), 0.0, 1e-9) << name;
  }
  // Background 3/4, the face 1/4.
  EXPECT_NEAR(value("viewpoint-entropy-2001"), 0.75 * std::log2(4.0 / 3.0) + 0.5, 1e-6);
  EXPECT_NEAR(value("silhouette-length"), (2.0 + std::sqrt(2.0)) / std::sqrt(2.0), 1e-9);
}

}  // namespace
}  // namespace vantage
