// SPDX-License-Identifier: MIT
#include "batch/confined_folder.h"

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include "vantage/core/error.h"

#include "batch/descriptor.h"
#include "support/temporary_folder.h"

namespace vantage::batch {
namespace {

namespace fs = std::filesystem;

std::string text_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

/// A folder beside one that is not to be touched, with a link from the one to the other.
class ConfinedFolderTest : public ::testing::Test {
 protected:
  ConfinedFolderTest() {
    fs::create_directories(scratch_.file("own"));
    fs::create_directories(scratch_.file("victim"));
    static_cast<void>(scratch_.write("victim/file", "mine"));
    fs::create_symlink("../victim", scratch_.file("own/link"));
  }

  void expect_untouched() const {
    EXPECT_EQ(text_of(scratch_.file("victim/file")), "mine");
    EXPECT_EQ(std::distance(fs::directory_iterator(scratch_.file("victim")), {}), 1);
  }

  test::TemporaryFolder scratch_{};
};

TEST(ConfinedFolder, TakesOnlyNamesThatStayInside) {
  for (const char* name : {"a", "a/b", "..a", ".work/x", "a\\..\\b"}) {
    EXPECT_TRUE(ConfinedFolder::is_name(name)) << name;
  }
  for (const char* name : {"", "/", "/a", "a/", "a//b", ".", "..", "a/..", "../a", "a/./b"}) {
    EXPECT_FALSE(ConfinedFolder::is_name(name)) << name;
  }
  EXPECT_FALSE(ConfinedFolder::is_name(std::string("a\0b", 3)));
}

TEST_F(ConfinedFolderTest, NeitherWritesNorRemovesNorSeesWhatIsOutside) {
  const ConfinedFolder folder(scratch_.file("own"));
  for (const std::string& name :
       {std::string("link/file"), std::string("../victim/file"), scratch_.file("victim/file")}) {
    EXPECT_FALSE(folder.exists(name)) << name;
    EXPECT_FALSE(folder.remove(name)) << name;
    EXPECT_THROW(folder.write(name, "x"), IoError) << name;
    EXPECT_THROW(folder.make_folders(name), IoError) << name;
    EXPECT_THROW(folder.make_new_folder(name), IoError) << name;
    EXPECT_EQ(folder.beginning_of(name, 4), "") << name;
  }
  expect_untouched();
}

TEST_F(ConfinedFolderTest, RemovesALinkAndNotWhatItLeadsTo) {
  const ConfinedFolder folder(scratch_.file("own"));
  fs::create_directories(scratch_.file("own/tree/below"));
  fs::create_symlink("../../../victim", scratch_.file("own/tree/below/link"));
  EXPECT_TRUE(folder.remove("tree"));
  EXPECT_TRUE(folder.remove("link"));
  EXPECT_FALSE(fs::exists(fs::symlink_status(scratch_.file("own/link"))));
  expect_untouched();
}

TEST_F(ConfinedFolderTest, AFileTakesThePlaceOfALink) {
  const ConfinedFolder folder(scratch_.file("own"));
  fs::create_symlink("../victim/file", scratch_.file("own/page"));
  folder.write("page", "new");
  EXPECT_EQ(text_of(scratch_.file("own/page")), "new");
  EXPECT_FALSE(fs::exists(scratch_.file("own/.work/local.part")));
  expect_untouched();
}

TEST_F(ConfinedFolderTest, OpensNeitherLinksNorPipesNorASecondNameForWriting) {
  const ConfinedFolder folder(scratch_.file("own"));
  fs::create_symlink("../victim/file", scratch_.file("own/page"));
  fs::create_hard_link(scratch_.file("victim/file"), scratch_.file("own/twin"));
  ::mkfifo(scratch_.file("own/pipe").c_str(), 0600);
  for (const char* name : {"page", "pipe", "twin", "link"}) {
    EXPECT_LT(Descriptor(folder.open_file(name, O_WRONLY | O_APPEND)).number(), 0) << name;
  }
  EXPECT_LT(Descriptor(folder.open_file("pipe", O_RDONLY)).number(), 0);
  expect_untouched();
}

TEST_F(ConfinedFolderTest, MovesAFolderIntoThePlaceOfAnother) {
  const ConfinedFolder folder(scratch_.file("own"));
  fs::create_directories(scratch_.file("own/new"));
  fs::create_directories(scratch_.file("own/models/a"));
  static_cast<void>(scratch_.write("own/new/x", "new"));
  static_cast<void>(scratch_.write("own/models/a/x", "old"));
  folder.move("new", "models/a");
  EXPECT_EQ(text_of(scratch_.file("own/models/a/x")), "new");
  EXPECT_FALSE(fs::exists(scratch_.file("own/new")));
  fs::create_directories(scratch_.file("own/new"));
  EXPECT_THROW(folder.move("new", "link/a"), IoError);
  expect_untouched();
}

}  // namespace
}  // namespace vantage::batch
