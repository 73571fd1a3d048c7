// SPDX-License-Identifier: MIT
#include "batch/shard_merge.h"

#include <algorithm>
#include <filesystem>
#include <optional>
#include <set>
#include <utility>

#include "vantage/core/error.h"

#include "batch/result_folders.h"
#include "batch/result_heirs.h"
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

/// Takes records in, and from other folders the results that they stand for. No folder of results is touched
/// before finish(): a merge that ends before has changed nothing.
class Merge {
 public:
  Merge(ResultsStore& store, const ConfinedFolder& root, const RunContext& run)
      : store_(store),
        root_(root),
        run_(run),
        heirs_(store, root,
               {.is_there = [this](const std::string& folder) { return is_there(folder); },
                .move =
                    [this](const std::string& from, const std::string& folder) {
                      moves_.emplace_back(from, folder);
                      coming_.insert(folder);
                    }}) {}

  /// \param origin folder that the record comes from; null: the one that receives them.
  void take(const ModelRecord& record, const ConfinedFolder* origin) {
    run_.check();
    if (!is_sound(record)) {  // a row of a store
      ++counts_.torn;
      return;
    }
    ++counts_.seen;
    const bool brings_results = origin != nullptr && !record.folder.empty();
    const std::string owner = brings_results ? store_.owner_of(record.folder) : std::string();
    if (!owner.empty() && owner != record.key) {
      take_beside(record, owner);
    } else if (brings_results) {
      take_with_results(record, *origin);
    } else if (origin != nullptr && !record.duplicate_of.empty()) {
      equals_.push_back(record);
    } else {
      put(record);
    }
  }

  /// Stores what was taken in, and puts results in place. Between the two no record names a folder that others
  /// come into: who is killed there leaves models without results, which the next merge or batch brings.
  void finish() {
    std::for_each(equals_.begin(), equals_.end(), [this](const auto& equal) { take_equal(equal); });
    std::vector<std::pair<std::string, std::string>> owners;
    for (const std::string& folder : coming_) {
      if (const std::string key = store_.owner_of(folder); !key.empty()) {
        owners.emplace_back(key, folder);
        set_folder(key, "");
      }
    }
    store_.commit();
    for (const auto& [from, folder] : moves_) {
      root_.move(from, model_folder(folder));
    }
    store_.begin();
    for (const auto& [key, folder] : owners) {
      set_folder(key, folder);
    }
    store_.commit();
    for (const std::string& folder : left_) {
      heirs_.remove_unowned(folder);
    }
  }

  [[nodiscard]] MergeCounts& counts() { return counts_; }

 private:
  [[nodiscard]] bool is_wanted(const ModelRecord& record) {
    const std::optional<ModelRecord> held = store_.find(record.key);
    return !held || supersedes(record, *held);
  }

  void put(const ModelRecord& record) {
    if (is_wanted(record)) {
      ++counts_.taken;
      if (std::string left = heirs_.replace(record); !left.empty()) {
        left_.push_back(std::move(left));
      }
    }
  }

  void take_with_results(const ModelRecord& record, const ConfinedFolder& origin) {
    if (!is_wanted(record)) {
      return;
    }
    if (origin.is_folder(model_folder(record.folder))) {
      heirs_.bring(copied_results(record, origin), record);
      put(record);
      return;
    }
    ++counts_.missing;
    if (!has_results(record.key)) {
      ModelRecord bare = record;  // what is in that folder here may be the answer to something else
      bare.folder.clear();
      put(bare);
    }
  }

  /// Takes in a record that has another's results, unless those did not come and it has some.
  void take_equal(const ModelRecord& record) {
    const std::optional<ModelRecord> owner = store_.find(record.duplicate_of);
    if ((owner && have_one_answer(*owner, record)) || !has_results(record.key)) {
      put(record);
    } else if (is_wanted(record)) {
      ++counts_.missing;
    }
  }

  [[nodiscard]] bool is_there(const std::string& folder) const {
    return coming_.contains(folder) || root_.is_folder(model_folder(folder));
  }

  /// Whether there are results of a model, or of the one whose results stand for it.
  [[nodiscard]] bool has_results(const std::string& key) {
    std::optional<ModelRecord> held = store_.find(key);
    if (held && !held->duplicate_of.empty()) {
      held = store_.find(held->duplicate_of);
    }
    return held && held->status == "done" && !held->folder.empty() && is_there(held->folder);
  }

  /// Takes in a record whose folder is there, as another model's: of equal models, that one's results stand
  /// for both.
  void take_beside(const ModelRecord& record, const std::string& owner) {
    const std::optional<ModelRecord> holder = store_.find(owner);
    if (!holder || !have_one_answer(*holder, record)) {
      ++counts_.clashes;
      return;
    }
    ModelRecord equal = record;
    equal.folder.clear();
    equal.result.clear();
    equal.duplicate_of = owner;
    put(equal);
  }

  /// \return name of the folder that holds the copy.
  std::string copied_results(const ModelRecord& record, const ConfinedFolder& origin) {
    const std::string place = model_folder(record.folder);
    std::string staging = work_folder(kMergeCorner) + "/in-" + std::to_string(moves_.size());
    root_.make_folders(staging);
    for (const fs::directory_entry& file : fs::directory_iterator(origin.path_of(place))) {
      if (file.symlink_status().type() != fs::file_type::regular) {
        continue;  // none of ours
      }
      const std::string name = "/" + file.path().filename().string();
      const std::optional<std::string> bytes = origin.content_of(place + name);
      if (!bytes) {
        throw IoError(origin.path_of(place + name), "cannot be read");
      }
      root_.write(staging + name, *bytes);
    }
    return staging;
  }

  void set_folder(const std::string& key, const std::string& folder) {
    ModelRecord record = *store_.find(key);
    record.folder = folder;
    store_.put(record);
  }

  ResultsStore& store_;
  const ConfinedFolder& root_;
  const RunContext& run_;
  ResultHeirs heirs_;
  std::vector<std::pair<std::string, std::string>> moves_{};  // of results to folders, in order
  std::set<std::string> coming_{};                            // those folders
  std::vector<ModelRecord> equals_{};  // of further folders; their results may come after them
  std::vector<std::string> left_{};    // folders of records that were replaced
  MergeCounts counts_{};
};

void take_all(const std::vector<std::string>& folders, Merge& merge) {
  for (const std::string& folder : folders) {
    std::optional<ConfinedFolder> other;
    if (!fs::equivalent(folder, folders.front())) {
      other.emplace(folder, kMergeCorner);
    }
    const auto take = [&](const ModelRecord& record) {
      merge.take(record, other ? &*other : nullptr);
    };
    for (const std::string& file : shard_files(folder)) {
      merge.counts().torn += read_shard_file(file, take);
    }
    if (other && fs::exists(fs::path(folder) / ResultsStore::kFileName)) {
      ResultsStore(folder, Database::Mode::Read).for_each_record(take);
    }
  }
}

}  // namespace

MergeCounts merge_shards(const std::vector<std::string>& folders, ResultsStore& store,
                         const ConfinedFolder& root, const RunContext& run) {
  for (const std::string& folder : folders) {
    if (!fs::is_directory(folder)) {
      throw IoError(folder, "is not a folder of a batch");
    }
  }
  root.remove(work_folder(kMergeCorner));  // a killed merge's
  Merge merge(store, root, run);
  store.begin();
  try {
    take_all(folders, merge);
    merge.finish();
  } catch (...) {
    root.remove(work_folder(kMergeCorner));
    throw;
  }
  root.remove(work_folder(kMergeCorner));
  return merge.counts();
}

}  // namespace vantage::batch
