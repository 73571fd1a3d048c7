// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "vantage/core/run_context.h"

#include "batch/results_store.h"

namespace vantage::batch {

/// What a merge came across.
struct MergeCounts {
  std::size_t seen = 0;   ///< Records read.
  std::size_t taken = 0;  ///< Of these, new or better than what was there.
  std::size_t torn = 0;   ///< Lines and rows that were no sound records, and were left out.
};

/// Folds the shard files of the folders, and the stores of all but the first, into the first one's
/// store, in one transaction; as often as wanted, also while shards run. \throw IoError, Cancelled
MergeCounts merge_shards(const std::vector<std::string>& folders, ResultsStore& store,
                         const RunContext& run = {});

}  // namespace vantage::batch
