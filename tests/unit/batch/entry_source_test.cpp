// SPDX-License-Identifier: MIT
#include "batch/entry_source.h"

#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <sys/stat.h>

#include "vantage/core/error.h"

#include "support/temporary_folder.h"

namespace vantage::batch {
namespace {

std::vector<Entry> all_of(EntrySource& source) {
  std::vector<Entry> entries;
  while (std::optional<Entry> entry = source.next()) {
    entries.push_back(*entry);
  }
  return entries;
}

/// What a manifest of this text lists.
std::vector<Entry> listed(const std::string& text) {
  const test::TemporaryFolder scratch;
  return all_of(*entries_of_manifest(scratch.write("list", text)));
}

TEST(EntryFilter, TakesReadableFormatsInAnyCaseUnlessToldOtherwise) {
  EXPECT_TRUE(EntryFilter{}.accepts("d/A.PLY"));
  EXPECT_FALSE(EntryFilter{}.accepts("d/a.txt"));
  EXPECT_FALSE(EntryFilter{}.accepts("d/a.step"));
  EXPECT_TRUE(EntryFilter{.imports = true}.accepts("d/A.STEP"));
  EXPECT_TRUE((EntryFilter{.include = {"*.txt"}}.accepts("d/a.txt")));
  EXPECT_FALSE((EntryFilter{.include = {}, .exclude = {"d/*"}}.accepts("d/a.ply")));
  EXPECT_FALSE((EntryFilter{.include = {"*.ply"}}.accepts("d/._a.ply")));  // of macOS
  EXPECT_FALSE(EntryFilter{}.accepts("__MACOSX/a.ply"));
  EXPECT_TRUE(EntryFilter{}.accepts("d/a__MACOSX/a._.ply"));
}

TEST(EntriesOfPaths, WalkFoldersByTheBytesOfNames) {
  const test::TemporaryFolder scratch;
  std::filesystem::create_directory(scratch.file("b"));
  for (const char* name : {"c.ply", "a.ply", "b/z.ply", "B.ply"}) {
    static_cast<void>(scratch.write(name, ""));
  }
  const auto source = entries_of_paths({scratch.file("")}, {}, "", {});
  std::vector<std::string> names;
  for (const Entry& entry : all_of(*source)) {
    EXPECT_EQ(entry.position, static_cast<std::int64_t>(names.size()));
    names.push_back(
        std::filesystem::path(entry.path).lexically_relative(scratch.file("")).string());
  }
  EXPECT_EQ(names, (std::vector<std::string>{"B.ply", "a.ply", "b/z.ply", "c.ply"}));
}

TEST(EntriesOfPaths, AreNoResultsOfOurOwn) {
  const test::TemporaryFolder scratch;
  for (const char* folder : {"a.vantage", "results", "results/models", "theirs"}) {
    std::filesystem::create_directory(scratch.file(folder));
  }
  for (const char* name : {"a.vantage/a.ply", "a.vantage/map.ply", "a.vantage/camera-best.gltf",
                           "results/results.sqlite", "results/models/b.ply", "theirs/map.ply"}) {
    static_cast<void>(scratch.write(name, ""));
  }
  static_cast<void>(scratch.write("a.vantage/view.json", "{\n  \"vantage\": \"0.1.0\"}"));
  static_cast<void>(scratch.write("theirs/view.json", "{}"));
  std::vector<std::string> names;
  for (const Entry& entry : all_of(*entries_of_paths({scratch.file("")}, {}, "", {}))) {
    names.push_back(
        std::filesystem::path(entry.path).lexically_relative(scratch.file("")).string());
  }
  EXPECT_EQ(names, (std::vector<std::string>{"a.vantage/a.ply", "theirs/map.ply"}));
}

TEST(EntriesOfPaths, DoNotWaitForAPipeThatIsNamedLikeResults) {
  const test::TemporaryFolder scratch;
  ASSERT_EQ(::mkfifo(scratch.file("view.json").c_str(), 0600), 0);
  static_cast<void>(scratch.write("map.ply", ""));
  EXPECT_EQ(all_of(*entries_of_paths({scratch.file("")}, {}, "", {})).size(), 1U);
}

TEST(EntriesOfPaths, DoNotFollowLinksToFolders) {
  const test::TemporaryFolder scratch;
  std::filesystem::create_directory_symlink(".", scratch.file("loop"));
  static_cast<void>(scratch.write("a.ply", ""));
  EXPECT_EQ(all_of(*entries_of_paths({scratch.file("")}, {}, "", {})).size(), 1U);
}

TEST(EntriesOfManifest, PathsAreRelativeToItsFolder) {
  const test::TemporaryFolder scratch;
  const auto source = entries_of_manifest(scratch.write("list", "a.ply\n/b.ply\n"));
  const std::vector<Entry> entries = all_of(*source);
  ASSERT_EQ(entries.size(), 2U);
  EXPECT_EQ(entries[0].key, "a.ply");
  EXPECT_EQ(entries[0].path, scratch.file("a.ply"));
  EXPECT_EQ(entries[1].path, "/b.ply");
}

TEST(EntriesOfManifest, CellsOfCsvMayHoldCommasQuotesAndLineEnds) {
  const std::vector<Entry> entries = listed("name,path,up\n\"a \"\"b\"\"\",\"c,d\ne.ply\",-z\n");
  ASSERT_EQ(entries.size(), 1U);
  EXPECT_EQ(entries[0].name, "a \"b\"");
  EXPECT_EQ(entries[0].key, "c,d\ne.ply");
  EXPECT_EQ(entries[0].up, "-z");
}

// A stray quote once made the rest of the table one name.
TEST(EntriesOfManifest, AQuoteInsideACellOfCsvIsText) {
  const std::vector<Entry> entries = listed("path,name\nc.ply,5\" pipe\nd.ply, \"d\" \n");
  ASSERT_EQ(entries.size(), 2U);
  EXPECT_EQ(entries[0].name, "5\" pipe");
  EXPECT_EQ(entries[1].key, "d.ply");
  EXPECT_EQ(entries[1].name, "d");
}

TEST(EntriesOfManifest, ACellOfCsvThatIsNeverClosedIsRefusedByItsLine) {
  const test::TemporaryFolder scratch;
  const auto source =
      entries_of_manifest(scratch.write("list.csv", "path,name\nc.ply,c\nd.ply,\"d\ne.ply,e\n"));
  EXPECT_EQ(source->next()->key, "c.ply");
  try {
    static_cast<void>(source->next());
    FAIL();
  } catch (const FormatError& error) {
    EXPECT_NE(std::string(error.what()).find("line 3"), std::string::npos) << error.what();
  }
}

// A blank first line once made every manifest a list of paths.
TEST(EntriesOfManifest, BlankLinesAheadAreNoFirstLine) {
  for (const char* const text :
       {"\n{\"path\": \"a.ply\"}\n", "\xEF\xBB\xBF\r\n {\"path\": \"a.ply\"}\n",
        " \t\npath\na.ply\n"}) {
    const std::vector<Entry> entries = listed(text);
    ASSERT_EQ(entries.size(), 1U) << text;
    EXPECT_EQ(entries[0].key, "a.ply");
    EXPECT_EQ(entries[0].problem, "");
  }
}

TEST(EntriesOfManifest, RowsAndLinesOfBlanksListNothing) {
  for (const char* const text : {"path,key\na.ply,a\n,\n , \"\"\n", "path;key\na.ply;a\n;\n",
                                 "{\"path\": \"a.ply\"}\n  \n\t\r\n", "a.ply\n \t\n"}) {
    EXPECT_EQ(listed(text).size(), 1U) << text;
  }
}

TEST(EntriesOfManifest, NamesThatSayNothingAreToldOnce) {
  const test::TemporaryFolder scratch;
  std::vector<std::string> told;
  const auto source = entries_of_manifest(
      scratch.write("list", "{\"path\": \"a\"}\n{\"path\": \"b\", \"x\": 1}\n{\"y\": 2}\n"), {},
      [&](const std::string& warning) { told.push_back(warning); });
  EXPECT_EQ(all_of(*source).size(), 3U);
  ASSERT_EQ(told.size(), 1U);
  EXPECT_NE(told[0].find("line 2 has members that are not read: x; those that are: path, key"),
            std::string::npos)
      << told[0];
}

TEST(Entry, IsCalledByItsPathWhereItsKeySaysAnotherThing) {
  const auto label = [](const char* key, const char* path, const char* member = "") {
    return Entry{.key = key, .path = path, .member = member}.label();
  };
  EXPECT_EQ(label("a/b.ply", "a/b.ply"), "a/b.ply");
  EXPECT_EQ(label("b.ply", "lists/b.ply"), "b.ply");
  EXPECT_EQ(label("chair", "a/b.ply"), "chair (a/b.ply)");
  EXPECT_EQ(label("a.zip//b.ply", "a.zip", "b.ply"), "a.zip//b.ply");
  EXPECT_EQ(label("k", ""), "k");
  const Entry entry{.key = "chair", .path = "a/b.ply"};
  EXPECT_EQ(entry.labelled("crashed"), "chair (a/b.ply): crashed");
  EXPECT_EQ(entry.labelled("chair (a/b.ply): crashed"), "chair (a/b.ply): crashed");
}

TEST(EntriesOfManifest, LinesAreCountedWithThoseInsideCells) {
  const std::vector<Entry> entries = listed("path,name\na.ply,\"x\ny\"\n,c\n");
  ASSERT_EQ(entries.size(), 2U);
  EXPECT_EQ(entries[1].problem, "line 4 of the manifest names no path");
}

// Found by fuzzing: any line with a field of that name was an entry of ours, without path or key.
TEST(EntriesOfManifest, AFieldCalledPlannedMakesNoPlan) {
  const test::TemporaryFolder scratch;
  const auto source = entries_of_manifest(
      scratch.write("list", "{\"planned\": 2}\n{\"planned\": true, \"path\": \"a.ply\"}\n"));
  const std::vector<Entry> entries = all_of(*source);
  ASSERT_EQ(entries.size(), 2U);
  EXPECT_EQ(entries[0].problem, "line 1 of the manifest names no path");
  EXPECT_EQ(entries[1].problem, "");
  EXPECT_EQ(entries[1].path, scratch.file("a.ply"));
  EXPECT_EQ(entries[1].key, "a.ply");
}

TEST(EntriesOfManifest, OneThatIsNotThereIsRefused) {
  EXPECT_THROW(entries_of_manifest("/nowhere/list"), IoError);
}

}  // namespace
}  // namespace vantage::batch
