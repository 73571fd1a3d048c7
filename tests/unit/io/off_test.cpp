// SPDX-License-Identifier: MIT
#include <bit>

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

Model off(const std::string& text) {
  return parse_model(text, "a.off");
}

void append_word(std::string& bytes, std::uint32_t word, bool high_first) {
  for (int i = 0; i < 4; ++i) {
    bytes += static_cast<char>((word >> (high_first ? 24 - 8 * i : 8 * i)) & 0xFFU);
  }
}

/// A binary file of one triangle; each face ends with a number of colour components if high first.
std::string binary_off(bool high_first, bool says_dimension = false) {
  std::string bytes = says_dimension ? "nOFF BINARY\n" : "OFF BINARY\n";
  const auto add = [&](std::uint32_t word) { append_word(bytes, word, high_first); };
  const auto add_real = [&](float value) { add(std::bit_cast<std::uint32_t>(value)); };
  if (says_dimension) {
    add(3);
  }
  for (const std::uint32_t count : {3U, 1U, 0U}) {
    add(count);
  }
  for (const float value : {0.0F, 0.0F, 0.0F, 1.5F, 0.0F, 0.0F, 0.0F, 2.5F, 0.0F}) {
    add_real(value);
  }
  for (const std::uint32_t value : {3U, 0U, 1U, 2U}) {
    add(value);
  }
  if (high_first) {
    add(0);
  }
  return bytes;
}

TEST(Off, SaysThatColoursOfFacesAreLeftOut) {
  const std::string points = "OFF\n3 2 0\n0 0 0\n1 0 0\n0 1 0\n";
  const Model plain = parse_model(points + "3 0 1 2 # plain\n3 0 2 1\n", "a.off");
  EXPECT_THAT(plain.notes, IsEmpty());
  const Model coloured = parse_model(points + "3 0 1 2 255 0 0\n3 0 2 1\n", "a.off");
  EXPECT_THAT(coloured.notes, ElementsAre("colours of faces left out: 1"));
}

TEST(Off, ReadsCountsOnTheHeaderLine) {
  EXPECT_EQ(off("OFF 3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n").polygons, 1U);
}

TEST(Off, ReadsAFileOnOneLine) {
  const Model model = off("OFF 4 2 0 0 0 0 1 0 0 0 1 0 1 1 0 3 0 1 2 3 1 3 2");
  EXPECT_THAT(model.mesh.triangles, ElementsAre(Triangle{0, 1, 2}, Triangle{1, 3, 2}));
}

TEST(Off, PassesOverCommentsAndEmptyLinesAndAMissingEdgeCount) {
  const Model model = off("# a\nOFF # b\n\n3 1\n# c\n0 0 0 # d\n\n1 0 0\n0 1 0\n3 0 1 2 # e\n");
  EXPECT_THAT(model.mesh.triangles, ElementsAre(Triangle{0, 1, 2}));
}

TEST(Off, PassesOverColoursOfFaces) {
  const Model model =
      off("OFF\n3 2 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2 255 0 0\n3 2 1 0 0.5 0.5 1 1\n");
  EXPECT_THAT(model.mesh.triangles, ElementsAre(Triangle{0, 1, 2}, Triangle{2, 1, 0}));
}

TEST(Off, ReadsColoursNormalsAndTextureCoordinatesInTheirOrder) {
  const Model model =
      off("STCNOFF\n3 1 0\n0 0 0 0 0 1 1 0 0 1 0.3 0.4\n1 0 0 0 0 1 0 1 0 1 0.3 0.4\n"
          "0 1 0 0 0 1 0 0 1 1 0.3 0.4\n3 0 1 2\n");
  EXPECT_THAT(model.vertex_colours, ElementsAre(Rgb8{255, 0, 0}, Rgb8{0, 255, 0}, Rgb8{0, 0, 255}));
  EXPECT_EQ(model.mesh.positions[1], Vec3(1, 0, 0));
}

TEST(Off, ReadsHeaderWordsInAnyOrderOfTheirLetters) {
  // As MeshLab writes them: colours before normals where N comes before C.
  for (const std::string text :
       {"NCOFF\n1 0 0\n1 2 3 255 128 0 255 0 0 1\n",
        "NCSTOFF\n1 0 0\n1 2 3 255 128 0 255 0 0 1 0.3 0.4\n",
        "CSTOFF\n1 0 0\n1 2 3 255 128 0 255 0.3 0.4\n", "CNOFF\n1 0 0\n1 2 3 0 0 1 255 128 0 255\n",
        "NCOFF 1 0 0 1 2 3 255 128 0 255 0 0 1",
        "NSTCOFF\n1 0 0\n1 2 3 255 128 0 0 0 1 0.3 0.4\n"}) {
    const Model model = off(text);
    EXPECT_THAT(model.mesh.positions, ElementsAre(Vec3(1, 2, 3))) << text;
    EXPECT_THAT(model.vertex_colours, ElementsAre(Rgb8{255, 128, 0})) << text;
    EXPECT_THAT(model.notes, IsEmpty()) << text;
  }
  EXPECT_EQ(parse_model("NCOFF\n1 0 0\n1 2 3 255 128 0 255 0 0 1\n", "stdin").format,
            ModelFormat::Off);
  EXPECT_THAT(error_text("NNOFF\n1 0 0\n1 2 3\n", "a.off"),
              HasSubstr("expected the header word OFF"));
}

TEST(Off, ReadsByteColoursOfThreeNumbers) {
  EXPECT_THAT(off("COFF\n1 0 0\n0 0 0 255 128 0\n").vertex_colours, ElementsAre(Rgb8{255, 128, 0}));
}

TEST(Off, DividesHomogeneousCoordinates) {
  EXPECT_EQ(off("4OFF\n1 0 0\n2 4 6 2\n").mesh.positions[0], Vec3(1, 2, 3));
}

TEST(Off, ReadsAThreeDimensionalFileThatSaysSo) {
  EXPECT_EQ(off("nOFF\n3\n1 0 0\n1 2 3\n").mesh.positions[0], Vec3(1, 2, 3));
}

TEST(Off, ReadsABinaryFileThatSaysItsDimension) {
  for (const bool high_first : {true, false}) {
    const Model model = parse_model(binary_off(high_first, true), "a.off");
    EXPECT_EQ(model.mesh.positions[2], Vec3(0, 2.5, 0));
    EXPECT_THAT(model.mesh.triangles, ElementsAre(Triangle{0, 1, 2}));
  }
}

TEST(Off, ReadsCountsAndCoordinatesEachOnALineOfItsOwn) {
  for (const std::string text :
       {"OFF\n3\n1\n0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n", "OFF\n3\n1\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n",
        "OFF\n3 1 0\n0\n0\n0\n1\n0\n0\n0\n1\n0\n3 0 1 2\n"}) {
    const Model model = parse_model(text, "a.off");
    EXPECT_EQ(model.mesh.positions[2], Vec3(0, 1, 0)) << text;
    EXPECT_THAT(model.mesh.triangles, ElementsAre(Triangle{0, 1, 2})) << text;
  }
}

TEST(Off, ReadsVerticesThatAreBrokenOverLines) {
  const std::string text = "OFF\n4 2 0\n0 0\n0\n1 0\n0\n0 1\n0\n0 0\n1\n3 0 1 2\n3 0 1 3\n";
  const Model model = off(text);
  EXPECT_EQ(model.mesh.positions[3], Vec3(0, 0, 1));
  EXPECT_THAT(model.mesh.triangles, ElementsAre(Triangle{0, 1, 2}, Triangle{0, 1, 3}));
  // Only if all numbers are accounted for.
  EXPECT_THAT(error_text(text + "7\n", "a.off"), HasSubstr("line 3: expected 3 coordinates"));
}

TEST(Off, ReadsNormalsOnLinesOfTheirOwn) {
  const Model model =
      off("NOFF\n3 2 0\n0 0 0\n0 0 1\n1 0 0\n0 0 1\n0 1 0\n0 0 1\n3 0 1 2\n3 0 2 1\n");
  EXPECT_THAT(model.mesh.triangles, ElementsAre(Triangle{0, 1, 2}, Triangle{0, 2, 1}));
  EXPECT_THAT(model.notes, IsEmpty());
}

TEST(Off, LeavesLinesWithTextBeyondThemAsTheyAre) {
  const Model model = off("NOFF\n3 1 0\n0 0 0 0 0 1\n1 0 0 0 0 1\n0 1 0 0 0 1\n3 0 1 2 9 9\n7\n");
  EXPECT_THAT(model.mesh.triangles, ElementsAre(Triangle{0, 1, 2}));
  EXPECT_THAT(model.notes, Contains(HasSubstr("text after the last face left out, from line 7")));
}

TEST(Off, SaysThatBytesFollowTheFacesOfABinaryFile) {
  EXPECT_THAT(off(binary_off(true)).notes, IsEmpty());
  EXPECT_THAT(off(binary_off(true) + "rest!").notes,
              ElementsAre("bytes after the last face left out: 5"));
}

TEST(Off, ReadsBinaryWithTheHighestByteFirst) {
  const Model model = parse_model(binary_off(true), "a.off");
  EXPECT_EQ(model.mesh.positions[2], Vec3(0, 2.5, 0));
  EXPECT_THAT(model.mesh.triangles, ElementsAre(Triangle{0, 1, 2}));
}

TEST(Off, ReadsBinaryWithTheLowestByteFirstAndSaysSo) {
  const Model model = parse_model(binary_off(false), "a.off");
  EXPECT_EQ(model.mesh.positions[1], Vec3(1.5, 0, 0));
  EXPECT_THAT(model.notes, ElementsAre(HasSubstr("lowest byte first")));
}

TEST(Off, ReadsCountsGluedToTheHeaderWord) {
  EXPECT_EQ(off("OFF3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n").polygons, 1U);
}

TEST(Off, ReadsAFileWithoutHeaderWordAndSaysSo) {
  const Model model = off("3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
  EXPECT_THAT(model.notes, ElementsAre(HasSubstr("header word OFF is missing")));
}

TEST(Off, LeavesOutFacesWithFewerThanThreeCorners) {
  EXPECT_EQ(off("OFF\n3 4 0\n0 0 0\n1 0 0\n0 1 0\n0\n1 0\n2 0 1\n3 0 1 2\n").skipped_faces, 3U);
}

TEST(Off, RefusesTooFewCoordinates) {
  EXPECT_THAT(error_text("OFF\n2 1 0\n0 0\n1 0 0\n3 0 1 1\n", "a.off"),
              HasSubstr("a.off, line 3: expected 3 coordinates, found 2"));
}

TEST(Off, RefusesAnIndexEqualToTheNumberOfVertices) {
  EXPECT_THAT(error_text("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n", "a.off"),
              HasSubstr("line 6: face names vertex 3, but the file has 3 vertices"));
}

TEST(Off, RefusesNegativeIndices) {
  EXPECT_THAT(error_text("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 -1\n", "a.off"),
              HasSubstr("line 6: expected a vertex index, found '-1'"));
}

TEST(Off, RefusesCountsThatTheFileCannotHold) {
  EXPECT_THAT(error_text("OFF\n4294967295 4294967295 0\n0 0 0\n", "a.off"),
              HasSubstr("line 2: the file declares 4294967295 vertices and 4294967295 faces"));
}

TEST(Off, RefusesAFaceLongerThanTheFile) {
  EXPECT_THAT(error_text("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n999999999 0 1 2\n", "a.off"),
              HasSubstr("line 6: a face declares 999999999 corners"));
}

TEST(Off, RefusesATruncatedFile) {
  EXPECT_THAT(error_text("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1", "a.off"), HasSubstr("the file"));
  EXPECT_THAT(error_text(binary_off(true).substr(0, 60), "a.off"), HasSubstr("byte"));
}

TEST(Off, RefusesAnotherHeaderWord) {
  EXPECT_THAT(error_text("OOF\n1 0 0\n", "a.off"),
              HasSubstr("line 1: expected the header word OFF, found 'OOF'"));
}

TEST(Off, RefusesFourDimensions) {
  EXPECT_THAT(error_text("nOFF\n4\n1 0 0\n1 2 3 4\n", "a.off"), HasSubstr("4 dimensions"));
}

TEST(Off, RefusesAVertexAtInfinity) {
  EXPECT_THAT(error_text("4OFF\n1 0 0\n1 2 3 0\n", "a.off"), HasSubstr("lies at infinity"));
}

}  // namespace
}  // namespace vantage::test
