// SPDX-License-Identifier: MIT
// Convergence of all measures that look at samples, on meshes of few large faces in the folder that
// VANTAGE_DATA names: there a sliver of a face weighs most.
#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "vantage/io/model.h"
#include "vantage/report/measured_shape.h"
#include "vantage/view/measurer.h"

#include "support/data_pack.h"

namespace vantage {
namespace {

/// A model and the set of views that it is looked at from: 12 at level 0, 42 at 1, 162 at 2.
struct Case {
  const char* file;
  int level;
};

/// The measures that hang on samples: the others ask for vertices alone.
std::vector<Measure> sampled_measures() {
  std::vector<Measure> measures;
  for (const Measure& measure : builtin_measures()) {
    if (measure.needs.faces || measure.needs.channel || measure.needs.outline) {
      measures.push_back(measure);
    }
  }
  return measures;
}

MeasureValues values_at(const OrientedMesh& oriented, int level, int sampling) {
  MeasureSubject subject;
  subject.surface = &oriented.mesh;
  subject.sides = oriented.sides;
  subject.camera = {.sphere = enclosing_sphere(referenced_points(oriented.mesh))};
  subject.sampling = sampling;
  return ViewMeasurer(subject, sampled_measures(), level).set_values();
}

/// Values of the measures that sum a map, by area, with the model's own map.
MeasureValues sums_by_area(const ShapeAnalysis& shape, int level, int sampling) {
  MeasureSubject subject = measure_subject(shape, {.weight = Weight::Area});
  subject.sampling = sampling;
  return ViewMeasurer(subject, {find_measure("kssm"), find_measure("mesh-saliency")}, level)
      .set_values();
}

/// Largest change over the range of the finer values.
double change_over_range(const std::vector<double>& used, const std::vector<double>& finer) {
  const auto [low, high] = std::minmax_element(finer.begin(), finer.end());
  double change = 0.0;
  for (std::size_t i = 0; i < finer.size(); ++i) {
    change = std::max(change, std::abs(used[i] - finer[i]));
  }
  return change / (*high - *low);
}

class SamplesTwiceAsNear : public test::DataPackTest<testing::TestWithParam<Case>> {};

TEST_P(SamplesTwiceAsNear, ChangeNoMeasureByAHundredthOfItsRange) {
  const auto& [file, level] = GetParam();
  const OrientedMesh oriented = orient_shells(load_model((root() / file).string()).mesh);
  const std::vector<Measure> measures = sampled_measures();
  const MeasureValues used = values_at(oriented, level, 1);
  const MeasureValues finer = values_at(oriented, level, 2);
  for (std::size_t m = 0; m < measures.size(); ++m) {
    if (used[m] != finer[m]) {
      EXPECT_LE(change_over_range(used[m], finer[m]), 0.01) << measures[m].name;
    }
  }
}

TEST_P(SamplesTwiceAsNear, ChangeNoScoreByAreaByAHundredthOfItsRange) {
  const auto& [file, level] = GetParam();
  const ShapeAnalysis shape =
      analyse_shape(load_model((root() / file).string()), {.weight = Weight::Area});
  const MeasureValues used = sums_by_area(shape, level, 1);
  const MeasureValues finer = sums_by_area(shape, level, 2);
  for (std::size_t m = 0; m < used.size(); ++m) {
    EXPECT_GT(change_over_range(used[m], finer[m]), 0.0) << "nothing was sampled anew";
    EXPECT_LE(change_over_range(used[m], finer[m]), 0.01);
  }
  // The search's scores are the measure's values.
  const FaceVisibility faces(shape.surface, shape.sides);
  const ViewScorer scorer(faces, shape.map.of_vertex, scoring_camera(shape, {}));
  EXPECT_EQ(scorer.score_all(direction_set(ViewSphereBase::Icosahedron, level).directions),
            used[0]);
}

INSTANTIATE_TEST_SUITE_P(DataPack, SamplesTwiceAsNear,
                         testing::Values(Case{"clean/scad_example009.off", 1},
                                         Case{"clean/sh3d_cat.obj", 2},
                                         Case{"clean/sh3d_dog.obj", 2}, Case{"clean/block.off", 1},
                                         Case{"clean/torus.obj", 1},
                                         Case{"clean/triceratops.off", 1},
                                         Case{"paper/rocker-arm_10044.off", 0},
                                         // Of more than 60 000 faces samples tell.
                                         Case{"paper/armadillo_43243.obj", 0}));

}  // namespace
}  // namespace vantage
