// SPDX-License-Identifier: MIT
#include "io/obj_libraries.h"

#include <algorithm>

#include "io/named_path.h"
#include "io/text_cursor.h"

namespace vantage {
namespace {

std::string folder_of(const std::string& path) {
  return path.substr(0, path.find_last_of('/') + 1);
}

/// What a name is if " #" begins a comment behind it.
std::string_view without_comment(std::string_view name) {
  return trimmed(name.substr(0, name.find(" #")));
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
    // One whose name has spaces, or else several, or else one beside the model whose name has spaces.
    const std::optional<std::string> whole = inside_folder(with_slashes(names));
    bool found = whole && read_once(*whole);
    std::string_view rest = found ? std::string_view() : std::string_view(names);
    for (std::string_view name = take_token(rest); !name.empty(); name = take_token(rest)) {
      found = read_library(name) || found;
    }
    if (!found && !read_library(names)) {
      missing_.push_back(names);
    }
  }
}

const MtlMaterial* ObjLibraries::find(std::string_view name) const {
  auto found = materials_.find(name);
  found = found == materials_.end() ? materials_.find(without_comment(name)) : found;
  return found == materials_.end() ? nullptr : &found->second;
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
  const std::vector<std::string> places = places_of_file(with_slashes(name));
  return std::any_of(places.begin(), places.end(),
                     [this](const std::string& path) { return read_once(path); });
}

bool ObjLibraries::read_once(const std::string& path) {
  const auto [known, is_new] = is_read_.try_emplace(path, false);
  if (is_new) {
    known->second = read_materials(path);
  }
  return known->second;
}

bool ObjLibraries::read_materials(const std::string& path) {
  const SideFile file = files_ ? files_(path) : SideFile{};
  if (!file.bytes) {
    return false;
  }
  paths_.push_back(path);
  const std::string folder = folder_of(path);
  for (auto& [material, look] : parse_mtl(*file.bytes)) {
    for (std::string* name : {&look.picture.name, &look.mask.name}) {
      *name = name->empty() ? "" : folder + with_slashes(*name);
    }
    materials_.try_emplace(material, look);
    materials_.try_emplace(std::string(without_comment(material)), look);
  }
  return true;
}

}  // namespace vantage
