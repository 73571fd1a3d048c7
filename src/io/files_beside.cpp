// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <set>
#include <system_error>
#include <utility>

#include <nlohmann/json.hpp>

#include "vantage/core/error.h"
#include "vantage/io/model.h"

#include "io/byte_cursor.h"
#include "io/gltf_uri.h"
#include "io/model_format.h"
#include "io/named_path.h"
#include "io/obj_libraries.h"
#include "io/obj_lines.h"
#include "io/ply_header.h"
#include "io/side_files.h"
#include "io/text_cursor.h"

namespace vantage {
namespace {

constexpr std::size_t kMostLibraries = 64U << 20U;  // [ours] of all lines with libraries
constexpr std::size_t kMostJson =
    1U << 30U;  // [ours] of a glTF, so that a batch ends on no file's size
// A GLB begins with 12 bytes of its own and 8 of the chunk that is its JSON, the first four its length.
constexpr std::size_t kGlbHeaders = 20;
constexpr std::size_t kGlbLength = 12;
constexpr std::size_t kMostHeader = 1U << 20U;     // [ours] of a PLY
constexpr std::size_t kDetectedBytes = 1U << 20U;  // [ours] of a model, which say what it is
constexpr std::string_view kLibrary = "mtllib";

/// Whether a line may yet turn out to name a library.
bool may_name_library(std::string_view line) {
  const std::string_view word = take_token(line);
  return line.empty() ? kLibrary.starts_with(word) : word == kLibrary;
}

/// Paths that the reader would ask for, in the order of the text.
std::vector<std::string> names_in_gltf(std::string_view text) {
  using nlohmann::json;
  const auto is_list = [](int depth, json::parse_event_t event, const json& key) {
    return depth > 1 || event != json::parse_event_t::key || key == "buffers" || key == "images";
  };
  std::vector<std::string> names;
  const auto gltf = json::parse(text, is_list, false);
  for (const char* const list : {"buffers", "images"}) {
    if (!gltf.is_object() || !gltf.contains(list) || !gltf[list].is_array()) {
      continue;
    }
    for (const auto& file : gltf[list]) {
      if (!file.is_object() || !file.contains("uri") || !file["uri"].is_string()) {
        continue;
      }
      if (auto name = relative_path_of_uri(file["uri"].get_ref<const std::string&>())) {
        names.push_back(std::move(*name));
      }
    }
  }
  return names;
}

/// Adds the place where a picture is, after those where it would be read instead if it were there.
void add_places(std::vector<std::string>& names, const std::string& picture,
                const SideFileCheck& exists) {
  for (std::string& place : places_of_file(picture)) {
    names.push_back(std::move(place));
    if (exists(names.back())) {
      return;
    }
  }
}

std::vector<std::string> names_in_obj(const std::string& text, const SideFileSource& files,
                                      const SideFileCheck& exists) {
  ObjLibraries libraries(files, exists);
  ObjLines lines(text);
  while (std::optional<std::string_view> line = lines.next()) {
    if (take_token(*line) == kLibrary) {
      libraries.add(trimmed(*line));
    }
  }
  libraries.read();
  std::vector<std::string> names = libraries.paths();
  for (const auto& [material, look] : libraries.materials()) {
    for (const std::string& picture : {look.picture.name, look.mask.name}) {
      if (!picture.empty()) {
        add_places(names, picture, exists);
      }
    }
  }
  const std::vector<std::string> unread = libraries.unread_paths();
  names.insert(names.end(), unread.begin(), unread.end());
  return names;
}

std::vector<std::string> names_in_ply(const std::string& text, const std::string& model_path,
                                      const SideFileCheck& exists) {
  std::vector<std::string> names;
  const RunContext run;
  try {
    const ModelBuilder builder(ModelFormat::Ply, model_path, run, 0);
    for (const std::string& texture : read_ply_header(without_bom(text), builder).textures) {
      add_places(names, with_slashes(texture), exists);
    }
  } catch (const FormatError&) {  // no model either
  }
  return names;
}

}  // namespace

FilesBeside::FilesBeside(std::string model_path) : model_path_(std::move(model_path)) {}

void FilesBeside::pass(std::string_view bytes) {
  if (is_told_) {
    keep(bytes);
    return;
  }
  begin_.append(bytes);
  if (begin_.size() >= kDetectedBytes) {
    tell_format();
  }
}

void FilesBeside::tell_format() {
  if (std::exchange(is_told_, true)) {
    return;
  }
  try {
    const DetectedFormat detected = detect_format(begin_, model_path_, /*may_import=*/true);
    format_ = detected.format;
    import_as_ = detected.import_as;
  } catch (const FormatError&) {  // no model either
  }
  keep(std::exchange(begin_, {}));
}

void FilesBeside::keep(std::string_view bytes) {
  if (format_ == ModelFormat::Gltf) {
    text_.append(bytes.substr(0, kMostJson - std::min(text_.size(), kMostJson)));
  } else if (format_ == ModelFormat::Glb) {
    keep_json_of_glb(bytes);
  } else if (format_ == ModelFormat::Ply) {
    text_.append(bytes.substr(0, kMostHeader - std::min(text_.size(), kMostHeader)));
  } else if (format_ == ModelFormat::Obj) {
    keep_libraries(bytes);
  }
}

const ImportFormat* FilesBeside::import_as() {
  tell_format();
  return import_as_;
}

void FilesBeside::keep_json_of_glb(std::string_view bytes) {
  const auto keep_up_to = [&](std::size_t size) {
    const std::size_t count = std::min(bytes.size(), size - std::min(size, text_.size()));
    text_.append(bytes.substr(0, count));
    bytes.remove_prefix(count);
  };
  keep_up_to(kGlbHeaders);
  if (text_.size() >= kGlbHeaders) {
    const auto length = decode<std::uint32_t>(text_.data() + kGlbLength, ByteOrder::Little);
    keep_up_to(kGlbHeaders + std::min<std::size_t>(length, kMostJson));
  }
}

void FilesBeside::keep_libraries(std::string_view bytes) {
  while (!bytes.empty() && text_.size() < kMostLibraries) {
    const auto end = static_cast<std::size_t>(
        std::find_if(bytes.begin(), bytes.end(), is_line_end) - bytes.begin());
    if (!skips_) {
      line_.append(bytes.substr(0, end));
      skips_ = !goes_on_ && !may_name_library(without_bom(line_));
    }
    if (end == bytes.size()) {
      return;
    }
    const bool is_second_half = line_.empty() && !skips_ && bytes[end] == '\n';  // of \r\n
    if (!skips_ && !is_second_half) {
      goes_on_ = goes_on(line_);
      text_.append(line_).append("\n");
    }
    line_.clear();
    skips_ = false;
    bytes.remove_prefix(end + 1);
  }
}

std::vector<FileBeside> FilesBeside::find() {
  tell_format();
  FolderNames folders;
  const SideFileSource files = [&](const std::string& relative) {
    return side_file(model_path_, relative, folders);
  };
  const SideFileCheck exists = side_file_check(model_path_, folders);
  std::vector<std::string> names;
  if (format_ == ModelFormat::Gltf || format_ == ModelFormat::Glb) {
    const std::size_t begin = format_ == ModelFormat::Glb ? kGlbHeaders : 0;
    names = names_in_gltf(std::string_view(text_).substr(std::min(begin, text_.size())));
  } else if (format_ == ModelFormat::Obj) {
    names = names_in_obj(text_ + line_, files, exists);
  } else if (format_ == ModelFormat::Ply) {
    names = names_in_ply(text_, model_path_, exists);
  }
  for (const std::string& picture : pictures_) {
    add_places(names, picture, exists);
  }
  std::vector<FileBeside> found;
  std::set<std::string> known;
  for (const std::string& name : names) {
    if (!known.insert(name).second) {
      continue;
    }
    std::error_code error;
    const std::string path = place_beside(model_path_, name, folders, error).string();
    if (error || !path.empty()) {  // else it lies outside
      found.push_back({name, error ? "" : path});
    }
  }
  return found;
}

}  // namespace vantage
