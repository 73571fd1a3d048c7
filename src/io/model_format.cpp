// SPDX-License-Identifier: MIT
#include "io/model_format.h"

#include <algorithm>
#include <array>

#include "vantage/core/error.h"

#include "io/number_parsing.h"
#include "io/readers.h"
#include "io/text_cursor.h"
#include "io/threemf_package.h"

namespace vantage {
namespace {

constexpr std::string_view kUnpack = "; unpack it first, with ";
constexpr std::string_view kConvertMesh =
    "; convert it to OBJ, PLY or GLB first, for example with meshlab or Blender";
constexpr std::string_view kConvertSolid =
    "; convert it to STL or OBJ first, for example with FreeCAD or gmsh";
constexpr std::string_view kNoModel = ", not a model";

/// How a format that is not read gives itself away, and what to do about it.
struct ForeignMagic {
  std::string_view magic;
  std::string_view what;
  std::string_view remedy;
  std::string_view tool;
};

using namespace std::string_view_literals;

constexpr std::array<ForeignMagic, 25> kForeignMagics = {{
    {"\x1F\x8B"sv, "is compressed with gzip", kUnpack, "gunzip"},
    {"BZh"sv, "is compressed with bzip2", kUnpack, "bunzip2"},
    {"\xFD"
     "7zXZ"sv,
     "is compressed with xz", kUnpack, "unxz"},
    {"\x28\xB5\x2F\xFD"sv, "is compressed with zstd", kUnpack, "unzstd"},
    {"7z\xBC\xAF\x27\x1C"sv, "is a 7-Zip archive", kUnpack, "7z x"},
    {"PK\x03\x04"sv, "is a ZIP archive without a 3MF model (USDZ and KMZ files are such)",
     kConvertMesh, ""},
    {"DRACO"sv, "is a Draco file", "; convert it to PLY first, with ", "draco_decoder"},
    {"OCTM"sv, "is an OpenCTM file", kConvertMesh, ""},
    {"AC3D"sv, "is an AC3D file", kConvertMesh, ""},
    {"BLENDER"sv, "is a Blender scene", "; export it as GLB or PLY from Blender", ""},
    {"Kaydara FBX Binary"sv, "is an FBX file", kConvertMesh, ""},
    {"; FBX"sv, "is an FBX file", kConvertMesh, ""},
    {"ISO-10303-21"sv, "is a STEP file", kConvertSolid, ""},
    {"DBRep_DrawableShape"sv, "is an Open CASCADE BREP file", kConvertSolid, ""},
    {"#usda"sv, "is a USD file", kConvertMesh, ""},
    {"PXR-USDC"sv, "is a USD file", kConvertMesh, ""},
    {"#VRML"sv, "is a VRML file", kConvertMesh, ""},
    {"# vtk DataFile"sv, "is a VTK file", kConvertMesh, ""},
    {"<?xml"sv, "is an XML file (COLLADA and X3D files are)", kConvertMesh, ""},
    {"\x89PNG"sv, "is a PNG picture", kNoModel, ""},
    {"\xFF\xD8\xFF"sv, "is a JPEG picture", kNoModel, ""},
    {"GIF8"sv, "is a GIF picture", kNoModel, ""},
    {"%PDF"sv, "is a PDF document", kNoModel, ""},
    {"\xFF\xFE"sv, "is UTF-16 text; convert it first, with ", "iconv -f UTF-16 -t UTF-8", ""},
    {"\xFE\xFF"sv, "is UTF-16 text; convert it first, with ", "iconv -f UTF-16 -t UTF-8", ""},
}};

struct ForeignExtension {
  std::string_view extension;
  std::string_view what;
  std::string_view remedy;
};

constexpr std::array<ForeignExtension, 26> kForeignExtensions = {{
    {"3ds", "3DS", kConvertMesh},
    {"ac", "AC3D", kConvertMesh},
    {"amf", "AMF", kConvertMesh},
    {"blend", "Blender", kConvertMesh},
    {"brep", "BREP", kConvertSolid},
    {"ctm", "OpenCTM", kConvertMesh},
    {"dae", "COLLADA", kConvertMesh},
    {"drc", "Draco", "; convert it to PLY first, with draco_decoder"},
    {"dxf", "DXF", kConvertMesh},
    {"fbx", "FBX", kConvertMesh},
    {"iges", "IGES", kConvertSolid},
    {"igs", "IGES", kConvertSolid},
    {"las", "LAS", kConvertMesh},
    {"laz", "LAZ", kConvertMesh},
    {"lwo", "LightWave", kConvertMesh},
    {"max", "3ds Max", kConvertMesh},
    {"mesh", "Medit", kConvertMesh},
    {"msh", "Gmsh", kConvertMesh},
    {"skp", "SketchUp", kConvertMesh},
    {"step", "STEP", kConvertSolid},
    {"stp", "STEP", kConvertSolid},
    {"usd", "USD", kConvertMesh},
    {"usdz", "USDZ", kConvertMesh},
    {"vtk", "VTK", kConvertMesh},
    {"wrl", "VRML", kConvertMesh},
    {"x3d", "X3D", kConvertMesh},
}};

constexpr std::array<std::string_view, 11> kFormatNames = {
    "obj", "off", "ply", "stl", "gltf", "glb", "xyz", "pts", "pwn", "pcd", "3mf"};

std::string lower(std::string_view text) {
  std::string result(text);
  for (char& c : result) {
    c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  }
  return result;
}

std::string extension_of(std::string_view name) {
  const std::string_view file = name.substr(name.find_last_of('/') + 1);
  const std::size_t dot = file.find_last_of('.');
  return dot == std::string_view::npos ? "" : lower(file.substr(dot + 1));
}

bool starts_with(std::string_view bytes, std::string_view magic) {
  return bytes.substr(0, magic.size()) == magic;
}

std::optional<ModelFormat> format_of_extension(std::string_view extension) {
  const auto* const entry = std::find(kFormatNames.begin(), kFormatNames.end(), extension);
  return entry == kFormatNames.end()
             ? std::nullopt
             : std::optional(static_cast<ModelFormat>(entry - kFormatNames.begin()));
}

void reject_foreign_magic(std::string_view bytes, std::string_view name) {
  for (const ForeignMagic& foreign : kForeignMagics) {
    if (starts_with(bytes, foreign.magic)) {
      throw FormatError(
          name, "",
          std::string(foreign.what) + std::string(foreign.remedy) + std::string(foreign.tool));
    }
  }
}

[[noreturn]] void reject_extension(std::string_view name, const std::string& extension) {
  const auto* const entry =
      std::find_if(kForeignExtensions.begin(), kForeignExtensions.end(),
                   [&](const ForeignExtension& known) { return known.extension == extension; });
  if (entry != kForeignExtensions.end()) {
    throw FormatError(
        name, "", std::string(entry->what) + " files are not read" + std::string(entry->remedy));
  }
  throw FormatError(
      name, "",
      "cannot tell what format this is; OBJ, OFF, PLY, STL, glTF, GLB, 3MF, PCD, XYZ, "
      "PTS and PWN are read");
}

/// What the first bytes say for sure.
std::optional<ModelFormat> format_of_magic(std::string_view bytes) {
  if (starts_with(bytes, "glTF")) {
    return ModelFormat::Glb;
  }
  if (is_threemf(bytes)) {
    return ModelFormat::Threemf;
  }
  if (starts_with(bytes, "# .PCD")) {
    return ModelFormat::Pcd;
  }
  const std::string_view first_line = TextCursor(bytes).next_line().value_or("");
  if (trimmed(first_line) == "ply") {
    return ModelFormat::Ply;
  }
  if (has_off_header(bytes)) {
    return ModelFormat::Off;
  }
  return std::nullopt;
}

/// A guess from the content, for bytes without a telling name.
std::optional<ModelFormat> format_of_content(std::string_view bytes) {
  if (has_binary_stl_size(bytes)) {
    return ModelFormat::Stl;
  }
  TextCursor cursor(without_bom(bytes));
  const std::string_view word = cursor.next_token('#');
  if (lower(word.substr(0, 5)) == "solid") {
    return ModelFormat::Stl;
  }
  if (starts_with(word, "{")) {
    return ModelFormat::Gltf;
  }
  constexpr std::array<std::string_view, 8> kObjWords = {"v",      "vn", "vt", "g",
                                                         "mtllib", "o",  "s",  "usemtl"};
  if (std::find(kObjWords.begin(), kObjWords.end(), word) != kObjWords.end()) {
    return ModelFormat::Obj;
  }
  return std::nullopt;
}

}  // namespace

std::string_view format_name(ModelFormat format) {
  return kFormatNames[static_cast<std::size_t>(format)];
}

std::string model_name(std::string_view path) {
  const std::string_view file = path.substr(path.find_last_of('/') + 1);
  const std::size_t dot = file.find_last_of('.');
  return std::string(file.substr(0, dot == 0 ? std::string_view::npos : dot));
}

DetectedFormat detect_format(std::string_view bytes, std::string_view name) {
  if (bytes.empty()) {
    throw FormatError(name, "", "the file is empty");
  }
  const std::string extension = extension_of(name);
  const std::optional<ModelFormat> said = format_of_extension(extension);
  if (const std::optional<ModelFormat> found = format_of_magic(bytes)) {
    const bool contradicts = found != said && !extension.empty();
    return {*found, contradicts ? "the name says ." + extension + ", but the bytes are " +
                                      std::string(format_name(*found)) + " and were read as such"
                                : ""};
  }
  if (said == ModelFormat::Threemf) {
    if (!starts_with(bytes, "PK")) {
      throw FormatError(name, "byte 0", "expected the letters PK, which start every 3MF file");
    }
    return {*said, ""};
  }
  // A binary STL may start with any 80 bytes.
  if (!(said == ModelFormat::Stl && has_binary_stl_size(bytes))) {
    reject_foreign_magic(bytes, name);
  }
  if (said == ModelFormat::Glb) {
    throw FormatError(name, "byte 0", "expected the letters glTF, which start every GLB file");
  }
  if (said == ModelFormat::Ply) {
    throw FormatError(name, "line 1", "expected the word ply, which starts every PLY file");
  }
  if (said) {
    return {*said, ""};
  }
  if (const std::optional<ModelFormat> found = format_of_content(bytes);
      found && std::none_of(kForeignExtensions.begin(), kForeignExtensions.end(),
                            [&](const ForeignExtension& f) { return f.extension == extension; })) {
    const bool unusual = !extension.empty();
    return {*found, unusual ? "the name says ." + extension + ", but the bytes look like " +
                                  std::string(format_name(*found)) + " and were read as such"
                            : ""};
  }
  reject_extension(name, extension);
}

}  // namespace vantage
