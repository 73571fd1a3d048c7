// SPDX-License-Identifier: MIT
#include <algorithm>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "vantage/io/model.h"

#include "io/byte_cursor.h"
#include "unit/io/gltf_scene.h"

namespace vantage::test {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;

TEST(Gltf, ReadsStripsTurningEverySecondTriangle) {
  EXPECT_THAT(Scene{}.parsed().mesh.triangles, ElementsAre(Triangle{0, 1, 2}, Triangle{2, 1, 3}));
}

/// The square held by two joints, the left corners by one at x = 5 and the right ones by one at x = 7, both bound
/// at x = 1.
Scene skinned_square() {
  Scene scene;
  scene.nodes = R"([{"children":[1,2,3]},{"mesh":0,"skin":0,"translation":[100,0,0]},
      {"translation":[5,0,0]},{"translation":[7,0,0]}])";
  scene.primitive =
      R"({"attributes":{"POSITION":0,"JOINTS_0":2,"WEIGHTS_0":3},"indices":1,"mode":5})";
  scene.accessors += R"(,{"bufferView":2,"componentType":5121,"count":4,"type":"VEC4"},
      {"bufferView":3,"componentType":5126,"count":4,"type":"VEC4"},
      {"bufferView":4,"componentType":5126,"count":2,"type":"MAT4"})";
  scene.views += R"(,{"buffer":0,"byteOffset":52,"byteLength":16},
      {"buffer":0,"byteOffset":68,"byteLength":64},{"buffer":0,"byteOffset":132,"byteLength":128})";
  scene.more = R"(,"skins":[{"joints":[2,3],"inverseBindMatrices":4}])";
  for (const int corner : {0, 1, 0, 1}) {
    scene.binary += std::string{static_cast<char>(corner), '\0', '\0', '\0'};
  }
  for (int corner = 0; corner < 4; ++corner) {
    for (const float weight : {0.5F, 0.0F, 0.0F, 0.0F}) {  // of which only the shares count
      append_little_endian(scene.binary, weight);
    }
  }
  for (int joint = 0; joint < 2; ++joint) {
    for (const float x :
         {1.F, 0.F, 0.F, 0.F, 0.F, 1.F, 0.F, 0.F, 0.F, 0.F, 1.F, 0.F, -1.F, 0.F, 0.F, 1.F}) {
      append_little_endian(scene.binary, x);
    }
  }
  scene.buffer = R"({"byteLength":260})";
  return scene;
}

TEST(Gltf, PlacesSkinnedVerticesByTheirJointsAndNotByTheirNode) {
  const Model model = skinned_square().parsed();
  ASSERT_EQ(model.mesh.positions.size(), 4U);
  EXPECT_THAT(model.mesh.positions,
              ElementsAre(Vec3(4, 0, 0), Vec3(7, 0, 0), Vec3(4, 1, 0), Vec3(7, 1, 0)));
  EXPECT_THAT(model.notes, testing::Contains(HasSubstr("as their joints stand in the file")));
}

TEST(Gltf, SkinnedFacesAreTurnedWhereTheirJointsAreMirroredAndNotWhereTheirNodeIs) {
  Scene scene = skinned_square();
  const std::string joints = R"({"translation":[5,0,0]},{"translation":[7,0,0]}])";
  scene.nodes = R"([{"scale":[-1,1,1],"children":[1,2,3]},{"mesh":0,"skin":0},)" + joints;
  EXPECT_THAT(scene.parsed().mesh.triangles, ElementsAre(Triangle{0, 2, 1}, Triangle{2, 3, 1}));
  scene.nodes = R"([{"children":[1,2,3]},{"mesh":0,"skin":0,"scale":[-1,1,1]},)" + joints;
  EXPECT_THAT(scene.parsed().mesh.triangles, ElementsAre(Triangle{0, 1, 2}, Triangle{2, 1, 3}));
}

TEST(Gltf, PlacesAChainOfTenThousandJointsInLinearTime) {
  Scene scene = skinned_square();
  constexpr int kJoints = 10'000;
  std::string joints = "2";
  scene.nodes = R"([{"children":[1,2]},{"mesh":0,"skin":0})";
  for (int joint = 0; joint < kJoints; ++joint) {
    scene.nodes += R"(,{"translation":[0.5,0,0])";
    scene.nodes +=
        joint + 1 < kJoints ? R"(,"children":[)" + std::to_string(joint + 3) + "]}" : "}";
    joints += joint > 0 ? "," + std::to_string(joint + 2) : "";
  }
  scene.nodes += "]";
  scene.more = R"(,"skins":[{"joints":[)" + joints + "]}]";
  const Model model = scene.parsed();
  EXPECT_EQ(model.mesh.positions[0], Vec3(0.5, 0, 0));
  EXPECT_EQ(model.mesh.positions[1], Vec3(2.0, 0, 0));  // held by the second joint
}

TEST(GltfError, NamesWhatASkinLacks) {
  Scene scene = skinned_square();
  scene.more = "";
  EXPECT_THAT(scene.error(), HasSubstr("skin 0 does not exist"));
  scene.more = R"(,"skins":[{"joints":[2],"inverseBindMatrices":4}])";
  EXPECT_THAT(scene.error(), HasSubstr("held by joint 1 of 1"));
  scene.more = R"(,"skins":[{"joints":[2,9],"inverseBindMatrices":4}])";
  EXPECT_THAT(scene.error(), HasSubstr("node 9 does not exist"));
  scene.more = R"(,"skins":[{"joints":[2,3,2,3,2]}])";
  EXPECT_THAT(scene.error(), HasSubstr("more joints than there are nodes"));
  scene.more = R"(,"skins":[{"joints":[2,3],"inverseBindMatrices":3}])";
  EXPECT_THAT(scene.error(), HasSubstr("are not one matrix a joint"));
}

TEST(Gltf, ReadsFans) {
  Scene scene;
  scene.primitive = R"({"attributes":{"POSITION":0},"indices":1,"mode":6})";
  EXPECT_THAT(scene.parsed().mesh.triangles, ElementsAre(Triangle{0, 1, 2}, Triangle{0, 2, 3}));
}

TEST(Gltf, ReadsPrimitivesWithoutIndices) {
  Scene scene;
  scene.primitive = R"({"attributes":{"POSITION":0}})";
  const Model model = scene.parsed();
  EXPECT_THAT(model.mesh.triangles, ElementsAre(Triangle{0, 1, 2}));
  EXPECT_EQ(model.mesh.positions.size(), 4U);
}

TEST(Gltf, AppliesTranslationRotationAndScaleDownTheTree) {
  Scene scene;  // half a turn about z after scaling by 2, then moved by 10
  scene.nodes =
      R"([{"translation":[10,0,0],"children":[1]},{"rotation":[0,0,1,0],"scale":[2,2,2],"mesh":0}])";
  const Vec3 corner = scene.parsed().mesh.positions[1];
  EXPECT_NEAR((corner - Vec3(10 - 2, 0, 0)).norm(), 0.0, 1e-14);
}

TEST(Gltf, AppliesAMatrixColumnByColumn) {
  Scene scene;
  scene.nodes = R"([{"mesh":0,"matrix":[1,0,0,0, 0,1,0,0, 0,0,1,0, 5,6,7,1]}])";
  EXPECT_EQ(scene.parsed().mesh.positions[0], Vec3(5, 6, 7));
}

TEST(Gltf, AMirroredNodeKeepsItsSurfaceRightSideOut) {
  Scene scene;
  scene.nodes = R"([{"mesh":0,"scale":[-1,1,1]}])";
  EXPECT_THAT(scene.parsed().mesh.triangles, ElementsAre(Triangle{0, 2, 1}, Triangle{2, 3, 1}));
}

TEST(Gltf, SaysThatMorphTargetsAreLeftOutWhereOneIsWeighed) {
  Scene scene;
  scene.nodes = R"([{"mesh":0,"weights":[0, 0.5]}])";
  EXPECT_THAT(scene.parsed().notes, testing::Contains(testing::HasSubstr("morph targets")));
  scene.nodes = R"([{"mesh":0,"weights":[0]}])";
  EXPECT_THAT(scene.parsed().notes, testing::IsEmpty());
}

TEST(Gltf, NotesExtensionsThatItNeedsAndThatAreNotRead) {
  Scene scene;
  scene.more =
      R"(,"extensionsRequired":["KHR_materials_unlit","KHR_mesh_quantization","EXT_made_up",5])";
  EXPECT_THAT(
      scene.parsed().notes,
      ElementsAre("needs the extension 'EXT_made_up', which is not read: what it changes is "
                  "not shown"));
}

TEST(Gltf, LeavesHiddenNodesOutWithAllBelowThem) {
  Scene scene;
  const std::string hidden = R"("extensions":{"KHR_node_visibility":{"visible":false}})";
  scene.nodes = R"([{"mesh":0,"children":[1,3]},{"mesh":0,)" + hidden +
                R"(,"children":[2]},{"mesh":0},
                {"mesh":0,"extensions":{"KHR_node_visibility":{"visible":true}}}])";
  const Model model = scene.parsed();
  EXPECT_EQ(model.mesh.triangles.size(), 4U);
  EXPECT_THAT(model.notes,
              ElementsAre("nodes that the file hides left out, with all below them: 1"));
}

TEST(Gltf, ShowsAMeshOnceForEachNode) {
  Scene scene;
  scene.nodes = R"([{"children":[1,2]},{"name":"left","mesh":0},{"mesh":0,"translation":[0,0,9]}])";
  const Model model = scene.parsed();
  ASSERT_EQ(model.parts.size(), 2U);
  EXPECT_EQ(model.parts[0].name, "left");
  EXPECT_EQ(model.parts[1].name, "m");
  EXPECT_EQ(model.mesh.positions.size(), 8U);
  EXPECT_EQ(model.mesh.triangles[2][0], 4U);
}

TEST(Gltf, ReadsInterleavedAndNormalisedPositions) {
  Scene scene;  // signed bytes, one of every eight: −127 is −1, 127 is 1
  scene.binary = std::string("\x81\0\0\0....\x7F\0\0\0....\0\x7F\0\0....\0\0\0\0....", 32);
  scene.views = R"({"buffer":0,"byteLength":32,"byteStride":8})";
  scene.accessors =
      R"({"bufferView":0,"componentType":5120,"normalized":true,"count":4,"type":"VEC3"})";
  scene.primitive = R"({"attributes":{"POSITION":0}})";
  const Model model = scene.parsed();
  EXPECT_EQ(model.mesh.positions[0], Vec3(-1, 0, 0));
  EXPECT_EQ(model.mesh.positions[2], Vec3(0, 1, 0));
}

TEST(Gltf, ReadsSparseAccessors) {
  Scene scene;  // element 3 is replaced by the first point of the buffer, the origin
  scene.accessors =
      R"({"bufferView":0,"componentType":5126,"count":4,"type":"VEC3","sparse":{"count":1,
          "indices":{"bufferView":1,"byteOffset":3,"componentType":5121},"values":{"bufferView":0}}},
         {"bufferView":1,"componentType":5121,"count":4,"type":"SCALAR"})";
  EXPECT_EQ(scene.parsed().mesh.positions[3], Vec3(0, 0, 0));
  EXPECT_EQ(scene.parsed().mesh.positions[1], Vec3(1, 0, 0));
}

TEST(Gltf, TakesTheBaseColourOfAMaterialWhereVerticesHaveNone) {
  Scene scene;
  scene.primitive = R"({"attributes":{"POSITION":0},"indices":1,"mode":5,"material":0})";
  scene.more =
      R"(,"materials":[{"pbrMetallicRoughness":{"baseColorFactor":[1,0,0.50196078431,1]}}])";
  EXPECT_EQ(scene.parsed().vertex_colours[3], (Rgb8{255, 0, 188}));  // as below
  EXPECT_TRUE(scene.parsed().colours_are_materials);
}

TEST(Gltf, MaterialsThatMakeNoSenseAreWhite) {
  Scene scene;
  scene.primitive = R"({"attributes":{"POSITION":0},"indices":1,"mode":5,"material":0})";
  for (const char* material : {"1", "[]", R"({"pbrMetallicRoughness":[]})",
                               R"({"pbrMetallicRoughness":{"baseColorFactor":3}})",
                               R"({"pbrMetallicRoughness":{"baseColorFactor":["a",[],{}]}})"}) {
    scene.more = R"(,"materials":[)" + std::string(material) + "]";
    EXPECT_TRUE(scene.parsed().vertex_colours.empty()) << material;
  }
}

TEST(Gltf, AWhiteMaterialGivesNoColours) {
  Scene scene;
  scene.primitive = R"({"attributes":{"POSITION":0},"indices":1,"mode":5,"material":0})";
  scene.more = R"(,"materials":[{"name":"white"}])";
  EXPECT_TRUE(scene.parsed().vertex_colours.empty());
}

TEST(Gltf, LeavesColoursOutThatDoNotFitItsPositions) {
  Scene scene;
  scene.views += R"(,{"buffer":0,"byteLength":16})";
  scene.accessors +=
      R"(,{"bufferView":2,"componentType":5121,"normalized":true,"count":3,"type":"VEC4"})";
  scene.primitive = R"({"attributes":{"POSITION":0,"COLOR_0":2}})";
  const Model model = scene.parsed();
  EXPECT_EQ(model.mesh.positions.size(), 4U);
  EXPECT_THAT(model.notes, Contains(HasSubstr("colours of vertices that cannot be read")));
}

TEST(Gltf, TurnsLinearColoursIntoSrgb) {
  Scene scene;
  scene.binary += std::string("\xFF\0\x80\xFF", 4) + std::string(12, '\0');
  scene.views += R"(,{"buffer":0,"byteOffset":52,"byteLength":16})";
  scene.accessors +=
      R"(,{"bufferView":2,"componentType":5121,"normalized":true,"count":4,"type":"VEC4"})";
  scene.primitive = R"({"attributes":{"POSITION":0,"COLOR_0":2},"material":0})";
  scene.more = R"(,"materials":[{"alphaMode":"BLEND"}])";
  // 0x80 / 255 = 0.502 linear is 1.055 · 0.502^(1/2.4) − 0.055 = 0.7367, times 255 = 187.9
  EXPECT_EQ(scene.parsed().vertex_colours[0], (Rgb8{255, 0, 188}));
  EXPECT_FALSE(scene.parsed().colours_are_materials);
  EXPECT_THAT(scene.parsed().notes, Contains(HasSubstr("the opacity of vertices")));  // of 0
}

TEST(Gltf, ReadsADataUri) {
  // One triangle: (0,0,0), (1,0,0), (0,1,0) as 36 bytes in base64.
  std::string json =
      R"({"asset":{"version":"2.0"},"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],
      "accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"}],
      "bufferViews":[{"buffer":0,"byteLength":36}],"buffers":[{"byteLength":36,"uri":
      "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}]})";
  const Model model = parse_model(json, "a.gltf");
  EXPECT_EQ(model.mesh.positions[2], Vec3(0, 1, 0));
  EXPECT_THAT(model.notes, ElementsAre(HasSubstr("no scene")));
  json.replace(json.find("data:"), 5, "DATA:");
  json.replace(json.find("base64,"), 7, "BASE64,");
  json.replace(json.find("gD8"), 1, "%67");
  EXPECT_EQ(parse_model(json, "a.gltf").mesh.positions, model.mesh.positions);
}

TEST(Gltf, PassesOverPicturesAndExtras) {
  Scene scene;
  scene.more = R"(,"images":[{"uri":"/etc/passwd"},{"uri":"http://x/y.png"}],"textures":[{}],
      "materials":[{"extras":[[[1]]]}],"extras":{"a":1})";
  EXPECT_EQ(scene.parsed().mesh.triangles.size(), 2U);
}

TEST(Gltf, LeavesLinesOut) {
  Scene scene;
  scene.primitive += R"(,{"attributes":{"POSITION":0},"mode":1})";
  EXPECT_THAT(scene.parsed().notes, ElementsAre(HasSubstr("points or lines left out: 1")));
}

TEST(Gltf, ReadsAFileOfPointsAlone) {
  Scene scene;
  scene.primitive = R"({"attributes":{"POSITION":0},"mode":0})";
  EXPECT_EQ(scene.parsed().mesh.positions.size(), 4U);
}

TEST(Gltf, ShowsPointsUnlessTrianglesAreShown) {
  const std::string points = R"({"attributes":{"POSITION":0},"mode":0})";
  const std::string next_mesh = R"(]},{"primitives":[)";
  Scene scene;
  scene.primitive = points + R"(,{"attributes":{},"mode":4})";  // no triangles either
  EXPECT_EQ(scene.parsed().mesh.positions.size(), 4U);
  scene.primitive = points + next_mesh + Scene{}.primitive;  // of a mesh that no node shows
  EXPECT_EQ(scene.parsed().mesh.positions.size(), 4U);
  EXPECT_TRUE(scene.parsed().mesh.triangles.empty());
  scene.nodes = R"([{"children":[1,2]},{"mesh":0},
      {"mesh":1,"extensions":{"KHR_node_visibility":{"visible":false}}}])";
  EXPECT_EQ(scene.parsed().mesh.positions.size(), 4U);
  scene.nodes = R"([{"children":[1,2]},{"mesh":0},{"mesh":1}])";
  EXPECT_EQ(scene.parsed().mesh.positions.size(), 4U);
  EXPECT_EQ(scene.parsed().mesh.triangles.size(), 2U);
}

TEST(Gltf, ColoursOfWhatIsNotShownColourNothing) {
  const std::string red = R"("material":0})";
  Scene scene;
  scene.more = R"(,"materials":[{"pbrMetallicRoughness":{"baseColorFactor":[1,0,0,1]}}])";
  scene.primitive += R"(,{"attributes":{"POSITION":0},"mode":0,)" + red +
                     R"(]},{"primitives":[{"attributes":{"POSITION":0},"mode":5,)" + red;
  EXPECT_TRUE(scene.parsed().vertex_colours.empty());
  scene.nodes = R"([{"mesh":1}])";
  EXPECT_EQ(scene.parsed().vertex_colours.size(), 4U);
  scene.primitive = R"({"attributes":{"POSITION":0},"mode":0,)" + red;
  scene.nodes = Scene{}.nodes;
  EXPECT_EQ(scene.parsed().vertex_colours.size(), 4U);
}

TEST(Gltf, ReadsADataUriThatIsPercentEncoded) {
  Scene scene;
  std::string data;
  for (const char c : square_bytes()) {
    constexpr std::string_view kDigits = "0123456789abcdef";
    const auto byte = static_cast<unsigned char>(c);
    data += c == '?' ? "?" : std::string{'%', kDigits[byte / 16U], kDigits[byte % 16U]};
  }
  scene.buffer = R"({"byteLength":52,"uri":"data:application/octet-stream,)" + data + "\"}";
  EXPECT_EQ(scene.parsed().mesh.positions.at(1), Vec3(1, 0, 0));
}

TEST(Gltf, ReadsIndicesThatAreSparseOrZeroAndSoHaveNoBufferView) {
  Scene scene;
  scene.accessors =
      R"({"bufferView":0,"componentType":5126,"count":4,"type":"VEC3"},
         {"componentType":5121,"count":4,"type":"SCALAR","sparse":{"count":4,
          "indices":{"bufferView":1,"componentType":5121},"values":{"bufferView":1}}},
         {"componentType":5121,"count":3,"type":"SCALAR"})";
  EXPECT_EQ(scene.error(), "nothing");
  EXPECT_THAT(scene.parsed().mesh.triangles, ElementsAre(Triangle{0, 1, 2}, Triangle{2, 1, 3}));
  scene.primitive += R"(,{"attributes":{"POSITION":0},"indices":2})";
  EXPECT_EQ(scene.error(), "nothing");
  EXPECT_THAT(scene.parsed().mesh.triangles,
              ElementsAre(Triangle{0, 1, 2}, Triangle{2, 1, 3}, Triangle{4, 4, 4}));
}

TEST(Gltf, TheOpacityOfVerticesIsNotMissedWhereTheMaterialIgnoresIt) {
  Scene scene;
  scene.binary += std::string(16, '\x7F');
  scene.views += R"(,{"buffer":0,"byteOffset":52,"byteLength":16})";
  scene.accessors +=
      R"(,{"bufferView":2,"componentType":5121,"normalized":true,"count":4,"type":"VEC4"})";
  scene.primitive =
      R"({"attributes":{"POSITION":0,"COLOR_0":2},"indices":1,"mode":5,"material":0})";
  const auto is_missed = [&](const std::string& mode) {
    scene.more = R"(,"materials":[{)" + mode + "}]";
    const std::vector<std::string> notes = scene.parsed().notes;
    return std::any_of(notes.begin(), notes.end(), [](const std::string& note) {
      return note.find("the opacity of vertices was left out") != std::string::npos;
    });
  };
  EXPECT_TRUE(is_missed(R"("alphaMode":"BLEND")"));
  EXPECT_TRUE(is_missed(R"("alphaMode":"MASK")"));
  EXPECT_FALSE(is_missed(R"("alphaMode":"OPAQUE")"));
  EXPECT_FALSE(is_missed(""));
}

}  // namespace
}  // namespace vantage::test
