// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <random>
#include <stop_token>
#include <string_view>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "vantage/contraction/contraction.h"
#include "vantage/skeleton/skeleton.h"

#include "contraction/component_contraction.h"
#include "support/once.h"
#include "support/shapes.h"

/// \file
/// Sheets that are contracted further for the skeleton. A low limit stops any shape as a sheet.

namespace vantage {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

// A limit and a tolerance at which the shapes below stop as sheets.
constexpr double kLow = 7.0;
constexpr double kTolerance = 0.03;
constexpr double kHigh = 2048.0;
constexpr double kThin = 0.04;  // what a curve has left of its area, docs/contraction.md

/// Too many vertices to be contracted exactly by default.
TriMesh egg() {
  TriMesh mesh = test::cube_sphere(60);
  for (Vec3& p : mesh.positions) {
    p.x() *= 4.0;
  }
  return mesh;
}

ContractionHistory contract_to(const TriMesh& mesh, double limit, double sheet_limit) {
  return contract(
      mesh,
      {.contraction_limit = limit, .sheet_limit = sheet_limit, .shrinkage_tolerance = kTolerance});
}

/// Contractions of the egg, each computed once a process.
const ContractionHistory& egg_to(double limit, double sheet_limit) {
  return test::once(std::pair(limit, sheet_limit),
                    [&] { return contract_to(egg(), limit, sheet_limit); });
}

/// Flattened, and each vertex moved by up to 10^-4 along each axis.
TriMesh rough_lens(double height, unsigned seed) {
  TriMesh mesh = test::sphere(5);
  std::mt19937 random(seed);
  for (Vec3& p : mesh.positions) {
    for (double* x : {&p.x(), &p.y(), &p.z()}) {
      *x += 1e-4 * std::ldexp(static_cast<double>(random()), -31) - 1e-4;
    }
    p.z() *= height;
  }
  return mesh;
}

TEST(Thinning, IsWhatTheHigherLimitContractsTo) {
  const ContractionHistory& low = egg_to(kLow, kHigh);
  const ContractionHistory& high = egg_to(kHigh, kHigh);
  ASSERT_GT(low.shrinkage.back(), kThin);
  ASSERT_LE(high.shrinkage.back(), kThin);
  EXPECT_EQ(low.thinned, high.levels.back());
  EXPECT_THAT(low.components.front().strategy, HasSubstr("thinned"));
}

TEST(Thinning, ChangesNoLevel) {
  const ContractionHistory& with = egg_to(kLow, kHigh);
  const ContractionHistory& without = egg_to(kLow, kLow);
  EXPECT_EQ(with.levels, without.levels);
  EXPECT_EQ(with.shrinkage, without.shrinkage);
  EXPECT_THAT(without.thinned, IsEmpty());
  EXPECT_THAT(without.components.front().strategy, Not(HasSubstr("thinned")));
}

TEST(Thinning, LeavesCurvesAlone) {
  const ContractionHistory& history = egg_to(kHigh, 4.0 * kHigh);
  EXPECT_LE(history.shrinkage.back(), kThin);
  EXPECT_THAT(history.thinned, IsEmpty());
}

TEST(Thinning, IsForgottenWhereTheSheetStaysASheet) {
  constexpr double kLittle = 1.5 * kLow;
  const ContractionHistory& history = egg_to(kLow, kLittle);
  const double thinnest = egg_to(kLittle, kLittle).shrinkage.back();
  EXPECT_LT(thinnest, history.shrinkage.back());
  EXPECT_GT(thinnest, kThin);
  EXPECT_THAT(history.thinned, IsEmpty());
}

TEST(Thinning, LeavesOtherComponentsAndLooseVerticesWhereTheyAre) {
  TriMesh mesh = test::together(egg(), test::torus(1.0, 0.02, 60, 8), Vec3(5.0, 0.0, 0.0));
  mesh.positions.emplace_back(0.0, 9.0, 0.0);
  const ContractionHistory history = contract_to(mesh, kLow, kHigh);
  const std::size_t others = egg().positions.size();
  ASSERT_EQ(history.thinned.size(), mesh.positions.size());
  EXPECT_NE(history.thinned.front(), history.levels.back().front());
  EXPECT_THAT(history.components[0].strategy, HasSubstr("thinned"));
  EXPECT_THAT(history.components[1].strategy, Not(HasSubstr("thinned")));
  for (std::size_t v = others; v < mesh.positions.size(); ++v) {
    EXPECT_EQ(history.thinned[v], history.levels.back()[v]);
  }
}

TEST(Thinning, LeavesSmallComponentsAlone) {
  TriMesh small = test::sphere(4);
  for (Vec3& p : small.positions) {
    p = Vec3(2.0 * p.x(), 1.2 * p.y(), 0.8 * p.z());
  }
  const ContractionHistory history = contract_to(small, kLow, kHigh);
  EXPECT_GT(history.shrinkage.back(), kThin);
  EXPECT_THAT(history.thinned, IsEmpty());
}

TEST(Thinning, IsTheSameByBothMethods) {
  const ContractionHistory& fast = egg_to(kLow, kHigh);
  const ContractionHistory exact = contract(egg(), {.method = ContractionMethod::Exact,
                                                    .contraction_limit = kLow,
                                                    .sheet_limit = kHigh,
                                                    .shrinkage_tolerance = kTolerance});
  EXPECT_THAT(exact.components.front().strategy, testing::StrEq("exact, thinned"));
  EXPECT_EQ(exact.thinned, fast.thinned);
  EXPECT_NE(exact.levels.back(), fast.levels.back());
}

TEST(Thinning, ObeysTheStepLimit) {
  int thinned = 0;
  for (const int steps : {2, 4, 6, 8}) {
    const ContractionHistory low = contract(egg(), {.contraction_limit = kLow,
                                                    .sheet_limit = kHigh,
                                                    .shrinkage_tolerance = kTolerance,
                                                    .max_steps = steps});
    const ContractionHistory high = contract(egg(), {.contraction_limit = kHigh,
                                                     .sheet_limit = kHigh,
                                                     .shrinkage_tolerance = kTolerance,
                                                     .max_steps = steps});
    if (!low.thinned.empty()) {
      EXPECT_EQ(low.thinned, high.levels.back()) << steps;
      ++thinned;
    }
  }
  EXPECT_GT(thinned, 0);
  EXPECT_LT(thinned, 4);
}

/// What is reported until a stop is asked for past the half, where thinning begins.
std::vector<double> reports_until_stopped_late() {
  std::stop_source source;
  std::vector<double> seen;
  const auto stop_late = [&](std::string_view /*stage*/, double fraction) {
    seen.push_back(fraction);
    if (fraction > 0.5) {
      source.request_stop();
    }
  };
  try {
    contract(egg(),
             {.contraction_limit = kLow, .sheet_limit = kHigh, .shrinkage_tolerance = kTolerance},
             {.report = stop_late, .stop = source.get_token()});
  } catch (const Cancelled&) {
    return seen;
  }
  return {};
}

TEST(Thinning, ReportsWhatIsDoneAndCanBeStopped) {
  const std::vector<double> seen = reports_until_stopped_late();
  ASSERT_FALSE(seen.empty()) << "was not stopped";
  EXPECT_TRUE(std::is_sorted(seen.begin(), seen.end()));
  EXPECT_LT(seen.back(), 1.0);
}

TEST(Thinning, StandsBesideRefinedComponents) {
  const TriMesh mesh = test::together(egg(), test::cylinder(0.5, 6.0, 6, 1), Vec3(9.0, 0.0, 0.0));
  const ContractionHistory history = contract_to(mesh, kLow, kHigh);
  EXPECT_THAT(history.components[0].strategy, HasSubstr("thinned"));
  EXPECT_THAT(history.components[1].strategy, HasSubstr("refined"));
  const std::vector<Vec3>& fine = history.refinement->thinned;
  ASSERT_EQ(fine.size(), history.refinement->mesh.positions.size());
  EXPECT_EQ(history.thinned,
            std::vector<Vec3>(fine.begin(), fine.begin() + std::ssize(mesh.positions)));
}

TEST(Thinning, GivesTheSkeletonOfTheHigherLimit) {
  const Skeleton low = extract_skeleton(egg(), egg_to(kLow, kHigh));
  const Skeleton high = extract_skeleton(egg(), egg_to(kHigh, kHigh));
  const Skeleton sheet = extract_skeleton(egg(), egg_to(kLow, kLow));
  EXPECT_NE(low.raw.nodes, sheet.raw.nodes);
  EXPECT_EQ(low.raw.nodes, high.raw.nodes);
  EXPECT_EQ(low.raw.edges, high.raw.edges);
  EXPECT_EQ(low.graph.nodes, high.graph.nodes);
}

TEST(Thinning, KeepsTheCurveFromBeforeTheSlivers) {
  int met_slivers = 0;
  for (const unsigned seed : {1U, 2U}) {
    for (const double height : {0.4, 0.5}) {
      const TriMesh lens = rough_lens(height, seed);
      const ComponentHistory low = contract_component(lens, {}, {});
      const ComponentHistory high = contract_component(lens, {.contraction_limit = 8192.0}, {});
      const auto slivers = static_cast<std::size_t>(high.summary.regularised_steps);
      EXPECT_EQ(low.thinned, high.levels[high.levels.size() - 1 - slivers])
          << seed << " " << height;
      met_slivers += slivers > 0 ? 1 : 0;
    }
  }
  EXPECT_GT(met_slivers, 0);
}

TEST(Thinning, OfAnotherMeshIsRefused) {
  ContractionHistory history = egg_to(kLow, kHigh);
  history.thinned.pop_back();
  EXPECT_THROW(extract_skeleton(egg(), history), InvalidInput);
}

}  // namespace
}  // namespace vantage
