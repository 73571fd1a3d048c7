// SPDX-License-Identifier: MIT
// Visibility on real models against brute force, in the folder that VANTAGE_DATA names.
#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "vantage/io/model.h"
#include "vantage/mesh/measures.h"
#include "vantage/mesh/mesh_check.h"
#include "vantage/spatial/directions.h"
#include "vantage/visibility/face_visibility.h"
#include "vantage/visibility/vertex_visibility.h"

#include "support/data_pack.h"
#include "support/visibility_oracle.h"

namespace vantage {
namespace {

using test::Seen;

// Vertices asked about a model and eye: brute force takes milliseconds each on the largest …
constexpr std::size_t kAsked = 40;
// … and on small ones as many as so many pairs of vertex and face allow, a few hundredths of a
// second: hundreds.
constexpr std::size_t kPairs = 800'000;

class VisibilityOfRealModel : public test::DataPackTest<testing::TestWithParam<const char*>> {};

TEST_P(VisibilityOfRealModel, EqualsBruteForce) {
  const OrientedMesh oriented = orient_shells(load_model((root() / GetParam()).string()).mesh);
  const TriMesh& mesh = oriented.mesh;
  // The oracle knows one rule for sides: that of the first component, for all.
  const FaceSides sides = oriented.sides.front();
  const VertexVisibility visibility(mesh, {sides});
  const Sphere sphere = enclosing_sphere(referenced_points(mesh));
  const std::size_t asked = std::max(kAsked, kPairs / mesh.triangles.size());
  const std::size_t step = std::max<std::size_t>(1, mesh.positions.size() / asked);
  std::size_t decided = 0;
  for (const Viewpoint& eye :
       {Viewpoint{Projection::Perspective, sphere.centre + sphere.diameter * Vec3(1.4, 0.9, 1.1)},
        Viewpoint{Projection::Orthographic, Vec3(-0.2, -0.5, 0.8)}}) {
    const auto found = visibility.visible_vertices(eye);
    const auto expected = test::brute_force_visibility(mesh, sides, eye, step);
    for (std::size_t v = 0; v < found.size(); v += step) {
      if (expected[v] != Seen::Exactly) {
        ++decided;
        ASSERT_EQ(found[v] != 0, expected[v] == Seen::Yes) << "vertex " << v;
      }
    }
  }
  EXPECT_GT(decided, std::min(asked, mesh.positions.size()));
}

TEST_P(VisibilityOfRealModel, IsTheSameWhetherAllBacksAreAskedOrThoseThatMatter) {
  const OrientedMesh oriented = orient_shells(load_model((root() / GetParam()).string()).mesh);
  const FaceVisibility visibility(oriented.mesh, oriented.sides);
  const Sphere sphere = enclosing_sphere(referenced_points(oriented.mesh));
  for (const Vec3& towards : {Vec3(0, 0, 1), Vec3(-1, 0, 0), Vec3(0, 1, 1), Vec3(-0.7, 0.2, -0.6),
                              Vec3(0.3, -0.8, 0.5)}) {
    for (const Viewpoint& eye :
         {Viewpoint{Projection::Perspective, sphere.centre + 1.3 * sphere.diameter * towards},
          Viewpoint{Projection::Orthographic, towards}}) {
      ASSERT_EQ(visibility.seen_surface(eye).vertices, visibility.visible_vertices(eye))
          << towards.transpose();
    }
  }
}

class AreasOfRealModel : public test::DataPackTest<testing::TestWithParam<const char*>> {};

TEST_P(AreasOfRealModel, EqualBruteForce) {
  const TriMesh mesh = weld(load_model((root() / GetParam()).string()).mesh).mesh;
  const Sphere sphere = enclosing_sphere(referenced_points(mesh));
  const FaceVisibility visibility(mesh, {FaceSides::Both});
  // Brute force takes seconds for an eye before a thousand faces.
  std::vector<Vec3> directions = direction_set(ViewSphereBase::Icosahedron, 0).directions;
  directions.resize(std::min(directions.size(), 1 + 1000 / mesh.triangles.size()));
  for (const Vec3& towards : directions) {
    const Viewpoint eye{Projection::Perspective, sphere.centre + 1.9 * sphere.diameter * towards};
    std::vector<double> areas(mesh.triangles.size(), 0.0);
    for (const SeenFace& face : visibility.seen_faces(eye)) {
      areas[face.face] = face.projected_area;
    }
    const std::vector<double> expected =
        test::brute_force_areas(mesh, FaceSides::Both, eye, sphere.centre);
    for (std::size_t f = 0; f < areas.size(); ++f) {
      ASSERT_NEAR(areas[f], expected[f], 1e-9 * sphere.diameter * sphere.diameter)
          << "face " << f << " from " << towards.transpose();
    }
  }
}

INSTANTIATE_TEST_SUITE_P(DataPack, AreasOfRealModel,
                         testing::Values("nasty/trimesh/wallhole.obj", "nasty/vhacd/chair.off",
                                         "nasty/pmp/hole_capsule.off"));

INSTANTIATE_TEST_SUITE_P(
    DataPack, VisibilityOfRealModel,
    testing::Values("paper/armadillo_172966_loop.ply", "paper/venus_igea_134345.ply",
                    "paper/dinosaur_56194_loop.ply", "paper/horse_48485.obj",
                    "paper/horse_48485_insideout.ply", "paper/rockerarm_40177.ply",
                    "paper/cow_2904.off", "paper/dinosaur_9851_open.off",
                    "clean/fertility_24994.off", "clean/chair.off", "clean/block.off",
                    "clean/knot2.off", "clean/kitten.obj", "clean/homer.obj", "clean/turbine.off",
                    "clean/scad_example009.off", "clean/springer.obj", "clean/triceratops.off",
                    "clean/wingnut.obj", "clean/pinion.off"));

}  // namespace
}  // namespace vantage
