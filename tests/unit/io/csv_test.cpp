// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "vantage/core/error.h"
#include "vantage/io/model.h"

namespace vantage::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr std::array<std::string_view, 3> kDirection = {"dx", "dy", "dz"};

std::string csv_error(std::string_view text) {
  try {
    parse_directions_csv(text, "d.csv", kDirection);
  } catch (const FormatError& error) {
    return error.what();
  }
  return "nothing";
}

TEST(PointsCsv, ReadsNumbersWithoutHeader) {
  EXPECT_THAT(parse_points_csv("1,2,3\r\n\n# note\n -1 , .5,1e2 \n", "d.csv", kDirection),
              ElementsAre(Vec3(1, 2, 3), Vec3(-1, 0.5, 100)));
}

TEST(PointsCsv, FindsItsColumnsInTheHeader) {
  EXPECT_THAT(parse_points_csv("method,dz,dy,\"dx\",score\nkssm,3,2,1,9\n", "d.csv", kDirection),
              ElementsAre(Vec3(1, 2, 3)));
}

TEST(PointsCsv, ACommaInQuotesEndsNoField) {
  EXPECT_THAT(parse_points_csv("name,dx,dy,dz\n\"a,5,6,7,\"\"b\",1,2,3\n", "d.csv", kDirection),
              ElementsAre(Vec3(1, 2, 3)));
}

TEST(PointsCsv, AnEmptyFileHasNoPoints) {
  EXPECT_THAT(parse_points_csv("", "d.csv", kDirection), IsEmpty());
}

TEST(PointsCsv, NamesTheLineOfAnError) {
  EXPECT_THAT(csv_error("1,2,3\n1,2\n"), HasSubstr("d.csv, line 2: expected a value for dz"));
  EXPECT_THAT(csv_error("1,2,3\n1,x,3\n"), HasSubstr("line 2: column dy: expected a number"));
  EXPECT_THAT(csv_error("1,2,nan\n"), HasSubstr("line 1: column dz: 'nan' is not a finite number"));
  EXPECT_THAT(csv_error("1,2,3\n\n0,0,0\n"), HasSubstr("line 3: a direction must be neither zero"));
  EXPECT_THAT(csv_error("# \n1.7e308,1.7e308,1.7e308\n"), HasSubstr("line 2: a direction must be"));
  EXPECT_THAT(csv_error("x,y,z\n1,2,3\n"), HasSubstr("line 1: the header has no column dx"));
}

}  // namespace
}  // namespace vantage::test
