// SPDX-License-Identifier: MIT
#include "vantage/core/version.h"

#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace vantage {
namespace {

using ::testing::MatchesRegex;

TEST(Version, IsThreeNumbersWithDots) {
  EXPECT_THAT(std::string(version()), MatchesRegex("[0-9]+\\.[0-9]+\\.[0-9]+"));
}

TEST(LibraryVersions, NameEachLibraryThatShapesTheResultsOnOneLine) {
  const std::string line = library_versions();
  EXPECT_THAT(line, MatchesRegex("Eigen 3\\.[0-9.]+, oneTBB [0-9.]+, Embree [0-9.]+"));
}

}  // namespace
}  // namespace vantage
