// SPDX-License-Identifier: MIT
#include "batch/file_watch.h"

#include <filesystem>
#include <string>

#include <gtest/gtest.h>

#include "support/temporary_folder.h"

namespace vantage::batch {
namespace {

/// The time of change is set to that of before: what is left to tell two files apart is which they are.
class FileWatchTest : public ::testing::Test {
 protected:
  void replace_by(const std::string& text) {
    const std::string next = scratch_.write("next", text);
    std::filesystem::last_write_time(next, time_);
    std::filesystem::rename(next, path_);
  }

  test::TemporaryFolder scratch_;
  std::string path_ = scratch_.write("model.off", "one");
  std::filesystem::file_time_type time_ = std::filesystem::last_write_time(path_);
};

TEST_F(FileWatchTest, AFileThatIsLeftAloneIsUnchanged) {
  const FileWatch watch(path_);
  EXPECT_TRUE(watch.is_unchanged());
}

TEST_F(FileWatchTest, AnotherOfTheSameTextAfterOneOfAnotherTextIsTold) {
  const FileWatch watch(path_);
  replace_by("two");
  EXPECT_FALSE(watch.is_unchanged());
  for (int i = 0; i < 8; ++i) {
    replace_by("one");
    EXPECT_FALSE(watch.is_unchanged()) << i;
    replace_by("two");
  }
}

TEST_F(FileWatchTest, AFileThatIsGoneIsTold) {
  const FileWatch watch(path_);
  std::filesystem::remove(path_);
  EXPECT_FALSE(watch.is_unchanged());
}

TEST_F(FileWatchTest, AFileThatGrowsIsTold) {
  const FileWatch watch(path_);
  std::filesystem::resize_file(path_, 4);
  std::filesystem::last_write_time(path_, time_);
  EXPECT_FALSE(watch.is_unchanged());
}

}  // namespace
}  // namespace vantage::batch
