// SPDX-License-Identifier: MIT
#include <algorithm>
#include <string>
#include <vector>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "vantage/io/model.h"
#include "vantage/orientation/orientation.h"

#include "support/shapes.h"

namespace vantage::test {
namespace {

/// A square of 1 x 1 in z = 0 that looks to +z, with a picture, and one behind it without.
constexpr const char* kPicture =
    "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 -1\nv 1 0 -1\nv 1 1 -1\nv 0 1 -1\n"
    "vt 0 0\nvt 0.5 0\nvt 0.5 1\nvt 0 1\n";

TextureFlow flow_of(const std::string& faces) {
  const Model model = parse_model(kPicture + faces, "a.obj");
  return texture_flow(model.mesh, model.appearance);
}

TEST(TextureFlow, OfAnUprightPictureIsUpAndRight) {
  const TextureFlow flow = flow_of("f 1/1 2/2 3/3 4/4\nf 5 6 7 8\n");
  EXPECT_NEAR(flow.share, 0.5, 1e-12);
  EXPECT_NEAR((flow.up - 0.5 * Vec3::UnitY()).norm(), 0.0, 1e-12);
  EXPECT_NEAR((flow.right - 0.5 * Vec3::UnitX()).norm(), 0.0, 1e-12);
  EXPECT_NEAR(flow.side[4].area, 0.5, 1e-12);  // +z
  EXPECT_NEAR(flow.side[4].texels, 1.0, 1e-12);
  EXPECT_EQ(flow.side[5].area, 0.0);
}

TEST(TextureFlow, OfAMirroredPictureIsUpAndLeft) {
  const TextureFlow flow = flow_of("f 1/2 2/1 3/4 4/3\n");
  EXPECT_NEAR((flow.up - Vec3::UnitY()).norm(), 0.0, 1e-12);
  EXPECT_NEAR((flow.right + Vec3::UnitX()).norm(), 0.0, 1e-12);
  EXPECT_NEAR(flow.side[4].area, 1.0, 1e-12);
}

TEST(TextureFlow, IsNothingWithoutCoordinatesOrWhereTheyCollapse) {
  for (const char* const faces :
       {"f 1 2 3 4\n", "f 1/1 2/1 3/1 4/1\n", "f 1/1 2/2 3 4/4\n", "f 1/1 1/2 2/3\nf 1 2 3\n"}) {
    const TextureFlow flow = flow_of(faces);
    EXPECT_LT(flow.share, 0.6) << faces;
    EXPECT_TRUE(flow.up.allFinite());
  }
  EXPECT_EQ(flow_of("f 1 2 3 4\n").share, 0.0);
  EXPECT_EQ(texture_flow(box(1.0, 1.0, 1.0, 1), {}).share, 0.0);
}

TEST(TextureFlow, SpeaksForUpInTheEvidence) {
  // A cube says nothing itself; its picture is upright along x.
  const TriMesh cube = box(1.0, 1.0, 1.0, 2);
  TextureFlow flow;
  flow.share = 1.0;
  flow.up = 0.9 * Vec3::UnitX();
  const std::vector<OrientationFeatures> rows = OrientationEvidence(cube, flow).features();
  const auto texture_up = [](const OrientationFeatures& row) {
    return std::find_if(row.values.begin(), row.values.end(),
                        [](const OrientationFeature& f) { return f.name == "texture_up"; })
        ->value;
  };
  EXPECT_NEAR(texture_up(rows[0]), 0.9, 1e-12);   // x
  EXPECT_NEAR(texture_up(rows[1]), -0.9, 1e-12);  // -x
  EXPECT_NEAR(texture_up(rows[2]), 0.0, 1e-12);
}

}  // namespace
}  // namespace vantage::test
