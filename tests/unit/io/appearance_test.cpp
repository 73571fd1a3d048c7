// SPDX-License-Identifier: MIT
// What files say about how their surface looks.
#include <filesystem>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "vantage/io/model.h"
#include "vantage/io/write.h"

#include "io/model_builder.h"
#include "io/readers.h"
#include "io/texture_loader.h"
#include "support/temporary_folder.h"

namespace vantage::test {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

const ReadOptions kAll{.appearance = true};

std::string green_png() {
  return png_bytes(Image{1, 1, {0, 255, 0, 255}});
}

/// A square with texture coordinates as data URIs; `material` is what the test is about.
std::string gltf(const std::string& material, const std::string& more) {
  std::string numbers;
  const auto append = [&](std::initializer_list<float> values) {
    for (const float value : values) {
      numbers.append(reinterpret_cast<const char*>(&value), sizeof value);
    }
  };
  append({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0});  // positions
  append({0, 0, 1, 0, 0, 1, 1, 0.5F});           // coordinates
  return R"({"asset":{"version":"2.0"},"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],
    "meshes":[{"primitives":[{"attributes":{"POSITION":0,"TEXCOORD_0":1},"mode":5,"material":0}]}],
    "accessors":[{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3"},
                 {"bufferView":1,"componentType":5126,"count":4,"type":"VEC2"}],
    "bufferViews":[{"buffer":0,"byteLength":48},{"buffer":0,"byteOffset":48,"byteLength":32}],
    "buffers":[{"byteLength":80,"uri":"data:;base64,)" +
         base64(numbers) + R"("}],"materials":[)" + material + "]" + more + "}";
}

/// A texture 0 that shows an image given by members of it.
std::string image_part(const std::string& image) {
  return R"(,"textures":[{"source":0,"sampler":0}],"images":[{)" + image +
         R"(}],"samplers":[{"wrapS":33071,"wrapT":33648,"magFilter":9728}])";
}

std::string green_part() {
  return image_part(R"("uri":"data:image/png;base64,)" + base64(green_png()) + '"');
}

constexpr const char* kTextured = R"({"pbrMetallicRoughness":{"baseColorTexture":{"index":0}}})";

TEST(GltfAppearance, HasTheTextureAndItsSamplerAndCoordinates) {
  const Appearance a = parse_model(gltf(kTextured, green_part()), "a.gltf", {}, kAll).appearance;
  ASSERT_EQ(a.materials.size(), 1U);
  ASSERT_EQ(a.textures.size(), 1U);
  EXPECT_EQ(a.materials[0].texture, 0U);
  EXPECT_THAT(a.textures[0].image.rgba, ElementsAre(0, 255, 0, 255));
  EXPECT_EQ(a.textures[0].wrap_u, TextureWrap::Clamp);
  EXPECT_EQ(a.textures[0].wrap_v, TextureWrap::Mirror);
  EXPECT_TRUE(a.textures[0].nearest);
  EXPECT_THAT(a.material_of_triangle, ElementsAre(0U, 0U));
  EXPECT_THAT(a.uv_of_triangle, ElementsAre(Triangle{0, 1, 2}, Triangle{2, 1, 3}));
  EXPECT_THAT(a.uvs[3], ElementsAre(1.0F, 0.5F));
}

TEST(GltfAppearance, IsReadOnlyWhenAskedFor) {
  EXPECT_THAT(parse_model(gltf(kTextured, green_part()), "a.gltf").appearance.materials, IsEmpty());
}

TEST(GltfAppearance, KnowsHolesGlassAndWhatNeedsNoLight) {
  const auto material = [](const char* text) {
    return parse_model(gltf(text, ""), "a.gltf", {}, kAll).appearance.materials.at(0);
  };
  const Material mask = material(R"({"alphaMode":"MASK","alphaCutoff":0.25})");
  EXPECT_EQ(mask.alpha, AlphaMode::Mask);
  EXPECT_EQ(mask.alpha_cutoff, 0.25);
  const Material glass =
      material(R"({"alphaMode":"BLEND","pbrMetallicRoughness":{"baseColorFactor":[1,1,1,0.5]}})");
  EXPECT_EQ(glass.alpha, AlphaMode::Blend);
  EXPECT_EQ(glass.opacity, 0.5);
  EXPECT_TRUE(material(R"({"extensions":{"KHR_materials_unlit":{}}})").unlit);
}

TEST(GltfAppearance, KnowsLightOfItsOwn) {
  const auto material = [](const std::string& text) {
    return parse_model(gltf("{" + text + "}", green_part()), "a.gltf", {}, kAll)
        .appearance.materials.at(0);
  };
  const std::string factor = R"("emissiveFactor":[0.5,0.25,0])";
  const Material plain = material(factor);
  EXPECT_THAT(plain.emission, ElementsAre(0.5, 0.25, 0.0));
  EXPECT_FALSE(plain.emission_texture);
  const Material strong = material(
      factor + R"(,"extensions":{"KHR_materials_emissive_strength":{"emissiveStrength":3}})");
  EXPECT_THAT(strong.emission, ElementsAre(1.0, 0.75, 0.0));
  const Material screen = material(factor + R"(,"emissiveTexture":{"index":0,
      "extensions":{"KHR_texture_transform":{"offset":[5,7]}}})");
  EXPECT_THAT(screen.emission, ElementsAre(0.5, 0.25, 0.0));
  EXPECT_EQ(screen.emission_texture, 0U);
  EXPECT_EQ(screen.uv_transform[2], 5.0);
  EXPECT_THAT(material(R"("emissiveTexture":{"index":0})").emission, ElementsAre(0.0, 0.0, 0.0));
}

TEST(GltfAppearance, TakesTheCoordinatesOfAnEmissionWhereTheColourHasNoPicture) {
  const auto last_uv = [](const char* set) {
    const std::string material = R"({"emissiveFactor":[1,1,1],"emissiveTexture":{"index":0)";
    return parse_model(gltf(material + set + "}}", green_part()), "a.gltf", {}, kAll)
        .appearance.uvs.at(3);
  };
  EXPECT_THAT(last_uv(""), ElementsAre(1.0F, 0.5F));
  EXPECT_THAT(last_uv(R"(,"texCoord":1)"), ElementsAre(0.0F, 0.0F));  // which the primitive has not
}

TEST(GltfAppearance, LeavesOutLightWhosePictureIsMissingOrLiesOtherwiseThanTheColours) {
  const std::string factor = R"({"emissiveFactor":[1,1,1],"emissiveTexture":)";
  const std::string colour = R"(,"pbrMetallicRoughness":{"baseColorTexture":{"index":0}}})";
  for (const std::string& material :
       {factor + R"({"index":9}})", factor + R"({"index":0,"texCoord":1})" + colour,
        factor + R"({"index":0,"extensions":{"KHR_texture_transform":{"scale":[2,2]}}})" +
            colour}) {
    const Appearance a = parse_model(gltf(material, green_part()), "a.gltf", {}, kAll).appearance;
    EXPECT_THAT(a.materials.at(0).emission, ElementsAre(0.0, 0.0, 0.0)) << material;
    EXPECT_FALSE(a.materials.at(0).emission_texture) << material;
  }
}

TEST(GltfAppearance, GivesTheDiffuseColourOfSpecularAndGlossinessToTheVertices) {
  const Model model = parse_model(
      gltf(R"({"extensions":{"KHR_materials_pbrSpecularGlossiness":{"diffuseFactor":[1,0,0,1]}}})",
           ""),
      "a.gltf", {}, kAll);
  EXPECT_THAT(model.vertex_colours.at(0), ElementsAre(255, 0, 0));
}

TEST(GltfAppearance, MovesCoordinatesAsTheTransformSays) {
  // A quarter turn counter-clockwise of coordinates whose v runs down: (1, 0) goes to (0, −1).
  const Material material =
      parse_model(gltf(R"({"pbrMetallicRoughness":{"baseColorTexture":{"index":0,
      "extensions":{"KHR_texture_transform":{"offset":[5,7],"rotation":1.5707963267948966,"scale":[2,3]}}}}})",
                       green_part()),
                  "a.gltf", {}, kAll)
          .appearance.materials[0];
  const auto& m = material.uv_transform;
  EXPECT_NEAR(m[0] * 1.0 + m[2], 5.0, 1e-12);
  EXPECT_NEAR(m[3] * 1.0 + m[5], 7.0 - 2.0, 1e-12);
  EXPECT_NEAR(m[1] * 1.0 + m[2], 5.0 + 3.0, 1e-12);
  EXPECT_NEAR(m[4] * 1.0 + m[5], 7.0, 1e-12);
}

TEST(GltfAppearance, ATextureThatCannotBeHadIsANoteAndNoError) {
  for (const char* image :
       {R"("uri":"../secret.png")", R"("uri":"http://x/a.png")", R"("bufferView":9)",
        R"("uri":"data:image/png;base64,!!")", R"("uri":"a.png")"}) {
    const Model model = parse_model(gltf(kTextured, image_part(image)), "a.gltf", {}, kAll);
    EXPECT_THAT(model.appearance.textures, IsEmpty()) << image;
    EXPECT_THAT(model.notes, Contains(HasSubstr("was left out"))) << image;
    EXPECT_EQ(model.mesh.triangles.size(), 2U) << image;
  }
}

TEST(GltfAppearance, ReadsATextureThatIsPercentEncoded) {
  std::string data;
  for (const char c : green_png()) {
    constexpr std::string_view kDigits = "0123456789ABCDEF";
    const auto byte = static_cast<unsigned char>(c);
    data += std::string{'%', kDigits[byte / 16U], kDigits[byte % 16U]};
  }
  const Model model = parse_model(
      gltf(kTextured, image_part(R"("uri":"data:image/png,)" + data + '"')), "a.gltf", {}, kAll);
  EXPECT_EQ(model.appearance.textures.size(), 1U);
  EXPECT_THAT(model.notes, IsEmpty());
}

TEST(GltfAppearance, CoordinatesThatLeaveTheFileAreANote) {
  std::string text = gltf(kTextured, green_part());
  text.replace(text.find(R"("byteOffset":48,"byteLength":32)"), 31,
               R"("byteOffset":48,"byteLength":8 )");
  const Model model = parse_model(text, "a.gltf", {}, kAll);
  EXPECT_THAT(model.notes, Contains(HasSubstr("texture coordinates of a primitive left out")));
  EXPECT_THAT(model.appearance.uvs.at(3), ElementsAre(0.0F, 0.0F));
}

TEST(GltfAppearance, TriesAPictureThatIsNoneOnce) {
  const TemporaryFolder folder;
  write_file(folder.file("no.png"), "\x89PNG and no more");
  std::string materials;
  std::string textures;
  std::string images;
  for (int i = 0; i < 60; ++i) {
    const std::string comma = i == 0 ? "" : ",";
    materials += comma + R"({"pbrMetallicRoughness":{"baseColorTexture":{"index":)" +
                 std::to_string(i) + "}}}";
    textures += comma + R"({"source":)" + std::to_string(i) + "}";
    images += comma + R"({"uri":")" + (i % 2 == 0 ? "./" : "") + "no.png\"}";
  }
  write_file(folder.file("a.gltf"),
             gltf(materials, R"(,"textures":[)" + textures + R"(],"images":[)" + images + "]"));
  const Model model = load_model(folder.file("a.gltf"), {}, kAll);
  EXPECT_THAT(model.notes, ElementsAre(HasSubstr("'no.png' was left out")));
}

TEST(GltfAppearance, AnImageOfManyTexturesIsOneUnlessItIsSampledOtherwise) {
  std::string materials;
  for (int i = 0; i < 3; ++i) {
    materials += (i == 0 ? "" : ",") +
                 (R"({"pbrMetallicRoughness":{"baseColorTexture":{"index":)" + std::to_string(i)) +
                 "}}}";
  }
  std::string parts = green_part();
  const std::string one = R"({"source":0,"sampler":0})";
  parts.replace(parts.find(one), one.size(), one + "," + one + R"(,{"source":0})");
  const Appearance a = parse_model(gltf(materials, parts), "a.gltf", {}, kAll).appearance;
  EXPECT_EQ(a.textures.size(), 2U);
  EXPECT_EQ(a.materials.at(1).texture, 0U);
  EXPECT_EQ(a.materials.at(2).texture, 1U);
}

TEST(GltfAppearance, DecodesAnImageOnceInHoweverManyWaysItIsWrapped) {
  std::string parts = image_part(R"("uri":"a.png")");
  const std::string one = R"({"source":0,"sampler":0})";
  parts.replace(parts.find(one), one.size(), one + R"(,{"source":0})");
  const std::string two =
      R"({"pbrMetallicRoughness":{"baseColorTexture":{"index":0}}},
         {"pbrMetallicRoughness":{"baseColorTexture":{"index":1}}})";
  int reads = 0;
  Surroundings surroundings;
  surroundings.options = kAll;
  surroundings.side_files = [&](const std::string&) {
    ++reads;
    return SideFile{green_png(), ""};
  };
  const Appearance a = parse_gltf(gltf(two, parts), "a.gltf", {}, surroundings).appearance;
  EXPECT_EQ(reads, 1);
  ASSERT_EQ(a.textures.size(), 2U);
  EXPECT_EQ(a.textures[1].image.rgba, a.textures[0].image.rgba);
  EXPECT_EQ(a.textures[1].wrap_u, TextureWrap::Repeat);
  EXPECT_EQ(a.materials[1].texture, 1U);
}

TEST(TextureList, APictureThatIsTooLargeForOneMoreWayIsShownInAnEarlierOne) {
  const RunContext run;
  ModelBuilder builder(ModelFormat::Gltf, "a.gltf", run, 0);
  const Surroundings none;
  TextureLoader loader(none, builder);
  TextureList list(loader);
  const auto green = [&] { return loader.embedded(green_png(), "one"); };
  const Texture clamped{{}, TextureWrap::Clamp, TextureWrap::Clamp, false};
  const Texture mirrored{{}, TextureWrap::Mirror, TextureWrap::Mirror, false};
  EXPECT_EQ(list.add(0, {}, green), 0U);
  EXPECT_EQ(list.add(0, clamped, green), 1U);
  EXPECT_TRUE(loader.may_keep_again(kMostTexturePixels - 2));  // of two pixels
  EXPECT_TRUE(list.add(0, mirrored, green).value_or(9) < 2U);
  EXPECT_EQ(list.add(0, {}, green), 0U);
  EXPECT_EQ(list.take().size(), 2U);
  builder.add_point(Vec3::Zero(), {"vertex", 0});
  builder.add_point(Vec3::UnitX(), {"vertex", 1});
  EXPECT_THAT(builder.finish().notes, Contains(HasSubstr("wrapped in some of them alone")));
}

TEST(TextureLoader, CountsThePixelsOfDamagedPicturesToo) {
  constexpr int kSide = 64;
  constexpr std::size_t kPixels = std::size_t{kSide} * kSide;
  std::string damaged = png_bytes(Image{kSide, kSide, std::vector<std::uint8_t>(4 * kPixels, 255)});
  damaged[damaged.size() - 20] = static_cast<char>(damaged[damaged.size() - 20] ^ 1);
  const RunContext run;
  ModelBuilder builder(ModelFormat::Gltf, "a.gltf", run, 0);
  const Surroundings none;
  TextureLoader loader(none, builder);
  EXPECT_FALSE(loader.embedded(damaged, "one").has_value());
  EXPECT_EQ(loader.decoded_left(), kMostDecodedPixels - kPixels);
}

TEST(GltfAppearance, ReadsATextureBesideTheModelButNotThroughALinkOutOfItsFolder) {
  const TemporaryFolder folder;
  const TemporaryFolder elsewhere;
  write_file(folder.file("a.gltf"), gltf(kTextured, image_part(R"("uri":"my%20green.png")")));
  write_file(folder.file("my green.png"), green_png());
  EXPECT_EQ(load_model(folder.file("a.gltf"), {}, kAll).appearance.textures.size(), 1U);
  std::filesystem::rename(folder.file("my green.png"), elsewhere.file("green.png"));
  std::filesystem::create_symlink(elsewhere.file("green.png"), folder.file("my green.png"));
  const Model model = load_model(folder.file("a.gltf"), {}, kAll);
  EXPECT_THAT(model.appearance.textures, IsEmpty());
  EXPECT_THAT(model.notes, Contains(HasSubstr("lies outside the model's folder")));
}

/// A folder with an OBJ of one quad and a library.
class ObjAppearance : public testing::Test {
 protected:
  Model loaded(const std::string& obj, const std::string& library) {
    write_file(folder_.file("a.obj"), "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n" + obj);
    write_file(folder_.file("a.mtl"), library);
    write_file(folder_.file("green.png"), green_png());
    return load_model(folder_.file("a.obj"), {}, kAll);
  }

  TemporaryFolder folder_{};
};

TEST_F(ObjAppearance, HasColoursTexturesAndCoordinatesOfItsCorners) {
  const Model model = loaded(
      "mtllib a.mtl\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nusemtl red one\nf 1/1 2/2 3/3 4/4\n"
      "usemtl green\nf 1/-1 2/-2 3/-3\nf 1 2 3\n",
      "newmtl red one\nKd 1 0 0\nnewmtl green\nKd 1 1 1\nmap_Kd -s 2 3 1 -o 0.5 green.png\n");
  const Appearance& a = model.appearance;
  ASSERT_EQ(a.materials.size(), 2U);
  EXPECT_THAT(a.materials[0].colour, ElementsAre(1.0, 0.0, 0.0));
  EXPECT_THAT(a.material_of_triangle, ElementsAre(0U, 0U, 1U, 1U));
  EXPECT_EQ(a.textures.size(), 1U);
  for (std::size_t t = 0; t < 2; ++t) {  // vertex k has coordinates k
    EXPECT_EQ(a.uv_of_triangle[t], model.mesh.triangles[t]);
  }
  EXPECT_THAT(a.uv_of_triangle[2], ElementsAre(3U, 2U, 1U));
  EXPECT_EQ(a.uv_of_triangle[3][0], Appearance::kNone);
  // From the bottom left to the top left.
  EXPECT_THAT(a.materials[1].uv_transform, ElementsAre(2.0, 0.0, 0.5, 0.0, -3.0, 1.0));
}

TEST_F(ObjAppearance, FindsPicturesThatAreNamedAsOnTheAuthorsDisk) {
  const std::string face = "mtllib a.mtl\nvt 0 0\nusemtl m\nf 1/1 2/1 3/1\n";
  for (const char* name : {"C:\\art\\green.png", "../textures/green.png", "/home/me/green.png"}) {
    const Model model = loaded(face, std::string("newmtl m\nmap_Kd ") + name + "\n");
    EXPECT_EQ(model.appearance.textures.size(), 1U) << name;
  }
}

TEST_F(ObjAppearance, TakesQuotedNamesAndKeywordsInAnyCase) {
  const Model model = loaded("mtllib \"a.mtl\"\nvt 0 0\nusemtl m\nf 1/1 2/1 3/1\n",
                             "NewMtl m\nkd 1 0 0\nMAP_KD \"green.png\"\n");
  ASSERT_EQ(model.appearance.materials.size(), 1U);
  EXPECT_THAT(model.appearance.materials[0].colour, ElementsAre(1.0, 0.0, 0.0));
  EXPECT_EQ(model.appearance.textures.size(), 1U);
  EXPECT_THAT(model.notes, IsEmpty());
}

TEST_F(ObjAppearance, HasTheMaterialsOfAllLibrariesOfALine) {
  write_file(folder_.file("b.mtl"), "newmtl blue\nKd 0 0 1\n");
  const Model model = loaded("mtllib a.mtl b.mtl\nusemtl red\nf 1 2 3\nusemtl blue\nf 1 3 4\n",
                             "newmtl red\nKd 1 0 0\n");
  ASSERT_EQ(model.appearance.materials.size(), 2U);
  EXPECT_THAT(model.appearance.materials[1].colour, ElementsAre(0.0, 0.0, 1.0));
  EXPECT_THAT(model.notes, IsEmpty());
}

TEST_F(ObjAppearance, FindsLibrariesThatAreNamedAsOnTheAuthorsDisk) {
  write_file(folder_.file("b.mtl"), "newmtl blue\nKd 0 0 1\n");
  write_file(folder_.file("my own.mtl"), "newmtl blue\nKd 0 0 1\n");
  const auto blue = [&](const std::string& line) {
    const Model model =
        loaded(line + "\nusemtl red\nf 1 2 3\nusemtl blue\nf 1 3 4\n", "newmtl red\nKd 1 0 0\n");
    const std::vector<Material>& materials = model.appearance.materials;
    return materials.empty() ? Material{}.colour : materials.back().colour;
  };
  for (const char* name : {"/home/me/b.mtl", "C:\\art work\\b.mtl", "../b.mtl", "maps/b.mtl",
                           "C:\\art\\my own.mtl", "C:\\art\\a.mtl C:\\art\\b.mtl"}) {
    EXPECT_THAT(blue(std::string("mtllib ") + name), ElementsAre(0.0, 0.0, 1.0)) << name;
  }
}

TEST_F(ObjAppearance, NotesMaterialsThatNoLibraryHas) {
  const Model model = loaded("mtllib a.mtl\nusemtl red\nf 1 2 3\nusemtl glass\nf 1 3 4\n",
                             "newmtl red\nKd 1 0 0\n");
  EXPECT_THAT(model.notes, ElementsAre("materials of faces that no material library has: 1"));
}

TEST_F(ObjAppearance, WithoutItsLibraryIsANote) {
  const Model model = loaded("mtllib b.mtl\nusemtl m\nf 1 2 3\n", "");
  EXPECT_THAT(model.appearance.materials, IsEmpty());
  EXPECT_THAT(model.notes, Contains(HasSubstr("the material library 'b.mtl' was left out")));
}

TEST(ObjLibraries, AreReadOnceHoweverOftenTheyAreNamed) {
  int reads = 0;
  const Surroundings surroundings{{},
                                  [&](const std::string& path) {
                                    EXPECT_EQ(path, "a.mtl");
                                    ++reads;
                                    return SideFile{"newmtl m\nKd 1 0 0\n", {}};
                                  },
                                  kAll};
  const Model model = parse_obj(
      "mtllib a.mtl\nmtllib ./a.mtl\nmtllib a.mtl\nmtllib .//./a.mtl\nv 0 0 0\nv 1 0 0\n"
      "v 1 1 0\nusemtl m\nf 1 2 3\n",
      "a.obj", {}, surroundings);
  EXPECT_EQ(model.appearance.materials.size(), 1U);
  EXPECT_EQ(reads, 1);
}

TEST(ObjLibraries, APictureOfManyMaterialsIsReadOnce) {
  std::string library;
  std::string text = "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nvt 0 0\n";
  for (int i = 0; i < 9; ++i) {
    library += "newmtl m" + std::to_string(i) + "\nmap_Kd t.png\n";
    text += "usemtl m" + std::to_string(i) + "\nf 1/1 2/1 3/1\n";
  }
  const std::string picture = png_bytes(Image{1, 1, std::vector<std::uint8_t>(4, 255)});
  int reads = 0;
  const Surroundings surroundings{{},
                                  [&](const std::string& path) {
                                    reads += path == "t.png" ? 1 : 0;
                                    return SideFile{path == "t.png" ? picture : library, {}};
                                  },
                                  kAll,
                                  [](const std::string& path) { return path == "t.png"; }};
  EXPECT_EQ(parse_obj(text, "a.obj", {}, surroundings).appearance.textures.size(), 1U);
  EXPECT_EQ(reads, 1);
}

TEST_F(ObjAppearance, CountsLibrariesThatAreNotThere) {
  std::string lines;
  for (int i = 0; i < 12; ++i) {
    lines += "mtllib no" + std::to_string(i) + ".mtl\n";
  }
  const Model model = loaded(lines + "usemtl m\nf 1 2 3\n", "");
  EXPECT_EQ(model.notes.size(), 6U);
  EXPECT_THAT(model.notes, Contains(HasSubstr("more material libraries were left out: 7")));
}

TEST_F(ObjAppearance, FindsWhatIsSpelledInOtherCapitals) {
  std::filesystem::create_directory(folder_.file("Maps"));
  write_file(folder_.file("Maps/Bark.PNG"), green_png());
  const Model model = loaded("mtllib A.MTL\nvt 0 0\nusemtl m\nf 1/1 2/1 3/1\n",
                             "newmtl m\nmap_Kd maps\\bark.png\n");
  EXPECT_EQ(model.appearance.textures.size(), 1U);
  EXPECT_THAT(model.notes, IsEmpty());
}

TEST_F(ObjAppearance, DoesNotReadALibraryOutsideItsFolder) {
  const TemporaryFolder elsewhere;
  write_file(elsewhere.file("x.mtl"), "newmtl m\nKd 1 0 0\n");
  const std::string name = "../" + elsewhere.path().filename().string() + "/x.mtl";
  EXPECT_THAT(loaded("mtllib " + name + "\nusemtl m\nf 1 2 3\n", "").appearance.materials,
              IsEmpty());
}

TEST_F(ObjAppearance, AMaskOfItsOwnMakesHolesWhereItIsDark) {
  write_file(folder_.file("mask.png"), png_bytes(Image{2, 1, {0, 0, 0, 255, 255, 255, 255, 255}}));
  const Model model =
      loaded("mtllib a.mtl\nvt 0 0\nusemtl leaf\nf 1/1 2/1 3/1\nusemtl bare\nf 1 3 4\n",
             "newmtl leaf\nmap_Kd green.png\nmap_d mask.png\n"
             "newmtl bare\nmap_d mask.png\n");
  ASSERT_EQ(model.appearance.textures.size(), 2U);
  for (const Material& material : model.appearance.materials) {
    EXPECT_EQ(material.alpha, AlphaMode::Mask);
    const Image& image = model.appearance.textures.at(material.texture.value()).image;
    EXPECT_EQ(image.pixel(0, 0)[3], 0);
    EXPECT_EQ(image.pixel(image.width - 1, 0)[3], image.width > 1 ? 255 : 0);
  }
}

TEST_F(ObjAppearance, AMaskedGlassIsNoHoleAllOver) {
  const Model model = loaded("mtllib a.mtl\nvt 0 0\nusemtl m\nf 1/1 2/1 3/1\n",
                             "newmtl m\nd 0.4\nmap_Kd green.png\nmap_d green.png\n");
  EXPECT_EQ(model.appearance.materials.at(0).alpha, AlphaMode::Blend);
}

TEST_F(ObjAppearance, AMaskOfTheSamePictureMakesHolesAndDissolvingMakesGlass) {
  const Model model =
      loaded("mtllib a.mtl\nvt 0 0\nusemtl leaf\nf 1/1 2/1 3/1\nusemtl glass\nf 1 3 4\n",
             "newmtl leaf\nmap_Kd green.png\nmap_d green.png\nnewmtl glass\nd 0.25\n");
  EXPECT_EQ(model.appearance.materials.at(0).alpha, AlphaMode::Mask);
  EXPECT_EQ(model.appearance.materials.at(1).alpha, AlphaMode::Blend);
  EXPECT_EQ(model.appearance.materials.at(1).opacity, 0.25);
}

TEST(GltfAppearance, NamesThePictureAndTheExtensionThatPacksIt) {
  const std::string basis =
      R"(,"images":[{"uri":"wood.ktx2"},{"uri":"leaf.ktx2"}],"textures":[
        {"extensions":{"KHR_texture_basisu":{"source":0}}},
        {"extensions":{"KHR_texture_basisu":{"source":1}}}])";
  const std::string two =
      R"({"pbrMetallicRoughness":{"baseColorTexture":{"index":0}}},
         {"pbrMetallicRoughness":{"baseColorTexture":{"index":1}}})";
  EXPECT_THAT(
      parse_model(gltf(two, basis), "a.gltf", {}, kAll).notes,
      ElementsAre(
          "the texture image 0 was left out: it is packed by 'KHR_texture_basisu', which is "
          "not read; convert it to PNG or WebP, for example with gltf-transform",
          HasSubstr("the texture image 1 was left out")));
}

}  // namespace
}  // namespace vantage::test
