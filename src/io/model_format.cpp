// SPDX-License-Identifier: MIT
#include "io/model_format.h"

#include <algorithm>
#include <array>

#include "vantage/core/error.h"

#include "io/amf.h"
#include "io/foreign_format.h"
#include "io/number_parsing.h"
#include "io/readers.h"
#include "io/stl_layout.h"
#include "io/text_cursor.h"
#include "io/threemf_package.h"

namespace vantage {
namespace {

constexpr std::array<std::string_view, 13> kFormatNames = {"obj", "off", "ply",     "stl", "gltf",
                                                           "glb", "xyz", "pts",     "pwn", "pcd",
                                                           "3mf", "amf", "imported"};

std::optional<ModelFormat> format_of_extension(std::string_view extension) {
  const auto endings = model_endings();
  const auto entry = std::find(endings.begin(), endings.end(), extension);
  return entry == endings.end() ? std::nullopt
                                : std::optional(static_cast<ModelFormat>(entry - endings.begin()));
}

/// What the first bytes say for sure.
std::optional<ModelFormat> format_of_magic(std::string_view bytes) {
  if (bytes.starts_with("glTF")) {
    return ModelFormat::Glb;
  }
  if (is_threemf(bytes)) {
    return ModelFormat::Threemf;
  }
  if (is_amf(bytes)) {
    return ModelFormat::Amf;
  }
  if (without_bom(bytes).starts_with("# .PCD")) {
    return ModelFormat::Pcd;
  }
  const std::string_view first_line = TextCursor(without_bom(bytes)).next_line().value_or("");
  if (trimmed(first_line) == "ply") {
    return ModelFormat::Ply;
  }
  if (has_off_header(bytes)) {
    return ModelFormat::Off;
  }
  return std::nullopt;
}

/// What the content looks like, for bytes whose name does not tell or is wrong.
std::optional<ModelFormat> format_of_content(std::string_view bytes) {
  if (has_binary_stl_size(bytes)) {
    return ModelFormat::Stl;
  }
  TextCursor cursor(without_bom(bytes));
  const std::string_view word = cursor.next_token('#');
  if (lower_case(word.substr(0, 5)) == "solid") {
    return ModelFormat::Stl;
  }
  if (word.starts_with("{")) {
    return ModelFormat::Gltf;
  }
  constexpr std::array<std::string_view, 8> kObjWords = {"v",      "vn", "vt", "g",
                                                         "mtllib", "o",  "s",  "usemtl"};
  if (std::find(kObjWords.begin(), kObjWords.end(), word) != kObjWords.end()) {
    return ModelFormat::Obj;
  }
  return std::nullopt;
}

/// Whether it is named as STL and not plain text: a binary STL that is cut short starts with any bytes.
bool may_be_stl(std::string_view bytes, ModelFormat said) {
  constexpr std::size_t kLook = 512;
  return said == ModelFormat::Stl && bytes.substr(0, kLook).find('\0') != std::string_view::npos;
}

/// Whether the bytes are a ZIP archive or XML in UTF-16, which alone do not tell the format that the name says.
bool is_packed_or_wide(ModelFormat said, std::string_view bytes) {
  const bool is_amf = said == ModelFormat::Amf;
  return ((is_amf || said == ModelFormat::Threemf) && bytes.starts_with("PK")) ||
         (is_amf && (bytes.starts_with("\xFF\xFE") || bytes.starts_with("\xFE\xFF")));
}

}  // namespace

std::span<const std::string_view> model_endings() {
  return std::span(kFormatNames).first(kFormatNames.size() - 1);  // no file is called .imported
}

std::string extension_of(std::string_view name) {
  const std::string_view file = name.substr(name.find_last_of('/') + 1);
  const std::size_t dot = file.find_last_of('.');
  return dot == std::string_view::npos ? "" : lower_case(file.substr(dot + 1));
}

std::string_view format_name(ModelFormat format) {
  return kFormatNames[static_cast<std::size_t>(format)];
}

std::string model_name(std::string_view path) {
  const std::string_view file = path.substr(path.find_last_of('/') + 1);
  const std::size_t dot = file.find_last_of('.');
  return std::string(file.substr(0, dot == 0 ? std::string_view::npos : dot));
}

std::string_view format_name(const Model& model) {
  return model.format == ModelFormat::Imported ? std::string_view(model.imported_as)
                                               : format_name(model.format);
}

DetectedFormat detect_format(std::string_view bytes, std::string_view name, bool may_import) {
  if (bytes.empty()) {
    throw FormatError(name, "", "the file is empty");
  }
  const std::string extension = extension_of(name);
  const std::optional<ModelFormat> said = format_of_extension(extension);
  // A binary STL may start with any 80 bytes, also with those that start other formats.
  if (said == ModelFormat::Stl && has_binary_stl_size(bytes)) {
    return {*said, ""};
  }
  if (const std::optional<ModelFormat> found = format_of_magic(bytes)) {
    const bool contradicts = found != said && !extension.empty();
    return {*found, contradicts ? "the name says ." + extension + ", but the bytes are " +
                                      std::string(format_name(*found)) + " and were read as such"
                                : ""};
  }
  if (said && is_packed_or_wide(*said, bytes)) {
    return {*said, ""};
  }
  if (const ImportFormat* const found = check_foreign_bytes(bytes, extension, name, may_import)) {
    const ImportFormat* const named = import_format(extension);
    const bool contradicts = said || (named != nullptr && named->name != found->name);
    return {ModelFormat::Imported,
            contradicts ? "the name says ." + extension + ", but the bytes are " +
                              std::string(found->title) + " and were read as such"
                        : "",
            found};
  }
  if (const std::optional<ModelFormat> found = format_of_content(bytes);
      found && found != said &&
      (said ? !may_be_stl(bytes, *said) : !is_foreign_extension(extension))) {
    const bool is_named = !extension.empty();
    return {*found, is_named ? "the name says ." + extension + ", but the bytes look like " +
                                   std::string(format_name(*found)) + " and were read as such"
                             : ""};
  }
  if (said == ModelFormat::Threemf) {
    throw FormatError(name, "byte 0", "expected the letters PK, which start every 3MF file");
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
  return {ModelFormat::Imported, "", &check_foreign_extension(extension, name, may_import)};
}

}  // namespace vantage
