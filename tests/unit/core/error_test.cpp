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

}  // namespace
}  // namespace vantage
