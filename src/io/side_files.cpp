// SPDX-License-Identifier: MIT
#include "io/side_files.h"

#include <algorithm>
#include <map>
#include <string>

#include "vantage/core/error.h"

#include "io/files.h"
#include "io/text_cursor.h"

namespace vantage {

namespace fs = std::filesystem;

namespace {

/// In folders of more entries no name is looked for. [ours]
constexpr std::size_t kMostNames = 10'000;

/// The place below a folder whose name differs from the one wanted in capitals alone, as those differ whose
/// author's disk makes no difference. Empty if there is none.
fs::path spelled_otherwise(const fs::path& folder, const fs::path& relative, FolderNames& names) {
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
    const std::string found = names.spelled_otherwise(place, part.string());
    if (found.empty()) {
      return {};
    }
    place /= found;
  }
  return place;
}

}  // namespace

FolderNames::Names FolderNames::listed(const fs::path& folder) {
  Names names;
  std::size_t count = 0;
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error)) {
    if (++count > kMostNames) {
      return {};
    }
    const std::string name = entry->path().filename().string();
    std::string& first = names[lower_case(name)];
    first = first.empty() ? name : std::min(first, name);
  }
  return names;
}

std::string FolderNames::spelled_otherwise(const fs::path& folder, std::string_view name) {
  auto known = names_.find(folder);
  if (known == names_.end()) {
    known = names_.emplace(folder, listed(folder)).first;
  }
  const auto found = known->second.find(lower_case(name));
  return found == known->second.end() ? std::string() : found->second;
}

fs::path place_beside(const std::string& model_path, const std::string& relative,
                      FolderNames& names, std::error_code& error) {
  const fs::path folder = fs::canonical(fs::absolute(model_path).parent_path(), error);
  fs::path wanted = error ? fs::path() : fs::canonical(folder / relative, error);
  if (error && !folder.empty()) {
    const fs::path other = spelled_otherwise(folder, relative, names);
    wanted = other.empty() ? wanted : fs::canonical(other, error);
  }
  const fs::path inside = wanted.lexically_relative(folder);
  return inside.empty() || *inside.begin() == ".." ? fs::path() : wanted;
}

SideFileCheck side_file_check(const std::string& model_path, FolderNames& names) {
  return [&, known = std::map<std::string, bool>()](const std::string& relative) mutable {
    const auto [place, is_new] = known.try_emplace(relative, false);
    if (is_new) {
      std::error_code error;
      const fs::path path = place_beside(model_path, relative, names, error);
      place->second = !error && !path.empty() && fs::is_regular_file(path, error);
    }
    return place->second;
  };
}

SideFile side_file(const std::string& model_path, const std::string& relative, FolderNames& names) {
  std::error_code error;
  const fs::path wanted = place_beside(model_path, relative, names, error);
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
