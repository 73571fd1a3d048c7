// SPDX-License-Identifier: MIT
// Identities of the channel on real meshes, in the folder that VANTAGE_DATA names.
#include <cmath>

#include <gtest/gtest.h>

#include "vantage/io/model.h"
#include "vantage/view/measurer.h"

#include "support/data_pack.h"

namespace vantage {
namespace {

constexpr double kBits = 1e-9;

class MeasuresOfRealModel : public test::DataPackTest<testing::TestWithParam<const char*>> {};

TEST_P(MeasuresOfRealModel, KeepTheIdentitiesOfTheChannel) {
  const OrientedMesh oriented = orient_shells(load_model((root() / GetParam()).string()).mesh);
  MeasureSubject subject;
  subject.surface = &oriented.mesh;
  subject.sides = oriented.sides;
  subject.camera = {.sphere = enclosing_sphere(referenced_points(oriented.mesh))};
  // 42 views: identities hold for any set.
  ViewMeasurer measurer(subject,
                        {find_measure("vmi"), find_measure("i2"), find_measure("i3"),
                         find_measure("viewpoint-entropy"), find_measure("instability")},
                        1);
  const MeasureValues values = measurer.set_values();
  const ChannelTerms& terms = measurer.model().terms;
  double total = 0.0;
  double vmi = 0.0;
  double i2 = 0.0;
  double i3 = 0.0;
  for (std::size_t i = 0; i < terms.area_of_view.size(); ++i) {
    const double area = terms.area_of_view[i];
    total += area;
    vmi += area * values[0][i];
    i2 += area * values[1][i];
    i3 += area * values[2][i];
    EXPECT_NEAR(values[1][i] + values[3][i], terms.entropy_of_faces, kBits);
    EXPECT_GE(values[0][i], 0.0);
    const auto faces = static_cast<double>(measurer.model().set_views[i].size());
    EXPECT_LE(values[3][i], std::log2(faces) + kBits);
    EXPECT_GE(values[4][i], 0.0);
    EXPECT_LE(values[4][i], 1.0);
  }
  EXPECT_NEAR(vmi / total, terms.mutual_information, kBits);
  EXPECT_NEAR(i2 / total, terms.mutual_information, kBits);
  EXPECT_NEAR(i3 / total, terms.mutual_information, kBits);
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
