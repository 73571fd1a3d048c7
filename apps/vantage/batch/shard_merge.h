// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "vantage/core/run_context.h"

#include "batch/confined_folder.h"
#include "batch/results_store.h"

namespace vantage::batch {

/// What a merge came across.
struct MergeCounts {
  std::size_t seen = 0;     ///< Records read.
  std::size_t taken = 0;    ///< Of these, new or better than what was there.
  std::size_t torn = 0;     ///< Lines and rows that were no sound records, and were left out.
  std::size_t clashes = 0;  ///< Records left out: another model's results have their folder's name.
  std::size_t missing = 0;  ///< Records taken whose results are not where they come from.
};

/// Name of a merge among those that write in a folder.
inline constexpr const char* kMergeCorner = "merge";

/// Folds the shard files of the folders, and the stores of all but the first, into the first one's
/// store; as often as wanted, also while shards run. Results of all but the first are copied into it. Nothing
/// is changed where something cannot be read, or the run is stopped.
/// \param root the first folder. \throw IoError, Cancelled
MergeCounts merge_shards(const std::vector<std::string>& folders, ResultsStore& store,
                         const ConfinedFolder& root, const RunContext& run = {});

}  // namespace vantage::batch
