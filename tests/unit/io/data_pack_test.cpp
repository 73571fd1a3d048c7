// SPDX-License-Identifier: MIT
// Real and hostile models in a folder named by the environment variable VANTAGE_DATA, listed in its
// MANIFEST.tsv with their numbers of vertices and faces (before triangulation).
#include <charconv>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "vantage/core/error.h"
#include "vantage/io/model.h"

#include "io/files.h"
#include "io/text_cursor.h"

namespace vantage::test {
namespace {

namespace fs = std::filesystem;

class DataPack : public testing::Test {
 protected:
  void SetUp() override {
    const char* folder = std::getenv("VANTAGE_DATA");
    if (folder == nullptr) {
      GTEST_SKIP() << "NOTHING WAS TESTED: set VANTAGE_DATA to the folder of the data pack";
    }
    root_ = folder;
  }

  [[nodiscard]] const fs::path& root() const { return root_; }

 private:
  fs::path root_{};
};

struct Entry {
  std::string file;
  std::size_t vertices;
  std::size_t faces;
};

/// Lines of the manifest whose file starts with `folder` and whose counts are numbers.
std::vector<Entry> manifest(const fs::path& root, std::string_view folder) {
  const std::string text = read_file((root / "MANIFEST.tsv").string());
  std::vector<Entry> entries;
  TextCursor cursor(text);
  while (std::optional<std::string_view> line = cursor.next_line()) {
    std::vector<std::string_view> cells;
    for (std::size_t begin = 0; begin <= line->size();) {
      const std::size_t end = std::min(line->find('\t', begin), line->size());
      cells.push_back(line->substr(begin, end - begin));
      begin = end + 1;
    }
    Entry entry{std::string(cells[0]), 0, 0};
    const auto number = [](std::string_view cell, std::size_t& value) {
      return std::from_chars(cell.data(), cell.data() + cell.size(), value).ec == std::errc();
    };
    if (cells[0].substr(0, folder.size()) == folder && number(cells[2], entry.vertices) &&
        number(cells[3], entry.faces)) {
      entries.push_back(entry);
    }
  }
  return entries;
}

TEST_F(DataPack, SoundModelsHaveTheListedNumbersOfVerticesAndFaces) {
  for (const char* folder : {"clean/", "paper/"}) {
    const std::vector<Entry> entries = manifest(root(), folder);
    EXPECT_FALSE(entries.empty());
    for (const Entry& entry : entries) {
      SCOPED_TRACE(entry.file);
      const Model model = load_model((root() / entry.file).string());
      EXPECT_EQ(model.mesh.positions.size(), entry.vertices);
      EXPECT_EQ(model.polygons, entry.faces);
    }
  }
}

TEST_F(DataPack, HostileFilesAreReadOrRefusedAndNothingElse) {
  std::size_t read = 0;
  std::size_t refused = 0;
  for (const auto& entry : fs::recursive_directory_iterator(root() / "nasty")) {
    if (!entry.is_regular_file()) {
      continue;
    }
    SCOPED_TRACE(entry.path().string());
    try {
      EXPECT_FALSE(load_model(entry.path().string()).mesh.positions.empty());
      ++read;
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find(entry.path().filename().string()),
                std::string::npos);
      ++refused;
    }
  }
  EXPECT_GT(read, 0U);
  EXPECT_GT(refused, 0U);
}

}  // namespace
}  // namespace vantage::test
