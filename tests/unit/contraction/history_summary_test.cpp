// SPDX-License-Identifier: MIT
#include "contraction/history_summary.h"

#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace vantage {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

TEST(Summarise, WeighsShrinkageByVerticesAndKeepsTheLastOfThoseThatEndedEarlier) {
  const ComponentHistory small{.shrinkage = {1.0, 0.5}, .summary = {.vertices = 10}};
  const ComponentHistory large{.shrinkage = {1.0, 0.8, 0.2}, .summary = {.vertices = 30}};
  ContractionHistory history;
  history.levels.resize(3);
  const std::vector<ComponentHistory> parts{small, large};
  summarise(parts, history);
  EXPECT_THAT(history.shrinkage, ElementsAre(1.0, (5.0 + 24.0) / 40.0, (5.0 + 6.0) / 40.0));
  ASSERT_EQ(history.components.size(), 2U);
  EXPECT_EQ(history.components[0].shrinkage, 0.5);
  EXPECT_THAT(history.warnings, ElementsAre());
}

TEST(Summarise, WarnsOfStepsThatWereMendedAndOfSystemsThatCouldNotBeSolved) {
  ComponentHistory one{.shrinkage = {1.0}, .summary = {.vertices = 4}};
  one.summary.stop = ContractionStop::SolverFailed;
  one.summary.remedies = {"step 2 rose and was split"};
  const ComponentHistory other{.shrinkage = {1.0}, .summary = {.vertices = 4}};
  ContractionHistory history;
  history.levels.resize(1);
  const std::vector<ComponentHistory> parts{other, one};
  summarise(parts, history);
  EXPECT_THAT(history.warnings, ElementsAre("contraction of component 2: step 2 rose and was split",
                                            HasSubstr("1 component ended early")));
}

TEST(Summarise, CountsWarningsThatItLeavesOut) {
  ComponentHistory one{.shrinkage = {1.0}, .summary = {.vertices = 4}};
  one.summary.remedies.assign(7, "a copy of 500 vertices was contracted instead");
  ContractionHistory history;
  history.levels.resize(1);
  const std::vector<ComponentHistory> parts{one};
  summarise(parts, history);
  ASSERT_EQ(history.warnings.size(), 6U);
  EXPECT_EQ(history.warnings.back(), "contraction: 2 more warnings like these are left out");
}

}  // namespace
}  // namespace vantage
