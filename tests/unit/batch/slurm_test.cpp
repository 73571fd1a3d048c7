// SPDX-License-Identifier: MIT
#include "batch/slurm.h"

#include <filesystem>
#include <fstream>
#include <sstream>

#include <gtest/gtest.h>

#include "support/temporary_folder.h"

namespace vantage::batch {
namespace {

std::string content_of(const std::string& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

// The script is the one place where words of ours meet a shell: it is run, with a program that puts
// down its arguments in place of the shard.
TEST(SlurmScript, HandsItsWordsOnWhateverIsInThem) {
  const test::TemporaryFolder scratch;
  const std::string taken = scratch.file("taken");
  const std::vector<std::string> words = {"it's", "$(touch evil)",  "`touch evil`", "a b\nc",
                                          "--",   "-x; touch evil", "\"q\" \\ *"};
  SlurmRequest request{.folder = scratch.file("it's $(touch evil)"), .shards = 3};
  request.command = {"bash", "-c", "printf '%s\\0' \"$@\" > " + taken, "shard"};
  request.command.insert(request.command.end(), words.begin(), words.end());
  const std::string script = scratch.write("shard.sh", slurm_script(request));
  const std::string run =
      "cd '" + scratch.file("") + "' && SLURM_ARRAY_TASK_ID=2 bash '" + script + "' 2>&1";
  ASSERT_EQ(std::system(run.c_str()), 0);
  std::string expected;
  for (const std::string& word : words) {
    expected += word + std::string(1, '\0');
  }
  EXPECT_EQ(content_of(taken), expected + std::string("--shard\0002/3\0", 12));
  EXPECT_FALSE(std::filesystem::exists(scratch.file("evil")));
}

TEST(IndexRanges, JoinWhatFollowsEachOther) {
  EXPECT_EQ(index_ranges({0, 1, 2, 3, 7}), "0-3,7");
  EXPECT_EQ(index_ranges({5}), "5");
  EXPECT_EQ(index_ranges({}), "");
}

}  // namespace
}  // namespace vantage::batch
