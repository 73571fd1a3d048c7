// SPDX-License-Identifier: MIT
#include "batch/forget.h"

#include <filesystem>
#include <system_error>
#include <utility>
#include <vector>

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
  ResultHeirs heirs(store, root);
  store.begin();
  for (const ModelRecord& other : others) {
    store.forget(other.key);
  }
  for (const ModelRecord& other : others) {
    heirs.pass_on(other);
  }
  store.commit();
  for (const ModelRecord& other : others) {
    heirs.remove_unowned(other.folder);
  }
  return others.size();
}

}  // namespace vantage::batch
