// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "batch/confined_folder.h"
#include "batch/entry_source.h"
#include "batch/shard_log.h"

namespace vantage::batch {

/// Which of `shards` an entry is for: the one that its plan says, else by a hash of its key.
std::uint32_t shard_of(const Entry& entry, std::uint32_t shards);

/// Only the entries of one shard, at the places they have among all.
class ShardEntries : public EntrySource {
 public:
  ShardEntries(std::unique_ptr<EntrySource> all, const Shard& shard)
      : all_(std::move(all)), shard_(shard) {}

  std::optional<Entry> next() override;

  [[nodiscard]] bool has_more_now() const override { return all_->has_more_now(); }

  void fetch(Entry& entry, const std::string& file) override { all_->fetch(entry, file); }

 private:
  std::unique_ptr<EntrySource> all_;
  Shard shard_;
};

/// Writes every entry to a manifest that gives the same entries back, whatever changes in the
/// folders meanwhile: paths are absolute, and what JSON cannot hold is encoded as in keys.
/// \param name of the manifest in `folder`. \return the number of entries. \throw IoError
std::int64_t write_plan(EntrySource& entries, const ConfinedFolder& folder,
                        const std::string& name);

/// Gives each entry of a plan its shard, so that all shards cost about the same: the most expensive
/// model first, each to the shard that has least. The cost of a model is that of its file, which
/// grows with its size. Adding a model may move others. \throw IoError
void balance_plan(const ConfinedFolder& folder, const std::string& name, std::uint32_t shards);

}  // namespace vantage::batch
