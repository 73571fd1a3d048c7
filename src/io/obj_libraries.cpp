// SPDX-License-Identifier: MIT
#include "io/obj_libraries.h"

#include <algorithm>

#include "io/gltf_uri.h"
#include "io/text_cursor.h"

namespace vantage {
namespace {

/// Programs of Windows write backslashes.
std::string with_slashes(std::string_view name) {
  std::string path(name);
  std::replace(path.begin(), path.end(), '\\', '/');
  return path;
}

std::string folder_of(const std::string& path) {
  return path.substr(0, path.find_last_of('/') + 1);
}

/// A relative path as the file names it; nothing if it leaves the folder.
std::optional<std::string> inside_folder(const std::string& path) {
  // The rules are those of glTF; a percent sign is none of an OBJ's ways to write a character.
  std::string escaped;
  for (const char c : path) {
    escaped += c == '%' ? std::string("%25") : std::string(1, c);
  }
  return relative_path_of_uri(escaped);
}

}  // namespace

void ObjLibraries::add(std::string_view names) {
  names = without_quotes(names);
  if (!names.empty() && known_.emplace(names).second) {
    named_.emplace_back(names);
  }
}

void ObjLibraries::read() {
  for (const std::string& names : named_) {
    bool found = read_library(names);  // one whose name has spaces, or else several
    std::string_view rest = found ? std::string_view() : std::string_view(names);
    for (std::string_view name = take_token(rest); !name.empty(); name = take_token(rest)) {
      found = read_library(name) || found;
    }
    if (!found) {
      missing_.push_back(names);
    }
  }
}

bool ObjLibraries::read_library(std::string_view name) {
  const std::optional<std::string> path = inside_folder(with_slashes(name));
  if (!path || !files_) {
    return false;
  }
  const auto known = is_read_.find(*path);
  if (known != is_read_.end()) {
    return known->second;
  }
  const bool is_read = read_materials(*path);
  is_read_[*path] = is_read;
  return is_read;
}

bool ObjLibraries::read_materials(const std::string& path) {
  const SideFile file = files_(path);
  if (!file.bytes) {
    return false;
  }
  paths_.push_back(path);
  const std::string folder = folder_of(path);
  for (auto& [material, look] : parse_mtl(*file.bytes)) {
    look.picture = look.picture.empty() ? "" : folder + with_slashes(look.picture);
    look.mask = look.mask.empty() ? "" : folder + with_slashes(look.mask);
    materials_.try_emplace(material, look);
  }
  return true;
}

std::optional<std::string> ObjLibraries::place_of(const std::string& picture) const {
  // A path of the author's own disk: the picture has usually been put beside the model.
  const std::optional<std::string> path = inside_folder(picture);
  return path && (!files_ || files_(*path).bytes)
             ? path
             : inside_folder(picture.substr(picture.find_last_of('/') + 1));
}

}  // namespace vantage
