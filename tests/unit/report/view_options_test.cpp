// SPDX-License-Identifier: MIT
#include <functional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>

#include "vantage/report/view_report.h"

namespace vantage::test {
namespace {

TEST(Presets, PaperThinsNothingWhateverTheContractionLimit) {
  for_each_field(kContractionFields, [](const auto& field) {
    if (std::string_view(field.name) == "contraction-limit") {
      EXPECT_LE(preset_options(Preset::Paper).contraction.sheet_limit, field.low);
    }
  });
}

TEST(Presets, PaperIsBoxScalingRapidSearchFromACubeAndARawEpsilon) {
  const ViewOptions paper = preset_options(Preset::Paper);
  EXPECT_EQ(paper.contraction.scaling, ContractionScaling::Box);
  EXPECT_EQ(paper.search.strategy, SearchStrategy::Rapid);
  EXPECT_EQ(paper.search.base, ViewSphereBase::Cube);
  EXPECT_EQ(paper.search.subdivisions, 0);
  EXPECT_EQ(paper.search.epsilon, 0.1);
  EXPECT_FALSE(paper.search.epsilon_is_fraction);
  EXPECT_FALSE(paper.search.require_narrow_ring);
  EXPECT_FALSE(paper.kssm_to_finished_graph);
  EXPECT_EQ(paper.kssm.suppression, Suppression::Mean);
}

TEST(OptionsHash, ChangesWithEveryOptionThatShapesTheResult) {
  using Change = std::function<void(ViewOptions&)>;
  const std::vector<Change> changes{
      [](ViewOptions&) {},
      [](ViewOptions& o) { o.preset = Preset::Paper; },
      [](ViewOptions& o) { o.contraction.scaling = ContractionScaling::Box; },
      [](ViewOptions& o) { o.contraction.contraction_growth = 2.0; },
      [](ViewOptions& o) { o.contraction.max_steps = 7; },
      [](ViewOptions& o) { o.skeleton.spacing = 0.03; },
      [](ViewOptions& o) { o.skeleton.prune = false; },
      [](ViewOptions& o) { o.skeleton.centre = false; },
      [](ViewOptions& o) { o.kssm.suppression = Suppression::LocalMaxima; },
      [](ViewOptions& o) { o.kssm.kinematics = Kinematics::Velocity; },
      [](ViewOptions& o) { o.kssm_to_finished_graph = true; },
      [](ViewOptions& o) { o.search.strategy = SearchStrategy::Rapid; },
      [](ViewOptions& o) { o.search.subdivisions = 2; },
      [](ViewOptions& o) { o.search.epsilon = 0.5; },
      [](ViewOptions& o) { o.search.epsilon_is_fraction = false; },
      [](ViewOptions& o) { o.projection = Projection::Orthographic; },
      [](ViewOptions& o) { o.fov_y_deg = 40.0; },
      [](ViewOptions& o) { o.distance_factor = 3.0; },
      [](ViewOptions& o) { o.up = UpAxis::Z; },
      [](ViewOptions& o) { o.prior = no_prior(); },
      [](ViewOptions& o) { o.prior.upright.front_strength = 0.1; },
      [](ViewOptions& o) { o.prior.lobes.emplace_back(); },
      [](ViewOptions& o) { o.width = 801; },
  };
  std::set<std::string> hashes;
  for (const Change& change : changes) {
    ViewOptions options;
    change(options);
    hashes.insert(options_hash(options));
  }
  EXPECT_EQ(hashes.size(), changes.size());
}

TEST(UpAxis, IsZForStlAndYOtherwise) {
  EXPECT_EQ(default_up(ModelFormat::Stl), UpAxis::Z);
  for (const ModelFormat format : {ModelFormat::Obj, ModelFormat::Off, ModelFormat::Ply,
                                   ModelFormat::Gltf, ModelFormat::Glb}) {
    EXPECT_EQ(default_up(format), UpAxis::Y);
  }
  EXPECT_EQ(up_name(UpAxis::MinusZ), "-z");
  EXPECT_EQ(up_vector(UpAxis::MinusZ), Vec3(0.0, 0.0, -1.0));
}

}  // namespace
}  // namespace vantage::test
