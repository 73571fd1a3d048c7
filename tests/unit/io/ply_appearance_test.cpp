// SPDX-License-Identifier: MIT
// Textures of PLY, as MeshLab names and lays them.
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "vantage/io/model.h"
#include "vantage/io/write.h"

#include "support/temporary_folder.h"

namespace vantage::test {
namespace {

using testing::Contains;
using testing::Each;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr std::uint32_t kNone = Appearance::kNone;

/// A square of one quadrangle in a folder with a green picture "a.png" and a blue "m.png".
class PlyAppearance : public testing::Test {
 protected:
  PlyAppearance() {
    write_file(folder_.file("a.png"), png_bytes(Image{1, 1, {0, 255, 0, 255}}));
    write_file(folder_.file("m.png"), png_bytes(Image{1, 1, {0, 0, 255, 255}}));
  }

  Model load(const std::string& text, bool with_appearance = true) const {
    write_file(folder_.file("m.ply"), text);
    return load_model(folder_.file("m.ply"), {}, {.appearance = with_appearance});
  }

  /// \param comments lines. \param of_vertex, of_face properties that follow x, y, z and the corners.
  static std::string header(const std::string& comments, const std::string& of_vertex,
                            const std::string& of_face, int faces = 1) {
    return "ply\nformat ascii 1.0\n" + comments +
           "element vertex 4\nproperty float x\nproperty float y\nproperty float z\n" + of_vertex +
           "element face " + std::to_string(faces) + "\nproperty list uchar int vertex_indices\n" +
           of_face + "end_header\n";
  }

  const TemporaryFolder folder_{};
};

constexpr const char* kSquare = "0 0 0\n1 0 0\n1 1 0\n0 1 0\n";
constexpr const char* kOfCorners = "property list uchar float texcoord\n";
constexpr const char* kNamesA = "comment TextureFile a.png\n";

TEST_F(PlyAppearance, CornersHavePlacesOfTheirOwn) {
  const std::string text =
      header(kNamesA, "", kOfCorners) + kSquare + "4 0 1 2 3 8 0 0 1 0 1 0.5 0 1\n";
  const Appearance a = load(text).appearance;
  ASSERT_EQ(a.materials.size(), 1U);
  ASSERT_EQ(a.textures.size(), 1U);
  EXPECT_THAT(a.textures[0].image.rgba, ElementsAre(0, 255, 0, 255));
  EXPECT_EQ(a.materials[0].texture, 0U);
  EXPECT_THAT(a.material_of_triangle, ElementsAre(0U, 0U));
  ASSERT_EQ(a.uv_of_triangle.size(), 2U);
  const Model model = load(text);
  for (std::size_t t = 0; t < 2; ++t) {
    for (std::size_t c = 0; c < 3; ++c) {  // corner i of the only face is vertex i
      EXPECT_EQ(a.uv_of_triangle[t][c], model.mesh.triangles[t][c]);
    }
  }
  EXPECT_THAT(a.uvs[2], ElementsAre(1.0F, 0.5F));
  // (0, 0) is the picture's bottom left corner, which textures call (0, 1).
  EXPECT_THAT(a.materials[0].uv_transform, ElementsAre(1.0, 0.0, 0.0, 0.0, -1.0, 1.0));
  EXPECT_THAT(load(text, false).appearance.materials, IsEmpty());
}

TEST_F(PlyAppearance, PlacesMayStandBeforeTheCorners) {
  std::string text = header(kNamesA, "", kOfCorners);
  const std::string corners = "property list uchar int vertex_indices\n";
  text.erase(text.find(corners), corners.size());
  text.insert(text.find("end_header"), corners);
  const Appearance a = load(text + kSquare + "8 0 0 1 0 1 0.5 0 1 4 0 1 2 3\n").appearance;
  EXPECT_THAT(a.uvs[2], ElementsAre(1.0F, 0.5F));
  EXPECT_EQ(a.uv_of_triangle.size(), 2U);
}

TEST_F(PlyAppearance, EachFaceNamesItsPicture) {
  const std::string text = header(std::string(kNamesA) + "comment texturefile \"<this>.png\"\n", "",
                                  std::string(kOfCorners) + "property int texnumber\n", 4) +
                           kSquare +
                           "3 0 1 2 6 0 0 1 0 1 1 1\n"
                           "3 0 2 3 6 0 0 1 1 0 1 0\n"
                           "3 0 1 3 6 0 0 1 1 0 1 -1\n"  // none
                           "3 0 1 3 0 0\n";              // no places
  const Appearance a = load(text).appearance;
  EXPECT_EQ(a.textures.size(), 2U);
  EXPECT_THAT(a.material_of_triangle, ElementsAre(1U, 0U, kNone, kNone));
  EXPECT_THAT(a.uv_of_triangle[3], Each(kNone));
}

TEST_F(PlyAppearance, APictureIsOneTextureHoweverOftenItIsNamed) {
  const Appearance a = load(header(std::string(kNamesA) + "comment TextureFile m.png\n"
                                                          "comment TextureFile ./a.png\n",
                                   "", std::string(kOfCorners) + "property int texnumber\n", 3) +
                            kSquare +
                            "3 0 1 2 6 0 0 1 0 1 1 2\n3 0 2 3 6 0 0 1 1 0 1 1\n"
                            "3 0 1 3 6 0 0 1 0 0 1 0\n")
                           .appearance;
  EXPECT_EQ(a.textures.size(), 2U);
  EXPECT_THAT(a.material_of_triangle, ElementsAre(0U, 1U, 0U));
}

TEST_F(PlyAppearance, VerticesHavePlacesByAnyOfTheirNames) {
  for (const auto& [u, v] : {std::pair("texture_u", "texture_v"), {"s", "t"}, {"u", "v"}}) {
    const std::string text = header(kNamesA,
                                    std::string("property float ") + u + "\nproperty float " + v +
                                        "\nproperty uchar red\nproperty uchar green\n"
                                        "property uchar blue\n",
                                    "") +
                             "0 0 0 0 0 9 9 9\n1 0 0 1 0 9 9 9\n1 1 0 1 0.5 9 9 9\n"
                             "0 1 0 0 1 9 9 9\n4 0 1 2 3\n";
    const Model model = load(text);
    EXPECT_EQ(model.appearance.uv_of_triangle, model.mesh.triangles) << u;
    EXPECT_THAT(model.appearance.uvs[2], ElementsAre(1.0F, 0.5F)) << u;
    EXPECT_THAT(model.vertex_colours, IsEmpty());
    EXPECT_THAT(model.notes, Contains(HasSubstr("colours of vertices left out")));
    EXPECT_EQ(load(text, false).vertex_colours.size(), 4U);
  }
}

TEST_F(PlyAppearance, WhatCannotBeHadIsANoteAndKeepsTheColours) {
  const std::string colours =
      "property uchar red\nproperty uchar green\nproperty uchar blue\n"
      "property float s\nproperty float t\n";
  const std::string vertices =
      "0 0 0 9 9 9 0 0\n1 0 0 9 9 9 0 0\n1 1 0 9 9 9 0 0\n0 1 0 9 9 9 0 0\n";
  const Model gone =
      load(header("comment TextureFile gone.png\n", colours, "") + vertices + "4 0 1 2 3\n");
  EXPECT_THAT(gone.appearance.materials, IsEmpty());
  EXPECT_EQ(gone.vertex_colours.size(), 4U);
  EXPECT_THAT(gone.notes, Contains(HasSubstr("gone.png")));
  const Model nowhere = load(header(kNamesA, "", "") + kSquare + "4 0 1 2 3\n");
  EXPECT_THAT(nowhere.appearance.materials, IsEmpty());
  EXPECT_THAT(nowhere.notes, Contains(HasSubstr("does not say where it lies")));
}

TEST_F(PlyAppearance, ClearVerticesAreNoted) {
  const auto notes = [&](const char* type, const char* alpha) {
    const std::string colour = std::string("0 0 0 ") + alpha + "\n";
    return load(header("",
                       std::string("property uchar red\nproperty uchar green\nproperty uchar blue\n"
                                   "property ") +
                           type + " alpha\n",
                       "") +
                "0 0 0 " + colour + "1 0 0 " + colour + "1 1 0 " + colour + "0 1 0 " + colour +
                "4 0 1 2 3\n")
        .notes;
  };
  EXPECT_THAT(notes("uchar", "254"), Contains(HasSubstr("opacity")));
  EXPECT_THAT(notes("float", "0.5"), Contains(HasSubstr("opacity")));
  EXPECT_THAT(notes("uchar", "255"), IsEmpty());
  EXPECT_THAT(notes("float", "1"), IsEmpty());
}

TEST_F(PlyAppearance, DoesNotReadOutsideItsFolder) {
  const TemporaryFolder elsewhere;
  write_file(elsewhere.file("c.png"), png_bytes(Image{1, 1, {255, 0, 0, 255}}));
  const Model model =
      load(header("comment TextureFile " + elsewhere.file("c.png") + "\n", "", kOfCorners) +
           kSquare + "3 0 1 2 6 0 0 1 0 1 1\n");
  EXPECT_THAT(model.appearance.textures, IsEmpty());
}

}  // namespace
}  // namespace vantage::test
