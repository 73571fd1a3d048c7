// SPDX-License-Identifier: MIT
#include "io/obj_libraries.h"

#include "io/named_path.h"
#include "io/text_cursor.h"

namespace vantage {
namespace {

std::string folder_of(const std::string& path) {
  return path.substr(0, path.find_last_of('/') + 1);
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

std::vector<std::string> ObjLibraries::unread_paths() const {
  std::vector<std::string> paths;
  for (const auto& [path, is_read] : is_read_) {
    if (!is_read) {
      paths.push_back(path);
    }
  }
  return paths;
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

}  // namespace vantage
