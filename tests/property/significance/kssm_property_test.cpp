// SPDX-License-Identifier: MIT
#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "vantage/significance/kssm.h"
#include "vantage/skeleton/skeleton.h"

#include "core/random.h"
#include "support/dense_oracles.h"
#include "support/many_threads.h"
#include "support/named_mesh.h"
#include "support/once.h"
#include "support/shapes.h"
#include "support/worst.h"

namespace vantage {
namespace {

using test::NamedMesh;

TriMesh with_isolated_vertex(TriMesh mesh) {
  mesh.positions.insert(mesh.positions.begin() + 3, Vec3(40, 50, 60));
  for (Triangle& t : mesh.triangles) {
    for (std::uint32_t& v : t) {
      v += v >= 3 ? 1 : 0;
    }
  }
  return mesh;
}

/// Moves every vertex a little: on symmetric shapes, rounding alone would decide which of several
/// equal vertices is a strict local maximum.
std::vector<NamedMesh> uneven(std::vector<NamedMesh> shapes) {
  Pcg32 random(17);
  for (NamedMesh& shape : shapes) {
    for (Vec3& p : shape.mesh.positions) {
      p += 0.01 * Vec3(random.uniform(), random.uniform(), random.uniform());
    }
  }
  return shapes;
}

std::vector<NamedMesh> shapes() {
  return uneven({{"Torus", test::torus(1.0, 0.3, 30, 12)},
                 {"Box", test::box(1.0, 2.0, 3.0, 6)},
                 {"OpenCylinder", test::open_cylinder(0.3, 3.0, 12, 24)},
                 {"YOfTubes", test::y_of_tubes(0.25, 18)},
                 {"TwoComponents",
                  test::together(test::sphere(2), test::torus(1.0, 0.3, 24, 10), Vec3(0, 0, 5))},
                 {"WithIsolatedVertex", with_isolated_vertex(test::cylinder(0.3, 3.0, 12, 24))}});
}

/// All ways to ask for a map.
std::vector<KssmOptions> all_options() {
  std::vector<KssmOptions> all;
  for (const auto suppression : {Suppression::Mean, Suppression::LocalMaxima}) {
    for (const auto kinematics : {Kinematics::Displacement, Kinematics::Velocity}) {
      for (const bool by_area : {false, true}) {
        all.push_back({suppression, kinematics, by_area});
      }
    }
  }
  return all;
}

/// The contraction and the skeleton of a shape, each computed once a process.
const ContractionHistory& history_of(const NamedMesh& shape) {
  return test::once(shape.name, [&] { return contract(shape.mesh); });
}

const Skeleton& skeleton_of(const NamedMesh& shape) {
  return test::once(shape.name, [&] { return extract_skeleton(shape.mesh, history_of(shape)); });
}

class KssmOf : public ::testing::TestWithParam<NamedMesh> {
 protected:
  const TriMesh& shape_mesh = GetParam().mesh;
  const ContractionHistory& shape_history = history_of(GetParam());
  const Skeleton& shape_skeleton = skeleton_of(GetParam());
};

TEST_P(KssmOf, AgreesWithADirectEvaluation) {
  double worst = 0.0;
  for (const KssmOptions& options : all_options()) {
    const KssmMap map = compute_kssm(shape_mesh, shape_history, shape_skeleton.raw, options);
    const std::vector<double> expected =
        test::direct_kssm(shape_mesh, shape_history, shape_skeleton.raw, options);
    for (std::size_t v = 0; v < expected.size(); ++v) {
      worst = test::larger(worst, std::abs(map.of_vertex[v] - expected[v]));
    }
  }
  RecordProperty("worst_difference", std::to_string(worst * 1e15) + "e-15");
  EXPECT_LE(worst, 1e-12);
}

TEST_P(KssmOf, IsAtLeastZeroAndAtMostOneALevel) {
  const KssmMap map = compute_kssm(shape_mesh, shape_history, shape_skeleton.raw);
  for (const double value : map.of_vertex) {
    EXPECT_GE(value, 0.0);
    EXPECT_LE(value, static_cast<double>(shape_history.levels.size()));
  }
}

TEST_P(KssmOf, HasTheSameBytesForAnyNumberOfThreads) {
  const KssmMap one =
      compute_kssm(shape_mesh, shape_history, shape_skeleton.raw, {}, {.max_threads = 1});
  const KssmMap three = test::with_many_threads([&] {
    return compute_kssm(shape_mesh, shape_history, shape_skeleton.raw, {}, {.max_threads = 3});
  });
  EXPECT_EQ(one.of_vertex, three.of_vertex);
  EXPECT_EQ(one.displacement, three.displacement);
}

TEST_P(KssmOf, DoesNotChangeWhenEverythingIsMovedTogether) {
  const KssmMap plain = compute_kssm(shape_mesh, shape_history, shape_skeleton.raw);
  for (const double scale : {1e-6, 1e6}) {
    const auto move = [&](const std::vector<Vec3>& points) {
      return test::moved({.positions = points, .triangles = {}}, scale, 0.9, Vec3(1, -1, 2),
                         scale * Vec3(1, 2, 3))
          .positions;
    };
    TriMesh mesh = shape_mesh;
    mesh.positions = move(mesh.positions);
    ContractionHistory history = shape_history;
    for (auto& level : history.levels) {
      level = move(level);
    }
    CurveGraph graph = shape_skeleton.raw;
    graph.nodes = move(graph.nodes);
    const KssmMap moved = compute_kssm(mesh, history, graph);
    for (std::size_t v = 0; v < plain.of_vertex.size(); ++v) {
      // A level spans at least 1e-6 D; rounding of coordinates is 1e-16 D.
      EXPECT_NEAR(moved.of_vertex[v], plain.of_vertex[v], 1e-8);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Shapes, KssmOf, ::testing::ValuesIn(shapes()),
                         [](const auto& instance) { return instance.param.name; });

}  // namespace
}  // namespace vantage
