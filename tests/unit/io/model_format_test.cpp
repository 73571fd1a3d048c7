// SPDX-License-Identifier: MIT
#include "io/model_format.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "vantage/core/error.h"

#include "io/foreign_format.h"
#include "unit/io/error_text.h"

namespace vantage::test {
namespace {

using testing::HasSubstr;

constexpr const char* kPly =
    "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\n"
    "property float z\nend_header\n1 2 3\n";

TEST(ModelFormat, TheBytesWinOverTheNameAndANoteSaysSo) {
  const Model model = parse_model(kPly, "folder/liar.obj");
  EXPECT_EQ(model.format, ModelFormat::Ply);
  EXPECT_THAT(model.notes.at(0), HasSubstr("the name says .obj, but the bytes are ply"));
}

TEST(ModelFormat, TheExtensionMayBeInCapitals) {
  EXPECT_EQ(parse_model("v 1 2 3\n", "A.OBJ").format, ModelFormat::Obj);
}

TEST(ModelFormat, GuessesWithoutAnExtension) {
  EXPECT_EQ(detect_format("# hi\nv 1 2 3\n", "standard input").format, ModelFormat::Obj);
  EXPECT_EQ(detect_format("solid x\nfacet", "standard input").format, ModelFormat::Stl);
  EXPECT_EQ(detect_format(std::string(84, '\0'), "standard input").format, ModelFormat::Stl);
  EXPECT_EQ(detect_format(" {\"asset\":{}}", "standard input").format, ModelFormat::Gltf);
  EXPECT_EQ(detect_format("COFF\n", "standard input").format, ModelFormat::Off);
}

TEST(ModelFormat, TheContentDecidesWhereTheNameIsWrong) {
  const std::string binary_stl(84, '\0');
  const std::string text_stl = "solid x\nfacet";
  const std::string obj = "# hi\nv 1 2 3\n";
  const std::string gltf = " {\"asset\":{}}";
  for (const char* name :
       {"a.obj", "a.ply", "a.off", "a.glb", "a.gltf", "a.3mf", "a.amf", "a.xyz"}) {
    EXPECT_EQ(detect_format(binary_stl, name).format, ModelFormat::Stl) << name;
    EXPECT_EQ(detect_format(text_stl, name).format, ModelFormat::Stl) << name;
  }
  for (const char* name :
       {"a.stl", "a.ply", "a.off", "a.glb", "a.gltf", "a.3mf", "a.amf", "a.pts"}) {
    EXPECT_EQ(detect_format(obj, name).format, ModelFormat::Obj) << name;
  }
  for (const char* name : {"a.stl", "a.ply", "a.obj", "a.glb", "a.3mf"}) {
    EXPECT_EQ(detect_format(gltf, name).format, ModelFormat::Gltf) << name;
  }
  EXPECT_THAT(detect_format(obj, "a.stl").note,
              HasSubstr("the name says .stl, but the bytes look like obj"));
}

TEST(ModelFormat, ABinaryStlThatIsCutShortMayBeginWithAnyWord) {
  EXPECT_EQ(detect_format("o part" + std::string(100, '\0'), "a.stl").format, ModelFormat::Stl);
}

TEST(ModelFormat, NamesAreFileNamesWithoutExtension) {
  EXPECT_EQ(model_name("a/b.c/horse.v2.ply"), "horse.v2");
  EXPECT_EQ(model_name(".hidden"), ".hidden");
  EXPECT_EQ(model_name("plain"), "plain");
}

TEST(ModelFormat, RefusesCompressedFilesWithTheToolThatUnpacksThem) {
  EXPECT_THAT(error_text("\x1F\x8B\x08", "a.ply.gz"), HasSubstr("unpack it first, with gunzip"));
  EXPECT_THAT(error_text("BZh9", "a.obj.bz2"), HasSubstr("bunzip2"));
}

TEST(ModelFormat, RefusesForeignFormatsByTheirBytes) {
  EXPECT_THAT(error_text("PK\x03\x04", "a.usdz"), HasSubstr("is a ZIP archive"));
  EXPECT_THAT(error_text("DRACO\x02", "a"), HasSubstr("draco_decoder"));
  EXPECT_THAT(error_text("<?xml version", "a.dae"), HasSubstr("COLLADA"));
  EXPECT_THAT(error_text("<?xml version=\"1.0\"?>\n<model xmlns=\""
                         "http://schemas.microsoft.com/3dmanufacturing/core/2015/02\">",
                         "a.3mf"),
              HasSubstr("is the model part of a 3MF without its package; export it as 3MF again"));
  EXPECT_THAT(error_text("\x89PNG\r\n", "a.ply"), HasSubstr("is a PNG picture, not a model"));
  EXPECT_THAT(error_text("ISO-10303-21;", "a.step"), HasSubstr("convert it to STL or OBJ"));
}

TEST(ModelFormat, RefusesForeignFormatsByTheirExtension) {
  EXPECT_THAT(error_text("MM....", "a.3ds"), HasSubstr("3DS files are not read; convert it to"));
  EXPECT_THAT(error_text("LASF", "a.las"), HasSubstr("LAS files are not read"));
}

TEST(ModelFormat, RefusesWhatItDoesNotKnow) {
  EXPECT_THAT(error_text("hello", "a.what"), HasSubstr("cannot tell what format this is"));
  EXPECT_THAT(error_text("hello", "-"), HasSubstr("by the ending of the file's name: save it"));
}

TEST(ModelFormat, KnowsA3dsByItsFirstChunks) {
  using namespace std::string_literals;
  const auto is_3ds = [](const std::string& bytes) {
    const ImportFormat* const found = check_foreign_bytes(bytes, "", "-", true);
    return found != nullptr && found->name == "3ds";
  };
  EXPECT_TRUE(is_3ds("MM\x10\0\0\0\x02\0\x0A\0\0\0\x03\0\0\0"s));
  EXPECT_TRUE(is_3ds("MM\x0C\0\0\0==\x06\0\0\0"s));
  EXPECT_FALSE(is_3ds("MM\x11\0\0\0\x02\0\x0A\0\0\0\x03\0\0\0"s));                 // cut short
  EXPECT_FALSE(is_3ds("MM\0\x2A\0\0\0\x08\0\0\0\0"s + std::string(20000, '\0')));  // TIFF
  EXPECT_FALSE(is_3ds("MM"));
}

TEST(ModelFormat, RefusesBytesThatContradictAFormatWithASignature) {
  EXPECT_THAT(error_text("plx\n", "a.ply"), HasSubstr("line 1: expected the word ply"));
  EXPECT_THAT(error_text("glTX....", "a.glb"), HasSubstr("expected the letters glTF"));
}

TEST(ModelFormat, RefusesWhatWasFetchedInPlaceOfAModel) {
  const std::string pointer =
      "version https://git-lfs.github.com/spec/v1\noid sha256:4d7a\nsize 12345\n";
  const std::string page = "\n<!doctype HTML>\n<html><head><title>Not found</title></head><body>" +
                           std::string(200, 'x') + "</body></html>\n";
  for (const char* const name :
       {"a.obj", "a.stl", "a.glb", "a.ply", "a.3mf", "a.xyz", "a.dae", "a"}) {
    EXPECT_THAT(error_text(pointer, name),
                HasSubstr("is a Git LFS pointer in place of the file; fetch it, with git lfs pull"))
        << name;
    EXPECT_THAT(error_text(page, name), HasSubstr("is a web page, not a model")) << name;
    EXPECT_THAT(error_text("<html lang=\"en\">", name), HasSubstr("is a web page")) << name;
  }
}

}  // namespace
}  // namespace vantage::test
