// SPDX-License-Identifier: MIT
// Measures of one's own, and several that share their looks.
#include <algorithm>
#include <chrono>
#include <cstdint>
#include <limits>
#include <numeric>
#include <random>
#include <stop_token>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "vantage/core/error.h"
#include "vantage/view/measure.h"

#include "support/shapes.h"
#include "unit/view/measure_subject.h"

namespace vantage {
namespace {

using test::Subject;

TEST(Measures, OfOnesOwnTakePart) {
  const Subject cube(test::box(1, 1, 1, 1));
  const Measure own{.name = "own",
                    .needs = {.faces = true},
                    .value = [](const MeasuredModel& model, const SightTable& sight) {
                      return static_cast<double>(model.face_areas.size() - sight.faces.size());
                    }};
  const ViewMeasurer measurer(cube.given, {own});
  EXPECT_EQ(measurer.values(std::vector<Vec3>{Vec3::UnitX()})[0][0], 10.0);
}

TEST(Measures, OfOnesOwnNeedAFunction) {
  const Subject cube(test::box(1, 1, 1, 1));
  EXPECT_THROW(ViewMeasurer(cube.given, {Measure{.name = "own"}}), InvalidInput);
}

TEST(Measures, ThatAreNoNumberAreRefused) {
  const Subject cube(test::box(1, 1, 1, 1));
  const Measure own{.name = "own",
                    .needs = {.faces = true},
                    .value = [](const MeasuredModel& /*model*/, const SightTable& /*sight*/) {
                      return std::numeric_limits<double>::quiet_NaN();
                    }};
  ViewMeasurer measurer(cube.given, {own}, 0);
  const std::vector<Vec3> one{Vec3::UnitX()};
  EXPECT_THROW(static_cast<void>(measurer.values(one)), InvalidInput);
  EXPECT_THROW(static_cast<void>(measurer.values_of(0, one)), InvalidInput);
  EXPECT_THROW(measurer.kept_values_of(0, one), InvalidInput);
  EXPECT_THROW(static_cast<void>(measurer.survey_of(0)), InvalidInput);
  EXPECT_THROW(measurer.set_values(), InvalidInput);
}

TEST(Measures, OfOnesOwnSeeInTheSetWhatTheySeeElsewhere) {
  Subject ring(test::torus(1.0, 0.4, 24, 12), Projection::Orthographic);
  const std::vector<double> ones(ring.mesh.positions.size(), 1.0);
  ring.given.kssm = ones;
  ring.given.weight = Weight::Area;
  const Measure of_faces{.name = "of faces",
                         .needs = {.faces = true, .channel = true, .kssm = true},
                         .value = [](const MeasuredModel& /*model*/, const SightTable& sight) {
                           return sight.deepest + sight.depths[3] + sight.kssm_sum;
                         }};
  const Measure of_more{.name = "of more",
                        .needs = {.vertices = true, .outline = true, .neighbours = true},
                        .value = [](const MeasuredModel& /*model*/, const SightTable& sight) {
                          return std::accumulate(sight.vertices.begin(), sight.vertices.end(),
                                                 sight.outline.length);
                        }};
  ViewMeasurer measurer(ring.given, {of_faces, of_more}, 1);
  const MeasureValues of_set = measurer.set_values();
  EXPECT_EQ(of_set, measurer.values(measurer.set().directions));
  for (const std::vector<double>& values : of_set) {
    EXPECT_GT(*std::min_element(values.begin(), values.end()), 0.0);
  }
}

TEST(Measures, KeptOfOneLookAreThoseOfALookEach) {
  const Subject ring(test::torus(1.0, 0.4, 24, 12), Projection::Perspective);
  ViewMeasurer keeps(ring.given, builtin_measures(), 1);
  const ViewMeasurer looks(ring.given, builtin_measures(), 1);
  const std::vector<Vec3> some{Vec3(1, 2, 2) / 3.0, Vec3::UnitX(), Vec3(0.0, 0.6, -0.8)};
  const std::vector<Vec3> more{some[2], Vec3(0.48, 0.64, 0.6), some[0]};
  for (const std::vector<Vec3>& directions : {some, more}) {
    for (std::size_t m = 0; m < looks.measures().size(); ++m) {
      EXPECT_EQ(keeps.kept_values_of(m, directions), looks.values_of(m, directions))
          << looks.measures()[m].name;
    }
  }
}

TEST(Measures, KeptAreNotLookedAtAgain) {
  const Subject cube(test::box(1, 1, 1, 1));
  int looks = 0;
  const auto own = [&](MeasureNeeds needs) {
    return Measure{.name = "own",
                   .needs = needs,
                   .value = [&looks](const MeasuredModel& /*model*/, const SightTable& sight) {
                     ++looks;
                     return sight.projected_area;
                   }};
  };
  ViewMeasurer measurer(cube.given, {own({.faces = true}), own({.faces = true}),
                                     own({.vertices = true, .faces = true})});
  const std::vector<Vec3> one{Vec3::UnitX()};
  const RunContext alone{.max_threads = 1};
  const std::vector<double> value = measurer.kept_values_of(0, one, alone);
  EXPECT_EQ(looks, 2) << "faces tell nothing of vertices";
  EXPECT_EQ(measurer.kept_values_of(1, one, alone), value);
  EXPECT_EQ(measurer.kept_values_of(0, one, alone), value);
  EXPECT_EQ(looks, 2);
  EXPECT_EQ(measurer.kept_values_of(2, one, alone), value);
  EXPECT_EQ(looks, 5);
  // What the set of views tells costs little once faces are seen.
  ViewMeasurer of_set(cube.given, {own({.faces = true}), own({.faces = true, .channel = true})}, 1);
  looks = 0;
  const std::vector<Vec3> other{Vec3(0.6, 0.0, 0.8)};
  of_set.kept_values_of(0, other, alone);
  of_set.kept_values_of(1, other, alone);
  EXPECT_EQ(looks, 2);
}

/// Long thin triangles across each other: a look takes seconds.
TriMesh heap_of_needles(int count) {
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  const auto direction = [&] {
    const double x = normal(random);
    const double y = normal(random);
    return Vec3(x, y, normal(random)).normalized();
  };
  TriMesh mesh;
  for (int i = 0; i < count; ++i) {
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    const Vec3 end = direction();
    mesh.positions.insert(mesh.positions.end(), {end, -end, end + 1e-3 * direction()});
    mesh.triangles.push_back({first, first + 1, first + 2});
  }
  return mesh;
}

TEST(Measures, StopAmidALook) {
  const test::Subject subject(heap_of_needles(4000));
  const ViewMeasurer measurer(subject.given, {find_measure("projected-area")}, 1);
  std::stop_source source;
  const std::jthread stopper([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    source.request_stop();
  });
  EXPECT_THROW(static_cast<void>(
                   measurer.values(std::vector<Vec3>{Vec3::UnitX()}, {.stop = source.get_token()})),
               Cancelled);
}

}  // namespace
}  // namespace vantage
