// SPDX-License-Identifier: MIT
#include "vantage/core/error.h"

#include <cerrno>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace vantage {
namespace {

TEST(FormatErrorText, NamesFilePlaceAndProblem) {
  EXPECT_STREQ(FormatError("dragon.off", "line 17", "expected 3 coordinates, found 2").what(),
               "dragon.off, line 17: expected 3 coordinates, found 2");
}

TEST(FormatErrorText, LeavesOutAPlaceThatIsNotKnown) {
  EXPECT_STREQ(FormatError("dragon.off", "", "the file is empty").what(),
               "dragon.off: the file is empty");
}

TEST(IoErrorText, GivesTheReasonOfTheSystem) {
  const IoError error("a.ply", "cannot be opened", ENOENT);
  EXPECT_EQ(error.error_number(), ENOENT);
  EXPECT_THAT(error.what(), ::testing::StartsWith("a.ply: cannot be opened ("));
}

TEST(IoErrorText, DoesNotInventAReason) {
  EXPECT_STREQ(IoError("a.ply", "is a folder").what(), "a.ply: is a folder");
}

TEST(Errors, AreAllCaughtByTheirRoot) {
  EXPECT_THROW(throw Cancelled(), Error);
  EXPECT_THROW(throw InvalidInput("x"), Error);
  EXPECT_THROW(throw SolverError("x"), Error);
  EXPECT_THROW(throw IoError("f", "x"), Error);
  EXPECT_THROW(throw FormatError("f", "", "x"), Error);
}

TEST(Printable, KeepsLettersOfAllScriptsAndNothingThatATerminalWouldObey) {
  EXPECT_EQ(printable("Möbel/椅子.png 🪑"), "Möbel/椅子.png 🪑");
  EXPECT_EQ(printable("a\x1b[2Jb\tc\x7f"), "a?[2Jb?c?");
  EXPECT_EQ(printable("a\xC2\x9B"
                      "b"),
            "a?b");  // C1
  EXPECT_EQ(printable("a\xE2\x80\xAE"
                      "b"),
            "a?b");  // writes to the left from here on
}

TEST(Printable, MarksBytesThatAreNoUtf8) {
  EXPECT_EQ(printable("M\xF6"
                      "bel"),
            "M?bel");                                // Latin-1
  EXPECT_EQ(printable("\xC0\xAF"), "??");            // longer than need be
  EXPECT_EQ(printable("\xED\xA0\x80"), "???");       // a surrogate
  EXPECT_EQ(printable("a\xE6\xA4"), "a??");          // cut off
  EXPECT_EQ(printable("\xF4\x90\x80\x80"), "????");  // beyond the last letter
}

}  // namespace
}  // namespace vantage
