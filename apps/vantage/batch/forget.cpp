// SPDX-License-Identifier: MIT
#include "batch/forget.h"

#include <algorithm>
#include <filesystem>
#include <system_error>
#include <utility>
#include <vector>

#include "batch/result_folders.h"

namespace vantage::batch {
namespace {

/// Gives the results of a model that is forgotten to the first of its equals that stay.
void hand_over(ResultsStore& store, const ModelRecord& former,
               const std::unordered_set<std::string>& listed) {
  std::vector<ModelRecord> heirs;
  for (ModelRecord& equal : store.find_equals(former)) {
    if (equal.duplicate_of == former.key && listed.contains(equal.key)) {
      heirs.push_back(std::move(equal));
    }
  }
  std::stable_sort(heirs.begin(), heirs.end(), [](const ModelRecord& a, const ModelRecord& b) {
    return a.position < b.position;
  });
  for (ModelRecord& heir : heirs) {
    const bool is_first = &heir == &heirs.front();
    heir.duplicate_of = is_first ? "" : heirs.front().key;
    if (is_first) {
      heir.folder = former.folder;
      heir.result = former.result;
      heir.timings = former.timings;
    }
    store.put(heir);
  }
}

}  // namespace

std::optional<Entry> ListedEntries::next() {
  std::optional<Entry> entry = all_->next();
  if (entry) {
    keys_.insert(entry->key);
    std::error_code error;
    const bool is_there = entry->problem.empty() && std::filesystem::exists(entry->path, error);
    if (!is_there && missing_.empty()) {
      missing_ = entry->key;
    }
  }
  return entry;
}

std::size_t forget_others(ResultsStore& store, const ConfinedFolder& root,
                          const std::unordered_set<std::string>& listed) {
  std::vector<ModelRecord> others;
  store.for_each_record([&](const ModelRecord& record) {
    if (!listed.contains(record.key)) {
      others.push_back(record);
    }
  });
  store.begin();
  for (const ModelRecord& other : others) {
    store.forget(other.key);
    if (other.duplicate_of.empty()) {
      hand_over(store, other, listed);
    }
  }
  store.commit();
  for (const ModelRecord& other : others) {
    if (!other.folder.empty() && store.owner_of(other.folder).empty() &&
        holds_results(root, other.folder)) {
      root.remove(model_folder(other.folder));
    }
  }
  return others.size();
}

}  // namespace vantage::batch
