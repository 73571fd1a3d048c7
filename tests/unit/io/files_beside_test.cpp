// SPDX-License-Identifier: MIT
#include <filesystem>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "vantage/io/model.h"
#include "vantage/io/write.h"

#include "io/byte_cursor.h"
#include "io/side_files.h"
#include "support/temporary_folder.h"

namespace vantage::test {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

class FilesBesideAModel : public testing::Test {
 protected:
  void write(const std::string& name, const std::string& bytes = "x") {
    std::filesystem::create_directories((folder_.path() / name).parent_path());
    write_file(folder_.file(name), bytes);
  }

  /// Names of what is found if the bytes pass in pieces of `piece`.
  std::vector<std::string> found(const std::string& name, const std::string& bytes,
                                 std::size_t piece = 1000) {
    FilesBeside beside(folder_.file(name));
    for (std::size_t at = 0; at < bytes.size(); at += piece) {
      beside.pass(std::string_view(bytes).substr(at, piece));
    }
    std::vector<std::string> names;
    missing_.clear();
    for (const FileBeside& file : beside.find()) {
      (file.path.empty() ? missing_ : names).push_back(file.name);
      EXPECT_EQ(std::filesystem::is_regular_file(file.path), !file.path.empty()) << file.path;
    }
    return names;
  }

  const TemporaryFolder folder_{};
  std::vector<std::string> missing_{};  // of the files that were looked for last
};

TEST_F(FilesBesideAModel, PicturesAreInTheFolderOfTheirLibrary) {
  write("mats/a.mtl", "newmtl m\nmap_Kd t.png\n");
  write("mats/t.png");
  write("t.png");
  EXPECT_THAT(found("m.obj", "mtllib mats/a.mtl\n"), ElementsAre("mats/a.mtl", "mats/t.png"));
  EXPECT_THAT(found("m.obj", "mtllib .\\mats\\a.mtl\n"), ElementsAre("mats/a.mtl", "mats/t.png"));
}

TEST_F(FilesBesideAModel, APictureOfTheAuthorsDiskIsBesideTheModel) {
  write("a.mtl", "newmtl m\nmap_Kd -clamp on C:\\work\\my wood.png\n");
  write("my wood.png");
  EXPECT_THAT(found("m.obj", "mtllib a.mtl\n"), ElementsAre("a.mtl", "my wood.png"));
}

TEST_F(FilesBesideAModel, ALibraryOfTheAuthorsDiskIsBesideTheModel) {
  EXPECT_THAT(found("m.obj", "mtllib maps/a.mtl\n"), IsEmpty());
  EXPECT_THAT(missing_, ElementsAre("a.mtl", "maps/a.mtl"));
  write("a.mtl");
  EXPECT_THAT(found("m.obj", "mtllib maps/a.mtl\n"), ElementsAre("a.mtl"));
  EXPECT_THAT(missing_, ElementsAre("maps/a.mtl"));
  EXPECT_THAT(found("m.obj", "mtllib /home/me/a.mtl\n"), ElementsAre("a.mtl"));
  EXPECT_THAT(missing_, IsEmpty());
}

TEST_F(FilesBesideAModel, TheBytesSayWhatItIsAsForItsReader) {
  write("a.mtl");
  write("t.png");
  for (const char* const name : {"model", "m.stl", "m.txt", "m.bin"}) {
    EXPECT_THAT(found(name, "mtllib a.mtl\nv 0 0 0\n"), ElementsAre("a.mtl")) << name;
    EXPECT_THAT(found(name, R"({"images":[{"uri":"t.png"}]})"), ElementsAre("t.png")) << name;
  }
  EXPECT_THAT(found("m.obj", "solid a\nmtllib a.mtl\n"), IsEmpty());
}

TEST_F(FilesBesideAModel, FilesThatAreNotThereAreNamedWhereTheyWouldBeRead) {
  write("a.mtl", "newmtl m\nmap_Kd maps/t.png\nnewmtl n\nmap_Kd maps/t.png\n");
  EXPECT_THAT(found("m.obj", "mtllib a.mtl\nmtllib b.mtl\n"), ElementsAre("a.mtl"));
  EXPECT_THAT(missing_, ElementsAre("maps/t.png", "t.png", "b.mtl"));
  write("t.png");
  EXPECT_THAT(found("m.obj", "mtllib a.mtl\n"), ElementsAre("a.mtl", "t.png"));
  EXPECT_THAT(missing_, ElementsAre("maps/t.png"));
  write("maps/t.png");
  EXPECT_THAT(found("m.obj", "mtllib a.mtl\n"), ElementsAre("a.mtl", "maps/t.png"));
  EXPECT_THAT(missing_, IsEmpty());
}

TEST_F(FilesBesideAModel, PicturesOfAnImportedModelAreThoseThatItsReaderNames) {
  write("t.png");
  FilesBeside beside(folder_.file("m.dae"));
  beside.pass("<?xml version=\"1.0\"?><COLLADA/>");
  ASSERT_NE(beside.import_as(), nullptr);
  EXPECT_EQ(beside.import_as()->name, "dae");
  beside.add_pictures({"/home/a/t.png", "gone.png", "../out.png"});
  std::vector<std::string> names;
  for (const FileBeside& file : beside.find()) {
    names.push_back((file.path.empty() ? "no " : "") + file.name);
  }
  EXPECT_THAT(names, ElementsAre("t.png", "no gone.png", "no out.png"));
}

TEST_F(FilesBesideAModel, ALineNamesOneLibraryWithSpacesOrSeveral) {
  write("a.mtl");
  write("b.mtl");
  EXPECT_THAT(found("m.obj", "mtllib a.mtl b.mtl\n"), ElementsAre("a.mtl", "b.mtl"));
  write("a.mtl b.mtl");
  EXPECT_THAT(found("m.obj", "mtllib a.mtl b.mtl\n"), ElementsAre("a.mtl b.mtl"));
}

TEST_F(FilesBesideAModel, TheirFolderIsListedOnce) {
  write("B.mtl");
  write("b.MTL");
  FolderNames names;
  EXPECT_EQ(names.spelled_otherwise(folder_.path(), "b.mtl"), "B.mtl");
  EXPECT_EQ(names.spelled_otherwise(folder_.path(), "a.mtl"), "");
  write("A.mtl");
  EXPECT_EQ(names.spelled_otherwise(folder_.path(), "a.mtl"), "");
  EXPECT_EQ(names.spelled_otherwise(folder_.path() / "none", "a.mtl"), "");
}

TEST_F(FilesBesideAModel, LibrariesAreFoundAnywhereInTheFile) {
  write("a.mtl");
  write("b.mtl");
  std::string text = "v 0 0 0\n";
  while (text.size() < 3U << 20U) {
    text += "# a long way down\n";
  }
  text += "f 1 1 1\r\n  mtllib a.mtl \\\r\nb.mtl\r\nmtllibrary no.mtl";
  for (const std::size_t piece : {std::size_t{1}, std::size_t{7}, text.size()}) {
    EXPECT_THAT(found("m.obj", text, piece), ElementsAre("a.mtl", "b.mtl")) << piece;
  }
  EXPECT_THAT(found("m.OBJ", "mtllib a.mtl", 3), ElementsAre("a.mtl"));
  EXPECT_THAT(found("m.obj", "mtllib a.mtl # D:\\\nmtllib b.mtl\n"), ElementsAre("a.mtl", "b.mtl"));
}

TEST_F(FilesBesideAModel, BuffersAndPicturesOfABinaryGltf) {
  write("t.png");
  const std::string json = R"({"images": [{"uri": "t.png"}]})";
  const std::string rest = R"({"images": [{"uri": "m.glb"}]})";  // behind the JSON: not asked for
  std::string text = "glTF";
  append_little_endian(text, std::uint32_t{2});
  append_little_endian(text, static_cast<std::uint32_t>(20 + json.size() + rest.size()));
  append_little_endian(text, static_cast<std::uint32_t>(json.size()));
  text += "JSON" + json + rest;
  write("m.glb", text);
  EXPECT_THAT(found("m.glb", text, 7), ElementsAre("t.png"));
  EXPECT_THAT(found("m.glb", text), ElementsAre("t.png"));
  EXPECT_THAT(found("m.glb", text.substr(0, 15)), IsEmpty());
}

TEST_F(FilesBesideAModel, BuffersAndPicturesOfAGltf) {
  write("my buffer.bin");
  write("t.png");
  const std::string text = R"({"images":[{"uri":"t.png"},{"uri":"data:,"},{"bufferView":0}],
      "buffers":[{"uri":"my%20buffer.bin"},{"uri":"http://a/t.png"},{"uri":"gone.bin"},{}]})";
  EXPECT_THAT(found("m.gltf", text, 10), ElementsAre("my buffer.bin", "t.png"));
  EXPECT_THAT(missing_, ElementsAre("gone.bin"));
}

TEST_F(FilesBesideAModel, OfAGltfLongerThanWhatIsReadOfOthers) {
  write("t.png");
  const std::string text = R"({"images":[{"uri":"t.png"}]})";
  const std::string long_text = "{" + std::string(65U << 20U, ' ') + text.substr(1);
  EXPECT_THAT(found("m.gltf", long_text, 1U << 20U), ElementsAre("t.png"));
}

TEST_F(FilesBesideAModel, PicturesOfAPly) {
  write("my wood.png");
  write("t.png");
  write("m_a.png");
  const std::string text =
      "ply\nformat ascii 1.0\ncomment TextureFile C:\\work\\my wood.png\n"
      "comment TextureFile t.png\ncomment TextureFile <this>_a.png\n"
      "comment TextureFile gone.png\nelement vertex 1\nproperty float x\n"
      "property float y\nproperty float z\nend_header\n0 0 0\n";
  EXPECT_THAT(found("m.ply", text, 7), ElementsAre("my wood.png", "t.png", "m_a.png"));
  EXPECT_THAT(found("m.ply", text.substr(0, 60)), IsEmpty());
}

TEST_F(FilesBesideAModel, NothingOutsideTheFolder) {
  const TemporaryFolder elsewhere;
  write_file(elsewhere.file("a.mtl"), "x");
  std::filesystem::create_symlink(elsewhere.file("a.mtl"), folder_.file("link.mtl"));
  EXPECT_THAT(found("m.obj", "mtllib link.mtl\nmtllib ../a.mtl\nmtllib " + elsewhere.file("a.mtl")),
              IsEmpty());
}

}  // namespace
}  // namespace vantage::test
