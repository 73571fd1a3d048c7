// SPDX-License-Identifier: MIT
// Files turned in place: what they hold afterwards is what the readers find in them.
#include <algorithm>
#include <cstddef>
#include <cstring>
#include <set>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "vantage/core/error.h"
#include "vantage/io/model.h"
#include "vantage/io/write.h"

#include "core/json_text.h"
#include "glb_bytes.h"
#include "io/byte_cursor.h"

namespace vantage::test {
namespace {

/// z up and −y in front becomes y up and z in front: (x, y, z) goes to (x, z, −y).
const AxisTurn kToY(Vec3::UnitZ(), -Vec3::UnitY(), Vec3::UnitY(), Vec3::UnitZ());

std::string turned(const std::string& text, const std::string& name, ModelFormat format) {
  return turned_bytes(text, name, format, kToY);
}

TEST(TurnedBytes, OfAnObjHaveEveryVertexTurned) {
  for (const std::string text :
       {"v 1 2 3\nv 4 5 6\nv 7 8 10\nf 1 2 3\n", "v 1 2 3\r\nv 4 5 6\r\nv 7 8 10\r\nf 1 2 3\r\n",
        "\xEF\xBB\xBFv 1 2 3\nv 4 5 6\nv 7 8 10\nf 1 2 3\n",
        "  v\t1 2 3 0.5 0.5 0.5\nv 4 5 6 0 0 0\nv 7 8 10 1 1 1\nf 1 2 3\n"}) {
    const Model model = parse_model(turned(text, "a.obj", ModelFormat::Obj), "a.obj");
    EXPECT_THAT(model.mesh.positions,
                testing::ElementsAre(Vec3(1, 3, -2), Vec3(4, 6, -5), Vec3(7, 10, -8)))
        << text;
  }
}

// Which ears are cut first at corners on one line is a matter of rounding.
TEST(TurnedBytes, OfAnObjWithAConcavePolygonAreTurned) {
  std::string text;
  std::string face = "f";
  const double corners[][2] = {{0, 0}, {1, 0}, {2, 0}, {3, 0}, {3, 2},
                               {2, 2}, {2, 1}, {1, 1}, {1, 2}, {0, 2}};
  for (const auto& [x, y] : corners) {
    text += "v " + std::to_string(x) + " " + std::to_string(y) + " " +
            std::to_string(0.5 * x + 0.25 * y) + "\n";
    face += " " + std::to_string(std::count(text.begin(), text.end(), '\n'));
  }
  const Model model = parse_model(turned(text + face + "\n", "a.obj", ModelFormat::Obj), "a.obj");
  EXPECT_EQ(model.mesh.triangles.size(), 8U);
}

TEST(TurnedBytes, OfAGlbWithBytesBehindItsEndAreReadable) {
  const std::string json = R"({"asset":{"version":"2.0"},"nodes":[{}],"scenes":[{"nodes":[0]}]})";
  const std::string whole = glb(json, "");
  const std::string after = turned(whole + "what follows", "a.glb", ModelFormat::Glb);
  std::uint32_t length = 0;
  std::memcpy(&length, after.data() + 8, sizeof length);
  EXPECT_EQ(length, after.size());
  EXPECT_EQ(after, turned(whole, "a.glb", ModelFormat::Glb));
}

TEST(TurnedBytes, OfAnObjThatIsWrittenOtherwiseAreRefused) {
  for (const std::string text :
       {"v 1 2 3\rv 4 5 6\rv 7 8 10\rf 1 2 3\r", "v 1 2 3\\\n\nv 4 5 6\nv 7 8 10\nf 1 2 3\n"}) {
    EXPECT_THROW((void)turned(text, "a.obj", ModelFormat::Obj), InvalidInput) << text;
  }
}

TEST(TurnedBytes, OfAnStlInCapitalsAreTurned) {
  const std::string text =
      "SOLID A\nFACET NORMAL 0 0 1\nOUTER LOOP\nVERTEX 0 0 1\nVERTEX 1 0 1\nVERTEX 0 1 1\nENDLOOP\n"
      "ENDFACET\nENDSOLID A\n";
  const std::string after = turned(text, "a.stl", ModelFormat::Stl);
  EXPECT_THAT(parse_model(after, "a.stl").mesh.positions,
              testing::UnorderedElementsAre(Vec3(0, 1, 0), Vec3(1, 1, 0), Vec3(0, 1, -1)));
  EXPECT_THAT(after, testing::HasSubstr("FACET NORMAL 0 1 0\n"));
}

TEST(TurnedBytes, OfAnStlWithSeveralVerticesALineAreRefused) {
  const std::string text =
      "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 1 vertex 1 0 1 vertex 0 1 1\nendloop\n"
      "endfacet\nendsolid a\n";
  EXPECT_THROW((void)turned(text, "a.stl", ModelFormat::Stl), Error);
}

TEST(TurnedBytes, OfABinaryStlAreTurnedAlsoIfItBeginsWithSolid) {
  for (const std::string rest : {"", "tail"}) {
    std::string bytes = "solid";
    bytes.resize(80, ' ');
    append_little_endian(bytes, std::uint32_t{1});
    for (const float value : {0.F, 0.F, 1.F, 1.F, 2.F, 3.F, 4.F, 5.F, 6.F, 7.F, 8.F, 10.F}) {
      append_little_endian(bytes, value);
    }
    bytes.append(2, '\0').append(rest);
    const std::string after = turned(bytes, "a.stl", ModelFormat::Stl);
    EXPECT_THAT(parse_model(after, "a.stl").mesh.positions,
                testing::ElementsAre(Vec3(1, 3, -2), Vec3(4, 6, -5), Vec3(7, 10, -8)));
    EXPECT_TRUE(after.ends_with(rest));
    EXPECT_THROW((void)turned(bytes.substr(0, 130), "a.stl", ModelFormat::Stl), FormatError);
  }
}

TEST(TurnedBytes, OfABinaryStlThatDeclaresNoTrianglesAreThoseItHolds) {
  std::string bytes(84, '\0');
  for (const float value : {0.F, 0.F, 1.F, 1.F, 2.F, 3.F, 4.F, 5.F, 6.F, 7.F, 8.F, 10.F}) {
    append_little_endian(bytes, value);
  }
  bytes.append(2, '\0');
  EXPECT_THAT(parse_model(turned(bytes, "a.stl", ModelFormat::Stl), "a.stl").mesh.positions,
              testing::ElementsAre(Vec3(1, 3, -2), Vec3(4, 6, -5), Vec3(7, 10, -8)));
}

TEST(TurnedBytes, OfAGltfWithoutScenesTurnTheNodesThatAreNobodysChild) {
  for (const std::string scenes : {"", R"("scenes":[],)"}) {
    const std::string text = R"({"asset":{"version":"2.0"},)" + scenes +
                             R"("nodes":[{},{"children":[0]},{"children":[3]},{}]})";
    const auto root = parsed_json(turned(text, "a.gltf", ModelFormat::Gltf));
    ASSERT_EQ(root["scenes"].size(), 1U) << scenes;
    EXPECT_EQ(root["scene"], 0);
    std::set<std::size_t> shown;
    for (const auto& node : root["scenes"][0]["nodes"]) {
      EXPECT_TRUE(root["nodes"][node.get<std::size_t>()].contains("rotation"));
      for (const auto& child : root["nodes"][node.get<std::size_t>()]["children"]) {
        shown.insert(child.get<std::size_t>());
      }
    }
    EXPECT_EQ(shown, (std::set<std::size_t>{1, 2})) << scenes;
  }
}

TEST(TurnedBytes, OfAGltfInWhichNothingCanBeTurnedAreRefused) {
  for (const std::string text : {R"({"asset":{"version":"2.0"},"nodes":[],"meshes":[{}]})",
                                 R"({"asset":{"version":"2.0"},"nodes":[{}],"scenes":[{}]})"}) {
    EXPECT_THROW((void)turned(text, "a.gltf", ModelFormat::Gltf), FormatError) << text;
  }
}

TEST(TurnedBytes, OfAGltfTurnEachNodeOnceHoweverManyScenesShowIt) {
  const std::string text =
      R"({"asset":{"version":"2.0"},"scenes":[{"nodes":[0,1]},{"nodes":[1]}],"nodes":[{},{}]})";
  const auto root = parsed_json(turned(text, "a.gltf", ModelFormat::Gltf));
  std::vector<int> parents(root["nodes"].size(), 0);
  for (const auto& node : root["nodes"]) {
    for (const auto& child : node.value("children", OrderedJson::array())) {
      ++parents[child.get<std::size_t>()];
    }
  }
  EXPECT_EQ(root["nodes"].size(), 4U);
  EXPECT_THAT(parents, testing::Each(testing::Le(1)));
  for (const auto& scene : root["scenes"]) {
    for (const auto& node : scene["nodes"]) {
      EXPECT_TRUE(root["nodes"][node.get<std::size_t>()].contains("rotation"));
    }
  }
}

TEST(TurnedBytes, OfAnObjWithANormalOfTwoNumbersKeepIt) {
  const std::string after =
      turned("v 1 2 3\nv 4 5 6\nv 7 8 10\nvn 0 0\nf 1 2 3\n", "a.obj", ModelFormat::Obj);
  EXPECT_THAT(after, testing::HasSubstr("\nvn 0 0\n"));
  EXPECT_EQ(parse_model(after, "a.obj").mesh.positions.at(0), Vec3(1, 3, -2));
}

TEST(TurnedBytes, OfAnObjWithContinuedLinesAreRefusedWithARemedy) {
  for (const std::string line :
       {"v 1 2 \\\n3\n", "v 1 2 3\nvn 0 0 \\\n1\n", "v 1 2 3\nvn 0 0\\\n 1\n"}) {
    try {
      (void)turned(line + "v 4 5 6\nv 7 8 10\nf 1 2 3\n", "a.obj", ModelFormat::Obj);
      FAIL() << line;
    } catch (const FormatError& error) {
      EXPECT_THAT(error.what(), testing::HasSubstr("write a .ply")) << line;
    }
  }
}

}  // namespace
}  // namespace vantage::test
