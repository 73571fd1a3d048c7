// SPDX-License-Identifier: MIT
#include "vantage/significance/mesh_saliency.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stop_token>
#include <string_view>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "vantage/core/error.h"
#include "vantage/core/run_context.h"
#include "vantage/mesh/measures.h"
#include "vantage/mesh/topology.h"

#include "mesh/curvature.h"
#include "support/shapes.h"
#include "support/worst.h"

namespace vantage {
namespace {

// Sums of some hundred Gaussian weights, then a quotient by the span of their differences.
constexpr double kRelative = 1e-9;

/// A sphere with a sharp bump around the pole.
TriMesh sphere_with_bump(int level) {
  TriMesh mesh = test::sphere(level);
  for (Vec3& p : mesh.positions) {
    const double away = (p - Vec3::UnitZ()).squaredNorm();
    p *= 1.0 + 0.15 * std::exp(-away / 0.02);
  }
  return mesh;
}

/// The definition, straight from the formulas: all pairs.
std::vector<double> direct_saliency(const TriMesh& mesh, const MeshSaliencyOptions& options) {
  const std::size_t n = mesh.positions.size();
  std::vector<double> c = mean_curvatures(mesh);
  if (!options.signed_curvature) {
    std::transform(c.begin(), c.end(), c.begin(), [](double x) { return std::abs(x); });
  }
  const std::vector<double> areas = vertex_areas(mesh);
  const double epsilon = options.saliency_scale * bounding_box(mesh.positions).size().norm();
  std::vector<double> squared(n);  // of distances from the vertex at hand
  const auto mean_within = [&](double sigma) {
    double sum = 0.0;
    double weights = 0.0;
    for (std::size_t u = 0; u < n; ++u) {
      if (std::sqrt(squared[u]) <= 2.0 * sigma) {
        const double w =
            std::exp(-squared[u] / (2.0 * sigma * sigma)) * (options.area_kernel ? areas[u] : 1.0);
        sum += w * c[u];
        weights += w;
      }
    }
    return sum / weights;
  };
  constexpr std::array kScales{2, 3, 4, 5, 6};
  std::array<std::vector<double>, kScales.size()> levels;
  for (std::size_t v = 0; v < n; ++v) {
    for (std::size_t u = 0; u < n; ++u) {
      squared[u] = (mesh.positions[u] - mesh.positions[v]).squaredNorm();
    }
    for (std::size_t k = 0; k < kScales.size(); ++k) {
      const double sigma = kScales[k] * epsilon;
      levels[k].push_back(std::abs(mean_within(sigma) - mean_within(2.0 * sigma)));
    }
  }
  const IndexLists rings = vertex_neighbours(mesh);
  std::vector<double> saliency(n, 0.0);
  for (std::vector<double>& level : levels) {
    const auto [low, high] = std::minmax_element(level.begin(), level.end());
    const double bottom = *low;
    const double span = *high - *low;
    for (double& x : level) {
      x = (x - bottom) / span;
    }
    double sum = 0.0;
    int peaks = 0;
    for (std::size_t v = 0; v < n; ++v) {
      const auto ring = rings[v];
      if (level[v] < 1.0 && std::all_of(ring.begin(), ring.end(),
                                        [&](std::uint32_t u) { return level[u] < level[v]; })) {
        sum += level[v];
        ++peaks;
      }
    }
    const double mean = peaks > 0 ? sum / peaks : 0.0;
    for (std::size_t v = 0; v < n; ++v) {
      saliency[v] += (1.0 - mean) * (1.0 - mean) * level[v];
    }
  }
  return saliency;
}

double largest_difference(const std::vector<double>& a, const std::vector<double>& b) {
  double largest = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    largest = test::larger(largest, std::abs(a[i] - b[i]));
  }
  return largest;
}

/// No symmetry, so that no two vertices tie as local maxima.
TriMesh uneven_shape() {
  TriMesh mesh = test::y_of_tubes(0.2, 24);
  for (Vec3& p : mesh.positions) {
    p.z() += 0.1 * std::sin(3.0 * p.x() + 1.0) + 0.05 * p.y() * p.y();
  }
  return mesh;
}

class MeshSaliencyFormula : public testing::TestWithParam<MeshSaliencyOptions> {};

TEST_P(MeshSaliencyFormula, IsWhatDirectEvaluationOverAllPairsGives) {
  const TriMesh mesh = uneven_shape();
  const MeshSaliency saliency = compute_mesh_saliency(mesh, GetParam());
  EXPECT_LT(largest_difference(saliency.of_vertex, direct_saliency(mesh, GetParam())), kRelative);
}

INSTANTIATE_TEST_SUITE_P(Variants, MeshSaliencyFormula,
                         testing::Values(MeshSaliencyOptions{},
                                         MeshSaliencyOptions{.signed_curvature = true},
                                         MeshSaliencyOptions{.area_kernel = true},
                                         MeshSaliencyOptions{.saliency_scale = 0.01}));

/// A mesh and a triangle so far away that all of the mesh is within reach of each of its vertices.
TriMesh with_a_far_triangle(const TriMesh& mesh) {
  const TriMesh triangle{.positions = {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)},
                         .triangles = {{0, 1, 2}}};
  return test::together(mesh, triangle, Vec3(1e3, 0.0, 0.0));
}

TEST(MeshSaliency, BesideAFarTriangleIsWhatDirectEvaluationOverAllPairsGives) {
  const TriMesh mesh = with_a_far_triangle(uneven_shape());
  EXPECT_LT(largest_difference(compute_mesh_saliency(mesh).of_vertex, direct_saliency(mesh, {})),
            kRelative);
}

TEST(MeshSaliency, BesideAFarTriangleHearsAStopAmidItsSums) {
  std::stop_source source;
  const RunContext run{.report =
                           [&](std::string_view stage, double fraction) {
                             if (stage == "saliency" && fraction > 0.0) {
                               source.request_stop();
                             }
                           },
                       .stop = source.get_token()};
  EXPECT_THROW(compute_mesh_saliency(with_a_far_triangle(test::sphere(4)), {}, run), Cancelled);
}

TEST(MeshSaliency, OfASphereIsZeroEverywhere) {
  const MeshSaliency saliency = compute_mesh_saliency(test::sphere(4));
  for (const double s : saliency.of_vertex) {
    ASSERT_EQ(s, 0.0);
  }
}

TEST(MeshSaliency, OfAFlatSheetIsZeroEverywhere) {
  for (const double s : compute_mesh_saliency(test::sheet(2.0, 1.0, 12)).of_vertex) {
    ASSERT_EQ(s, 0.0);
  }
}

TEST(MeshSaliency, IsGreatestOnTheBumpOfASphere) {
  const TriMesh mesh = sphere_with_bump(5);
  const std::vector<double> s = compute_mesh_saliency(mesh).of_vertex;
  ASSERT_THAT(s, testing::Each(testing::Ge(0.0)));
  const auto peak = static_cast<std::size_t>(std::max_element(s.begin(), s.end()) - s.begin());
  EXPECT_LT((mesh.positions[peak].normalized() - Vec3::UnitZ()).norm(), 0.3);
}

TEST(MeshSaliency, LeavesIsolatedVerticesOutOfTheKernelAndAtZero) {
  const TriMesh mesh = uneven_shape();
  TriMesh with_strays = mesh;
  with_strays.positions.emplace_back(mesh.positions[3] + Vec3(1e-3, 0, 0));
  with_strays.positions.emplace_back(1e3, 0.0, 0.0);
  std::vector<double> expected = compute_mesh_saliency(mesh).of_vertex;
  expected.insert(expected.end(), {0.0, 0.0});
  EXPECT_EQ(compute_mesh_saliency(with_strays).of_vertex, expected);
}

TEST(MeshSaliency, OfATriangleAndOfNothingIsZeroAndFinite) {
  const TriMesh triangle{.positions = {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)},
                         .triangles = {{0, 1, 2}}};
  EXPECT_EQ(compute_mesh_saliency(triangle).of_vertex, std::vector<double>(3, 0.0));
  EXPECT_TRUE(compute_mesh_saliency(TriMesh{}).of_vertex.empty());
}

TEST(MeshSaliency, RefusesAScaleOutsideItsRange) {
  EXPECT_THROW(compute_mesh_saliency(test::sphere(1), {.saliency_scale = 0.0}), InvalidInput);
}

}  // namespace
}  // namespace vantage
