// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cstdint>
#include <string>
#include <tuple>
#include <vector>

#include <gtest/gtest.h>

#include "vantage/mesh/measures.h"
#include "vantage/spatial/directions.h"
#include "vantage/visibility/vertex_visibility.h"

#include "core/random.h"
#include "support/many_threads.h"
#include "support/shapes.h"
#include "support/visibility_oracle.h"

namespace vantage {
namespace {

using test::Seen;

struct Shape {
  std::string name{};
  TriMesh mesh{};
  FaceSides sides = FaceSides::Front;
};

/// Triangles thrown about in a unit cube. \param size of each.
TriMesh random_soup(int faces, double size, unsigned seed) {
  Pcg32 random(seed);
  const auto point = [&] {
    const double x = random.uniform();
    const double y = random.uniform();
    const double z = random.uniform();
    return Vec3(x, y, z);
  };
  TriMesh mesh;
  for (int f = 0; f < faces; ++f) {
    const Vec3 corner = point();
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    for (int i = 0; i < 3; ++i) {
      mesh.positions.emplace_back(corner + size * point());
    }
    mesh.triangles.push_back({first, first + 1, first + 2});
  }
  return mesh;
}

std::vector<Shape> shapes() {
  const Vec3 axis(1.0, 2.0, 3.0);
  const auto turned = [&](const TriMesh& mesh) {
    return test::moved(mesh, 1.0, 0.7, axis, Vec3(0.1, 0.2, 0.3));
  };
  return {{"Torus", turned(test::torus(1.0, 0.4, 28, 14)), FaceSides::Front},
          {"AlignedTorus", test::torus(1.0, 0.4, 24, 12), FaceSides::Front},
          {"TorusBothSides", turned(test::torus(1.0, 0.4, 24, 12)), FaceSides::Both},
          {"TubesInAY", turned(test::y_of_tubes(0.2, 14)), FaceSides::Front},
          {"Box", test::box(1.0, 2.0, 3.0, 4), FaceSides::Front},
          {"OpenCylinder", turned(test::open_cylinder(1.0, 2.0, 24, 8)), FaceSides::Both},
          {"StlTorus", test::soup(test::torus(1.0, 0.4, 14, 7)), FaceSides::Front},
          {"LargeTriangles", random_soup(150, 1.0, 1), FaceSides::Both},
          {"SmallTriangles", random_soup(300, 0.1, 2), FaceSides::Both}};
}

std::vector<Viewpoint> eyes_around(const TriMesh& mesh) {
  const Sphere sphere = enclosing_sphere(mesh.positions);
  std::vector<Viewpoint> eyes;
  Pcg32 random(11);
  const auto directions = direction_set(ViewSphereBase::Icosahedron, 0).directions;
  for (std::size_t i = 0; i < 6; ++i) {
    // Far, just outside the sphere, and inside it.
    for (const double radii : {3.86, 1.02, 0.3 + 0.5 * random.uniform()}) {
      eyes.push_back({Projection::Perspective,
                      sphere.centre + 0.5 * sphere.diameter * radii * directions[2 * i]});
    }
    eyes.push_back({Projection::Orthographic, directions[2 * i]});
  }
  for (int axis = 0; axis < 3; ++axis) {
    eyes.push_back({Projection::Orthographic, Vec3::Unit(axis)});
  }
  return eyes;
}

class VisibilityOf : public testing::TestWithParam<std::size_t> {
 protected:
  Shape shape = shapes()[GetParam()];
};

TEST_P(VisibilityOf, EqualsBruteForceOffExactSilhouettes) {
  const VertexVisibility visibility(shape.mesh, {shape.sides});
  std::size_t decided = 0;
  for (const Viewpoint& eye : eyes_around(shape.mesh)) {
    const std::vector<std::uint8_t> found = visibility.visible_vertices(eye);
    const std::vector<Seen> expected = test::brute_force_visibility(shape.mesh, shape.sides, eye);
    for (std::size_t v = 0; v < found.size(); ++v) {
      if (expected[v] != Seen::Exactly) {
        ++decided;
        ASSERT_EQ(found[v] != 0, expected[v] == Seen::Yes)
            << "vertex " << v << " from " << eye.position.transpose();
      }
    }
  }
  EXPECT_GT(decided, shape.mesh.positions.size());
}

TEST_P(VisibilityOf, DoesNotDependOnScaleOrPosition) {
  const Viewpoint eye = eyes_around(shape.mesh)[0];
  const std::vector<Seen> sure = test::brute_force_visibility(shape.mesh, shape.sides, eye);
  const VertexVisibility visibility(shape.mesh, {shape.sides});
  const std::vector<std::uint8_t> expected = visibility.visible_vertices(eye);
  for (const auto& [scale, shift] :
       {std::pair{1e-6, 0.0}, std::pair{1e6, 0.0}, std::pair{1.0, 100.0}, std::pair{1e6, -3e6}}) {
    const Vec3 offset(shift, 2.0 * shift, -shift);
    const TriMesh mesh = test::moved(shape.mesh, scale, 0.0, Vec3::UnitX(), offset);
    const auto found = VertexVisibility(mesh, {shape.sides})
                           .visible_vertices({eye.projection, Vec3(scale * eye.position + offset)});
    for (std::size_t v = 0; v < found.size(); ++v) {
      if (sure[v] != Seen::Exactly) {
        ASSERT_EQ(found[v], expected[v]) << "vertex " << v << " at scale " << scale;
      }
    }
  }
}

TEST_P(VisibilityOf, FollowsItsVerticesWhenTheyAreRenumbered) {
  const Viewpoint eye = eyes_around(shape.mesh)[1];
  std::vector<std::uint32_t> old_of_new;
  const TriMesh shuffled = test::renumbered(shape.mesh, 5, &old_of_new);
  const auto expected = VertexVisibility(shape.mesh, {shape.sides}).visible_vertices(eye);
  const auto found = VertexVisibility(shuffled, {shape.sides}).visible_vertices(eye);
  for (std::size_t v = 0; v < found.size(); ++v) {
    ASSERT_EQ(found[v], expected[old_of_new[v]]);
  }
}

INSTANTIATE_TEST_SUITE_P(Shapes, VisibilityOf, testing::Range(std::size_t{0}, shapes().size()),
                         [](const auto& param) { return shapes()[param.param].name; });

TEST(VisibilityThreads, DoNotChangeTheAnswer) {
  const TriMesh mesh = test::torus(1.0, 0.4, 160, 80);
  const VertexVisibility visibility(mesh, {FaceSides::Front});
  // One eye outside, answered by the grid, and one inside, answered by the hierarchy.
  for (const Vec3& position : {Vec3(3.0, 4.0, 2.0), Vec3(1.0, 0.1, 0.0)}) {
    const Viewpoint eye{Projection::Perspective, position};
    const auto expected = visibility.visible_vertices(eye, {.max_threads = 1});
    for (const int threads : {2, 3, 8}) {
      const auto seen = test::with_many_threads(
          [&] { return visibility.visible_vertices(eye, {.max_threads = threads}); });
      EXPECT_EQ(seen, expected) << threads;
    }
  }
}

}  // namespace
}  // namespace vantage
