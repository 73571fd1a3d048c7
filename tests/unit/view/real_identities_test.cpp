// SPDX-License-Identifier: MIT
// Identities of the channel on real meshes, in the folder that VANTAGE_DATA names.
#include <gtest/gtest.h>

#include "vantage/io/model.h"
#include "vantage/view/measure.h"

#include "support/channel_identities.h"
#include "support/data_pack.h"

namespace vantage {
namespace {

class MeasuresOfRealModel : public test::DataPackTest<testing::TestWithParam<const char*>> {};

TEST_P(MeasuresOfRealModel, KeepTheIdentitiesOfTheChannel) {
  const OrientedMesh oriented = orient_shells(load_model((root() / GetParam()).string()).mesh);
  MeasureSubject subject;
  subject.surface = &oriented.mesh;
  subject.sides = oriented.sides;
  subject.camera = {.sphere = enclosing_sphere(referenced_points(oriented.mesh))};
  // 42 views: identities hold for any set.
  ViewMeasurer measurer(subject, test::channel_measures(), 1);
  test::expect_channel_identities(measurer);
  test::expect_merging_tells_no_more(measurer.model());
}

INSTANTIATE_TEST_SUITE_P(DataPack, MeasuresOfRealModel,
                         testing::Values("paper/cow_2904.off", "paper/dinosaur_5026_qem.ply",
                                         "paper/dinosaur_9851_open.off",
                                         "paper/rocker-arm_10044.off", "clean/scad_example009.off",
                                         "clean/sh3d_cat.obj", "clean/sh3d_dog.obj",
                                         "clean/block.off", "clean/torus.obj", "clean/goathead.obj",
                                         "clean/triceratops.off", "clean/scad_candleStand.off",
                                         "clean/scad_example020.off", "clean/wingnut.obj",
                                         "clean/anchor_dense.off", "clean/wolf.obj",
                                         "clean/homer.obj", "clean/knot2.off",
                                         "clean/scorpion_low_resolution.obj", "clean/octpus.off"));

}  // namespace
}  // namespace vantage
