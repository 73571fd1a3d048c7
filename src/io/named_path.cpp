// SPDX-License-Identifier: MIT
#include "io/named_path.h"

#include <algorithm>

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

std::optional<std::string> place_of_picture(const std::string& named, const SideFileSource& files) {
  // A path of the author's own disk: the picture has usually been put beside the model.
  const std::optional<std::string> path = inside_folder(named);
  return path && (!files || files(*path).bytes)
             ? path
             : inside_folder(named.substr(named.find_last_of('/') + 1));
}

}  // namespace vantage
