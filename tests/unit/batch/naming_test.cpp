// SPDX-License-Identifier: MIT
#include "batch/naming.h"

#include <string>

#include <gtest/gtest.h>

#include "vantage/core/error.h"

namespace vantage::batch {
namespace {

TEST(KeyOfPath, LeavesUtf8AsItIs) {
  EXPECT_EQ(key_of_path("ä/日本.ply"), "ä/日本.ply");
}

TEST(KeyOfPath, WritesBytesThatAreNoUtf8AsHexadecimal) {
  EXPECT_EQ(key_of_path("a\xE9.ply"), "a\\xe9.ply");
  EXPECT_EQ(key_of_path("\xED\xA0\x80"), "\\xed\\xa0\\x80") << "a surrogate";
  EXPECT_EQ(key_of_path("\xC0\xAF"), "\\xc0\\xaf") << "an overlong slash";
}

TEST(KeyOfPath, CanBeTurnedBackForEveryPairOfBytes) {
  for (int a = 1; a < 256; ++a) {
    for (int b = 1; b < 256; ++b) {
      const std::string path{static_cast<char>(a), static_cast<char>(b), '\\', 'x', '4', '1'};
      ASSERT_EQ(path_of_key(key_of_path(path)), path) << a << ' ' << b;
    }
  }
}

TEST(FolderName, FillsInEveryField) {
  const NameFields fields{
      .path = "d/e/m.x.ply", .name = "N", .key = "k", .content = "0123456789abcdef0123"};
  EXPECT_EQ(folder_name("{stem}|{name}|{ext}|{parent}", fields), "m.x_N_ply_e");
  EXPECT_EQ(folder_name("{hash2}/{hash8}/{hash16}", fields), "01/01234567/0123456789abcdef");
  // printf k | sha256sum
  EXPECT_EQ(folder_name("{key8}", fields), "8254c329");
}

TEST(FolderName, NeverLeavesItsFolder) {
  for (const char* path : {"../..", "a/..", "..", ".", "/", "", "a/.ply", "-rf", "~", "C:\\x"}) {
    const std::string name = folder_name("{stem}", {.path = path, .key = path});
    EXPECT_EQ(name.find('/'), std::string::npos) << path;
    EXPECT_NE(name.front(), '.') << path;
    EXPECT_NE(name.front(), '-') << path;
  }
}

TEST(FolderName, CutsLongNamesBetweenCharacters) {
  std::string stem;
  for (int i = 0; i < 100; ++i) {
    stem += "日";
  }
  const std::string name = folder_name("{stem}", {.path = stem + ".ply", .key = "k"});
  EXPECT_EQ(name.size(), 99U) << "30 characters of 3 bytes, a dash and 8 digits fit into 100";
  EXPECT_EQ(stem.substr(0, 90), name.substr(0, 90));
}

TEST(FolderName, KeepsLongNamesApartWhereverTheyDiffer) {
  const std::string a(240, 'a');
  const auto named = [](const std::string& text, const std::string& path) {
    return folder_name(text, {.path = path, .key = "k", .content = "0123456789abcdef"});
  };
  EXPECT_EQ(named("{stem}", a + "1.ply"), named("{stem}", a + "1.ply"));
  EXPECT_NE(named("{stem}", a + "1.ply"), named("{stem}", a + "2.ply"));
  // The fields fit, but not together; what is cut off may be all that differs.
  EXPECT_NE(named("{parent}-{stem}-1", a + "/" + a), named("{parent}-{stem}-2", a + "/" + a));
  EXPECT_LE(named("{parent}-{stem}", a + "/" + a).size(), 150U);
}

TEST(CheckTemplate, RefusesUnknownFieldsAndPartsWithoutAName) {
  for (const char* text : {"{what}", "{stem", "", "/a", "a/", "a//b"}) {
    EXPECT_THROW(check_template(text, false), InvalidInput) << text;
  }
  EXPECT_NO_THROW(check_template("{parent}/{stem}", false));
}

TEST(CheckTemplate, AsksShardsForAFieldThatTellsModelsApart) {
  EXPECT_THROW(check_template("{stem}-{hash2}", true), InvalidInput);
  EXPECT_NO_THROW(check_template("{stem}-{key8}", true));
}

}  // namespace
}  // namespace vantage::batch
