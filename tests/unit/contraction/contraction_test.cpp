// SPDX-License-Identifier: MIT
#include "vantage/contraction/contraction.h"

#include <cmath>
#include <cstdint>
#include <limits>
#include <set>
#include <stop_token>
#include <string>
#include <thread>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "vantage/mesh/measures.h"

#include "support/many_threads.h"
#include "support/shapes.h"
#include "support/worst.h"

namespace vantage {
namespace {

using ::testing::HasSubstr;

/// Without refining coarse parts first, which takes longer than all else.
constexpr ContractionOptions kAsTheyAre{.method = ContractionMethod::Exact};

void expect_finite(const ContractionHistory& history) {
  for (const auto& level : history.levels) {
    for (const Vec3& p : level) {
      ASSERT_TRUE(p.allFinite());
    }
  }
}

TEST(Contract, LevelZeroIsTheInputBitForBit) {
  const TriMesh mesh =
      test::moved(test::torus(1.0, 0.3, 16, 8), 1e-3, 0.7, Vec3(1, 2, 3), Vec3(5, 6, 7));
  EXPECT_EQ(contract(mesh, kAsTheyAre).levels.front(), mesh.positions);
}

TEST(Contract, BringsACylinderToItsAxis) {
  const double radius = 0.25;
  const TriMesh mesh = test::cylinder(radius, 4.0, 24, 48);
  const ContractionHistory history = contract(mesh);
  double farthest = 0.0;
  for (const Vec3& p : history.levels.back()) {
    farthest = test::larger(farthest, std::hypot(p.x(), p.y()));
  }
  RecordProperty("farthest_from_axis_in_radii", std::to_string(farthest / radius));
  EXPECT_LE(farthest, 0.02 * radius);
}

TEST(Contract, BringsATorusToItsCoreCircle) {
  const double minor = 0.25;
  const TriMesh mesh = test::torus(1.0, minor, 48, 16);
  const ContractionHistory history = contract(mesh);
  double farthest = 0.0;
  for (const Vec3& p : history.levels.back()) {
    farthest = test::larger(farthest, std::hypot(std::hypot(p.x(), p.y()) - 1.0, p.z()));
  }
  RecordProperty("farthest_from_circle_in_radii", std::to_string(farthest / minor));
  EXPECT_LE(farthest, 0.5 * minor);
}

TEST(Contract, KeepsComponentsApartThatAFaceOfOneVertexTwiceNames) {
  TriMesh mesh = test::together(test::sphere(1), test::sphere(1), {5.0, 0.0, 0.0});
  const auto second = static_cast<std::uint32_t>(mesh.positions.size() / 2);
  mesh.triangles.push_back({0, 0, second});
  const ContractionHistory history = contract(mesh, kAsTheyAre);
  EXPECT_EQ(history.components.size(), 2U);
  EXPECT_NE(history.component_of_vertex[0], history.component_of_vertex[second]);
}

TEST(Contract, LeavesIsolatedVerticesExactlyWhereTheyAre) {
  TriMesh mesh = test::torus(1.0, 0.3, 16, 8);
  const Vec3 place(0.1, 0.2, 1.0 / 3.0);
  mesh.positions.push_back(place);
  const ContractionHistory history = contract(mesh, kAsTheyAre);
  ASSERT_GE(history.level_count(), 1U);
  for (const auto& level : history.levels) {
    EXPECT_EQ(level.back(), place);
  }
  EXPECT_EQ(history.component_of_vertex.back(), ContractionHistory::kIsolated);
  EXPECT_EQ(history.components.size(), 1U);
}

TEST(Contract, OfNothingButPointsHasOnlyTheInput) {
  const TriMesh mesh{.positions = {{0, 0, 0}, {1, 2, 3}}, .triangles = {}};
  const ContractionHistory history = contract(mesh);
  EXPECT_EQ(history.levels.size(), 1U);
  EXPECT_TRUE(history.components.empty());
}

TEST(Contract, OfAnEmptyMeshIsOneEmptyLevel) {
  EXPECT_EQ(contract({}).levels.size(), 1U);
}

TEST(Contract, LeavesASurfaceWithoutAreaAlone) {
  const TriMesh needle{.positions = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, .triangles = {{0, 1, 2}}};
  const ContractionHistory history = contract(needle);
  ASSERT_EQ(history.components.size(), 1U);
  EXPECT_EQ(history.components.front().stop, ContractionStop::NothingToMove);
  EXPECT_EQ(history.levels.back(), needle.positions);
}

TEST(Contract, SurvivesFacesThatNameAVertexTwice) {
  TriMesh mesh = test::box(1, 1, 3, 5);
  mesh.triangles.push_back({0, 0, 1});
  mesh.triangles.push_back({2, 2, 2});
  const ContractionHistory history = contract(mesh, kAsTheyAre);
  expect_finite(history);
  EXPECT_GE(history.level_count(), 1U);
}

TEST(Contract, SurvivesFacesThatStandTwice) {
  TriMesh mesh = test::torus(1.0, 0.3, 16, 8);
  for (std::size_t f = 0; f < 20; ++f) {
    const Triangle copy = mesh.triangles[f];
    mesh.triangles.push_back(copy);
    mesh.triangles.push_back({copy[0], copy[2], copy[1]});
  }
  const ContractionHistory history = contract(mesh, kAsTheyAre);
  expect_finite(history);
  EXPECT_GE(history.level_count(), 1U);
}

TEST(Contract, SurvivesNeedlesAndZeroAreaFaces) {
  TriMesh mesh = test::cylinder(0.25, 4.0, 16, 32);
  constexpr std::size_t kAround = 16;
  // Push rings together until neighbouring ones coincide to the last bits, and one exactly.
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    const std::size_t ring = v / kAround;
    if (ring == 10) {
      mesh.positions[v].z() = mesh.positions[9 * kAround].z() * (1.0 + 1e-15);
    } else if (ring == 20) {
      mesh.positions[v].z() = mesh.positions[19 * kAround].z();
    }
  }
  const ContractionHistory history = contract(mesh);
  expect_finite(history);
  EXPECT_GE(history.level_count(), 1U);
  EXPECT_LT(history.shrinkage.back(), 0.5);
}

TEST(Contract, SurvivesAVertexOfWhichEveryFaceHasNoArea) {
  TriMesh mesh = test::sphere(2);
  const auto [a, b, c] = mesh.triangles.front();
  const auto middle = static_cast<std::uint32_t>(mesh.positions.size());
  mesh.positions.emplace_back(0.5 * (mesh.positions[a] + mesh.positions[b]));
  mesh.triangles.push_back({a, b, middle});
  const ContractionHistory history = contract(mesh, kAsTheyAre);
  expect_finite(history);
  EXPECT_LT(history.shrinkage.back(), 0.5);
}

TEST(Contract, GivesBackTheVertexOrderOfTwoInterwovenComponents) {
  TriMesh mesh;
  const TriMesh torus = test::torus(1.0, 0.3, 16, 8);
  for (const Vec3& p : torus.positions) {
    mesh.positions.push_back(p);
    mesh.positions.emplace_back(p + Vec3(10, 0, 0));
  }
  for (const auto& [a, b, c] : torus.triangles) {
    mesh.triangles.push_back({2 * a, 2 * b, 2 * c});
    mesh.triangles.push_back({2 * a + 1, 2 * b + 1, 2 * c + 1});
  }
  const ContractionHistory history = contract(mesh, kAsTheyAre);
  ASSERT_EQ(history.components.size(), 2U);
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    EXPECT_EQ(history.component_of_vertex[v], v % 2);
    EXPECT_EQ(history.levels.back()[v].x() > 5.0, v % 2 == 1);
  }
}

TEST(Contract, ObeysTheStepLimit) {
  const ContractionHistory history = contract(test::torus(1.0, 0.3, 16, 8), {.max_steps = 1});
  EXPECT_EQ(history.level_count(), 1U);
  EXPECT_EQ(history.components.front().stop, ContractionStop::StepLimit);
}

std::string complaint_about(const ContractionOptions& options) {
  try {
    contract(test::box(1, 1, 1, 1), options);
  } catch (const InvalidInput& error) {
    return error.what();
  }
  return "none";
}

TEST(Contract, RefusesOptionsOutOfRangeByName) {
  for_each_number(kContractionFields, [](const auto& field) {
    ContractionOptions options;
    options.*(field.member) = field.high;
    options.*(field.member) *= 2;
    EXPECT_THAT(complaint_about(options), HasSubstr(std::string(field.name)));
  });
}

TEST(Contract, RefusesNotANumberByName) {
  try {
    contract(test::box(1, 1, 1, 1),
             {.contraction_growth = std::numeric_limits<double>::quiet_NaN()});
    ADD_FAILURE() << "was accepted";
  } catch (const InvalidInput& error) {
    EXPECT_THAT(error.what(), HasSubstr("contraction-growth"));
  }
}

TEST(Contract, RefusesOptionsBelowTheirRangeByName) {
  for_each_number(kContractionFields, [](const auto& field) {
    ContractionOptions options;
    options.*(field.member) = field.low;
    options.*(field.member) -= 1;
    try {
      contract(test::box(1, 1, 1, 1), options);
      ADD_FAILURE() << field.name << " was accepted";
    } catch (const InvalidInput& error) {
      EXPECT_THAT(error.what(), HasSubstr(std::string(field.name)));
    }
  });
}

TEST(ContractProgress, NeverGoesBackOverManyComponents) {
  // The large component first: the shares of the later ones must still follow on.
  TriMesh mesh = test::torus(1.0, 0.3, 24, 12);
  for (int i = 0; i < 3; ++i) {
    mesh = test::together(mesh, test::sphere(1), Vec3(5.0 * (i + 1), 0, 0));
  }
  std::vector<double> seen;
  const auto report = [&](std::string_view, double f) { seen.push_back(f); };
  contract(mesh, kAsTheyAre, {.report = report, .max_threads = 1});  // others are silent
  ASSERT_GE(seen.size(), 5U);
  EXPECT_TRUE(std::is_sorted(seen.begin(), seen.end()));
  EXPECT_EQ(seen.back(), 1.0);
  EXPECT_GE(seen.front(), 0.0);
}

/// Contracts on one thread and requests a stop at the given report; returns how many reports came.
int reports_until_stop(const TriMesh& mesh, int stop_at) {
  std::stop_source source;
  int seen = 0;
  const auto count = [&](std::string_view, double) {
    if (++seen == stop_at) {
      source.request_stop();
    }
  };
  try {
    contract(mesh, kAsTheyAre, {.report = count, .stop = source.get_token(), .max_threads = 1});
  } catch (const Cancelled&) {
    return seen;
  }
  return stop_at == 0 ? seen : -1;
}

TEST(ContractProgress, ComesFromTheCallingThreadAsPartsAreDone) {
  TriMesh mesh = test::sphere(1);
  for (int i = 0; i < 20; ++i) {
    mesh = test::together(mesh, test::sphere(1), Vec3(5.0 * (i + 1), 0, 0));
  }
  std::set<std::thread::id> threads;
  std::vector<double> seen;
  const auto report = [&](std::string_view, double f) {
    threads.insert(std::this_thread::get_id());
    seen.push_back(f);
  };
  contract(mesh, kAsTheyAre, {.report = report, .max_threads = 2});
  EXPECT_EQ(threads, std::set{std::this_thread::get_id()});
  EXPECT_TRUE(std::is_sorted(seen.begin(), seen.end()));
  EXPECT_EQ(seen.back(), 1.0);
}

TEST(Contract, OfManyPartsIsTheSameForAnyNumberOfThreads) {
  TriMesh mesh = test::torus(1.0, 0.3, 24, 12);
  for (int i = 0; i < 7; ++i) {
    mesh = test::together(mesh, test::sphere(i % 3), Vec3(5.0 * (i + 1), 0, 0));
  }
  constexpr ContractionOptions kTwoSteps{.max_steps = 2};
  const ContractionHistory alone = contract(mesh, kTwoSteps, {.max_threads = 1});
  const ContractionHistory many =
      test::with_many_threads([&] { return contract(mesh, kTwoSteps, {.max_threads = 3}); });
  EXPECT_EQ(many.levels, alone.levels);
  EXPECT_EQ(many.component_of_vertex, alone.component_of_vertex);
  EXPECT_EQ(many.shrinkage, alone.shrinkage);
}

TEST(ContractCancel, StopsAtEveryReportedFraction) {
  TriMesh mesh = test::torus(1.0, 0.3, 12, 8);
  for (int i = 0; i < 3; ++i) {
    mesh = test::together(mesh, test::sphere(1), Vec3(5.0 * (i + 1), 0, 0));
  }
  const int reports = reports_until_stop(mesh, 0);
  ASSERT_GE(reports, 4);
  for (int at = 1; at < reports; ++at) {  // after the last one nothing is left to stop
    EXPECT_EQ(reports_until_stop(mesh, at), at);
  }
}

}  // namespace
}  // namespace vantage
