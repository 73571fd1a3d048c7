// SPDX-License-Identifier: MIT
// The files that fuzzers of readers start from, and every input that once broke a reader, in this build.
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "vantage/core/error.h"
#include "vantage/io/camera_files.h"
#include "vantage/io/model.h"
#include "vantage/mesh/mesh_check.h"

#include "io/files.h"
#include "io/mtl.h"
#include "io/picture_decoding.h"

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

/// Parses each file; a FormatError is a good answer, anything else escapes.
/// \return how many were read.
template <class Parse>
int replay(const std::string& folder, const Parse& parse) {
  int read = 0;
  for (const fs::path& file : files_of(folder)) {
    try {
      parse(read_file(file.string()));
      ++read;
    } catch (const FormatError& error) {
      std::puts(error.what());
    }
  }
  return read;
}

bool has_valid_indices(const TriMesh& mesh) {
  return std::all_of(mesh.triangles.begin(), mesh.triangles.end(), [&](const Triangle& t) {
    return std::max({t[0], t[1], t[2]}) < mesh.positions.size();
  });
}

class CorpusReplay : public testing::TestWithParam<const char*> {};

TEST_P(CorpusReplay, GivesAModelWithValidIndicesOrAFormatError) {
  const std::string name = std::string("fuzz.") + GetParam();
  EXPECT_GT(replay(GetParam(),
                   [&](const std::string& bytes) {
                     const Model model = parse_model(bytes, name, {}, {.appearance = true});
                     EXPECT_TRUE(has_valid_indices(model.mesh));
                     EXPECT_EQ(check_mesh(model.mesh).faces, model.mesh.triangles.size());
                   }),
            0);
}

INSTANTIATE_TEST_SUITE_P(Formats, CorpusReplay,
                         testing::Values("obj", "off", "ply", "stl", "gltf", "glb", "3mf", "amf",
                                         "pcd", "pts", "pwn", "xyz"));

TEST(CorpusReplay, CamerasGiveAResultOrAFormatError) {
  EXPECT_GT(replay("camera",
                   [](const std::string& bytes) {
                     EXPECT_TRUE(parse_camera(bytes, "fuzz.json").eye.allFinite());
                   }),
            0);
}

TEST(CorpusReplay, PointsAreFiniteOrAFormatError) {
  std::size_t points = 0;  // a header alone is a table of none
  replay("csv", [&](const std::string& bytes) {
    for (const Vec3& point : parse_points_csv(bytes, "fuzz.csv", {"dx", "dy", "dz"})) {
      EXPECT_TRUE(point.allFinite());
      ++points;
    }
  });
  EXPECT_GT(points, 0U);
}

TEST(PictureReplay, GivesAPictureOrAProblem) {
  int read = 0;
  for (const fs::path& file : files_of("picture")) {
    const DecodedPicture picture = decode_picture(read_file(file.string()));
    EXPECT_NE(picture.image.has_value(), !picture.problem.empty()) << file;
    read += picture.image ? 1 : 0;
  }
  EXPECT_GT(read, 5);
}

TEST(MtlReplay, GivesNumbersInTheirRanges) {
  std::size_t materials = 0;  // a text without newmtl has none
  for (const fs::path& file : files_of("mtl")) {
    for (const auto& [name, material] : parse_mtl(read_file(file.string()))) {
      EXPECT_TRUE(material.opacity >= 0.0 && material.opacity <= 1.0) << file << name;
      ++materials;
    }
  }
  EXPECT_GT(materials, 0U);
}

}  // namespace
}  // namespace vantage::test
