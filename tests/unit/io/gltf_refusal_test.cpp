// SPDX-License-Identifier: MIT
// What a glTF is refused for.
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "vantage/core/error.h"
#include "vantage/io/model.h"

#include "unit/io/gltf_scene.h"

namespace vantage::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

TEST(Gltf, RefusesAnAccessorLargerThanItsView) {
  Scene scene;
  scene.accessors = R"({"bufferView":0,"componentType":5126,"count":5,"type":"VEC3"})";
  scene.primitive = R"({"attributes":{"POSITION":0}})";
  EXPECT_THAT(scene.error(), HasSubstr("accessor 0 reaches beyond its buffer view"));
}

TEST(Gltf, RefusesAnAccessorOfAnAbsurdLength) {
  Scene scene;
  scene.accessors = R"({"componentType":5126,"count":300000000,"type":"VEC3"})";
  scene.primitive = R"({"attributes":{"POSITION":0}})";
  EXPECT_THAT(scene.error(), HasSubstr("accessor 0 has more elements than the size of the file"));
}

TEST(Gltf, RefusesAViewLargerThanItsBuffer) {
  Scene scene;
  scene.views = R"({"buffer":0,"byteLength":4800},{"buffer":0,"byteOffset":48,"byteLength":4})";
  EXPECT_THAT(scene.error(), HasSubstr("reaches beyond its buffer"));
}

TEST(Gltf, RefusesOffsetsThatOverflow) {
  Scene scene;
  scene.views = R"({"buffer":0,"byteOffset":18446744073709551615,"byteLength":48},
                   {"buffer":0,"byteOffset":48,"byteLength":4})";
  EXPECT_THAT(scene.error(), HasSubstr("reaches beyond its buffer"));
}

TEST(Gltf, RefusesIndicesBeyondThePrimitive) {
  Scene scene;
  scene.binary[50] = 4;
  EXPECT_THAT(scene.error(), HasSubstr("index 2 of accessor 1 names vertex 4"));
}

TEST(Gltf, RefusesSparseIndicesThatDoNotAscend) {
  Scene scene;
  scene.accessors =
      R"({"bufferView":0,"componentType":5126,"count":2,"type":"VEC3","sparse":{"count":2,
          "indices":{"bufferView":1,"byteOffset":2,"componentType":5121},"values":{"bufferView":0}}})";
  scene.primitive = R"({"attributes":{"POSITION":0}})";
  EXPECT_THAT(scene.error(), HasSubstr("sparse indices that do not ascend below its length"));
}

TEST(Gltf, RefusesANodeThatIsItsOwnChildThousandsOfTimesBeforeMemoryEnds) {
  Scene scene;
  std::string children = "0";
  std::string others;
  for (int i = 0; i < 40'000; ++i) {
    children += ",0";
    others += ",{}";
  }
  scene.nodes = R"([{"children":[)" + children + "]}" + others + "]";
  EXPECT_THAT(scene.error(), HasSubstr("is its own ancestor"));
}

TEST(Gltf, CountsTheNamesOfNodesThatAreShownManyTimes) {
  Scene scene;
  std::string children = "1";
  for (int i = 0; i < 2000; ++i) {
    children += ",1";
  }
  scene.nodes = R"([{"children":[)" + children + R"(]},{"mesh":0,"name":")" +
                std::string(20'000, 'n') + "\"}]";
  EXPECT_THAT(scene.error(), HasSubstr("out of proportion"));
}

TEST(Gltf, CountsFacesOfNodesBeforeTheyAreMade) {
  Scene scene;
  scene.nodes = R"([{"children":[1,1,1]},{"mesh":0}])";
  const std::size_t faces = scene.parsed().mesh.triangles.size();
  const auto parsed = [&](std::size_t most) {
    return parse_model(scene.bytes(), "a.glb", {}, {.max_faces = most}).mesh.triangles.size();
  };
  EXPECT_EQ(parsed(faces), faces);
  try {
    parsed(faces - 1);
    ADD_FAILURE() << "it was read";
  } catch (const FormatError& error) {
    EXPECT_THAT(error.what(), HasSubstr("has more than " + std::to_string(faces - 1) + " faces"));
  }
}

TEST(Gltf, CountsVerticesThatNoFaceHasBeforeTheyAreMade) {
  Scene scene;
  scene.accessors =
      R"({"componentType":5126,"count":4000,"type":"VEC3","sparse":{"count":4,
          "indices":{"bufferView":1,"componentType":5121},"values":{"bufferView":0}}},
         {"bufferView":1,"componentType":5121,"count":4,"type":"SCALAR"})";
  EXPECT_EQ(parse_model(scene.bytes(), "a.glb", {}, {.max_faces = 2000}).mesh.positions.size(),
            4000U);
  EXPECT_THAT(error_text(scene.bytes(), "a.glb", {.max_faces = 1000}),
              HasSubstr("has more than 1000 points"));
}

TEST(Gltf, CountsTheJointsOfEachSet) {
  Scene scene;
  scene.nodes = R"([{"mesh":0,"skin":0}])";
  scene.primitive = R"({"attributes":{"POSITION":0)";
  for (int set = 0; set < 20; ++set) {
    const std::string number = std::to_string(set);
    scene.primitive.append(R"(,"JOINTS_)").append(number).append(R"(":2,"WEIGHTS_)");
    scene.primitive.append(number).append(R"(":3)");
  }
  scene.primitive += R"(},"indices":1,"mode":5})";
  scene.accessors =
      R"({"componentType":5126,"count":100000,"type":"VEC3","sparse":{"count":4,
          "indices":{"bufferView":1,"componentType":5121},"values":{"bufferView":0}}},
         {"bufferView":1,"componentType":5121,"count":4,"type":"SCALAR"},
         {"componentType":5121,"count":100000,"type":"VEC4"},
         {"componentType":5126,"count":100000,"type":"VEC4"})";
  scene.more = R"(,"skins":[{"joints":[0]}])";
  EXPECT_THAT(scene.error(), HasSubstr("out of proportion"));
}

TEST(Gltf, CountsPrimitivesWithoutPositionsInOneNote) {
  Scene scene;
  scene.primitive += R"(,{"attributes":{}},{"attributes":{}})";
  EXPECT_THAT(scene.parsed().notes, ElementsAre("primitives without positions left out: 2"));
}

TEST(Gltf, CountsPrimitivesThatShowNothing) {
  Scene scene;
  std::string children = "1";
  for (int i = 0; i < 10'000; ++i) {
    children += ",1";
  }
  for (int i = 0; i < 4000; ++i) {
    scene.primitive += R"(,{"attributes":{"POSITION":0},"mode":1})";
  }
  scene.nodes = R"([{"children":[)" + children + R"(]},{"mesh":0}])";
  EXPECT_THAT(scene.error(), HasSubstr("out of proportion"));
}

TEST(Gltf, RefusesNodesThatAreTheirOwnAncestors) {
  Scene scene;
  scene.nodes = R"([{"children":[1]},{"children":[0],"mesh":0}])";
  EXPECT_THAT(scene.error(), HasSubstr("is its own ancestor"));
}

TEST(Gltf, RefusesNodesThatDoubleAtEveryLevel) {
  Scene scene;
  scene.nodes = "[";
  for (int level = 1; level <= 40; ++level) {
    const std::string next = std::to_string(level);
    scene.nodes.append(R"({"children":[)").append(next).append(",").append(next).append("]},");
  }
  scene.nodes += R"({"mesh":0}])";
  EXPECT_THAT(scene.error(), HasSubstr("out of proportion to the file"));
}

TEST(Gltf, RefusesTransformsThatAreNotFinite) {
  Scene scene;
  scene.nodes = R"([{"scale":[1e300,1,1],"children":[1]},{"mesh":0,"scale":[1e300,1,1]}])";
  EXPECT_THAT(scene.error(), HasSubstr("the transform of node 1 is not finite"));
  scene.nodes = R"([{"mesh":0,"scale":[1e999,1,1]}])";
  EXPECT_THAT(scene.error(), HasSubstr("a number that is too large"));
  scene.nodes = R"([{"mesh":0,"matrix":[1,2,3]}])";
  EXPECT_THAT(scene.error(), HasSubstr("has 3 numbers instead of 16"));
}

TEST(Gltf, RefusesPositionsThatAreNotFinite) {
  Scene scene;
  scene.binary.replace(0, 4, std::string("\0\0\xC0\x7F", 4));
  EXPECT_THAT(scene.error(), HasSubstr("position 0 of accessor 0 is not finite"));
}

TEST(Gltf, RefusesBuffersOutsideTheModelsFolder) {
  for (const char* uri : {"../a.bin", "/dev/zero", "http://127.0.0.1/a.bin", "file:///a",
                          "%2e%2e/a", "b/../../a", "b/../..", "b/..", "C:/a", "..\\\\a"}) {
    Scene scene;
    scene.buffer = R"({"byteLength":52,"uri":")" + std::string(uri) + "\"}";
    EXPECT_THAT(scene.error(), HasSubstr("only files in the model's own folder are read")) << uri;
  }
}

TEST(Gltf, RefusesAnExternalBufferWhereThereIsNoFolder) {
  for (const char* uri : {"a.bin", "./a.bin", "./a:b.bin", "b/../a.bin", "b/c/%2e%2e/..//a.bin"}) {
    Scene scene;
    scene.buffer = R"({"byteLength":52,"uri":")" + std::string(uri) + "\"}";
    EXPECT_THAT(scene.error(), HasSubstr("cannot be found without the model's folder")) << uri;
  }
}

TEST(Gltf, RefusesBrokenContainers) {
  const std::string whole = Scene{}.bytes();
  EXPECT_THAT(error_text(whole.substr(0, whole.size() - 8), "a.glb"),
              HasSubstr("byte 8: the file should have"));
  std::string version_one = whole;
  version_one[4] = 1;
  EXPECT_THAT(error_text(version_one, "a.glb"),
              HasSubstr("is GLB version 1, only 2 is read; convert it with gltf-pipeline"));
  EXPECT_THAT(error_text("glTF", "a.glb"), HasSubstr("too short for a GLB"));
  EXPECT_THAT(error_text("{\"asset\":", "a.gltf"), HasSubstr("the JSON is not well formed"));
  EXPECT_THAT(error_text("[]", "a.gltf"), HasSubstr("the JSON is not an object"));
  EXPECT_THAT(error_text("{}", "a.gltf"), HasSubstr("no asset.version"));
  EXPECT_THAT(error_text(R"({"accessors": {"a": {}}, "asset": {}})", "a.gltf"),
              HasSubstr("is glTF 1.0, only 2 is read; convert it with gltf-pipeline"));
  EXPECT_THAT(error_text(std::string(100000, '['), "a.gltf"),
              HasSubstr("nested deeper than 64 levels"));
}

TEST(Gltf, ReadsEveryVersionTwo) {
  const std::string bytes = Scene{}.bytes();
  const auto error_of = [&](const std::string& version) {  // five bytes, quotes and all
    std::string changed = bytes;
    return error_text(changed.replace(changed.find(R"("2.0")"), 5, version), "a.glb");
  };
  EXPECT_EQ(error_of(R"("2"  )"), "nothing");
  EXPECT_EQ(error_of(R"("2.1")"), "nothing");
  EXPECT_THAT(error_of(R"("1.0")"),
              HasSubstr("is glTF version '1.0', only 2 is read; convert it with gltf-pipeline"));
  EXPECT_THAT(error_of(R"("20" )"),
              HasSubstr("is glTF version '20', only 2 is read; export the model anew, as glTF 2"));
}

TEST(Gltf, RefusesWhatNeedsAReaderOfAVersionAboveTwo) {
  const auto error_of = [](const std::string& least) {
    std::string bytes = R"({"asset":{"version":"2.1","minVersion":)" + least + "}}";
    return error_text(bytes, "a.gltf");
  };
  EXPECT_THAT(error_of(R"("2.0")"), HasSubstr("neither faces nor points"));
  EXPECT_THAT(error_of(R"("2.1")"), HasSubstr("needs glTF version '2.1', only 2.0 is read"));
}

TEST(Gltf, SaysOfADraftNeitherThatItIsVersionOneNorThatGltfPipelineConvertsIt) {
  for (const char* const version : {"0.8", "'0.9'"}) {
    const std::string written = version[0] == '\'' ? R"("0.9")" : version;
    EXPECT_THAT(
        error_text(R"({"accessors": {"a": {}}, "asset": {"version": )" + written + "}}", "a.gltf"),
        HasSubstr("is glTF version " + std::string(version) +
                  ", only 2 is read; export the model anew, as glTF 2"));
  }
}

TEST(Gltf, RefusesWrongTypesInTheJson) {
  Scene scene;
  scene.accessors = R"({"bufferView":0,"componentType":"x","count":4,"type":"VEC3"})";
  EXPECT_THAT(scene.error(), HasSubstr("is not valid glTF"));
}

TEST(Gltf, SaysThatTheSceneShownIsEmpty) {
  EXPECT_THAT(error_text(R"({"asset":{"version":"2.0"},"scenes":[{}],"nodes":[{}]})", "a.gltf"),
              HasSubstr("neither faces nor points; scene 0, which is the one shown, has no nodes"));
}

TEST(Gltf, RefusesABufferThatIsNotBase64) {
  Scene scene;
  scene.buffer = R"({"byteLength":52,"uri":"data:;base64,**"})";
  EXPECT_THAT(scene.error(), HasSubstr("the data URI of buffer 0 is not well formed base64"));
  for (const char* uri : {"data:,%0", "data:", "data:;base64"}) {
    scene.buffer = R"({"byteLength":52,"uri":")" + std::string(uri) + "\"}";
    EXPECT_THAT(scene.error(), HasSubstr("the data URI of buffer 0 is not well formed")) << uri;
  }
}

TEST(Gltf, SaysWhereTheShapeOfAMeshOfMorphTargetsIsAndWhatToDo) {
  Scene scene;
  scene.accessors = R"({"componentType":5126,"count":3,"type":"VEC3"},
      {"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"})";
  scene.primitive = R"({"attributes":{"POSITION":0},"targets":[{"POSITION":1}]})";
  EXPECT_THAT(scene.error(), HasSubstr("its shape is in morph targets, which are not read; bake"));
  scene.primitive = R"({"attributes":{"POSITION":0},"targets":[]})";
  EXPECT_THAT(scene.error(), HasSubstr("have no data"));
  EXPECT_THAT(scene.error(), testing::Not(HasSubstr("morph")));
}

}  // namespace
}  // namespace vantage::test
