// SPDX-License-Identifier: MIT
// Real and hostile models in a folder named by the environment variable VANTAGE_DATA, listed in its
// MANIFEST.tsv with their numbers of vertices and faces (before triangulation).
#include "support/data_pack.h"

#include <array>
#include <charconv>
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

using DataPack = DataPackTest<>;

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

void expect_listed_counts(const fs::path& root, const char* folder) {
  const std::vector<Entry> entries = manifest(root, folder);
  EXPECT_FALSE(entries.empty());
  for (const Entry& entry : entries) {
    const Model model = load_model((root / entry.file).string());
    EXPECT_EQ(model.mesh.positions.size(), entry.vertices) << entry.file;
    EXPECT_EQ(model.polygons, entry.faces) << entry.file;
  }
}

TEST_F(DataPack, CleanModelsHaveTheListedNumbersOfVerticesAndFaces) {
  expect_listed_counts(root(), "clean/");
}

TEST_F(DataPack, ModelsOfThePaperHaveTheListedNumbersOfVerticesAndFaces) {
  expect_listed_counts(root(), "paper/");
}

/// Whether the file is read; if not, the error must name it. Other exceptions escape.
bool is_read(const fs::path& file) {
  try {
    return !load_model(file.string()).mesh.positions.empty();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find(file.filename().string()), std::string::npos);
    return false;
  }
}

TEST_F(DataPack, HostileFilesAreReadOrRefusedAndNothingElse) {
  std::array<std::size_t, 2> counts{};  // refused, read
  for (const auto& entry : fs::recursive_directory_iterator(root() / "nasty")) {
    if (entry.is_regular_file()) {
      ++counts[is_read(entry.path()) ? 1 : 0];
    }
  }
  EXPECT_GT(counts[0], 0U);
  EXPECT_GT(counts[1], 0U);
}

}  // namespace
}  // namespace vantage::test
