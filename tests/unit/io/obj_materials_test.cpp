// SPDX-License-Identifier: MIT
// Libraries of materials (MTL), and what an OBJ makes of them.
#include <map>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "vantage/io/model.h"
#include "vantage/io/write.h"

#include "io/mtl.h"
#include "io/readers.h"

namespace vantage::test {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

using Files = std::map<std::string, std::string>;

const Image kRed{1, 1, {255, 0, 0, 255}};

/// A triangle for each line of `uses`, beside these files.
Model triangles(const std::vector<std::string>& uses, const Files& files) {
  std::string text = "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nvt 0 0\n";
  for (const std::string& name : uses) {
    text.append("usemtl ").append(name).append("\nf 1/1 2/1 3/1\n");
  }
  const Surroundings surroundings{{},
                                  [&](const std::string& path) {
                                    const auto found = files.find(path);
                                    return found == files.end()
                                               ? SideFile{std::nullopt, "is missing"}
                                               : SideFile{found->second, {}};
                                  },
                                  {.appearance = true},
                                  [&](const std::string& path) { return files.count(path) > 0; }};
  return parse_obj(text, "a.obj", {}, surroundings);
}

TEST(Mtl, BelievesDissolvingRatherThanTransparencyInAnyOrder) {
  const auto materials =
      parse_mtl("newmtl a\nd 1.0\nTr 1.0\nnewmtl b\nTr 1.0\nd 0.75\nnewmtl c\nTr 0.25\n");
  EXPECT_EQ(materials.at("a").opacity, 1.0);
  EXPECT_EQ(materials.at("b").opacity, 0.75);
  EXPECT_EQ(materials.at("c").opacity, 0.75);
}

TEST(Mtl, JoinsLinesAsObjDoes) {
  const auto materials = parse_mtl("newmtl a\nKd 1 \\\n0 0\nd 0.5\n");
  EXPECT_THAT(materials.at("a").colour, ElementsAre(1.0, 0.0, 0.0));
  EXPECT_EQ(materials.at("a").opacity, 0.5);
}

TEST(Mtl, ReadsTheFactorOfAHalo) {
  EXPECT_EQ(parse_mtl("newmtl a\nd -halo 0.25\n").at("a").opacity, 0.25);
}

TEST(ObjMaterials, ACommentBehindANameIsNoPartOfIt) {
  const Model model =
      triangles({"a # red", "b", "c # 2"}, {{"a.mtl",
                                             "newmtl a\nKd 1 0 0\nnewmtl b # green\n"
                                             "Kd 0 1 0\nnewmtl c # 2\nKd 0 0 1\n"}});
  ASSERT_EQ(model.appearance.materials.size(), 3U);
  EXPECT_THAT(model.appearance.materials[0].colour, ElementsAre(1.0, 0.0, 0.0));
  EXPECT_THAT(model.appearance.materials[1].colour, ElementsAre(0.0, 1.0, 0.0));
  EXPECT_THAT(model.appearance.materials[2].colour, ElementsAre(0.0, 0.0, 1.0));
  EXPECT_THAT(model.notes, IsEmpty());
}

TEST(ObjMaterials, AMaskFinerThanItsPictureKeepsAllItsPixels) {
  const Image mask{4, 1, {255, 255, 255, 255, 0, 0, 0, 255, 255, 255, 255, 255, 0, 0, 0, 255}};
  const Model model = triangles({"m"}, {{"a.mtl", "newmtl m\nmap_Kd red.png\nmap_d mask.png\n"},
                                        {"red.png", png_bytes(kRed)},
                                        {"mask.png", png_bytes(mask)}});
  ASSERT_EQ(model.appearance.textures.size(), 1U);
  const Image& image = model.appearance.textures[0].image;
  EXPECT_EQ(image.width, 4);
  EXPECT_THAT(image.rgba, ElementsAre(255, 0, 0, 255, 255, 0, 0, 0, 255, 0, 0, 255, 255, 0, 0, 0));
}

TEST(ObjMaterials, OfATallMaskAndAWidePictureTheOneOfMorePixelsGivesTheSize) {
  const auto white = [](int width, int height) {
    return png_bytes(
        Image{width, height, std::vector<std::uint8_t>(4 * std::size_t(width * height), 255)});
  };
  const Model model = triangles({"m"}, {{"a.mtl", "newmtl m\nmap_Kd wide.png\nmap_d tall.png\n"},
                                        {"wide.png", white(3, 1)},
                                        {"tall.png", white(1, 5)}});
  ASSERT_EQ(model.appearance.textures.size(), 1U);
  EXPECT_EQ(model.appearance.textures[0].image.width, 1);
  EXPECT_EQ(model.appearance.textures[0].image.height, 5);
}

TEST(ObjMaterials, AMaskAloneLiesAsItsOptionsSay) {
  const Model model =
      triangles({"m"}, {{"a.mtl", "newmtl m\nmap_d -clamp on -s 4 2 1 -o 0.5 0.25 0 mask.png\n"},
                        {"mask.png", png_bytes(kRed)}});
  ASSERT_EQ(model.appearance.textures.size(), 1U);
  EXPECT_EQ(model.appearance.textures[0].wrap_u, TextureWrap::Clamp);
  EXPECT_THAT(model.appearance.materials.at(0).uv_transform,
              ElementsAre(4.0, 0.0, 0.5, 0.0, -2.0, 0.75));
  EXPECT_THAT(model.notes, IsEmpty());
}

TEST(ObjMaterials, AMaskThatShouldLieOtherwiseThanItsPictureIsANote) {
  const Model model = triangles({"m", "same"}, {{"a.mtl",
                                                 "newmtl m\nmap_Kd -s 2 2 red.png\nmap_d mask.png\n"
                                                 "newmtl same\nmap_Kd -s 2 2 red.png\n"
                                                 "map_d -s 2 2 mask.png\n"},
                                                {"red.png", png_bytes(kRed)},
                                                {"mask.png", png_bytes(kRed)}});
  EXPECT_EQ(model.appearance.materials.at(0).uv_transform[0], 2.0);
  EXPECT_THAT(model.notes, ElementsAre("masks (map_d) with options of their own, laid as their "
                                       "pictures are: 1"));
}

TEST(ObjMaterials, APictureIsOneTextureHoweverItIsSpelled) {
  const std::string clear = png_bytes(Image{1, 1, {255, 0, 0, 64}});
  const Model model = triangles({"a", "b", "c"}, {{"a.mtl",
                                                   "newmtl a\nmap_Kd red.png\nnewmtl b\n"
                                                   "map_Kd ./red.png\nnewmtl c\nmap_Kd red.png\n"
                                                   "map_d .//./red.png\n"},
                                                  {"red.png", clear}});
  ASSERT_EQ(model.appearance.textures.size(), 1U);
  for (const Material& material : model.appearance.materials) {
    EXPECT_EQ(material.texture, 0U);
  }
  EXPECT_EQ(model.appearance.materials.at(2).alpha, AlphaMode::Mask);
}

}  // namespace
}  // namespace vantage::test
