// SPDX-License-Identifier: MIT
#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

#include "vantage/spatial/directions.h"
#include "vantage/visibility/vertex_visibility.h"

#include "support/shapes.h"
#include "visibility/sample_query.h"

namespace vantage {
namespace {

/// Which side each face turns to the eye.
std::vector<std::uint8_t> sides_seen(SampleScene& samples, const Viewpoint& eye) {
  return SampleQuery(samples, eye_in_frame(eye, samples.surface().frame), {}).turned();
}

/// Whether it makes no difference that runs of faces are told by the cones around their normals.
void expect_same_without_cones(const TriMesh& mesh) {
  const std::vector<FaceSides> sides{FaceSides::Front};
  Surface surface = visibility_surface(mesh, sides);
  ASSERT_FALSE(surface.blocks.cosine.empty());
  SampleScene with_cones(surface);
  surface.blocks.cosine.clear();
  SampleScene without(surface);
  for (const Vec3& towards : direction_set(ViewSphereBase::Icosahedron, 1).directions) {
    EXPECT_EQ(sides_seen(with_cones, {Projection::Orthographic, towards}),
              sides_seen(without, {Projection::Orthographic, towards}));
    for (const double distance : {0.0, 0.3, 1.01, 5.0, 1e3, 1e7, 1e20, 1e200}) {
      const Viewpoint eye{Projection::Perspective, distance * towards};
      EXPECT_EQ(sides_seen(with_cones, eye), sides_seen(without, eye)) << distance;
    }
  }
}

TEST(SidesOfFaces, AreThoseOfEachWhateverIsToldOfRunsOfThem) {
  expect_same_without_cones(test::sphere(5));
  expect_same_without_cones(test::torus(1.0, 0.3, 120, 60));
  expect_same_without_cones(test::box(1.0, 2.0, 3.0, 12));
  expect_same_without_cones(test::soup(test::sphere(2)));
}

TEST(SidesOfFaces, OfFarEyesAreThoseOfTheDirection) {
  const VertexVisibility visibility(test::sphere(5), {FaceSides::Front});
  for (const Vec3& towards : direction_set(ViewSphereBase::Icosahedron, 1).directions) {
    EXPECT_EQ(visibility.visible_vertices({Projection::Perspective, 1e20 * towards}),
              visibility.visible_vertices({Projection::Orthographic, towards}));
  }
}

}  // namespace
}  // namespace vantage
