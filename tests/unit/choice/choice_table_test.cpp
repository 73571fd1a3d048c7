// SPDX-License-Identifier: MIT
#include "choice/choice_table.h"

#include <string>

#include <gtest/gtest.h>

#include "vantage/core/error.h"

namespace vantage::test {
namespace {

constexpr const char* kConstants = "habit 2\nsignificance 3\nbandwidth 0.5\nmirror 0.1\n";

TEST(ChoiceTable, IsReadAsItIsWritten) {
  const ChoiceTable table =
      parse_choice_table(std::string("# of two things\n\n") + kConstants +
                         "view 0.25 -1.5 101 0 0.6 0.8\nview 1 2 010 3 0 4\n");
  EXPECT_EQ(table.habit_weight, 2.0);
  EXPECT_EQ(table.significance_weight, 3.0);
  EXPECT_EQ(table.bandwidth, 0.5);
  EXPECT_EQ(table.mirror_weight, 0.1);
  ASSERT_EQ(table.choices.size(), 2U);
  const RecordedChoice& first = table.choices.front();
  EXPECT_EQ(first.shape.height, 0.25);
  EXPECT_EQ(first.shape.width, -1.5);
  EXPECT_TRUE(first.shape.mirrors_side);
  EXPECT_FALSE(first.shape.mirrors_front);
  EXPECT_TRUE(first.shape.mirrors_up);
  EXPECT_LT((table.choices.back().direction - Vec3(0.6, 0.0, 0.8)).norm(), 1e-15);
}

TEST(ChoiceTable, RefusesWhatItDoesNotUnderstand) {
  for (const char* line : {"views 1 2 000 0 0 1", "view 1 2 00 0 0 1", "view 1 2 000 0 0",
                           "view 1 2 000 0 0 0", "habit much", ""}) {
    EXPECT_THROW(parse_choice_table(std::string(kConstants) + line + "\n"), InvalidInput) << line;
  }
}

TEST(ChoiceTable, ThatIsShippedHoldsHundredsOfViewsMostlyFromAboveAndInFront) {
  const ChoiceTable& table = choice_table();
  EXPECT_GT(table.habit_weight, 0.0);
  EXPECT_GT(table.significance_weight, 0.0);
  ASSERT_GT(table.choices.size(), 300U);
  std::size_t usual = 0;
  for (const RecordedChoice& choice : table.choices) {
    EXPECT_NEAR(choice.direction.norm(), 1.0, 1e-12);
    usual += choice.direction.y() > 0.0 && choice.direction.z() > 0.0 ? 1 : 0;
  }
  EXPECT_GT(usual * 4, table.choices.size() * 3);
}

}  // namespace
}  // namespace vantage::test
