// SPDX-License-Identifier: MIT
#include "io/foreign_format.h"

#include <algorithm>
#include <array>
#include <string>

#include "vantage/core/error.h"
#include "vantage/io/import_stream.h"

#include "io/byte_cursor.h"
#include "io/text_cursor.h"

namespace vantage {
namespace {

constexpr std::string_view kUnpack = "; unpack it first, with ";
constexpr std::string_view kConvertMesh =
    "; convert it to OBJ, PLY or GLB first, for example with meshlab or Blender";
constexpr std::string_view kConvertSolid =
    "; convert it to STL or OBJ first, for example with FreeCAD or gmsh";
constexpr std::string_view kXml = "<?xml";
constexpr std::string_view kNoModel = ", not a model";

/// How a format that is not read gives itself away, and what to do about it.
struct ForeignMagic {
  std::string_view magic;
  std::string_view what;
  std::string_view remedy;
  std::string_view tool;
  std::string_view extension{};  ///< Extension of the format in kImportFormats, if it is there.
};

using namespace std::string_view_literals;

constexpr std::array<ForeignMagic, 36> kForeignMagics = {{
    {"\x1F\x8B"sv, "is compressed with gzip", kUnpack, "gunzip"},
    {"BZh"sv, "is compressed with bzip2", kUnpack, "bunzip2"},
    {"\xFD"
     "7zXZ"sv,
     "is compressed with xz", kUnpack, "unxz"},
    {"\x28\xB5\x2F\xFD"sv, "is compressed with zstd", kUnpack, "unzstd"},
    {"7z\xBC\xAF\x27\x1C"sv, "is a 7-Zip archive", kUnpack, "7z x"},
    {"PK\x03\x04"sv, "is a ZIP archive without a 3MF model (USDZ and KMZ files are such)", kUnpack,
     "unzip, or give archives of models to vantage batch"},
    {"DRACO"sv, "is a Draco file", "; convert it to PLY first, with ", "draco_decoder"},
    {"OCTM"sv, "is an OpenCTM file", kConvertMesh, ""},
    {"AC3D"sv, "is an AC3D file", kConvertMesh, "", "ac"},
    {"BLENDER"sv, "is a Blender scene", "; export it as GLB or PLY from Blender", "", "blend"},
    {"Kaydara FBX Binary"sv, "is an FBX file", kConvertMesh, "", "fbx"},
    {"; FBX"sv, "is an FBX file", kConvertMesh, "", "fbx"},
    {"ISO-10303-21"sv, "is a STEP file", kConvertSolid, "", "step"},
    {"DBRep_DrawableShape"sv, "is an Open CASCADE BREP file", kConvertSolid, "", "brep"},
    {"CASCADE Topology"sv, "is an Open CASCADE BREP file", kConvertSolid, "", "brep"},
    {"xof "sv, "is a DirectX X file", kConvertMesh, "", "x"},
    {"MS3D000000"sv, "is a MilkShape file", kConvertMesh, "", "ms3d"},
    {"IDP2"sv, "is a Quake II model", kConvertMesh, "", "md2"},
    {"IDP3"sv, "is a Quake III model", kConvertMesh, "", "md3"},
    {"MD5Version"sv, "is a Doom 3 model", kConvertMesh, "", "md5mesh"},
    {"BB3D"sv, "is a Blitz3D file", kConvertMesh, "", "b3d"},
    {"Caligari"sv, "is a trueSpace file", kConvertMesh, "", "cob"},
    {"INTERQUAKEMODEL"sv, "is an Inter-Quake model", kConvertMesh, "", "iqm"},
    {"*3DSMAX_ASCIIEXPORT"sv, "is a 3ds Max ASCII file", kConvertMesh, "", "ase"},
    {"#usda"sv, "is a USD file", kConvertMesh, ""},
    {"PXR-USDC"sv, "is a USD file", kConvertMesh, ""},
    {"#VRML"sv, "is a VRML file", kConvertMesh, ""},
    {"# vtk DataFile"sv, "is a VTK file", kConvertMesh, ""},
    {kXml, "is an XML file (COLLADA and X3D files are)", kConvertMesh, ""},
    {"\x89PNG"sv, "is a PNG picture", kNoModel, ""},
    {"\xFF\xD8\xFF"sv, "is a JPEG picture", kNoModel, ""},
    {"GIF8"sv, "is a GIF picture", kNoModel, ""},
    {"%PDF"sv, "is a PDF document", kNoModel, ""},
    {"version https://git-lfs"sv, "is a Git LFS pointer in place of the file", "; fetch it, with ",
     "git lfs pull"},
    {"\xFF\xFE"sv, "is UTF-16 text; convert it first, with ", "iconv -f UTF-16 -t UTF-8", ""},
    {"\xFE\xFF"sv, "is UTF-16 text; convert it first, with ", "iconv -f UTF-16 -t UTF-8", ""},
}};

/// Those of kImportFormats are known by it too.
struct ForeignExtension {
  std::string_view extension;
  std::string_view what;
  std::string_view remedy;
};

constexpr std::array<ForeignExtension, 12> kForeignExtensions = {{
    {"ctm", "OpenCTM", kConvertMesh},
    {"drc", "Draco", "; convert it to PLY first, with draco_decoder"},
    {"las", "LAS", kConvertMesh},
    {"laz", "LAZ", kConvertMesh},
    {"max", "3ds Max", kConvertMesh},
    {"mesh", "Medit", kConvertMesh},
    {"msh", "Gmsh", kConvertMesh},
    {"skp", "SketchUp", kConvertMesh},
    {"usd", "USD", kConvertMesh},
    {"usdz", "USDZ", kConvertMesh},
    {"vtk", "VTK", kConvertMesh},
    {"wrl", "VRML", kConvertMesh},
}};

/// How much of a file says which of several formats with one beginning it is.
constexpr std::size_t kTellingBytes = 8192;

bool says(std::string_view bytes, std::string_view word) {
  return bytes.substr(0, kTellingBytes).find(word) != std::string_view::npos;
}

/// What a server sends in place of a file that it does not have, or that wants a login.
bool is_web_page(std::string_view bytes) {
  constexpr std::array<std::string_view, 2> kStarts{"<!doctype html", "<html"};
  const std::string_view text = without_bom(bytes).substr(0, kTellingBytes);
  const std::size_t first = std::min(text.find_first_not_of(" \t\r\n"), text.size());
  return std::any_of(kStarts.begin(), kStarts.end(), [&](std::string_view start) {
    return equals_ignoring_case(text.substr(first, start.size()), start);
  });
}

/// 3DS: a chunk that holds all others (its mark, its size), and the first of these.
bool is_3ds(std::string_view bytes) {
  constexpr std::size_t kHead = 6;
  if (!bytes.starts_with("MM") || bytes.size() < 2 * kHead) {
    return false;
  }
  const auto size = decode<std::uint32_t>(bytes.data() + 2, ByteOrder::Little);
  const auto first = decode<std::uint16_t>(bytes.data() + kHead, ByteOrder::Little);
  constexpr std::uint16_t kVersion = 0x0002;
  constexpr std::uint16_t kScene = 0x3D3D;
  return size >= 2 * kHead && size <= bytes.size() && (first == kVersion || first == kScene);
}

/// What XML files are, by the names of their first elements.
const ImportFormat* import_of_xml(std::string_view bytes, std::string_view extension) {
  const bool known = import_format(extension) != nullptr;
  return says(bytes, "<COLLADA") ? import_format("dae")
         : says(bytes, "<X3D")   ? import_format("x3d")
         : says(bytes, "<WORLD") ? import_format("xgl")
         : known                 ? import_format(extension)
                                 : nullptr;
}

const ImportFormat* import_of(const ForeignMagic& foreign, std::string_view bytes,
                              std::string_view extension) {
  if (foreign.magic == kXml) {
    return import_of_xml(bytes, extension);
  }
  // Some formats may be packed whole, and their readers take text of either width.
  const ImportFormat* const named = import_format(extension);
  if (named != nullptr &&
      ((foreign.magic == "\x1F\x8B" && (named->name == "blend" || named->name == "xgl")) ||
       foreign.magic == "\xFF\xFE" || foreign.magic == "\xFE\xFF")) {
    return named;
  }
  if (foreign.magic == "ISO-10303-21" && (says(bytes, "'IFC") || says(bytes, "( 'IFC"))) {
    return import_format("ifc");
  }
  return foreign.extension.empty() ? nullptr : import_format(foreign.extension);
}

}  // namespace

bool is_foreign_extension(std::string_view extension) {
  return import_format(extension) != nullptr ||
         std::any_of(kForeignExtensions.begin(), kForeignExtensions.end(),
                     [&](const ForeignExtension& f) { return f.extension == extension; });
}

const ImportFormat* check_foreign_bytes(std::string_view bytes, std::string_view extension,
                                        std::string_view name, bool may_import) {
  for (const ForeignMagic& foreign : kForeignMagics) {
    if (bytes.substr(0, foreign.magic.size()) != foreign.magic) {
      continue;
    }
    const ImportFormat* const format = import_of(foreign, bytes, extension);
    if (format != nullptr && may_import) {
      return format;
    }
    if (foreign.magic == kXml && says(bytes, "schemas.microsoft.com/3dmanufacturing/core")) {
      throw FormatError(name, "",
                        "is the model part of a 3MF without its package; export it as 3MF again, "
                        "or pack it: as 3D/3dmodel.model in a ZIP archive that is named .3mf");
    }
    throw FormatError(
        name, "",
        std::string(foreign.what) + std::string(foreign.remedy) + std::string(foreign.tool));
  }
  if (is_web_page(bytes)) {
    throw FormatError(name, "",
                      "is a web page" + std::string(kNoModel) + "; download the file anew");
  }
  // Eighty columns a line, of which the seventy-third names the section: S is the first.
  constexpr std::size_t kIgesSection = 72;
  const bool iges =
      bytes.size() > kIgesSection + 8 && bytes[kIgesSection] == 'S' &&
      bytes.substr(kIgesSection + 1, 7).find_first_not_of(" 01") == std::string_view::npos;
  const std::string_view kind = iges ? "iges" : is_3ds(bytes) ? "3ds" : "";
  return may_import ? import_format(kind) : nullptr;
}

const ImportFormat& check_foreign_extension(std::string_view extension, std::string_view name,
                                            bool may_import) {
  const ImportFormat* const format = import_format(extension);
  if (format != nullptr && may_import) {
    return *format;
  }
  const auto* const entry =
      std::find_if(kForeignExtensions.begin(), kForeignExtensions.end(),
                   [&](const ForeignExtension& known) { return known.extension == extension; });
  if (entry != kForeignExtensions.end()) {
    throw FormatError(
        name, "", std::string(entry->what) + " files are not read" + std::string(entry->remedy));
  }
  if (format != nullptr) {
    throw FormatError(
        name, "",
        std::string(format->title) + " files are not read; " + std::string(import_advice(*format)));
  }
  throw FormatError(
      name, "",
      "cannot tell what format this is; OBJ, OFF, PLY, STL, glTF, GLB, 3MF, AMF, PCD, XYZ, "
      "PTS and PWN are read, and others by the ending of the file's name: save it with that");
}

}  // namespace vantage
