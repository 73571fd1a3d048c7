// SPDX-License-Identifier: MIT
#include <filesystem>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include "vantage/core/error.h"
#include "vantage/io/model.h"
#include "vantage/io/write.h"

#include "support/temporary_folder.h"
#include "unit/io/glb_bytes.h"

namespace vantage::test {
namespace {

using testing::HasSubstr;

std::string load_error(const std::string& path) {
  try {
    load_model(path);
  } catch (const Error& error) {
    return error.what();
  }
  return "nothing";
}

/// A glTF of one triangle whose buffer is the file `uri`.
std::string gltf_with_buffer(const std::string& uri) {
  return R"({"asset":{"version":"2.0"},"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],
    "meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],
    "accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"}],
    "bufferViews":[{"buffer":0,"byteLength":36}],"buffers":[{"byteLength":36,"uri":")" +
         uri + "\"}]}";
}

TEST(LoadModel, NamesTheModelAfterItsFile) {
  const TemporaryFolder folder;
  write_file(folder.file("my horse.obj"), "v 0 0 0\n");
  EXPECT_EQ(load_model(folder.file("my horse.obj")).name, "my horse");
}

TEST(LoadModel, ReadsABufferBesideTheModel) {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder.path() / "sub dir");
  write_file(folder.file("sub dir/a.bin"), std::string(36, '\0'));
  write_file(folder.file("a.gltf"), gltf_with_buffer("sub%20dir/a.bin"));
  EXPECT_EQ(load_model(folder.file("a.gltf")).mesh.positions.size(), 3U);
}

TEST(LoadModel, RefusesABufferBehindALinkThatLeavesTheFolder) {
  const TemporaryFolder folder;
  const TemporaryFolder elsewhere;
  write_file(elsewhere.file("a.bin"), std::string(36, '\0'));
  std::filesystem::create_symlink(elsewhere.file("a.bin"), folder.file("a.bin"));
  write_file(folder.file("a.gltf"), gltf_with_buffer("a.bin"));
  EXPECT_THAT(load_error(folder.file("a.gltf")), HasSubstr("lies outside the model's folder"));
}

TEST(LoadModel, SaysThatBytesFollowAGlb) {
  std::string json = gltf_with_buffer("");
  json.replace(json.find(R"(,"uri":"")"), 9, "");
  const std::string whole = glb(json, std::string(36, '\0'));
  EXPECT_THAT(parse_model(whole, "a.glb").notes, testing::IsEmpty());
  EXPECT_THAT(parse_model(whole + "tail", "a.glb").notes,
              testing::ElementsAre("bytes after the last chunk left out: 4"));
}

TEST(LoadModel, RefusesABufferThatIsMissing) {
  const TemporaryFolder folder;
  write_file(folder.file("a.gltf"), gltf_with_buffer("a.bin"));
  EXPECT_THAT(load_error(folder.file("a.gltf")),
              HasSubstr("names the buffer a.bin, which cannot be opened (No such file"));
}

TEST(LoadModel, RefusesABufferThatIsAPipe) {
  const TemporaryFolder folder;
  ASSERT_EQ(::mkfifo(folder.file("a.bin").c_str(), 0600), 0);
  write_file(folder.file("a.gltf"), gltf_with_buffer("a.bin"));
  EXPECT_THAT(load_error(folder.file("a.gltf")), HasSubstr("is not a regular file"));
}

TEST(LoadModel, RefusesFoldersDevicesAndPipes) {
  const TemporaryFolder folder;
  ASSERT_EQ(::mkfifo(folder.file("pipe.obj").c_str(), 0600), 0);
  EXPECT_THAT(load_error(folder.path().string()),
              HasSubstr("is a folder, not a file; vantage batch takes"));
  EXPECT_THAT(load_error("/dev/zero"), HasSubstr("is not a regular file"));
  EXPECT_THAT(load_error(folder.file("pipe.obj")), HasSubstr("is not a regular file"));
}

TEST(LoadModel, RefusesAFileThatIsNotThere) {
  EXPECT_THAT(load_error("/nowhere/a.obj"),
              HasSubstr("/nowhere/a.obj: cannot be opened (No such file or directory)"));
}

TEST(LoadModel, StopsWhenAsked) {
  const TemporaryFolder folder;
  write_file(folder.file("a.obj"), "v 0 0 0\n");
  std::stop_source source;
  source.request_stop();
  EXPECT_THROW(load_model(folder.file("a.obj"), {.stop = source.get_token()}), Cancelled);
}

TEST(LoadModel, ReportsProgressThatNeverFalls) {
  std::string text;
  for (int i = 0; i < 100'000; ++i) {
    text += "v 0 0 1\n";
  }
  std::vector<double> fractions;
  RunContext run;
  run.report = [&](std::string_view, double fraction) { fractions.push_back(fraction); };
  parse_model(text, "a.obj", run);
  EXPECT_GT(fractions.size(), 3U);
  EXPECT_TRUE(std::is_sorted(fractions.begin(), fractions.end()));
  EXPECT_EQ(fractions.back(), 1.0);
}

}  // namespace
}  // namespace vantage::test
