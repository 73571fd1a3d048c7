// SPDX-License-Identifier: MIT
#include "visibility/eye_grid.h"

#include <array>
#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

#include "vantage/visibility/vertex_visibility.h"

#include "core/random.h"
#include "visibility/sample_query.h"
#include "visibility/surface.h"

namespace vantage {
namespace {

/// Triangles with corners drawn by lot from a cube, each apart.
TriMesh heap(std::uint32_t faces) {
  Pcg32 random(7);
  TriMesh mesh;
  for (std::uint32_t f = 0; f < faces; ++f) {
    for (int c = 0; c < 3; ++c) {
      const double x = random.uniform();
      const double y = random.uniform();
      mesh.positions.emplace_back(x, y, random.uniform());
    }
    mesh.triangles.push_back({3 * f, 3 * f + 1, 3 * f + 2});
  }
  return mesh;
}

TEST(EyeGrid, IsEnoughForAHeapOfLargeFaces) {
  const std::array sides{FaceSides::Both};
  SampleScene samples(visibility_surface(heap(4000), sides));
  const Surface& surface = samples.surface();
  const Viewpoint eye{Projection::Perspective, Vec3(2.0, 3.0, 4.0)};
  TurnedFaces turned;
  find_turned(surface, eye, turned, {});
  EyeGrid grid;
  grid.begin(eye, turned, {});
  std::vector<std::uint8_t> seen(surface.samples.size(), 1);
  EXPECT_TRUE(grid.hide(surface, seen, {}));
  for (std::uint32_t i = 0; i < seen.size(); i += 7) {
    EXPECT_EQ(seen[i] == 0, samples.hides_sample(i, eye)) << i;
  }
}

}  // namespace
}  // namespace vantage
