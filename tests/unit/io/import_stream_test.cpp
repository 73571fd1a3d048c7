// SPDX-License-Identifier: MIT
// The stream of vantage-import: whole ones are read as they are, and no count in one is believed.
#include "vantage/io/import_stream.h"

#include <bit>
#include <fstream>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "vantage/core/error.h"
#include "vantage/io/model.h"

#include "io/byte_cursor.h"

namespace vantage::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

template <class... Numbers>
std::string bytes(Numbers... numbers) {
  std::string text;
  (append_little_endian(text, numbers), ...);
  return text;
}

std::string record(const std::string& tag, const std::string& payload) {
  return tag + bytes(std::uint64_t{payload.size()}) + payload;
}

std::string head(double unit_m, std::uint32_t up, bool stated) {
  return record("head", bytes(unit_m, up, std::uint32_t{stated}, 1U));
}

const std::string kCornerBytes = bytes(0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0);

struct Mesh {
  std::uint32_t flags = 0;
  std::uint32_t material = kImportNone;
  std::string name = "part";
  std::uint64_t vertices = 3;
  std::uint64_t faces = 1;
  std::string body = kCornerBytes + bytes(3U, 0U, 1U, 2U);

  [[nodiscard]] std::string text() const {
    return record("mesh", bytes(flags, material, static_cast<std::uint32_t>(name.size())) + name +
                              bytes(vertices, faces) + body);
  }
};

std::string stream(const std::vector<std::string>& records, std::uint64_t meshes) {
  std::string text(kImportMagic);
  for (const std::string& one : records) {
    text += one;
  }
  return text + record("done", bytes(meshes));
}

Model read(const std::string& sent, const std::string& name = "a.fbx",
           const std::string& file = "?") {
  return parse_model(
      file, name, {},
      {.appearance = true, .importer = [&](const auto&, const auto&) { return sent; }});
}

std::string error_of(const std::string& sent) {
  try {
    static_cast<void>(read(sent));
    return "nothing was wrong";
  } catch (const FormatError& error) {
    return error.what();
  }
}

TEST(ImportStream, GivesVerticesFacesPartsUnitAndUpAsTheyWereSent) {
  const Model model =
      read(stream({head(0.01, 5, true), Mesh{.name = "a"}.text(),
                   Mesh{.flags = kImportSamePart, .name = "a"}.text(), Mesh{.name = "b"}.text()},
                  3));
  EXPECT_EQ(format_name(model), "fbx");
  EXPECT_EQ(model.mesh.positions.size(), 9U);
  EXPECT_EQ(model.mesh.positions[4], Vec3(1.0, 0.0, 0.0));
  EXPECT_THAT(model.mesh.triangles,
              ElementsAre(Triangle{0, 1, 2}, Triangle{3, 4, 5}, Triangle{6, 7, 8}));
  ASSERT_EQ(model.parts.size(), 2U);
  EXPECT_EQ(model.parts[0].name, "a");
  EXPECT_EQ(model.parts[0].triangle_count, 2U);
  EXPECT_EQ(model.unit_m, 0.01);
  EXPECT_EQ(model.usual_up, Vec3(0.0, 0.0, -1.0));
  EXPECT_TRUE(model.up_is_stated);
  EXPECT_TRUE(model.double_precision);
}

TEST(ImportStream, GivesColoursAndMaterials) {
  const std::string colours = bytes(1.0F, 0.0F, 0.0F, 0.0F, 1.0F, 0.0F, 0.0F, 0.0F, 1.0F);
  const std::string material = bytes(0.25, 0.5, 1.0, 0.5, kImportNone, 0U, 2U);
  const Model model = read(stream({record("matl", material), Mesh{}.text(),
                                   Mesh{.flags = kImportColours,
                                        .material = 0,
                                        .body = kCornerBytes + colours + bytes(3U, 0U, 1U, 2U)}
                                       .text()},
                                  2));
  ASSERT_EQ(model.vertex_colours.size(), 6U);
  EXPECT_EQ(model.vertex_colours[0][0], 255);  // white, for want of a colour
  EXPECT_EQ(model.vertex_colours[4][0], 0);
  EXPECT_EQ(model.vertex_colours[4][1], 255);
  ASSERT_EQ(model.appearance.materials.size(), 1U);
  EXPECT_EQ(model.appearance.materials[0].colour[1], 0.5);
  EXPECT_EQ(model.appearance.materials[0].alpha, AlphaMode::Blend);
  EXPECT_THAT(model.appearance.material_of_triangle, ElementsAre(Appearance::kNone, 0U));
}

TEST(ImportStream, TriangulatesPolygonsAndLeavesOutLines) {
  const std::string square = bytes(0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 1.0, 1.0, 0.0, 0.0, 1.0, 0.0);
  const Model model = read(stream(
      {Mesh{.vertices = 4, .faces = 2, .body = square + bytes(2U, 0U, 1U, 4U, 0U, 1U, 2U, 3U)}
           .text()},
      1));
  EXPECT_EQ(model.mesh.triangles.size(), 2U);
  EXPECT_EQ(model.quads, 1U);
  EXPECT_EQ(model.skipped_faces, 1U);
}

TEST(ImportStream, BelievesNoCount) {
  const std::uint64_t many = std::uint64_t{1} << 61U;
  EXPECT_THAT(error_of(stream({Mesh{.vertices = many}.text()}, 1)), HasSubstr("less than"));
  EXPECT_THAT(error_of(stream({Mesh{.vertices = many / 4 + 1}.text()}, 1)), HasSubstr("less than"));
  EXPECT_THAT(error_of(stream({Mesh{.faces = many}.text()}, 1)), HasSubstr("less than"));
  EXPECT_THAT(error_of(stream({Mesh{.faces = 0}.text()}, 1)), HasSubstr("more than"));
  EXPECT_THAT(error_of(stream({Mesh{.body = kCornerBytes + bytes(~0U, 0U)}.text()}, 1)),
              HasSubstr("less than"));
  EXPECT_THAT(error_of(stream({Mesh{.body = kCornerBytes + bytes(3U, 0U, 1U, 3U)}.text()}, 1)),
              HasSubstr("names vertex 3 of a part that has 3"));
  EXPECT_THAT(error_of(std::string(kImportMagic) + "note" + bytes(~std::uint64_t{0})),
              HasSubstr("less than"));
}

TEST(ImportStream, RefusesWhatIsCutOrNotAStream) {
  const std::string whole = stream({Mesh{}.text()}, 1);
  for (std::size_t size = 0; size < whole.size(); ++size) {
    EXPECT_THAT(error_of(whole.substr(0, size)), HasSubstr("vantage-import")) << size;
  }
  EXPECT_THAT(error_of(whole + "x"), HasSubstr("after its end"));
  EXPECT_THAT(error_of(stream({Mesh{}.text()}, 2)), HasSubstr("lost a part"));
  EXPECT_THAT(error_of(stream({record("what", "")}, 0)), HasSubstr("another version"));
  EXPECT_THAT(error_of(stream({}, 0)), HasSubstr("holds no faces"));
}

TEST(ImportStream, SaysInOneLineWhyNothingCouldBeRead) {
  EXPECT_THAT(error_of(std::string(kImportMagic) + record("fail", "bad\n\x1B[31mfile.")),
              HasSubstr("cannot be read as FBX by Assimp: bad  [31mfile; convert it to OBJ, PLY or "
                        "GLB first, for example with meshlab or Blender"));
}

TEST(ImportStream, RefusesCoordinatesThatAreNoNumbers) {
  const std::string body = bytes(std::bit_cast<double>(~std::uint64_t{0}), 0.0, 0.0) +
                           kCornerBytes.substr(24) + bytes(3U, 0U, 1U, 2U);
  EXPECT_THAT(error_of(stream({Mesh{.body = body}.text()}, 1)), HasSubstr("not a finite number"));
}

TEST(ImportStream, LeavesOutPicturesThatAreNotBesideTheModel) {
  const auto picture = [](const std::string& path) { return record("pict", bytes(0U) + path); };
  const auto material = [](std::uint32_t of) {
    return record("matl", bytes(1.0, 1.0, 1.0, 1.0, of, 0U, 0U));
  };
  const std::string sent =
      stream({picture("../../etc/passwd"), picture("http://a/b.png"), material(0), material(1),
              material(7), Mesh{.material = 0}.text()},
             1);
  std::ofstream(testing::TempDir() + "picture_test.fbx") << "; FBX";
  const Model model =
      load_model(testing::TempDir() + "picture_test.fbx", {},
                 {.appearance = true, .importer = [&](const auto&, const auto&) { return sent; }});
  EXPECT_TRUE(model.appearance.textures.empty());
  EXPECT_EQ(model.appearance.materials.size(), 3U);
  EXPECT_THAT(model.notes, ElementsAre(HasSubstr("'passwd'"), HasSubstr("'b.png'")));
}

/// What a file would be imported as; empty: it is not asked for.
std::string asked_for(const std::string& file, const std::string& name) {
  std::string asked;
  try {
    static_cast<void>(
        parse_model(file, name, {}, {.importer = [&](const ImportRequest& request, const auto&) {
                      asked = request.format.name;
                      return std::string();
                    }}));
  } catch (const FormatError&) {
    return asked;
  }
  return asked;
}

TEST(ImportStream, IsAskedForByContentAndElseByName) {
  EXPECT_EQ(asked_for("ISO-10303-21;", "a.txt"), "step");
  EXPECT_EQ(asked_for("ISO-10303-21;\nFILE_SCHEMA(('IFC2X3'));", "a.step"), "ifc");
  EXPECT_EQ(asked_for("Kaydara FBX Binary  ", "standard input"), "fbx");
  EXPECT_EQ(asked_for("<?xml version='1.0'?><COLLADA>", "a"), "dae");
  EXPECT_EQ(asked_for("<?xml version='1.0'?><html>", "a"), "");
  EXPECT_EQ(asked_for("MM....", "a.3DS"), "3ds");
  EXPECT_EQ(asked_for("\x1F\x8B\x08", "a.blend"), "blend");
  EXPECT_EQ(asked_for("\x1F\x8B\x08", "a.step"), "");
  EXPECT_EQ(asked_for("\xFF\xFE<", "a.dae"), "dae");
  EXPECT_EQ(asked_for("v 1 2 3\nv 2 3 4\nv 3 4 6\nf 1 2 3\n", "a.obj"), "");
  EXPECT_EQ(asked_for("LASF", "a.las"), "");
  const std::string line = std::string(72, ' ') + "S      1\n";
  EXPECT_EQ(asked_for(line, "a.bin"), "iges");
}

TEST(PicturesBeside, AreThoseOfAStreamThatAreNotInsideIt) {
  const std::string text = stream(
      {head(1.0, 2, true), record("pict", bytes(0U) + ".\\maps\\a.png"),
       record("pict", bytes(1U) + "PNG"), record("pict", bytes(0U) + "b.png"), Mesh().text()},
      1);
  EXPECT_THAT(pictures_beside(text), ElementsAre("maps/a.png", "b.png"));
  for (std::size_t size = 0; size < text.size(); ++size) {
    EXPECT_LE(pictures_beside(std::string_view(text).substr(0, size)).size(), 2U);
  }
  EXPECT_THAT(pictures_beside("no stream"), ElementsAre());
}

}  // namespace
}  // namespace vantage::test
