// SPDX-License-Identifier: MIT
// The whole method on real models, in the folder that the environment variable VANTAGE_DATA names.

#include <gtest/gtest.h>

#include "vantage/pipeline/find_views.h"

#include "support/data_pack.h"

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

}  // namespace
}  // namespace vantage::test
