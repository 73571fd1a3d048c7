// SPDX-License-Identifier: MIT
// Every file the fuzzers start from, and every input that once broke a reader, in this build.
#include <filesystem>
#include <vector>

#include <gtest/gtest.h>

#include "vantage/core/error.h"
#include "vantage/io/camera_files.h"
#include "vantage/io/csv.h"
#include "vantage/io/model.h"
#include "vantage/mesh/mesh_check.h"

#include "io/files.h"

namespace vantage::test {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> files_of(const std::string& format) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(fs::path(VANTAGE_CORPUS) / format)) {
    files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

class CorpusReplay : public testing::TestWithParam<const char*> {};

TEST_P(CorpusReplay, GivesAModelWithValidIndicesOrAFormatError) {
  const std::vector<fs::path> files = files_of(GetParam());
  ASSERT_FALSE(files.empty());
  for (const fs::path& file : files) {
    SCOPED_TRACE(file.filename().string());
    const std::string bytes = read_file(file.string());
    try {
      const Model model = parse_model(bytes, std::string("fuzz.") + GetParam());
      for (const Triangle& t : model.mesh.triangles) {
        ASSERT_LT(std::max({t[0], t[1], t[2]}), model.mesh.positions.size());
      }
      EXPECT_EQ(check_mesh(model.mesh).faces, model.mesh.triangles.size());
    } catch (const FormatError& error) {
      EXPECT_NE(std::string(error.what()), "");
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Formats, CorpusReplay,
                         testing::Values("obj", "off", "ply", "stl", "gltf", "glb"));

TEST(CorpusReplay, CamerasAndPointsGiveAResultOrAFormatError) {
  int read = 0;
  for (const fs::path& file : files_of("camera")) {
    try {
      EXPECT_TRUE(parse_camera(read_file(file.string()), "fuzz.json").eye.allFinite());
      ++read;
    } catch (const FormatError& error) {
      EXPECT_NE(std::string(error.what()), "");
    }
  }
  for (const fs::path& file : files_of("csv")) {
    try {
      read += parse_points_csv(read_file(file.string()), "fuzz.csv", {"dx", "dy", "dz"}).empty()
                  ? 0
                  : 1;
    } catch (const FormatError& error) {
      EXPECT_NE(std::string(error.what()), "");
    }
  }
  EXPECT_GT(read, 1);
}

}  // namespace
}  // namespace vantage::test
