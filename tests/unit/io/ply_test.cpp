// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "vantage/io/model.h"

#include "io/byte_cursor.h"
#include "unit/io/error_text.h"

namespace vantage::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr const char* kVertices =
    "element vertex 4\nproperty float x\nproperty float y\nproperty float z\n";
constexpr const char* kFourPoints = "0 0 0\n1 0 0\n0 1 0\n1 1 0\n";

Model ply(const std::string& text) {
  return parse_model(text, "a.ply");
}

std::string ascii(const std::string& header, const std::string& body) {
  return "ply\nformat ascii 1.0\n" + header + "end_header\n" + body;
}

template <class T>
void append(std::string& bytes, T value, ByteOrder order) {
  std::string raw;
  append_little_endian(raw, value);
  bytes.append(order == ByteOrder::Little ? raw : std::string(raw.rbegin(), raw.rend()));
}

/// One triangle: a scalar of every type stands before each position.
std::string binary_ply(ByteOrder order) {
  std::string bytes = "ply\nformat binary_";
  bytes += order == ByteOrder::Little ? "little" : "big";
  bytes +=
      "_endian 1.0\nelement vertex 3\nproperty char a\nproperty uchar b\nproperty int16 c\n"
      "property uint16 d\nproperty int e\nproperty uint f\nproperty float x\nproperty double y\n"
      "property float32 z\nelement face 1\nproperty list uchar short vertex_index\nend_header\n";
  for (int v = 0; v < 3; ++v) {
    append(bytes, std::int8_t{-1}, order);
    append(bytes, std::uint8_t{1}, order);
    append(bytes, std::int16_t{-1}, order);
    append(bytes, std::uint16_t{1}, order);
    append(bytes, std::int32_t{-1}, order);
    append(bytes, std::uint32_t{1}, order);
    append(bytes, static_cast<float>(v), order);
    append(bytes, v == 1 ? 0.1 : 0.0, order);
    append(bytes, v == 2 ? 2.5F : 0.0F, order);
  }
  append(bytes, std::uint8_t{3}, order);
  for (std::int16_t v = 0; v < 3; ++v) {
    append(bytes, v, order);
  }
  return bytes;
}

TEST(Ply, SaysThatColoursOfFacesAreLeftOutAndTakesNamesInAnyCase) {
  const std::string text =
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float "
      "z\n"
      "element face 1\nproperty list uchar int Vertex_Indices\nproperty uchar red\nend_header\n"
      "0 0 0\n1 0 0\n0 1 0\n3 0 1 2 255\n";
  const Model model = parse_model(text, "a.ply");
  EXPECT_EQ(model.mesh.triangles.size(), 1U);
  EXPECT_THAT(model.notes,
              testing::ElementsAre("colours of faces left out; those of vertices are read"));
}

TEST(Ply, KnowsColoursOfFacesByEachNameThatThoseOfVerticesHave) {
  for (const std::string name : {"red", "r", "diffuse_red"}) {
    const Model model = ply(ascii(std::string(kVertices) +
                                      "element face 1\nproperty list uchar int vertex_indices\n"
                                      "property uchar " +
                                      name + "\n",
                                  std::string(kFourPoints) + "3 0 1 2 255\n"));
    EXPECT_THAT(model.notes, ElementsAre("colours of faces left out; those of vertices are read"))
        << name;
  }
}

TEST(Ply, SaysWhatElsePointsWereJoinedBy) {
  const auto notes = [](const std::string& element, const std::string& rows) {
    return ply(ascii(kVertices + element, kFourPoints + rows)).notes;
  };
  EXPECT_THAT(notes("element edge 2\nproperty int vertex1\nproperty int vertex2\n", "0 1\n2 3\n"),
              ElementsAre("elements 'edge' left out: 2"));
  EXPECT_THAT(notes("element range_grid 2\nproperty list uchar int vertex_indices\n", "1 0\n0\n"),
              ElementsAre("elements 'range_grid' left out: 2"));
  EXPECT_THAT(notes("element camera 1\nproperty float view_px\n", "1\n"), IsEmpty());
  EXPECT_THAT(notes("element edge 0\nproperty int vertex1\nproperty int vertex2\n", ""), IsEmpty());
}

TEST(Ply, ReadsPropertiesInCapitals) {
  const std::string header =
      "element vertex 1\nproperty float X\nproperty float Y\nproperty float Z\nproperty uchar Red\n"
      "property uchar GREEN\nproperty uchar B\n";
  const Model model = ply(ascii(header, "1 2 3 255 128 0\n"));
  EXPECT_THAT(model.mesh.positions, ElementsAre(Vec3(1, 2, 3)));
  EXPECT_THAT(model.vertex_colours, ElementsAre(Rgb8{255, 128, 0}));
}

TEST(Ply, TellsByColoursOf16BitsWhetherTheyAreBytes) {
  for (const auto& [type, full] : {std::pair("short", 32767), std::pair("ushort", 65535)}) {
    const auto coloured = [&, type = type](int red, int green) {
      const std::string t = std::string("property ") + type + " ";
      return ply(ascii("element vertex 2\nproperty float x\nproperty float y\nproperty float z\n" +
                           t + "red\n" + t + "green\n" + t + "blue\n",
                       "0 0 0 0 0 0\n1 0 0 " + std::to_string(red) + " " + std::to_string(green) +
                           " 0\n"))
          .vertex_colours.at(1);
    };
    EXPECT_EQ(coloured(255, 128), (Rgb8{255, 128, 0})) << type;
    EXPECT_EQ(coloured(full, full / 3), (Rgb8{255, 85, 0})) << type;
  }
}

TEST(Ply, PassesOverAByteOrderMark) {
  const std::string mark = "\xEF\xBB\xBF";
  EXPECT_EQ(ply(mark + ascii(kVertices, kFourPoints)).mesh.positions.size(), 4U);
  EXPECT_EQ(parse_model(mark + binary_ply(ByteOrder::Little), "a").mesh.triangles.size(), 1U);
}

TEST(Ply, ReadsAscii) {
  const Model model =
      ply(ascii(std::string(kVertices) + "element face 2\nproperty list uchar int vertex_indices\n",
                std::string(kFourPoints) + "3 0 1 2\n4 0 1 3 2\n"));
  EXPECT_EQ(model.mesh.positions[3], Vec3(1, 1, 0));
  EXPECT_EQ(model.polygons, 2U);
  EXPECT_EQ(model.quads, 1U);
}

TEST(Ply, ReadsEveryScalarTypeInEitherByteOrder) {
  for (const ByteOrder order : {ByteOrder::Little, ByteOrder::Big}) {
    const Model model = ply(binary_ply(order));
    EXPECT_EQ(model.mesh.positions[1], Vec3(1, 0.1, 0));
    EXPECT_EQ(model.mesh.positions[2], Vec3(2, 0, 2.5));
    EXPECT_THAT(model.mesh.triangles, ElementsAre(Triangle{0, 1, 2}));
    EXPECT_TRUE(model.double_precision);
  }
}

TEST(Ply, PassesOverOtherElementsAndListProperties) {
  const Model model = ply(
      ascii("comment hello\nobj_info x\nelement camera 1\nproperty list uint8 float view\n"
            "property int k\n" +
                std::string(kVertices) +
                "property list uchar float more\nelement face 1\nproperty float q\n"
                "property list uchar int vertex_indices\nproperty list uchar float texcoord\n",
            "2 0.5 0.5 7\n0 0 0 1 9\n1 0 0 0\n0 1 0 2 1 1\n1 1 0 0\n0.5 3 0 1 2 6 0 0 0 0 0 0\n"));
  EXPECT_EQ(model.mesh.positions[2], Vec3(0, 1, 0));
  EXPECT_THAT(model.mesh.triangles, ElementsAre(Triangle{0, 1, 2}));
}

TEST(Ply, ReadsWhatBlender24Wrote) {
  const Model model = ply(
      "ply\nformat ascii 1.0\nCreated by Blender3D 247 - www.blender.org, source file: a.blend\n"
      "element vertex 3\nproperty float x\nproperty float y\nproperty float z\nelement face 1\n"
      "property list uchar uint vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
  EXPECT_EQ(model.mesh.triangles, (std::vector<Triangle>{{0, 1, 2}}));
  EXPECT_TRUE(model.notes.empty());
}

TEST(Ply, ReadsTriangleStripsWithSeparators) {
  // 0 1 2 3: the second triangle of a strip is turned. −1 starts a new strip.
  const Model model = ply(
      ascii(std::string(kVertices) + "element tristrips 1\nproperty list int int vertex_indices\n",
            std::string(kFourPoints) + "8 0 1 2 3 -1 3 2 1\n"));
  EXPECT_THAT(model.mesh.triangles,
              ElementsAre(Triangle{0, 1, 2}, Triangle{2, 1, 3}, Triangle{3, 2, 1}));
}

TEST(Ply, DropsTheEmptyTrianglesThatJoinStrips) {
  const Model model = ply(
      ascii(std::string(kVertices) + "element tristrips 1\nproperty list int int vertex_indices\n",
            std::string(kFourPoints) + "6 0 1 2 2 3 1\n"));
  EXPECT_THAT(model.mesh.triangles,
              ElementsAre(Triangle{0, 1, 2}, Triangle{3, 2, 1}));  // the sixth corner: turned
}

TEST(Ply, ReadsByteAndFloatColours) {
  const std::string point =
      "element vertex 1\nproperty float x\nproperty float y\nproperty float z\n";
  EXPECT_THAT(ply(ascii(point + "property uchar red\nproperty uchar green\nproperty uchar blue\n",
                        "0 0 0 255 1 0\n"))
                  .vertex_colours,
              ElementsAre(Rgb8{255, 1, 0}));
  EXPECT_THAT(ply(ascii(point + "property float red\nproperty float green\nproperty float blue\n",
                        "0 0 0 1 0.2 0\n"))
                  .vertex_colours,
              ElementsAre(Rgb8{255, 51, 0}));
}

TEST(Ply, AFewBrightColoursAreNoBytes) {
  EXPECT_THAT(ply(ascii("element vertex 2\nproperty float x\nproperty float y\nproperty float z\n"
                        "property float red\nproperty float green\nproperty float blue\n",
                        "0 0 0 0.2 0.4 0.6\n1 0 0 3 0.4 0.6\n"))
                  .vertex_colours,
              ElementsAre(Rgb8{51, 102, 153}, Rgb8{255, 102, 153}));
}

TEST(Ply, ReadsAHeaderWithReturnsAlone) {
  const Model model = ply(
      "ply\rformat binary_little_endian 1.0\relement vertex 1\rproperty uchar x\rproperty uchar y\r"
      "property uchar z\rend_header\r\n\x01\x02");
  EXPECT_EQ(model.mesh.positions[0], Vec3(10, 1, 2));  // 10 is the \n after the header
}

TEST(Ply, ReadsPointsWithoutFaces) {
  EXPECT_EQ(ply(ascii(kVertices, kFourPoints)).mesh.positions.size(), 4U);
}

TEST(Ply, RefusesCountsThatTheFileCannotHold) {
  EXPECT_THAT(error_text("ply\nformat binary_little_endian 1.0\nelement vertex 4294967295\n"
                         "property float x\nproperty float y\nproperty float z\nend_header\n....",
                         "a.ply"),
              HasSubstr("declares 4294967295 of element vertex, more than the size"));
}

TEST(Ply, RefusesAListLongerThanTheFile) {
  EXPECT_THAT(error_text(ascii(std::string(kVertices) +
                                   "element face 1\nproperty list uint int vertex_indices\n",
                               std::string(kFourPoints) + "4000000000 0 1 2\n"),
                         "a.ply"),
              HasSubstr("a list is longer than the rest of the file"));
}

TEST(Ply, RefusesIndicesThatAreNotThere) {
  const std::string header =
      std::string(kVertices) + "element face 1\nproperty list uchar int vertex_indices\n";
  EXPECT_THAT(error_text(ascii(header, std::string(kFourPoints) + "3 0 1 4\n"), "a.ply"),
              HasSubstr("face names vertex 4, but the file has 4 vertices"));
  EXPECT_THAT(error_text(ascii(header, std::string(kFourPoints) + "3 0 1 -1\n"), "a.ply"),
              HasSubstr("line 14: a face names a vertex that is not a whole number from 0"));
}

TEST(Ply, RefusesCoordinatesThatAreNotFiniteEvenOfIsolatedVertices) {
  const std::string header =
      std::string(kVertices) + "element face 1\nproperty list uchar int vertex_indices\n";
  EXPECT_THAT(error_text(ascii(header, "0 0 0\n1 0 0\nnan 1 0\n1 1 0\n3 0 1 3\n"), "a.ply"),
              HasSubstr("line 12: a coordinate is not a finite number"));
  EXPECT_THAT(error_text(ascii(kVertices, "0 0 0\n1 0 0\ninf 1 0\n1 1 0\n"), "a.ply"),
              HasSubstr("line 10: a coordinate is not a finite number"));
}

TEST(Ply, LeavesOutPointsWithoutAPositionWhereThereAreNoFaces) {
  const Model model =
      ply(ascii("element vertex 2\nproperty float x\nproperty float y\nproperty float z\n"
                "property uchar red\nproperty uchar green\nproperty uchar blue\n"
                "element face 0\nproperty list uchar int vertex_indices\n",
                "nan nan nan 1 2 3\n4 5 6 7 8 9\n"));
  EXPECT_THAT(model.mesh.positions, ElementsAre(Vec3(4, 5, 6)));
  EXPECT_THAT(model.vertex_colours, ElementsAre(Rgb8{7, 8, 9}));
  EXPECT_THAT(model.notes, ElementsAre("points without a position (NaN) left out: 1"));
}

TEST(Ply, RefusesATruncatedFile) {
  const std::string whole = binary_ply(ByteOrder::Little);
  EXPECT_THAT(error_text(whole.substr(0, whole.size() - 1), "a.ply"), HasSubstr("byte"));
  EXPECT_THAT(error_text("ply\nformat ascii 1.0\nelement vertex 1\n", "a.ply"),
              HasSubstr("the file ends inside its header"));
}

TEST(Ply, RefusesBrokenHeaders) {
  EXPECT_THAT(error_text("ply\nformat utf8 1.0\n", "a.ply"),
              HasSubstr("line 2: unknown format 'utf8'"));
  EXPECT_THAT(error_text("ply\nformat ascii 1.0\nelement vertex -5\n", "a.ply"),
              HasSubstr("line 3: expected a name and a number of elements, found 'vertex -5'"));
  EXPECT_THAT(error_text("ply\nformat ascii 1.0\nproperty float x\n", "a.ply"),
              HasSubstr("line 3: a property comes before any element"));
  EXPECT_THAT(error_text("ply\nformat ascii 1.0\nelement vertex 1\nproperty half x\n", "a.ply"),
              HasSubstr("line 4: unknown type 'half'"));
  EXPECT_THAT(
      error_text("ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nend_header\n0\n",
                 "a.ply"),
      HasSubstr("lacks one of the properties x, y, z"));
  EXPECT_THAT(error_text("ply\nelement vertex 0\nend_header\n", "a.ply"),
              HasSubstr("no line that names the format"));
  EXPECT_THAT(error_text("ply\nformat ascii 1.0\nelement face 0\nend_header\n", "a.ply"),
              HasSubstr("declares no element vertex"));
}

TEST(Ply, NotesWhatFollowsTheLastElement) {
  const std::string text = ascii(kVertices, kFourPoints);
  EXPECT_THAT(ply(text + "\n").notes, testing::IsEmpty());
  EXPECT_THAT(ply(text + "\n5 5 5\n").notes,
              ElementsAre("text after the last element left out, from line 13"));
  for (const ByteOrder order : {ByteOrder::Little, ByteOrder::Big}) {
    EXPECT_THAT(ply(binary_ply(order)).notes, testing::IsEmpty());
    EXPECT_THAT(ply(binary_ply(order) + "abc").notes,
                ElementsAre("bytes after the last element left out: 3"));
  }
}

TEST(Ply, ReadsCornersUnderEachOfTheirNames) {
  for (const std::string name : {"vertex_indices", "vertex_index", "vertex_indexes"}) {
    const std::string header =
        kVertices + ("element face 1\nproperty list uchar int " + name + "\n");
    EXPECT_EQ(ply(ascii(header, std::string(kFourPoints) + "3 0 1 2\n")).polygons, 1U) << name;
  }
}

TEST(Ply, TellsWhichListMayHoldTheCorners) {
  EXPECT_THAT(error_text(ascii(std::string(kVertices) + "element face 1\nproperty int q\n"
                                                        "property list uchar int corners\n",
                               std::string(kFourPoints) + "1 3 0 1 2\n"),
                         "a.ply"),
              HasSubstr("vertex_indices; if its corners are in 'corners', rename it"));
}

TEST(Ply, RefusesFacesWithoutCorners) {
  EXPECT_THAT(error_text(ascii(std::string(kVertices) + "element face 1\nproperty int q\n",
                               std::string(kFourPoints) + "1\n"),
                         "a.ply"),
              HasSubstr("lacks the list property vertex_indices"));
}

}  // namespace
}  // namespace vantage::test
