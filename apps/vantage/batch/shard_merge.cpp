// SPDX-License-Identifier: MIT
#include "batch/shard_merge.h"

#include <algorithm>
#include <filesystem>

#include "batch/shard_log.h"

namespace vantage::batch {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> shard_files(const std::string& folder) {
  std::vector<std::string> files;
  std::error_code error;
  for (const auto& file : fs::directory_iterator(shard_folder(folder), error)) {
    const std::string name = file.path().filename().string();
    // A log holds what a shard that runs, or was killed, has not yet put into its file.
    if (name.starts_with("shard-") && (name.ends_with(".jsonl") || name.ends_with(".jsonl.log"))) {
      files.push_back(file.path().string());
    }
  }
  std::sort(files.begin(), files.end());
  return files;
}

}  // namespace

MergeCounts merge_shards(const std::vector<std::string>& folders, ResultsStore& store,
                         const RunContext& run) {
  MergeCounts counts;
  const auto take = [&](const ModelRecord& record) {
    run.check();
    ++counts.seen;
    counts.taken += store.merge(record) ? 1 : 0;
  };
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
