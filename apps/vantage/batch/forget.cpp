// SPDX-License-Identifier: MIT
#include "batch/forget.h"

#include <filesystem>
#include <system_error>
#include <utility>
#include <vector>

#include "batch/result_folders.h"
#include "batch/result_heirs.h"

namespace vantage::batch {
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
  }
  for (const ModelRecord& other : others) {
    if (const std::optional<ModelRecord> heir = heir_of(store, root, other)) {
      hand_over(store, root, *heir, other, other.folder);
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
