// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>

#include "batch/confined_folder.h"
#include "batch/entry_source.h"

namespace vantage::batch {

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
