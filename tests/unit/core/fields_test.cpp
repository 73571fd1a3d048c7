// SPDX-License-Identifier: MIT
#include "vantage/core/fields.h"

#include <limits>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace vantage {
namespace {

struct Options {
  double ratio = 0.5;
  int count = 3;
};

constexpr auto kFields = std::tuple{
    Field{"ratio", &Options::ratio, 0.0, 1.0, "a ratio"},
    Field{"count", &Options::count, 1, 9, "a count"},
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
  EXPECT_EQ(names, "ratio count ");
}

}  // namespace
}  // namespace vantage
