// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "vantage/io/model.h"

#include "unit/io/error_text.h"

namespace vantage::test {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::UnorderedElementsAre;

constexpr const char* kThreePoints = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
constexpr const char* kCloud = "no faces: taken as a point cloud";

Model obj(const std::string& text) {
  return parse_model(text, "a.obj");
}

TEST(Obj, KeepsVerticesInFileOrder) {
  const Model model = obj("v 5 0 0\nv 1 2 3\nv 0 1 0\nf 3 1 2\n");
  ASSERT_EQ(model.mesh.positions.size(), 3U);
  EXPECT_EQ(model.mesh.positions[1], Vec3(1, 2, 3));
  EXPECT_THAT(model.mesh.triangles, ElementsAre(Triangle{2, 0, 1}));
}

TEST(Obj, CountsNegativeIndicesFromTheEnd) {
  const Model model = obj(std::string(kThreePoints) + "f -3 -2 -1\n");
  EXPECT_THAT(model.mesh.triangles, ElementsAre(Triangle{0, 1, 2}));
}

TEST(Obj, ReadsEveryCornerNotation) {
  const Model model =
      obj(std::string(kThreePoints) + "f 1/1 2/1 3/1\nf 1//1 2//1 3//1\nf 1/1/1 2/1/1 3/1/1\n");
  EXPECT_EQ(model.mesh.triangles.size(), 3U);
}

TEST(Obj, ReadsEveryKindOfLineEnd) {
  for (const char* end : {"\n", "\r\n", "\r"}) {
    std::string text = "\xEF\xBB\xBFv 0 0 0|v\t1  0 0 |v 0 1 0|f 1 2 3|";
    for (std::size_t at = text.find('|'); at != std::string::npos; at = text.find('|')) {
      text.replace(at, 1, end);
    }
    EXPECT_THAT(obj(text).mesh.triangles, ElementsAre(Triangle{0, 1, 2}));
  }
}

TEST(Obj, JoinsLinesThatEndInABackslash) {
  EXPECT_THAT(obj(std::string(kThreePoints) + "f 1 \\\n2 \\\r\n3").mesh.triangles,
              ElementsAre(Triangle{0, 1, 2}));
}

TEST(Obj, BlanksBehindTheBackslashChangeNothing) {
  EXPECT_THAT(obj(std::string(kThreePoints) + "f 1 \\ \t\n2 \\ \r\n3").mesh.triangles,
              ElementsAre(Triangle{0, 1, 2}));
}

TEST(Obj, ACommentMayFollowACornerWithoutABlank) {
  EXPECT_THAT(
      obj(std::string(kThreePoints) + "v 0 0 1#d\nf 1 2/7 3#c\nf 1/2/3# 4/5/6\n").mesh.triangles,
      ElementsAre(Triangle{0, 1, 2}));
}

TEST(Obj, ABackslashAtTheEndOfACommentHidesNothing) {
  EXPECT_EQ(obj(std::string("# from C:\\models\\\n") + kThreePoints + "f 1 2 3").polygons, 1U);
  EXPECT_EQ(obj(std::string(kThreePoints) + "usemtl a # D:\\tex\\\nf 1 2 3").polygons, 1U);
  EXPECT_EQ(obj(std::string(kThreePoints) + "usemtl a#1 \\\nb\nf 1 2 3").polygons, 1U);
}

TEST(Obj, AFaceMayComeBeforeItsVertices) {
  EXPECT_EQ(obj(std::string("f 1 2 3\n") + kThreePoints).mesh.triangles.size(), 1U);
}

TEST(Obj, ACornerOfAFaceThatIsLeftOutMayNameAnything) {
  for (const char* faces : {"f 1 99\nf 1 2 3\n", "f 1 2 3\nf 1 99\n"}) {
    const Model model = obj(std::string(kThreePoints) + faces);
    EXPECT_EQ(model.polygons, 1U);
    EXPECT_EQ(model.skipped_faces, 1U);
  }
}

TEST(Obj, CountsPolygonsBySize) {
  const Model model =
      obj("v 0 0 0\nv 1 0 0\nv 2 1 0\nv 1 2 0\nv 0 2 0\nf 1 2 3\nf 1 2 3 4\nf 1 2 3 4 5\nf 1 2\n");
  EXPECT_EQ(model.polygons, 3U);
  EXPECT_EQ(model.quads, 1U);
  EXPECT_EQ(model.larger_polygons, 1U);
  EXPECT_EQ(model.skipped_faces, 1U);
  EXPECT_EQ(model.mesh.triangles.size(), 1U + 2U + 3U);
}

TEST(Obj, GroupsAndObjectsBecomeParts) {
  const Model model =
      obj(std::string(kThreePoints) + "g left arm\nf 1 2 3\nf 1 3 2\ng empty\no tail\nf 1 2 3\n");
  ASSERT_EQ(model.parts.size(), 2U);
  EXPECT_EQ(model.parts[0].name, "left arm");
  EXPECT_EQ(model.parts[0].triangle_count, 2U);
  EXPECT_EQ(model.parts[1].name, "tail");
  EXPECT_EQ(model.parts[1].first_triangle, 2U);
}

TEST(Obj, AGroupWithoutANameOfItsOwnLeavesThatOfItsObject) {
  const Model model = obj(std::string(kThreePoints) +
                          "o body\ng\nf 1 2 3\ng arm\ng default\nf 1 3 2\ng default\nf 2 3 1\n");
  ASSERT_EQ(model.parts.size(), 3U);
  EXPECT_EQ(model.parts[0].name, "body");
  EXPECT_EQ(model.parts[1].name, "arm");
  EXPECT_EQ(model.parts[2].name, "default");  // a group that has faces already keeps them
}

TEST(Obj, ReadsColoursFromZeroToOne) {
  const Model model = obj("v 0 0 0 1 0.2 0\nv 1 0 0 0 0 1\nv 0 1 0 1 1 1\nf 1 2 3\n");
  EXPECT_THAT(model.vertex_colours,
              ElementsAre(Rgb8{255, 51, 0}, Rgb8{0, 0, 255}, Rgb8{255, 255, 255}));
}

TEST(Obj, ReadsColoursFromZeroTo255) {
  const Model model = obj("v 0 0 0 255 51 0\nv 1 0 0 0 0 1\n");
  EXPECT_THAT(model.vertex_colours, ElementsAre(Rgb8{255, 51, 0}, Rgb8{0, 0, 1}));
}

TEST(Obj, ReadsBytesWithFractions) {
  const Model model = obj("v 0 0 0 127.25 51.3 0\nv 1 0 0 0 0 1.4\n");
  EXPECT_THAT(model.vertex_colours, ElementsAre(Rgb8{127, 51, 0}, Rgb8{0, 0, 1}));
}

TEST(Obj, AFewBrightColoursAreNoBytes) {
  const Model model = obj("v 0 0 0 0.2 0.4 0.6\nv 1 0 0 3 0.4 nan\n");
  EXPECT_THAT(model.vertex_colours, ElementsAre(Rgb8{51, 102, 153}, Rgb8{255, 102, 0}));
}

TEST(Obj, ReadsNoOpacityAndSaysSo) {
  EXPECT_THAT(obj("v 0 0 0 1 0.2 0 0.5\nv 1 0 0 0 0 1 1\n").notes,
              ElementsAre(HasSubstr("the opacity of vertices was left out"), kCloud));
  const Model opaque = obj("v 0 0 0 1 0.2 0 1\n");
  EXPECT_THAT(opaque.vertex_colours, ElementsAre(Rgb8{255, 51, 0}));
  EXPECT_THAT(opaque.notes, ElementsAre(kCloud));
}

TEST(Obj, LeavesColoursOutUnlessEveryVertexHasOne) {
  const Model model = obj("v 0 0 0 1 0 0\nv 1 0 0\n");
  EXPECT_THAT(model.vertex_colours, IsEmpty());
  EXPECT_THAT(model.notes,
              UnorderedElementsAre(HasSubstr("only 1 of 2 vertices have a colour"), kCloud));
}

TEST(Obj, IgnoresTheWeightOfAVertexAndSaysSo) {
  const Model model = obj("v 2 4 6 2\n");
  EXPECT_EQ(model.mesh.positions[0], Vec3(2, 4, 6));
  EXPECT_THAT(model.notes, ElementsAre(HasSubstr("weights of vertices"), kCloud));
}

TEST(Obj, NotesThatItHasNoFacesUnlessItSaysWhatItHas) {
  EXPECT_THAT(obj(kThreePoints).notes, ElementsAre(kCloud));
  for (const char* element : {"f 1 2 3\n", "f 1 2\n", "l 1 2\n", "p 1\n", "call b.obj\n"}) {
    EXPECT_THAT(obj(std::string(kThreePoints) + element).notes, Not(Contains(kCloud))) << element;
  }
}

TEST(Obj, NotesUnknownKeywords) {
  const Model model = obj(std::string(kThreePoints) + "wobble 3\nf 1 2 3\n");
  EXPECT_THAT(model.notes, ElementsAre(HasSubstr("'wobble' in line 4")));
}

TEST(Obj, NotesFilesThatItCallsAndSurfacesOfOldKeywords) {
  const Model model = obj(std::string(kThreePoints) + "call b.obj\nbzp 1 2 3\nf 1 2 3\n");
  EXPECT_THAT(model.notes, ElementsAre("free-form curves and surfaces left out: 1",
                                       "files whose content belongs here (call) left out: 1"));
}

TEST(Obj, KnowsWhetherCoordinatesNeedDouble) {
  EXPECT_FALSE(obj("v 0.1 0.25 1234.5").double_precision);
  EXPECT_TRUE(obj("v 0.1234567890123 0 0").double_precision);
}

TEST(Obj, PointsAloneAreAModel) {
  EXPECT_EQ(obj("v 0 0 0\nv 1 0 0\n").mesh.triangles.size(), 0U);
}

TEST(Obj, RefusesAnIndexThatIsMissingInTheFile) {
  EXPECT_THAT(error_text(std::string(kThreePoints) + "f 1 2 4\n", "a.obj"),
              HasSubstr("a.obj, line 4: face names vertex 4, but the file has 3 vertices"));
}

TEST(Obj, RefusesIndexZero) {
  EXPECT_THAT(error_text(std::string(kThreePoints) + "f 0 1 2\n", "a.obj"),
              HasSubstr("line 4: face names vertex 0, but vertices are counted from 1"));
}

TEST(Obj, RefusesANegativeIndexBeforeTheFirstVertex) {
  EXPECT_THAT(error_text(std::string(kThreePoints) + "f -4 -2 -1\n", "a.obj"),
              HasSubstr("line 4: face names vertex -4, but only 3 vertices come before it"));
}

TEST(Obj, RefusesAnIndexBeyond32Bits) {
  EXPECT_THAT(error_text(std::string(kThreePoints) + "f 1 2 99999999999999999999\n", "a.obj"),
              HasSubstr("which no file can hold"));
}

TEST(Obj, RefusesACornerThatIsNoNumber) {
  EXPECT_THAT(error_text(std::string(kThreePoints) + "f 1; 2; 3;\n", "a.obj"),
              HasSubstr("line 4: expected a corner such as 7 or 7/2/5, found '1;'"));
}

TEST(Obj, RefusesCommasBetweenCornersWithAHint) {
  EXPECT_THAT(error_text(std::string(kThreePoints) + "f 1, 2, 3\n", "a.obj"),
              HasSubstr("found '1,'; separate corners by spaces"));
}

TEST(Obj, RefusesDecimalCommasWithAHint) {
  EXPECT_THAT(error_text("v 1,5 0 0\n", "a.obj"),
              HasSubstr("line 1: expected a number, found '1,5'; write decimals with a point"));
}

TEST(Obj, RefusesCoordinatesThatAreNotFinite) {
  EXPECT_THAT(error_text("v 0 0 0\nv nan 0 0\n", "a.obj"),
              HasSubstr("line 2: 'nan' is not a finite"));
  EXPECT_THAT(error_text("v 0 inf 0\n", "a.obj"), HasSubstr("line 1: 'inf' is infinite"));
  EXPECT_THAT(error_text("v 0 0 1e999\n", "a.obj"), HasSubstr("line 1: '1e999' is infinite"));
}

TEST(Obj, RefusesTooFewOrTooManyNumbersInAVertex) {
  EXPECT_THAT(error_text("v 0 0\n", "a.obj"), HasSubstr("line 1: expected 3 coordinates, found 2"));
  EXPECT_THAT(error_text("v 0 0 0 1 1\n", "a.obj"), HasSubstr("3 coordinates and 2 more"));
  EXPECT_THAT(error_text("v 0 0 0 1 1 1 1 1\n", "a.obj"),
              HasSubstr("more than 7 numbers; expected 3 coordinates, and"));
}

TEST(Obj, RefusesCoordinatesWhoseSquaresLeaveTheDoubles) {
  EXPECT_THAT(error_text("v 1e61 0 0\n", "a.obj"),
              HasSubstr("line 1: a coordinate is beyond 1e60"));
  EXPECT_THAT(error_text("v 0 0 0\nv 1e-61 0 0\n", "a.obj"), HasSubstr("less than 1e-60 across"));
}

TEST(Obj, RefusesAModelOfAFewStepsOfItsCoordinates) {
  EXPECT_THAT(error_text("v 1e15 0 0\nv 1000000000000001 0 0\n", "a.obj"),
              HasSubstr("only 8 places apart"));
  EXPECT_EQ(parse_model("v 1e12 0 0\nv 1000000000001 0 0\n", "a.obj").mesh.positions.size(), 2U);
}

TEST(Obj, RefusesAFileWithNothingInIt) {
  EXPECT_THAT(error_text("# nothing\n", "a.obj"), HasSubstr("holds neither faces nor points"));
  EXPECT_THAT(error_text("V 0 0 0\nV 1 0 0\n", "a.obj"),
              HasSubstr("neither faces nor points; lines with an unknown keyword left out: 2"));
  EXPECT_THAT(error_text("", "a.obj"), HasSubstr("the file is empty"));
}

}  // namespace
}  // namespace vantage::test
