// SPDX-License-Identifier: MIT
#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <type_traits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "vantage/core/error.h"
#include "vantage/pipeline/option_table.h"

namespace vantage::test {
namespace {

TEST(Presets, PaperThinsNothingWhateverTheContractionLimit) {
  for_each_number(kContractionFields, [](const auto& field) {
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

TEST(Size, IsExactOrOfThatManyPixels) {
  ViewOptions options;
  set_size(options, "auto");
  EXPECT_TRUE(options.fit_size);
  EXPECT_EQ(options.width * options.height, 800 * 600);
  EXPECT_EQ(size_text(options), "auto");
  set_size(options, "auto:300x200");
  EXPECT_TRUE(options.fit_size);
  EXPECT_EQ(options.width, 300);
  EXPECT_EQ(options.height, 200);
  EXPECT_EQ(size_text(options), "auto:300x200");
  set_size(options, "64");
  EXPECT_FALSE(options.fit_size);
  EXPECT_EQ(size_text(options), "64x64");
  for (const char* wrong : {"auto:", "auto:x", "auto64", "AUTO", "auto:0", "auto:9x99999", ""}) {
    EXPECT_THROW(set_size(options, wrong), InvalidInput) << wrong;
  }
  EXPECT_EQ(size_text(options), "64x64");
}

/// A valid value that is not what the option is by default; nothing for texts.
OptionValue another(const Option& option) {
  const OptionValue now = option.value({});
  switch (option.kind) {
    case OptionKind::Switch:
      return !std::get<bool>(now);
    case OptionKind::Choice:
      return now == OptionValue(option.words.front()) ? option.words.back() : option.words.front();
    case OptionKind::Number:
      return now == OptionValue(option.high) ? option.low : option.high;
    case OptionKind::Integer:
      return now == OptionValue(static_cast<std::uint64_t>(option.low))
                 ? static_cast<std::uint64_t>(option.low) + 1
                 : static_cast<std::uint64_t>(option.low);
    case OptionKind::Text:
      break;
  }
  const std::map<std::string, std::string> texts{{"method", "vmi"},   {"focus", "lamp"},
                                                 {"epsilon", "0.5"},  {"prior", "upright"},
                                                 {"size", "801x600"}, {"background", "#102030"}};
  return texts.at(option.name);
}

TEST(OptionTable, EveryOptionIsWhatItIsSetTo) {
  for (const Option& option : option_table()) {
    AllOptions all;
    option.set(all, another(option));
    EXPECT_EQ(option.value(all), another(option)) << option.name;
    EXPECT_NE(option.value(all), option.value({})) << option.name;
  }
}

TEST(OptionTable, NamesEachOptionOnce) {
  std::set<std::string> names;
  for (const Option& option : option_table()) {
    EXPECT_TRUE(names.insert(option.name).second) << option.name;
    EXPECT_EQ(find_option(option.name).name, option.name);
  }
  EXPECT_THROW(find_option("beauty"), InvalidInput);
}

TEST(OptionTable, RefusesWhatIsOutOfRangeOrOfAnotherKindByName) {
  for (const Option& option : option_table()) {
    const bool is_number = option.kind == OptionKind::Number || option.kind == OptionKind::Integer;
    const OptionValue wrong = is_number ? OptionValue(-7.5) : OptionValue(7.5);
    AllOptions all;
    try {
      option.set(all, wrong);
      ADD_FAILURE() << option.name << " was accepted";
    } catch (const InvalidInput& error) {
      EXPECT_THAT(error.what(), ::testing::StartsWith("option " + option.name + " "));
    }
  }
}

TEST(OptionTable, RefusesAWordThatIsNoChoiceAndListsThose) {
  AllOptions all;
  try {
    find_option("weight").set(all, std::string("areas"));
    ADD_FAILURE() << "was accepted";
  } catch (const InvalidInput& error) {
    EXPECT_STREQ(error.what(), "option weight is 'areas' but must be one of vertex, area");
  }
}

TEST(OptionTable, UnsetsWhatIsOptional) {
  AllOptions all;
  find_option("distance").set(all, 3.0);
  find_option("up").set(all, std::string("z"));
  find_option("distance").set(all, {});
  find_option("up").set(all, std::string("auto"));
  EXPECT_FALSE(all.view.distance_factor.has_value());
  EXPECT_FALSE(all.view.up.has_value());
}

TEST(OptionTable, ARapidSearchBeginsWithACubeUnlessSaidOtherwise) {
  AllOptions all;
  find_option("search").set(all, std::string("rapid"));
  EXPECT_EQ(all.view.search.base, ViewSphereBase::Cube);
  EXPECT_EQ(all.view.search.subdivisions, 0);
  find_option("subdivisions").set(all, std::uint64_t{2});
  EXPECT_EQ(all.view.search.subdivisions, 2);
}

TEST(OptionsHash, ChangesWithEveryOptionOfAView) {
  std::set<std::string> hashes{options_hash({})};
  for (const Option& option : option_table()) {
    if (!option.is_of_pictures) {
      AllOptions all;
      option.set(all, another(option));
      EXPECT_TRUE(hashes.insert(options_hash(all.view)).second) << option.name;
    }
  }
}

TEST(OptionsHash, ChangesWithWhatAPriorSaysAndNotWithItsName) {
  const ViewOptions upright{.prior = upright_prior()};
  ViewOptions stronger = upright;
  stronger.prior.upright.front_strength = 0.1;
  ViewOptions lobed = upright;
  lobed.prior.lobes.emplace_back();
  ViewOptions renamed = upright;
  renamed.prior.name = "copy.json";
  EXPECT_NE(options_hash(stronger), options_hash(upright));
  EXPECT_NE(options_hash(lobed), options_hash(upright));
  EXPECT_EQ(options_hash(renamed), options_hash(upright));
}

TEST(OptionsHash, ChangesWithoutTheSecondMeshWhichDecidesOnLevels) {
  ViewOptions alone;
  alone.contraction.second_mesh = false;
  EXPECT_NE(options_hash(alone), options_hash({}));
}

TEST(OptionsHash, ChangesIfASetOfViewsIsAskedForByItsDefaults) {
  ViewOptions several;
  several.view_set.emplace();
  EXPECT_NE(options_hash(several), options_hash({}));
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

TEST(ModelFrame, IsMadeOfTwoAxesAtRightAngles) {
  static_assert(!std::is_convertible_v<UpAxis, ModelFrame>);
  EXPECT_EQ(ModelFrame(UpAxis::Z).front, UpAxis::MinusY);
  EXPECT_THROW(ModelFrame(UpAxis::Y, UpAxis::Y), InvalidInput);
  EXPECT_THROW(ModelFrame(UpAxis::MinusX, UpAxis::X), InvalidInput);
  EXPECT_THROW(ModelFrame{UpAxis::Any}, InvalidInput);
  EXPECT_THROW(ModelFrame(UpAxis::Y, UpAxis::Any), InvalidInput);
  ModelFrame changed;
  changed.front = UpAxis::MinusY;
  EXPECT_THROW(upright_frame(changed), InvalidInput);
}

}  // namespace
}  // namespace vantage::test
