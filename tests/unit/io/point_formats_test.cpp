// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "vantage/io/model.h"

#include "io/byte_cursor.h"
#include "io/pcd_header.h"
#include "unit/io/error_text.h"

namespace vantage::test {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

std::string pcd(const std::string& points, const std::string& data) {
  return "# .PCD v0.7\nVERSION 0.7\nFIELDS x y z tag\nSIZE 4 4 4 1\nTYPE F F F U\nCOUNT 1 1 1 1\n"
         "WIDTH " +
         points + "\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS " + points + "\nDATA " + data + "\n";
}

TEST(Pcd, ReadsText) {
  const Model model = parse_model(pcd("2", "ascii") + "1 2 3 9\n4 5 6 9\n", "a.pcd");
  EXPECT_THAT(model.mesh.positions, ElementsAre(Vec3(1, 2, 3), Vec3(4, 5, 6)));
}

TEST(Pcd, NotesColoursThatItDoesNotRead) {
  std::string text = pcd("1", "ascii") + "1 2 3 9\n";
  EXPECT_TRUE(parse_model(text, "a.pcd").notes.empty());
  const std::size_t fields = text.find("FIELDS");
  const std::size_t last = text.rfind(' ', text.find('\n', fields)) + 1;
  text.replace(last, text.find('\n', fields) - last, "rgb");
  EXPECT_THAT(parse_model(text, "a.pcd").notes, ElementsAre("colours of points left out"));
}

TEST(Pcd, PassesOverAByteOrderMark) {
  const Model model = parse_model("\xEF\xBB\xBF" + pcd("1", "ascii") + "1 2 3 9\n", "a");
  EXPECT_EQ(model.format, ModelFormat::Pcd);
  EXPECT_THAT(model.mesh.positions, ElementsAre(Vec3(1, 2, 3)));
}

TEST(Pcd, LeavesOutPointsWithoutAPosition) {
  const Model model = parse_model(pcd("2", "ascii") + "nan nan nan 9\n4 5 6 9\n", "a.pcd");
  EXPECT_THAT(model.mesh.positions, ElementsAre(Vec3(4, 5, 6)));
}

TEST(Pcd, ReadsBinary) {
  std::string bytes = pcd("2", "binary");
  for (const float value : {1.0F, 4.0F}) {
    for (int c = 0; c < 3; ++c) {
      append_little_endian(bytes, value + static_cast<float>(c));
    }
    bytes += '\x09';
  }
  EXPECT_THAT(parse_model(bytes, "a.pcd").mesh.positions,
              ElementsAre(Vec3(1, 2, 3), Vec3(4, 5, 6)));
}

TEST(Pcd, ReadsCompressedColumnsOfLiterals) {
  std::string columns;
  for (const float value : {1.0F, 4.0F, 2.0F, 5.0F, 3.0F, 6.0F}) {
    append_little_endian(columns, value);
  }
  columns += "\x09\x09";
  const std::string packed = '\x19' + columns;  // 26 literal bytes: control 25
  std::string bytes = pcd("2", "binary_compressed");
  append_little_endian(bytes, static_cast<std::uint32_t>(packed.size()));
  append_little_endian(bytes, static_cast<std::uint32_t>(columns.size()));
  EXPECT_THAT(parse_model(bytes + packed, "a.pcd").mesh.positions,
              ElementsAre(Vec3(1, 2, 3), Vec3(4, 5, 6)));
}

TEST(Pcd, RefusesMorePointsThanTheFileHolds) {
  EXPECT_THAT(error_text(pcd("2000000000", "binary") + "abc", "a.pcd"),
              HasSubstr("more than the file holds"));
}

TEST(Pcd, CountsPointsBeforeTheyAreUnpacked) {
  for (const std::string kind : {"ascii", "binary", "binary_compressed"}) {
    EXPECT_THAT(error_text(pcd("6", kind) + "1", "a.pcd", {.max_faces = 1}),
                HasSubstr("has more than 1 points"))
        << kind;
  }
}

TEST(Pcd, NotesWhatFollowsTheLastPoint) {
  EXPECT_THAT(parse_model(pcd("1", "ascii") + "1 2 3 9\n4 5 6 9\n", "a.pcd").notes,
              ElementsAre("text after the last point left out, from line 13"));
  EXPECT_THAT(parse_model(pcd("1", "binary") + std::string(13 + 4, '\1'), "a.pcd").notes,
              ElementsAre("bytes after the last point left out: 4"));
}

TEST(Lzf, UnpacksAReferenceThatOverlapsItself) {
  std::string out;
  // One literal, then 5 bytes from 1 back: length 3 + 2, distance 0 + 1.
  EXPECT_TRUE(unpack_lzf(std::string("\x00"
                                     "a\x60\x00",
                                     4),
                         6, out));
  EXPECT_EQ(out, "aaaaaa");
}

TEST(Lzf, RefusesAReferenceBeforeTheBeginning) {
  std::string out;
  EXPECT_FALSE(unpack_lzf(std::string("\x00"
                                      "a\x60\x01",
                                      4),
                          6, out));
}

TEST(PointList, LeavesOutPointsWithoutAPosition) {
  for (const std::string name : {"a.xyz", "a.pts", "a.pwn"}) {
    const Model model = parse_model("2\nnan nan nan\n4 5 6\n", name);
    EXPECT_THAT(model.mesh.positions, ElementsAre(Vec3(4, 5, 6))) << name;
    EXPECT_THAT(model.notes, ElementsAre("points without a position (NaN) left out: 1")) << name;
  }
  EXPECT_EQ(parse_model("1\nnan 0 0\n1\n7 8 9\n", "a.pts").mesh.positions.size(), 1U);
  EXPECT_THAT(error_text("nan nan nan\n", "a.xyz"),
              HasSubstr("neither faces nor points; points without a position (NaN) left out: 1"));
  EXPECT_THAT(error_text("1 2 3\ninf 2 3\n", "a.xyz"), HasSubstr("line 2: 'inf' is infinite"));
}

TEST(PointList, PassesOverHeadingAndFurtherColumns) {
  const Model model = parse_model("2\n1 2 3 0 0 1\n4,5,6\n", "a.pwn");
  EXPECT_THAT(model.mesh.positions, ElementsAre(Vec3(1, 2, 3), Vec3(4, 5, 6)));
}

TEST(PointList, RefusesCommasThatMayBelongToNumbers) {
  for (const std::string line : {"0,5 2,5 3,5", "0,5;2,5;3,5", "0,5; 2,5; 3,5", "0,5\t2\t3",
                                 "1 2 3,5", "1;2;3,5", "0,5 2", "1, 2; 3"}) {
    EXPECT_THAT(error_text("1 2 3\n" + line + "\n", "a.xyz"),
                AllOf(HasSubstr("line 2"), HasSubstr("write numbers with a point")))
        << line;
  }
}

TEST(PointList, ReadsColumnsPartedInOneWay) {
  for (const std::string line :
       {"1,-2,3", "1, -2, 3", "  1,-2,  3", "1;-2;3", "1 ; -2 ; 3", "1\t-2\t3",
        "1,-2,3 # seen twice", "1,-2,3;4", "1 -2 3 4,5", "1,-2 ,3"}) {
    EXPECT_THAT(parse_model(line + "\n", "a.xyz").mesh.positions, ElementsAre(Vec3(1, -2, 3)))
        << line;
  }
}

TEST(PointList, ReadsAllScansOfAPts) {
  const std::string text = "2\n1 2 3 -5 9 9 9\n4 5 6 -5 9 9 9\n\n1\n7 8 9 -5 9 9 9\n";
  const Model model = parse_model(text, "a.pts");
  EXPECT_THAT(model.mesh.positions, ElementsAre(Vec3(1, 2, 3), Vec3(4, 5, 6), Vec3(7, 8, 9)));
  EXPECT_THAT(model.notes, ElementsAre("colours or normals behind the coordinates left out",
                                       HasSubstr("scans of the file, all read: 2")));
  EXPECT_TRUE(parse_model("1 2 3 0.5\n4 5 6 0.5\n", "a.xyz").notes.empty()) << "an intensity";
  EXPECT_THAT(error_text(text, "a.xyz"), HasSubstr("expected 3 coordinates, found 1"));
  // Not after the number of points that was said.
  EXPECT_THAT(error_text("2\n1 2 3\n4\n7 8 9\n", "a.pts"), HasSubstr("line 3"));
}

TEST(PointList, HoldsTheCountOfAHeadingAgainstThePoints) {
  for (const std::string name : {"a.pts", "a.pwn"}) {
    EXPECT_THAT(error_text("1000\n0 0 0\n1 0 0\n", name),
                HasSubstr("line 3: the heading declares 1000 points, the file ends after 2"));
    const Model model = parse_model("1\n0 0 0\n1 0 0\n0 1 0 \n", name);
    EXPECT_EQ(model.mesh.positions.size(), 3U);
    EXPECT_THAT(model.notes,
                ElementsAre("points beyond those that the heading declares, read too: 2"));
  }
  EXPECT_THAT(error_text("1\n0 0 0\n3\n1 0 0\n", "a.pts"),
              HasSubstr("the heading declares 3 points, the file ends after 1"));
}

TEST(PointList, TakesTheSecondHalfOfAPwnForNormals) {
  const std::string points = "2\n1 2 3\n4 5 6\n";
  const Model model = parse_model(points + "# normals\n0 0 1\n0 0.123456789012 1\n", "a.pwn");
  EXPECT_THAT(model.mesh.positions, ElementsAre(Vec3(1, 2, 3), Vec3(4, 5, 6)));
  EXPECT_FALSE(model.double_precision);
  EXPECT_THAT(model.notes, ElementsAre("normals that follow the points left out: 2"));
  for (const std::string rest : {"0 0 1\n", "0 0 1\n0 1 0\n1 0 0\n", "0 0 1 1\n0 1 0 1\n"}) {
    EXPECT_GT(parse_model(points + rest, "a.pwn").mesh.positions.size(), 2U) << rest;
  }
}

TEST(PointList, LeavesOutOneHeadingAndSaysSo) {
  for (const std::string text : {"x y z\n1 2 3\n", "1\nx y z\n1 2 3\n", "x y z\n1\n1 2 3\n",
                                 "# a\n// b\n\nx y z\n# c\n1 2 3\n"}) {
    const Model model = parse_model(text, "a.xyz");
    EXPECT_THAT(model.mesh.positions, ElementsAre(Vec3(1, 2, 3))) << text;
    EXPECT_THAT(model.notes, ElementsAre(HasSubstr("left out as a heading: 'x y z'"))) << text;
  }
}

TEST(PointList, RefusesFurtherLinesOfWords) {
  EXPECT_THAT(error_text("3\nwater\nO 0 0 0\nH 1 0 0\n", "a.xyz"),
              AllOf(HasSubstr("line 3: expected a number, found 'O'"), HasSubstr("such as 0.5")));
  EXPECT_THAT(error_text("O.5 1 2\nO.5 1 3\n0 0 0\n", "a.xyz"), HasSubstr("line 2"));
}

TEST(PointList, NamesTheLineOfAWordThatIsNoNumber) {
  EXPECT_THAT(error_text("1 2 3\n1 x 3\n", "a.xyz"), HasSubstr("line 2"));
}

}  // namespace
}  // namespace vantage::test
