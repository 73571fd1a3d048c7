// SPDX-License-Identifier: MIT
#include "vantage/core/fields.h"

#include <limits>
#include <optional>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace vantage {
namespace {

struct Options {
  double ratio = 0.5;
  int count = 3;
  std::optional<double> share{};
  bool is_on = true;
};

constexpr auto kFields = std::tuple{
    Field{"ratio", &Options::ratio, 0.0, 1.0, "a ratio"},
    Field{"count", &Options::count, 1, 9, "a count"},
    Field{"share", &Options::share, 0.0, 1.0, "an optional number"},
    Switch{"on", &Options::is_on, "a switch", "the same, off"},
};

std::string complaint(const Options& options) {
  try {
    check_fields(options, kFields);
  } catch (const InvalidInput& error) {
    return error.what();
  }
  return "";
}

TEST(CheckFields, AcceptsValuesInRange) {
  EXPECT_EQ(complaint({}), "");
}

TEST(CheckFields, CountsBothEndsOfTheRangeAsInside) {
  EXPECT_EQ(complaint({.ratio = 0.0, .count = 1}), "");
  EXPECT_EQ(complaint({.ratio = 1.0, .count = 9}), "");
}

TEST(CheckFields, NamesTheOptionItsValueAndItsRange) {
  EXPECT_EQ(complaint({.ratio = 0.5, .count = 10}),
            "option count is 10 but must be between 1 and 9");
}

TEST(CheckFields, ChecksAnOptionalNumberWhereThereIsOne) {
  EXPECT_EQ(complaint({.share = 1.0}), "");
  EXPECT_EQ(complaint({.share = 1.5}), "option share is 1.5 but must be between 0 and 1");
}

TEST(CheckFields, RefusesNotANumber) {
  EXPECT_THAT(complaint({.ratio = std::numeric_limits<double>::quiet_NaN()}),
              ::testing::StartsWith("option ratio is"));
}

TEST(CheckFields, RefusesInfinity) {
  EXPECT_THAT(complaint({.ratio = std::numeric_limits<double>::infinity()}),
              ::testing::StartsWith("option ratio is inf"));
}

TEST(ForEachField, VisitsInOrderOfTheTable) {
  std::string names;
  for_each_field(kFields, [&](const auto& field) { names += std::string(field.name) + ' '; });
  EXPECT_EQ(names, "ratio count share on ");
}

TEST(ForEachNumber, LeavesOutWhatIsNone) {
  std::string names;
  for_each_number(kFields, [&](const auto& field) { names += std::string(field.name) + ' '; });
  EXPECT_EQ(names, "ratio count share ");
}

TEST(Words, AreFoundByPlaceAndByName) {
  EXPECT_EQ(word_at("one|two|three", 0), "one");
  EXPECT_EQ(word_at("one|two|three", 2), "three");
  EXPECT_EQ(word_at("one|two|three", 9), "three");
  EXPECT_EQ(index_of_word("one|two|three", "two"), 1U);
  EXPECT_EQ(index_of_word("one|two|three", "tw"), std::nullopt);
  EXPECT_EQ(index_of_word("one|two|three", ""), std::nullopt);
}

}  // namespace
}  // namespace vantage
