// SPDX-License-Identifier: MIT
#include <algorithm>
#include <limits>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "vantage/io/model.h"

#include "io/byte_cursor.h"
#include "support/shapes.h"
#include "unit/io/error_text.h"

namespace vantage::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

constexpr const char* kFacet =
    "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n";

std::string binary_stl(const TriMesh& mesh, const std::string& title) {
  std::string bytes = title;
  bytes.resize(80, ' ');
  append_little_endian(bytes, static_cast<std::uint32_t>(mesh.triangles.size()));
  for (const Triangle& t : mesh.triangles) {
    bytes.append(12, '\0');
    for (const std::uint32_t v : t) {
      for (int c = 0; c < 3; ++c) {
        append_little_endian(bytes, static_cast<float>(mesh.positions[v][c]));
      }
    }
    bytes.append(2, '\0');
  }
  return bytes;
}

TEST(Stl, JoinsEqualPositionsInOrderOfFirstAppearance) {
  const TriMesh cube = box(1, 2, 3, 1);
  const Model model = parse_model(binary_stl(cube, "made by a test"), "a.stl");
  EXPECT_EQ(model.mesh.positions.size(), 8U);
  EXPECT_EQ(model.mesh.triangles.size(), 12U);
  EXPECT_EQ(model.mesh.positions[0], cube.positions[cube.triangles[0][0]]);
  EXPECT_EQ(model.mesh.positions[1], cube.positions[cube.triangles[0][1]]);
  EXPECT_THAT(model.mesh.triangles[0], ElementsAre(0, 1, 2));
}

TEST(Stl, KnowsABinaryFileThatStartsWithSolidByItsSize) {
  EXPECT_EQ(parse_model(binary_stl(box(1, 1, 1, 1), "solid facet"), "a.stl").polygons, 12U);
}

TEST(Stl, KeepsFacesThatWeldingMadeDegenerate) {
  TriMesh mesh;
  mesh.positions = {Vec3(0, 0, 0), Vec3(0, 0, 0), Vec3(1, 0, 0)};
  mesh.triangles = {{0, 1, 2}};
  const Model model = parse_model(binary_stl(mesh, ""), "a.stl");
  EXPECT_THAT(model.mesh.triangles, ElementsAre(Triangle{0, 0, 1}));
}

TEST(Stl, ReadsTextInEitherCase) {
  const std::string lower = std::string("solid a b\n") + kFacet + "endsolid a b\n";
  std::string upper = lower;
  for (char& c : upper) {
    c = c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
  }
  EXPECT_EQ(parse_model(lower, "a.stl").parts.at(0).name, "a b");
  EXPECT_EQ(parse_model(upper, "a.stl").mesh.triangles.size(), 1U);
}

TEST(Stl, ReadsFacetsHoweverTheyAreBrokenIntoLines) {
  std::string one_line = std::string("solid a\n") + kFacet + kFacet;
  std::replace(one_line.begin() + 8, one_line.end(), '\n', ' ');
  const Model model = parse_model(one_line + "\nendsolid a\n", "a.stl");
  EXPECT_EQ(model.mesh.triangles.size(), 2U);
  EXPECT_EQ(
      model.mesh.positions,
      parse_model(std::string("solid a\n") + kFacet + "endsolid a\n", "a.stl").mesh.positions);
}

TEST(Stl, ReadsSeveralSolidsAsParts) {
  const Model model = parse_model(
      std::string("solid a\n") + kFacet + "endsolid\nsolid b\n" + kFacet + "endsolid\n", "a.stl");
  ASSERT_EQ(model.parts.size(), 2U);
  EXPECT_EQ(model.parts[1].first_triangle, 1U);
}

TEST(Stl, PassesOverWordsBehindTheEndOfAFacet) {
  std::string text = std::string("solid\n") + kFacet + kFacet + "endsolid\n";
  text.replace(text.find("endfacet"), 8, "endfacet blah");
  EXPECT_EQ(parse_model(text, "a.stl").polygons, 2U);
}

TEST(Stl, EndsAFacetWhereTheNextStatementCutsItOff) {
  std::string text = std::string("solid a\n") + kFacet + kFacet + "endsolid\n";
  text.erase(text.find("endloop"), std::string("endloop\nendfacet\n").size());
  const Model model = parse_model(text, "a.stl");
  EXPECT_THAT(model.mesh.triangles, ElementsAre(Triangle{0, 1, 2}, Triangle{0, 1, 2}));
  EXPECT_THAT(model.notes, ElementsAre(HasSubstr("1, the first was ended in line 7")));
  text.erase(text.rfind("endloop"), std::string("endloop\nendfacet\n").size());
  EXPECT_EQ(parse_model(text, "a.stl").polygons, 2U);
}

TEST(Stl, ReadsASolidThatStandsOnItsFirstLine) {
  std::string text = std::string("solid a facet b ") + kFacet + kFacet + "endsolid a\n";
  std::replace(text.begin(), text.end(), '\n', ' ');
  const Model model = parse_model(text, "a.stl");
  EXPECT_EQ(model.polygons, 2U);
  EXPECT_EQ(model.parts.at(0).name, "a facet b");
}

TEST(Stl, ReadsWhatThereIsRoomForIfNoTrianglesAreDeclared) {
  std::string bytes = binary_stl(box(1, 1, 1, 1), "");
  bytes.replace(80, 4, 4, '\0');
  const Model model = parse_model(bytes, "a.stl");
  EXPECT_EQ(model.polygons, 12U);
  EXPECT_THAT(model.notes, ElementsAre("the file declares 0 triangles but has room for 12, all of "
                                       "which were read"));
}

TEST(Stl, MayBeginWithTheWordsOfOtherFormats) {
  for (const std::string title : {"OFF exported by a tool", "ply\nexported", "# .PCD", "glTF"}) {
    const std::string bytes = binary_stl(box(1, 1, 1, 1), title);
    EXPECT_EQ(parse_model(bytes, "a.stl").polygons, 12U) << title;
  }
}

TEST(Stl, NotesBytesAfterTheLastTriangle) {
  const Model model = parse_model(binary_stl(box(1, 1, 1, 1), "") + "xyz", "a.stl");
  EXPECT_THAT(model.notes, ElementsAre(HasSubstr("bytes after the last triangle left out: 3")));
}

TEST(Stl, RefusesMoreTrianglesThanTheFileHolds) {
  const std::string whole = binary_stl(box(1, 1, 1, 1), "");
  EXPECT_THAT(error_text(whole.substr(0, whole.size() - 1), "a.stl"),
              HasSubstr("byte 80: the file declares 12 triangles but has room for 11"));
}

TEST(Stl, RefusesCoordinatesThatAreNotFinite) {
  TriMesh mesh;
  mesh.positions = {Vec3(0, 0, 0), Vec3(1, 0, 0),
                    Vec3(0, std::numeric_limits<double>::quiet_NaN(), 0)};
  mesh.triangles = {{0, 1, 2}};
  EXPECT_THAT(error_text(binary_stl(mesh, ""), "a.stl"),
              HasSubstr("byte 120: a coordinate is not a finite number"));  // 84 + 12 + 2 · 12
}

TEST(Stl, RefusesTextThatEndsInsideAFacet) {
  EXPECT_THAT(error_text("solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\n", "a.stl"),
              HasSubstr("the file ends inside a facet"));
}

TEST(Stl, KnowsABinaryFileThatStartsWithSolidAlsoWithAWrongSize) {
  const std::string whole = binary_stl(box(1, 1, 1, 1), "solid box");
  EXPECT_EQ(parse_model(whole + "xyz", "a.stl").polygons, 12U);
  EXPECT_THAT(error_text(whole.substr(0, whole.size() - 1), "a.stl"),
              HasSubstr("declares 12 triangles but has room for 11; it may be cut short"));
  EXPECT_THAT(error_text(binary_stl(box(1, 1, 1, 1), "solid box\nfacet").substr(0, 500), "a.stl"),
              HasSubstr("it may be cut short"));
}

TEST(Stl, PassesOverLinesBeforeTheFacets) {
  for (const std::string head : {"solid a\n\n# by hand\ncolor 1 0 0\n",
                                 "; made by a program\n# two\nsolid\n", "solid a\nunits mm\n"}) {
    const Model model = parse_model(head + kFacet + kFacet + "endsolid\n", "a.stl");
    EXPECT_EQ(model.polygons, 2U) << head;
    EXPECT_THAT(model.notes, ElementsAre(HasSubstr("lines before facets left out"))) << head;
  }
}

TEST(Stl, SaysWhereATextIsNoStl) {
  EXPECT_THAT(error_text("solid a\n# nothing\nvertex 0 0 0\n", "a.stl"),
              HasSubstr("line 3: a vertex stands outside a facet"));
}

TEST(Stl, RefusesOtherStatements) {
  EXPECT_THAT(error_text(std::string("solid a\n") + kFacet + "hello\n", "a.stl"),
              HasSubstr("line 9: expected a statement such as facet or vertex, found 'hello'"));
}

TEST(Stl, RefusesAVertexWithTwoCoordinates) {
  EXPECT_THAT(error_text("solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0\nvertex", "a.stl"),
              HasSubstr("line 4: expected 3 coordinates, found 2"));
}

TEST(Stl, RefusesBytesThatAreNeitherTextNorLongEnough) {
  EXPECT_THAT(error_text("hello", "a.stl"), HasSubstr("is neither a text STL"));
}

TEST(Stl, RefusesAFileWithoutTriangles) {
  EXPECT_THAT(
      error_text(std::string(84, '\0'), "a.stl"),
      HasSubstr("neither faces nor points: the file declares 0 triangles and has room for 0"));
}

/// A binary STL of one triangle.
std::string triangle(std::string header, unsigned char low, unsigned char high) {
  header.resize(80, ' ');
  std::string bytes = header + std::string("\1\0\0\0", 4) + std::string(12, '\0');
  for (const float value : {0.0F, 0.0F, 0.0F, 1.0F, 0.0F, 0.0F, 0.0F, 1.0F, 0.0F}) {
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
  }
  return bytes + static_cast<char>(low) + static_cast<char>(high);
}

TEST(StlColours, AreNoted) {
  const auto notes = [](const std::string& bytes) { return parse_model(bytes, "a.stl").notes; };
  EXPECT_THAT(notes(triangle("VisCAM", 0x1F, 0x80)),
              testing::Contains(testing::HasSubstr("colours of faces")));
  EXPECT_THAT(notes(triangle("COLOR=\xFF\x01\x01\xFF", 0x1F, 0)),
              testing::Contains(testing::HasSubstr("colours of faces")));
  EXPECT_THAT(notes(triangle("plain", 0x1F, 0)), testing::IsEmpty());
}

TEST(Stl, OtherTextIsCalledTextAndNotABinaryFileThatIsCut) {
  const std::string text(200, 'x');
  EXPECT_THAT(error_text(text, "a.stl"),
              testing::HasSubstr("is text that does not start with the word"
                                 " solid, as a text STL does"));
  std::string binary(84, '\0');
  binary[80] = 9;
  EXPECT_THAT(error_text(binary, "a.stl"), testing::HasSubstr("it may be cut short"));
}

}  // namespace
}  // namespace vantage::test
