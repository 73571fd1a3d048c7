// SPDX-License-Identifier: MIT
#include "batch/shard_merge.h"

#include <algorithm>
#include <filesystem>
#include <optional>

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

/// Takes records in, and from other folders the results that they stand for.
class Merge {
 public:
  Merge(ResultsStore& store, const ConfinedFolder& root, const RunContext& run)
      : store_(store), root_(root), run_(run) {}

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
      return;
    }
    const std::optional<ModelRecord> former =
        brings_results ? store_.find(record.key) : std::nullopt;
    if (former && supersedes(record, *former) && !have_one_answer(record, *former)) {
      save_shared_results(*former, record.folder);
    }
    if (store_.merge(record)) {
      ++counts_.taken;
      if (brings_results) {
        copy_results(record, *origin);
        if (former && !former->folder.empty() && former->folder != record.folder) {
          former_.push_back(former->folder);
        }
      }
    }
  }

  /// Removes the results of records that others have replaced, where they are nobody's now. \pre What was
  /// taken in is stored: a merge that ends before leaves no record without its results.
  void remove_former() const {
    for (const std::string& folder : former_) {
      if (store_.owner_of(folder).empty() && holds_results(root_, folder)) {
        root_.remove(model_folder(folder));
      }
    }
  }

  [[nodiscard]] MergeCounts& counts() { return counts_; }

 private:
  /// Results that others will replace stay those of the models that share them.
  void save_shared_results(const ModelRecord& former, const std::string& replaced) {
    if (const std::optional<ModelRecord> heir = heir_of(store_, root_, former)) {
      const auto is_claimed = [&](const std::string& folder) {
        return !store_.owner_of(folder).empty();
      };
      hand_over(store_, root_, *heir, former,
                former.folder == replaced ? free_folder(root_, former.folder, is_claimed)
                                          : former.folder);
    }
  }

  /// Takes in a record whose folder is there, as another model's: of equal models, that one's results stand
  /// for both.
  void take_beside(const ModelRecord& record, const std::string& owner) {
    const std::optional<ModelRecord> holder = store_.find(owner);
    if (!holder || holder->content != record.content || holder->options != record.options ||
        holder->version != record.version) {
      ++counts_.clashes;
      return;
    }
    ModelRecord equal = record;
    equal.folder.clear();
    equal.result.clear();
    equal.duplicate_of = owner;
    counts_.taken += store_.merge(equal) ? 1 : 0;
  }

  void copy_results(const ModelRecord& record, const ConfinedFolder& origin) {
    const std::string place = model_folder(record.folder);
    if (!origin.is_folder(place)) {
      ++counts_.missing;
      return;
    }
    const std::string staging = work_folder(kMergeCorner) + "/in";
    root_.remove(staging);
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
    root_.move(staging, place);
  }

  ResultsStore& store_;
  const ConfinedFolder& root_;
  const RunContext& run_;
  std::vector<std::string> former_{};  // folders of records that were replaced
  MergeCounts counts_{};
};

}  // namespace

MergeCounts merge_shards(const std::vector<std::string>& folders, ResultsStore& store,
                         const ConfinedFolder& root, const RunContext& run) {
  for (const std::string& folder : folders) {
    if (!fs::is_directory(folder)) {
      throw IoError(folder, "is not a folder of a batch");
    }
  }
  Merge merge(store, root, run);
  store.begin();
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
  store.commit();
  merge.remove_former();
  if (folders.size() > 1) {
    root.remove(work_folder(kMergeCorner));
  }
  return merge.counts();
}

}  // namespace vantage::batch
