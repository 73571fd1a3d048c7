// SPDX-License-Identifier: MIT
// The whole method on real models, in the folder that the environment variable VANTAGE_DATA names.

#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

#include "vantage/pipeline/find_views.h"

#include "core/spearman.h"
#include "support/data_pack.h"
#include "support/shapes.h"

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

using RealPlate = RealModel;

// Steps three times as large are stuck in one order of the vertices and not in the other.
TEST_P(RealPlate, HasItsMapInAnyOrderOfVertices) {
  const ShapeAnalysis shape = analyse_shape(model, {});
  for (const unsigned seed : {1U, 2U, 3U, 4U}) {
    std::vector<std::uint32_t> old_of_new;
    Model other = model;
    other.mesh = renumbered(model.mesh, seed, &old_of_new);
    const ShapeAnalysis again = analyse_shape(other, {});
    const std::vector<double> found = on_input_vertices(again, again.significance);
    std::vector<double> back(found.size());
    for (std::size_t v = 0; v < found.size(); ++v) {
      back[old_of_new[v]] = found[v];
    }
    EXPECT_GT(spearman(on_input_vertices(shape, shape.significance), back), 0.99) << seed;
  }
}

INSTANTIATE_TEST_SUITE_P(DataPack, RealPlate,
                         testing::Values("nasty/libigl/inspired_mesh_quads_Smooth.off"));

}  // namespace
}  // namespace vantage::test
