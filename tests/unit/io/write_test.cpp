// SPDX-License-Identifier: MIT
#include "vantage/io/write.h"

#include <filesystem>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <png.h>
#include <sys/stat.h>
#include <unistd.h>

#include "vantage/core/error.h"
#include "vantage/io/model.h"

#include "io/files.h"
#include "support/shapes.h"
#include "support/temporary_folder.h"

namespace vantage::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::UnorderedElementsAre;

std::vector<std::string> names_in(const std::filesystem::path& folder) {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    names.push_back(entry.path().filename().string());
  }
  return names;
}

TEST(NumberText, IsTheShortestThatReadsBack) {
  EXPECT_EQ(number_text(0.1), "0.1");
  EXPECT_EQ(number_text(1.0 / 3.0), "0.3333333333333333");
  EXPECT_EQ(number_text(-2.0), "-2");
}

TEST(NumberText, IsNullForWhatJsonCannotHold) {
  EXPECT_EQ(number_text(std::numeric_limits<double>::infinity()), "null");
  EXPECT_EQ(number_text(std::numeric_limits<double>::quiet_NaN()), "null");
}

TEST(WriteFile, ReplacesAFileAndLeavesNothingElse) {
  const TemporaryFolder folder;
  write_file(folder.file("a.txt"), "old and long");
  write_file(folder.file("a.txt"), "new");
  EXPECT_EQ(read_file(folder.file("a.txt")), "new");
  EXPECT_THAT(names_in(folder.path()), ElementsAre("a.txt"));
}

TEST(WriteFile, ReplacesALinkAndAPipe) {
  const TemporaryFolder folder;
  write_file(folder.file("target"), "old");
  std::filesystem::create_symlink("target", folder.file("link"));
  ASSERT_EQ(::mkfifo(folder.file("pipe").c_str(), 0600), 0);
  for (const char* const name : {"link", "pipe"}) {
    write_file(folder.file(name), "new");
    EXPECT_TRUE(
        std::filesystem::is_regular_file(std::filesystem::symlink_status(folder.file(name))));
  }
  EXPECT_EQ(read_file(folder.file("target")), "old");
}

TEST(WriteFile, TakesTheLongestNameThereIs) {
  const TemporaryFolder folder;
  const std::string name(255, 'n');
  write_file(folder.file(name), "old");
  write_file(folder.file(name), "new");
  EXPECT_EQ(read_file(folder.file(name)), "new");
  EXPECT_THAT(names_in(folder.path()), ElementsAre(name));
}

TEST(WriteNamedFile, WritesThroughALink) {
  const TemporaryFolder folder;
  write_file(folder.file("target"), "old");
  std::filesystem::create_symlink("target", folder.file("link"));
  write_named_file(folder.file("link"), "new");
  EXPECT_TRUE(std::filesystem::is_symlink(folder.file("link")));
  EXPECT_EQ(read_file(folder.file("target")), "new");
}

TEST(WriteFile, DoesNotWriteThroughALinkLaidUnderItsTemporaryName) {
  const TemporaryFolder folder;
  write_file(folder.file("victim"), "kept");
  const std::string temporary = ".a.txt.part." + std::to_string(::getpid());
  write_file(folder.file("a.txt"), "old");  // what has no name yet needs no temporary one
  std::filesystem::create_symlink("victim", folder.file(temporary));
  write_file(folder.file("a.txt"), "new");
  EXPECT_EQ(read_file(folder.file("victim")), "kept");
  EXPECT_EQ(read_file(folder.file("a.txt")), "new");
  EXPECT_THAT(names_in(folder.path()), UnorderedElementsAre("a.txt", "victim"));
}

TEST(WriteFile, DoesNotReplaceADevice) {
  write_file("/dev/null", "gone");
  EXPECT_TRUE(std::filesystem::is_character_file("/dev/null"));
}

TEST(WriteFile, ToAFullDeviceSaysWhy) {
  try {
    write_file("/dev/full", "x");
    FAIL() << "nothing was thrown";
  } catch (const IoError& error) {
    EXPECT_EQ(error.error_number(), ENOSPC);
    EXPECT_THAT(error.what(), HasSubstr("/dev/full: cannot be written"));
  }
}

TEST(WriteFile, RefusesAFolderAndAMissingFolder) {
  const TemporaryFolder folder;
  EXPECT_THROW(write_file(folder.path().string(), "x"), IoError);
  EXPECT_THROW(write_file(folder.file("none/a.txt"), "x"), IoError);
}

TEST(PlyBytes, AreReadBackExactlyInDouble) {
  const TriMesh mesh = sphere(1);
  std::vector<double> quality(mesh.positions.size(), 0.5);
  std::vector<Rgb8> colours(mesh.positions.size(), Rgb8{1, 2, 3});
  const Model model = parse_model(ply_bytes(mesh, quality, colours, true), "a.ply");
  EXPECT_EQ(model.mesh.positions, mesh.positions);
  EXPECT_EQ(model.mesh.triangles, mesh.triangles);
  EXPECT_EQ(model.vertex_colours, colours);
  EXPECT_TRUE(model.double_precision);
}

TEST(PlyBytes, DeclareQualityBetweenPositionAndColour) {
  const std::string bytes =
      ply_bytes(sheet(1, 1, 1), std::vector<double>(4, 1.0), std::vector<Rgb8>(4), false);
  EXPECT_THAT(bytes, HasSubstr("property float z\nproperty float quality\nproperty uchar red\n"));
}

TEST(PlyBytes, LeaveOutQualityAndColoursThatAreNotGiven) {
  const std::string bytes = ply_bytes(sheet(1, 1, 1), {}, {}, false);
  EXPECT_EQ(bytes.find("quality"), std::string::npos);
  EXPECT_EQ(bytes.size(), bytes.find("end_header\n") + std::size_t{11} + std::size_t{4} * 12 +
                              std::size_t{2} * 13);
}

TEST(PlyBytes, TurnToDoubleWhereFloatsWouldLoseTheShape) {
  const auto bytes_of = [](double scale, const Vec3& shift) {
    return ply_bytes(moved(sheet(1, 1, 1), scale, 0.0, Vec3::UnitX(), shift), {}, {}, false);
  };
  EXPECT_THAT(bytes_of(1e60, Vec3::Zero()), HasSubstr("property double x"));
  EXPECT_THAT(bytes_of(1e-45, Vec3::Zero()), HasSubstr("property double x"));
  EXPECT_THAT(bytes_of(0.3, Vec3(5e6, 0.1, 0.1)), HasSubstr("property double x"));
  EXPECT_THAT(bytes_of(1.0, Vec3(0.1, 0.1, 0.1)), HasSubstr("property float x"));
  EXPECT_THAT(bytes_of(1.0, Vec3(0.0, 0.0, 5e6)), HasSubstr("property float x"));  // exact
}

TEST(PlyBytes, RefuseMapsThatDoNotFit) {
  EXPECT_THROW(ply_bytes(sheet(1, 1, 1), std::vector<double>(3), {}, false), InvalidInput);
  EXPECT_THROW(ply_bytes(sheet(1, 1, 1), {}, std::vector<Rgb8>(5), false), InvalidInput);
  EXPECT_THROW(
      ply_bytes(sheet(1, 1, 1), std::vector<double>(4, std::numeric_limits<double>::quiet_NaN()),
                {}, false),
      InvalidInput);
}

CurveGraph two_sticks() {
  return {{Vec3(0, 0, 0), Vec3(1, 0.5, 0), Vec3(2, 0, 1e-9)}, {{0, 1}, {1, 2}}};
}

TEST(SkeletonFiles, ObjCountsFromOne) {
  EXPECT_EQ(skeleton_obj(two_sticks()),
            "# written by vantage\nv 0 0 0\nv 1 0.5 0\nv 2 0 1e-09\nl 1 2\nl 2 3\n");
}

TEST(SkeletonFiles, PlyDeclaresEdges) {
  const std::string text = skeleton_ply(two_sticks());
  EXPECT_THAT(text, HasSubstr("element edge 2\nproperty int vertex1\nproperty int vertex2\n"));
  EXPECT_THAT(text, HasSubstr("1 0.5 0\n2 0 1e-09\n0 1\n1 2\n"));
}

TEST(SkeletonFiles, JsonHoldsAllLists) {
  const CurveGraph graph = two_sticks();
  const std::vector<double> radius = {1.0, 0.5, std::numeric_limits<double>::infinity()};
  const std::vector<std::int64_t> node = {0, -1};
  const std::string text = skeleton_json({&graph, radius, node});
  EXPECT_THAT(text, HasSubstr("\"edges\": [\n    [0, 1],\n    [1, 2]\n  ]"));
  EXPECT_THAT(text, HasSubstr("\"radius\": [\n    1,\n    0.5,\n    null\n  ]"));
  EXPECT_THAT(text, HasSubstr("\"vertex_node\": [\n    0,\n    -1\n  ]"));
  EXPECT_THAT(text, HasSubstr("\"degree\": [\n    1,\n    2,\n    1\n  ]"));
  EXPECT_THAT(text, HasSubstr("\"branches\": [\n    [0, 1, 2]\n  ]"));
}

TEST(SkeletonFiles, JsonHoldsTheLength) {
  const CurveGraph graph{{Vec3(0, 0, 0), Vec3(3, 0, 0), Vec3(3, 4, 0)}, {{0, 1}, {1, 2}}};
  EXPECT_THAT(skeleton_json({.graph = &graph}), HasSubstr("\"length\": 7\n"));
}

TEST(SkeletonFiles, SwcPutsParentsFirstAndNamesEndsAndJunctions) {
  const CurveGraph graph{{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(2, 0, 0), Vec3(1, 1, 0)},
                         {{0, 1}, {1, 2}, {1, 3}}};
  const std::vector<double> radius{1.0, 2.0, 3.0, 4.0};
  EXPECT_THAT(skeleton_swc({.graph = &graph, .radius = radius}),
              ::testing::EndsWith("# loops cut: 0\n1 6 0 0 0 1 -1\n2 5 1 0 0 2 1\n"
                                  "3 6 2 0 0 3 2\n4 6 1 1 0 4 2\n"));
}

TEST(SkeletonFiles, SwcCutsLoopsAndSaysWhere) {
  const CurveGraph triangle{{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)},
                            {{0, 1}, {0, 2}, {1, 2}}};
  const std::vector<double> radius(3, 1.0);
  EXPECT_THAT(skeleton_swc({.graph = &triangle, .radius = radius}),
              ::testing::EndsWith("# loops cut: 1\n# cut between 2 and 3\n1 0 0 0 0 1 -1\n"
                                  "2 0 1 0 0 1 1\n3 0 0 1 0 1 1\n"));
}

TEST(SkeletonFiles, GraphmlHoldsRadiiAndLengths) {
  const CurveGraph graph{{Vec3(0, 0, 0), Vec3(3, 4, 0)}, {{0, 1}}};
  const std::vector<double> radius{0.5, std::numeric_limits<double>::infinity()};
  const std::string text = skeleton_graphml({.graph = &graph, .radius = radius});
  EXPECT_THAT(text, HasSubstr("<data key=\"z\">0</data><data key=\"radius\">0.5</data></node>"));
  EXPECT_THAT(text, HasSubstr("<edge source=\"n0\" target=\"n1\"><data key=\"length\">5</data>"));
  EXPECT_EQ(text.find("null"), std::string::npos);
}

TEST(PngBytes, ReadBackAsTheSamePixels) {
  Image image;
  image.width = 3;
  image.height = 2;
  for (int i = 0; i < 24; ++i) {
    image.rgba.push_back(static_cast<std::uint8_t>(10 * i));
  }
  const std::string bytes = png_bytes(image);
  png_image read{};
  read.version = PNG_IMAGE_VERSION;
  ASSERT_NE(png_image_begin_read_from_memory(&read, bytes.data(), bytes.size()), 0);
  EXPECT_EQ(read.width, 3U);
  EXPECT_EQ(read.height, 2U);
  read.format = PNG_FORMAT_RGBA;
  std::vector<std::uint8_t> pixels(24);
  ASSERT_NE(png_image_finish_read(&read, nullptr, pixels.data(), 0, nullptr), 0);
  EXPECT_EQ(pixels, image.rgba);
}

TEST(PngBytes, RefuseAPictureWithoutPixels) {
  EXPECT_THROW(png_bytes(Image{}), InvalidInput);
  EXPECT_THROW(png_bytes(Image{2, 2, std::vector<std::uint8_t>(15)}), InvalidInput);
}

}  // namespace
}  // namespace vantage::test
