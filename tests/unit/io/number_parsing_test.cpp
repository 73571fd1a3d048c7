// SPDX-License-Identifier: MIT
#include "io/number_parsing.h"

#include <cmath>
#include <limits>
#include <string>

#include <gtest/gtest.h>

namespace vantage {
namespace {

TEST(NumberParsing, AcceptsALeadingPlus) {
  EXPECT_EQ(number_from("+1.5"), 1.5);
}

TEST(NumberParsing, AcceptsNumbersWithoutDigitsOnOneSideOfThePoint) {
  EXPECT_EQ(number_from("-.5"), -0.5);
  EXPECT_EQ(number_from("5."), 5.0);
}

TEST(NumberParsing, RefusesForeignNotations) {
  for (const char* token :
       {"", "+", "1,5", "1d3", "0x10", "1_000", "1.#IND", "+-1", "1 2", "--1"}) {
    EXPECT_FALSE(number_from(token).has_value()) << token;
  }
}

TEST(NumberParsing, GivesZeroBelowTheSmallestDoubleAndInfinityAboveTheLargest) {
  EXPECT_EQ(number_from("1e-400"), 0.0);
  EXPECT_EQ(number_from("0.0000001e-400"), 0.0);
  EXPECT_EQ(number_from("1e400"), std::numeric_limits<double>::infinity());
  EXPECT_EQ(number_from("-1e400"), -std::numeric_limits<double>::infinity());
}

TEST(NumberParsing, AFloatWrittenWithNineDigitsDoesNotNeedDouble) {
  EXPECT_FALSE(needs_double("0.100000001", 0.100000001));  // the float nearest to 0.1
  EXPECT_FALSE(needs_double("1.00000000000", 1.0));
}

TEST(NumberParsing, MoreDigitsThanAFloatHoldsNeedDouble) {
  EXPECT_TRUE(needs_double("0.10000000000000001", 0.1));
  EXPECT_TRUE(needs_double("4567890.123", 4567890.123));
  EXPECT_TRUE(needs_double("1e60000", 1e300));
}

TEST(NumberParsing, WholeNumbersBeyond64BitsAreClamped) {
  EXPECT_EQ(integer_from("99999999999999999999"), std::numeric_limits<std::int64_t>::max());
  EXPECT_EQ(integer_from("-99999999999999999999"), std::numeric_limits<std::int64_t>::min());
  EXPECT_FALSE(integer_from("1.0").has_value());
}

TEST(InQuotes, ShowsLettersOfAllScripts) {
  EXPECT_EQ(in_quotes("Möbel/椅子.png"), "'Möbel/椅子.png'");
  EXPECT_EQ(in_quotes("a\x07"
                      "b"),
            "'a?b'");
}

TEST(InQuotes, CutsLongTokensBetweenLetters) {
  const std::string ascii(40, 'x');
  EXPECT_EQ(in_quotes(ascii), "'" + ascii + "'");
  EXPECT_EQ(in_quotes(ascii + "y"), "'" + ascii + "…'");
  const std::string before(39, 'x');
  EXPECT_EQ(in_quotes(before + "椅子"), "'" + before + "…'");  // three bytes from the 40th on
  EXPECT_EQ(in_quotes(std::string(50, '\x80')), "'" + std::string(36, '?') + "…'");  // no letters
}

}  // namespace
}  // namespace vantage
