// SPDX-License-Identifier: MIT
#include "io/named_path.h"

#include <algorithm>
#include <utility>

#include "io/gltf_uri.h"

namespace vantage {

std::string with_slashes(std::string_view name) {
  std::string path(name);
  std::replace(path.begin(), path.end(), '\\', '/');
  return path;
}

std::optional<std::string> inside_folder(const std::string& path) {
  // The rules are those of glTF; a percent sign is none of these files' ways to write a character.
  std::string escaped;
  for (const char c : path) {
    escaped += c == '%' ? std::string("%25") : std::string(1, c);
  }
  return relative_path_of_uri(escaped);
}

std::vector<std::string> places_of_file(const std::string& named) {
  std::vector<std::string> places;
  for (const std::string& path : {named, named.substr(named.find_last_of('/') + 1)}) {
    std::optional<std::string> place = inside_folder(path);
    if (place && (places.empty() || places.front() != *place)) {
      places.push_back(std::move(*place));
    }
  }
  return places;
}

std::optional<std::string> place_of_picture(const std::string& named, const SideFileCheck& exists) {
  const std::vector<std::string> places = places_of_file(named);
  if (places.empty()) {
    return std::nullopt;
  }
  return !exists || exists(places.front()) ? places.front() : places.back();
}

}  // namespace vantage
