// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

#include "vantage/mesh/measures.h"
#include "vantage/visibility/face_visibility.h"

#include "support/shapes.h"

namespace vantage {
namespace {

/// Faces whose front is turned to the eye.
std::vector<std::uint32_t> fronts(const TriMesh& mesh, const Viewpoint& eye) {
  std::vector<std::uint32_t> result;
  for (std::uint32_t f = 0; f < mesh.triangles.size(); ++f) {
    const Vec3& corner = mesh.positions[mesh.triangles[f][0]];
    const Vec3 sight =
        eye.projection == Projection::Perspective ? Vec3(eye.position - corner) : eye.position;
    if (area_vector(mesh, mesh.triangles[f]).dot(sight) > 0.0) {
      result.push_back(f);
    }
  }
  return result;
}

TEST(FaceVisibility, SeesEveryFrontFaceOfAConvexMeshWithItsCornersAndNoOther) {
  const TriMesh mesh = test::sphere(7);  // 327 680 faces
  const FaceVisibility visibility(mesh, {FaceSides::Front});
  const VertexVisibility vertices(mesh, {FaceSides::Front});
  for (const Viewpoint& eye : {Viewpoint{Projection::Perspective, Vec3(2.0, 3.0, -1.0)},
                               Viewpoint{Projection::Orthographic, Vec3(0.3, -0.2, 0.9)}}) {
    const std::vector<std::uint32_t> expected = fronts(mesh, eye);
    std::vector<std::uint8_t> corners(mesh.positions.size(), 0);
    for (const std::uint32_t f : expected) {
      for (const std::uint32_t v : mesh.triangles[f]) {
        corners[v] = 1;
      }
    }
    const std::vector<SeenFace> seen = visibility.seen_faces(eye);
    EXPECT_TRUE(
        std::equal(seen.begin(), seen.end(), expected.begin(), expected.end(),
                   [](const SeenFace& face, std::uint32_t front) { return face.face == front; }));
    EXPECT_EQ(visibility.visible_vertices(eye), corners);
    EXPECT_EQ(vertices.visible_vertices(eye), corners);
  }
}

}  // namespace
}  // namespace vantage
