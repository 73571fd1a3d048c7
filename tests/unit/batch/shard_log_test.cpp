// SPDX-License-Identifier: MIT
#include "batch/shard_log.h"

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "vantage/core/error.h"

#include "batch/content_hash.h"
#include "support/temporary_folder.h"
#include "unit/batch/first_of_equals.h"

namespace vantage::batch {
namespace {

ModelRecord record(const std::string& key, std::int64_t position, const std::string& content) {
  ModelRecord made;
  made.key = key;
  made.position = position;
  made.content = content;
  made.status = "done";
  made.folder = key + "-folder";
  return made;
}

TEST(Shard, NumbersAreTheFirstEightBytesOfTheHashOfTheKey) {
  // printf abc | sha256sum: ba7816bf 8f01cfea …
  EXPECT_EQ(stable_number("abc"), 0xba7816bf8f01cfeaULL);
}

TEST(Shard, EveryKeyIsInExactlyOne) {
  for (int i = 0; i < 200; ++i) {
    int holders = 0;
    for (std::uint32_t index = 0; index < 7; ++index) {
      holders += Shard{index, 7}.holds("model-" + std::to_string(i)) ? 1 : 0;
    }
    EXPECT_EQ(holders, 1) << i;
  }
}

TEST(ParseShard, TakesAnIndexBelowItsCount) {
  EXPECT_EQ(parse_shard("3/64").index, 3U);
  EXPECT_EQ(parse_shard("3/64").count, 64U);
  for (const char* text : {"", "3", "3/", "/3", "3/3", "-1/3", "1/2x", "0/0", "0/100000"}) {
    EXPECT_THROW(parse_shard(text), InvalidInput) << text;
  }
}

TEST(ShardLog, FindsAllOfOneContentAndKeepsAFolderWithTheOneThatTookIt) {
  const test::TemporaryFolder scratch;
  ShardLog log(scratch.file(), {0, 2});
  ModelRecord first = record("first", 1, "same");
  ModelRecord second = record("second", 2, "same");
  second.folder = first.folder;
  log.put(first);
  log.put(second);
  log.put(record("third", 3, "other"));
  EXPECT_EQ(log.find_equals(record("new", 5, "same")).size(), 2U);
  first.folder.clear();
  log.put(first);
  EXPECT_EQ(log.owner_of("first-folder"), "second");
}

TEST(ShardLog, FindsTheFirstOfEqualContentByPosition) {
  const test::TemporaryFolder scratch;
  ShardLog log(scratch.file(), {0, 2});
  log.put(record("late", 9, "same"));
  log.put(record("early", 2, "same"));
  EXPECT_EQ(log.find_content(record("new", 5, "same"))->key, "early");
  EXPECT_FALSE(log.find_content(record("new", 5, "other")));
}

TEST(ShardLog, FindsTheFirstOfEqualModelsThatIsDone) {
  const test::TemporaryFolder scratch;
  ShardLog book(scratch.file(), {0, 2});
  test::expect_finds_what_stands_for_a_content(book);
}

TEST(ShardLog, FindsTheFirstThatHasTheResultsOfAnother) {
  const test::TemporaryFolder scratch;
  ShardLog book(scratch.file(), {0, 2});
  test::expect_finds_first_duplicate(book);
}

TEST(ShardLog, ALargeFileIsWrittenAnewWhenItsLogIsAsLong) {
  const test::TemporaryFolder scratch;
  ShardLog log(scratch.file(), {0, 1});
  const std::string file = scratch.file() + "/shards/shard-00000-of-00001.jsonl";
  int written = 0;
  std::uintmax_t before = 0;
  for (int i = 0; i < 2048; ++i) {
    log.put(record("m" + std::to_string(i), i, "of-" + std::to_string(i)));
    const std::uintmax_t size = std::filesystem::file_size(file);
    written += size == std::exchange(before, size) ? 0 : 1;
  }
  EXPECT_EQ(written, 4);  // at 256, 512, 1024 and 2048 records
}

TEST(ShardLog, RecordsSurviveWithoutFinishAndATornLineIsPassedOver) {
  const test::TemporaryFolder scratch;
  {
    ShardLog log(scratch.file(), {0, 2});
    log.put(record("a", 0, "A"));
    log.put(record("b", 1, "B"));
  }
  const std::string file = scratch.file("shards/shard-00000-of-00002.jsonl");
  std::ofstream(file + ".log", std::ios::app) << R"({"key": "torn", "posi)";
  ShardLog log(scratch.file(), {0, 2});
  EXPECT_TRUE(log.find("a"));
  EXPECT_TRUE(log.find("b"));
  EXPECT_FALSE(log.find("torn"));
  EXPECT_FALSE(std::filesystem::exists(file + ".log"));
}

TEST(ShardLog, WritesTheSameBytesInWhateverOrderModelsEnd) {
  std::vector<std::string> files;
  for (const bool forward : {true, false}) {
    const test::TemporaryFolder scratch;
    ShardLog log(scratch.file(), {0, 2});
    log.put(forward ? record("a", 0, "A") : record("b", 1, "B"));
    log.put(forward ? record("b", 1, "B") : record("a", 0, "A"));
    log.finish();
    std::ifstream stream(scratch.file("shards/shard-00000-of-00002.jsonl"));
    files.emplace_back(std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>());
  }
  EXPECT_EQ(files[0], files[1]);
}

}  // namespace
}  // namespace vantage::batch
