// SPDX-License-Identifier: MIT
// The whole method on real models, in the folder that the environment variable VANTAGE_DATA names.

#include <gtest/gtest.h>

#include "vantage/pipeline/find_views.h"

#include "support/data_pack.h"
#include "support/visibility_oracle.h"

namespace vantage::test {
namespace {

class RealModel : public DataPackTest<testing::TestWithParam<const char*>> {
 protected:
  void SetUp() override {
    DataPackTest::SetUp();
    if (!IsSkipped()) {
      model = load_model((root() / GetParam()).string());
    }
  }

  Model model{};
};

using RealClosedModel = RealModel;

TEST_P(RealClosedModel, HasAsManySkeletonCyclesAsGenus) {
  const ShapeAnalysis shape = analyse_shape(model, {});
  ASSERT_TRUE(shape.check.genus.has_value());
  EXPECT_EQ(cycle_count(shape.skeleton.raw), *shape.check.genus);
  EXPECT_EQ(cycle_count(shape.skeleton.graph), *shape.check.genus);
  EXPECT_EQ(component_count(shape.skeleton.graph), shape.check.components);
  EXPECT_GE(shape.history.level_count(), 3U);
}

INSTANTIATE_TEST_SUITE_P(DataPack, RealClosedModel,
                         testing::Values("paper/rocker-arm_10044.off", "paper/cow_2904.off",
                                         "paper/dinosaur_5026_qem.ply", "clean/9HandleTorus.off",
                                         "clean/turbine.off", "clean/anchor_dense.off",
                                         "clean/block.off", "clean/scad_candleStand.off",
                                         "clean/knot2.off", "clean/rings.obj", "clean/kitten.obj",
                                         "clean/skull_low_resolution.obj", "clean/chair.off"));

using RealSmallModel = RealModel;

TEST_P(RealSmallModel, VisibleVerticesAreThoseOfBruteForce) {
  const ShapeAnalysis shape = prepare_surface(model);
  const VertexVisibility visibility(shape.surface, shape.sides);
  const ScoringCamera camera = scoring_camera(shape, {});
  for (const Vec3& direction : direction_set(ViewSphereBase::Cube, 0).directions) {
    const Viewpoint eye = camera.viewpoint(direction);
    const auto visible = visibility.visible_vertices(eye);
    const auto truth = brute_force_visibility(shape.surface, shape.sides.front(), eye);
    for (std::size_t v = 0; v < visible.size(); ++v) {
      if (truth[v] != Seen::Exactly) {
        ASSERT_EQ(visible[v] != 0, truth[v] == Seen::Yes) << "vertex " << v;
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(DataPack, RealSmallModel,
                         testing::Values("clean/block.off", "clean/goathead.obj",
                                         "clean/scad_example009.off"));

}  // namespace
}  // namespace vantage::test
