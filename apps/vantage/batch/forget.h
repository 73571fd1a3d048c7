// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <unordered_set>
#include <utility>

#include "batch/confined_folder.h"
#include "batch/entry_source.h"
#include "batch/results_store.h"

namespace vantage::batch {

/// Passes entries on and remembers their keys, and whether the list may be incomplete.
class ListedEntries : public EntrySource {
 public:
  explicit ListedEntries(std::unique_ptr<EntrySource> all) : all_(std::move(all)) {}

  std::optional<Entry> next() override;

  [[nodiscard]] bool has_more_now() const override { return all_->has_more_now(); }

  void fetch(Entry& entry, const std::string& file) override { all_->fetch(entry, file); }

  [[nodiscard]] const std::unordered_set<std::string>& keys() const { return keys_; }

  /// The first entry that cannot be listed or is not there, as an input that is not mounted; empty if there is
  /// none.
  [[nodiscard]] const std::string& missing() const { return missing_; }

 private:
  std::unique_ptr<EntrySource> all_;
  std::unordered_set<std::string> keys_{};
  std::string missing_{};
};

/// Removes the records of models that are not `listed`, and results that are nobody's then. Where listed
/// models equal one of these, the first of them takes over its results. \return how many were removed.
/// \throw IoError
std::size_t forget_others(ResultsStore& store, const ConfinedFolder& root,
                          const std::unordered_set<std::string>& listed);

}  // namespace vantage::batch
