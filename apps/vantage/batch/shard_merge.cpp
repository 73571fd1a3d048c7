// SPDX-License-Identifier: MIT
#include "batch/shard_merge.h"

#include <algorithm>
#include <filesystem>

#include "vantage/core/error.h"

#include "batch/shard_log.h"

namespace vantage::batch {
namespace {

namespace fs = std::filesystem;

/// The logs come first: a shard that runs may put its log into its file meanwhile, and what is read twice
/// counts once.
std::vector<std::string> shard_files(const std::string& folder) {
  std::vector<std::string> files;
  std::error_code error;
  const fs::path shards = fs::path(folder) / kShardFolder;
  fs::directory_iterator file(shards, error);
  for (; !error && file != fs::directory_iterator(); file.increment(error)) {
    // A log holds what a shard that runs, or was killed, has not yet put into its file.
    if (is_shard_file(file->path().filename().string())) {
      files.push_back(file->path().string());
    }
  }
  if (error && error != std::errc::no_such_file_or_directory) {
    throw IoError(shards.string(), "cannot be listed", error.value());
  }
  std::sort(files.begin(), files.end());
  std::stable_partition(files.begin(), files.end(), [](const std::string& name) {
    return fs::path(name).extension() == ".log";
  });
  return files;
}

}  // namespace

MergeCounts merge_shards(const std::vector<std::string>& folders, ResultsStore& store,
                         const RunContext& run) {
  MergeCounts counts;
  const auto take = [&](const ModelRecord& record) {
    run.check();
    if (!is_sound(record)) {  // a row of a store
      ++counts.torn;
      return;
    }
    ++counts.seen;
    counts.taken += store.merge(record) ? 1 : 0;
  };
  for (const std::string& folder : folders) {
    if (!fs::is_directory(folder)) {
      throw IoError(folder, "is not a folder of a batch");
    }
  }
  store.begin();
  for (const std::string& folder : folders) {
    for (const std::string& file : shard_files(folder)) {
      counts.torn += read_shard_file(file, take);
    }
    if (folder != folders.front() && fs::exists(fs::path(folder) / ResultsStore::kFileName)) {
      ResultsStore(folder, Database::Mode::Read).for_each_record(take);
    }
  }
  store.commit();
  return counts;
}

}  // namespace vantage::batch
