// SPDX-License-Identifier: MIT
#include "batch/folder_owner.h"

#include <algorithm>
#include <filesystem>
#include <string_view>
#include <system_error>
#include <vector>

#include <fcntl.h>

#include "vantage/core/error.h"

#include "batch/confined_folder.h"
#include "batch/descriptor.h"
#include "batch/model_record.h"
#include "batch/results_store.h"
#include "batch/shard_log.h"

namespace vantage::batch {
namespace {

namespace fs = std::filesystem;

/// Names in a folder; none if it cannot be listed.
std::vector<std::string> names_in(const fs::path& folder) {
  std::vector<std::string> names;
  std::error_code error;
  for (fs::directory_iterator at(folder, error); !error && at != fs::directory_iterator();
       at.increment(error)) {
    names.push_back(at->path().filename().string());
  }
  return names;
}

/// Whether a file is empty, or begins as a database does. What is in it, the store itself looks at.
bool is_store(const ConfinedFolder& folder) {
  constexpr std::string_view kMagic = "SQLite format 3";
  const std::string name = ResultsStore::kFileName;
  std::error_code error;
  const bool empty = fs::is_regular_file(fs::symlink_status(folder.path_of(name), error)) &&
                     fs::file_size(folder.path_of(name), error) == 0;
  return empty || folder.beginning_of(name, kMagic.size()) == kMagic;
}

/// Whether a shard has written there; one that has only begun has an empty log.
bool holds_shards(const ConfinedFolder& folder) {
  constexpr std::size_t kLargestRecord = 1U << 20U;
  const std::string shards = kShardFolder;
  if (!folder.is_folder(shards)) {
    return false;
  }
  const std::vector<std::string> names = names_in(folder.path_of(shards));
  return std::any_of(names.begin(), names.end(), [&](const std::string& name) {
    const std::string path = shards + "/" + name;
    if (!is_shard_file(name) || Descriptor(folder.open_file(path, O_RDONLY)).number() < 0) {
      return false;
    }
    const std::string text = folder.beginning_of(path, kLargestRecord);
    return text.empty() || record_from_line(text.substr(0, text.find('\n')));
  });
}

/// Whether there is nothing but what a batch makes before its first record.
bool holds_beginnings_only(const ConfinedFolder& folder) {
  const std::vector<std::string> names = names_in(folder.path());
  return std::all_of(names.begin(), names.end(), [&](const std::string& name) {
    if (name == ".work") {
      const std::vector<std::string> work = names_in(folder.path_of(name));
      return folder.is_folder(name) &&
             std::all_of(work.begin(), work.end(), [](const std::string& corner) {
               return corner.starts_with("local") || corner.starts_with("shard-") ||
                      corner.starts_with("merge");
             });
    }
    return (name == kShardFolder || name == "slurm" || name == "models") &&
           folder.is_empty_folder(name);
  });
}

}  // namespace

void prepare_folder(const std::string& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error || !fs::is_directory(folder)) {
    throw IoError(folder, "cannot make this folder; choose another with -o", error.value());
  }
  const ConfinedFolder root(folder);
  if (!is_store(root) && !holds_shards(root) && !holds_beginnings_only(root)) {
    throw IoError(folder,
                  "holds files that are not results of a batch; choose another folder with -o");
  }
}

}  // namespace vantage::batch
