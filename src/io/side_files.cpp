// SPDX-License-Identifier: MIT
#include "io/side_files.h"

#include <algorithm>
#include <string>

#include "vantage/core/error.h"

#include "io/files.h"
#include "io/text_cursor.h"

namespace vantage {

namespace fs = std::filesystem;

namespace {

/// In folders of more entries no name is looked for. [ours]
constexpr int kMostNames = 10'000;

/// The place below a folder whose name differs from the one wanted in capitals alone, as those differ whose
/// author's disk makes no difference; the first by name. Empty if there is none.
fs::path spelled_otherwise(const fs::path& folder, const fs::path& relative) {
  fs::path place = folder;
  for (const fs::path& part : relative) {
    std::error_code error;
    if (part == "..") {
      return {};
    }
    if (fs::exists(place / part, error)) {
      place /= part;
      continue;
    }
    const std::string wanted = lower_case(part.string());
    std::string found;
    int names = 0;
    for (fs::directory_iterator entry(place, error), end;
         !error && entry != end && names <= kMostNames; entry.increment(error), ++names) {
      const std::string name = entry->path().filename().string();
      if (equals_ignoring_case(name, wanted) && (found.empty() || name < found)) {
        found = name;
      }
    }
    if (found.empty() || names > kMostNames) {
      return {};
    }
    place /= found;
  }
  return place;
}

}  // namespace

fs::path place_beside(const std::string& model_path, const std::string& relative,
                      std::error_code& error) {
  const fs::path folder = fs::canonical(fs::absolute(model_path).parent_path(), error);
  fs::path wanted = error ? fs::path() : fs::canonical(folder / relative, error);
  if (error && !folder.empty()) {
    const fs::path other = spelled_otherwise(folder, relative);
    wanted = other.empty() ? wanted : fs::canonical(other, error);
  }
  const fs::path inside = wanted.lexically_relative(folder);
  return inside.empty() || *inside.begin() == ".." ? fs::path() : wanted;
}

SideFile side_file(const std::string& model_path, const std::string& relative) {
  std::error_code error;
  const fs::path wanted = place_beside(model_path, relative, error);
  if (error) {
    return {std::nullopt, "cannot be opened"};
  }
  if (wanted.empty()) {
    return {std::nullopt, "lies outside the model's folder"};
  }
  try {
    return {read_file(wanted.string()), {}};
  } catch (const IoError&) {  // the model is sound without it
    return {std::nullopt, "cannot be read"};
  }
}

}  // namespace vantage
