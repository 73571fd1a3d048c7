// SPDX-License-Identifier: MIT
#include "contraction/proxy.h"

#include <cmath>
#include <cstdint>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "vantage/contraction/contraction.h"
#include "vantage/mesh/measures.h"

#include "support/many_threads.h"
#include "support/shapes.h"
#include "support/worst.h"

/// \file
/// Contraction by a decimated proxy, and of surfaces that are refined first.

namespace vantage {
namespace {

/// A torus of more vertices than are contracted exactly by default: 240 × 96 = 23 040.
TriMesh large_torus() {
  return test::torus(1.0, 0.3, 240, 96);
}

/// Of the centroids of the area of the torus's rings: 1 + 0.3² / 2, as they have more of it outside.
constexpr double kCentroidRadius = 1.045;

double distance_to_centroids(const Vec3& p) {
  return std::hypot(std::hypot(p.x(), p.y()) - kCentroidRadius, p.z());
}

TEST(MakeProxy, PlacesEveryVertexWithinTheSagOfItsFaces) {
  const TriMesh torus = large_torus();
  const Proxy proxy = make_proxy(torus, 8000, 4000, {});
  ASSERT_EQ(proxy.place.size(), torus.positions.size());
  for (std::size_t v = 0; v < torus.positions.size(); ++v) {
    const Vec3 p = position_of(proxy.place[v], proxy.mesh, proxy.mesh.positions);
    // 4000 vertices on 11.8 square units: edges of 0.06, which sag by 0.06² / (8 · 0.3) = 0.0015 on
    // the tube; some edges are twice as long.
    EXPECT_LE((p - torus.positions[v]).norm(), 4 * 0.0015);
  }
}

TEST(MakeProxy, SharesAllEvenVerticesOut) {
  const Proxy proxy = make_proxy(large_torus(), 8000, 4000, {});
  double sum = 0.0;
  for (const double count : proxy.shares.count) {
    sum += count;
  }
  EXPECT_NEAR(sum, 5000.0, 50.0);  // a small share is rounded up
}

TEST(MakeProxy, MergesOnTheWayWithoutLosingTheHandle) {
  const TriMesh torus = large_torus();
  const MergedSurface merged = make_proxy(torus, 8000, 4000, {}).merged;
  EXPECT_LE(merged.vertex_count, 8000U);
  EXPECT_GT(merged.vertex_count, 4000U);
  const std::set<std::uint32_t> used(merged.of_vertex.begin(), merged.of_vertex.end());
  EXPECT_EQ(used.size(), merged.vertex_count);
  EXPECT_EQ(*used.rbegin(), merged.vertex_count - 1);
  // A closed surface has 3/2 edges a face, and a torus V − E + F = 0.
  EXPECT_EQ(2 * merged.vertex_count, merged.triangles.size());
}

TEST(ContractByProxy, MergesLargeComponentsOnlyAndKeepsAllOthersApart) {
  // Two points of no face, the first and the last, and between them the torus and a ball.
  TriMesh point;
  point.positions.emplace_back(0.0, 9.0, 0.0);
  const TriMesh torus = large_torus();   // 23 040 vertices
  const TriMesh ball = test::sphere(5);  // too fine to be refined first
  const TriMesh mesh =
      test::together(test::together(point, torus, Vec3::Zero()),
                     test::together(ball, point, Vec3::Zero()), Vec3(5.0, 0.0, 0.0));
  const auto merged = contract(mesh, {.max_steps = 1}).merged;
  ASSERT_TRUE(merged.has_value());
  const auto of_torus = merged->of_vertex.begin() + 1;
  const auto of_ball = of_torus + static_cast<std::ptrdiff_t>(torus.positions.size());
  std::set<std::uint32_t> small(of_ball, merged->of_vertex.end());
  small.insert(merged->of_vertex.front());
  EXPECT_EQ(small.size(), ball.positions.size() + 2);
  const std::set<std::uint32_t> large(of_torus, of_ball);
  EXPECT_EQ(large.size() + small.size(), merged->vertex_count);
}

TEST(ContractByProxy, IsNotDoneWhereExactIsAskedFor) {
  const auto exact = contract(large_torus(), {.method = ContractionMethod::Exact, .max_steps = 1});
  EXPECT_EQ(exact.components.front().strategy, "exact");
}

TEST(ContractExactly, CountsVerticesAndByAreaIsWhatIsDoneWithoutAProxy) {
  for (const TriMesh& mesh : {test::torus(1.0, 0.3, 12, 6), test::torus(1.0, 0.3, 120, 40)}) {
    const auto by_area =
        contract(mesh, {.method = ContractionMethod::Exact, .weights = ContractionWeights::Area});
    EXPECT_EQ(by_area.levels, contract(mesh).levels);
    const auto paper = contract(mesh, {.method = ContractionMethod::Exact});
    EXPECT_NE(by_area.levels, paper.levels);
    EXPECT_FALSE(paper.refinement);
    EXPECT_EQ(paper.levels, contract(mesh, {.method = ContractionMethod::Exact,
                                            .weights = ContractionWeights::Vertex})
                                .levels);
  }
}

TEST(SecondMesh, IsCoarserAndHasPlacesForAllItsVerticesAtAllLevels) {
  TriMesh mesh = test::together(test::torus(1.0, 0.3, 120, 40), test::torus(0.5, 0.1, 60, 20),
                                Vec3(5.0, 0.0, 0.0));
  const auto history = contract(mesh);
  const SecondMesh& second = history.second;
  const std::size_t n = second.mesh.positions.size();
  EXPECT_LT(2 * n, mesh.positions.size());
  EXPECT_EQ(second.component_of_vertex.back(), 1U);
  EXPECT_EQ(second.remeshing, std::vector<Remeshing>(2, Remeshing::Coarser));
  ASSERT_EQ(second.here.size(), history.levels.size());
  ASSERT_EQ(second.there.size(), history.levels.size());
  for (std::size_t level = 0; level < history.levels.size(); ++level) {
    ASSERT_EQ(second.here[level].size(), n);
    ASSERT_EQ(second.there[level].size(), n);
    for (std::size_t v = 0; v < n; ++v) {
      EXPECT_LT((second.here[level][v] - second.there[level][v]).norm(), 0.1) << level;
    }
  }
}

TEST(SecondMesh, OfAFewVerticesIsNoOther) {
  const TriMesh mesh =
      test::together(test::torus(1.0, 0.3, 40, 20), test::box(1, 1, 1, 1), Vec3(5.0, 0.0, 0.0));
  const auto history =
      contract(mesh, {.method = ContractionMethod::Exact});  // which refines nothing
  EXPECT_EQ(history.second.remeshing, (std::vector{Remeshing::Coarser, Remeshing::None}));
}

TEST(ContractByProxy, ShrinksAsAllVerticesDoStepByStep) {
  TriMesh torus = large_torus();
  const Sphere sphere = enclosing_sphere(torus.positions);
  for (Vec3& p : torus.positions) {
    p = (p - sphere.centre) * (2.0 / sphere.diameter);
  }
  const auto proxy = contract(torus, {.max_steps = 3});
  const ComponentHistory exact =
      contract_component(torus, {.max_steps = 3}, {}, even_shares(torus));
  ASSERT_EQ(proxy.levels.size(), exact.levels.size());
  for (std::size_t level = 1; level < exact.levels.size(); ++level) {
    double worst = 0.0;
    for (std::size_t v = 0; v < torus.positions.size(); ++v) {
      worst = test::larger(worst, (proxy.levels[level][v] - exact.levels[level][v]).norm());
    }
    EXPECT_LE(worst, 0.02 * 0.3) << level;  // 2 % of the tube's radius
  }
}

TEST(ContractByProxy, BringsATorusFromWhereItIsToTheCircleOfItsCentroidsAndSaysSo) {
  const TriMesh torus = large_torus();
  const ContractionHistory history = contract(torus);
  EXPECT_EQ(history.components.front().strategy, "proxy 10000");
  EXPECT_EQ(history.levels.front(), torus.positions);  // to the bit
  double mean = 0.0;
  for (const Vec3& p : history.levels.back()) {
    mean += distance_to_centroids(p) / static_cast<double>(history.levels.back().size());
  }
  EXPECT_LE(mean, 0.1 * 0.3);
}

TEST(ContractByProxy, HasTheSameBytesForAnyNumberOfThreads) {
  const TriMesh torus = large_torus();
  constexpr ContractionOptions kTwoSteps{.max_steps = 2};
  const auto one = contract(torus, kTwoSteps, {.max_threads = 1});
  const auto three =
      test::with_many_threads([&] { return contract(torus, kTwoSteps, {.max_threads = 3}); });
  EXPECT_EQ(three.levels, one.levels);
}

TEST(ContractRefined, SaysSoAndKeepsTheInputsVerticesOnly) {
  const TriMesh cube = test::box(1, 1, 1, 1);
  const ContractionHistory history = contract(cube);
  EXPECT_EQ(history.components.front().strategy.substr(0, 8), "refined ");
  for (const auto& level : history.levels) {
    EXPECT_EQ(level.size(), cube.positions.size());
  }
}

TEST(ContractRefined, ContractsABeamOfTwelveTrianglesToItsAxis) {
  const ContractionHistory history = contract(test::box(10, 1, 1, 1));
  ASSERT_TRUE(history.refinement.has_value());
  double mean = 0.0;
  const auto& last = history.refinement->levels.back();
  for (const Vec3& p : last) {
    mean += std::hypot(p.y() - 0.5, p.z() - 0.5) / static_cast<double>(last.size());
  }
  EXPECT_LE(mean, 0.1);  // a fifth of half its thickness
}

}  // namespace
}  // namespace vantage
