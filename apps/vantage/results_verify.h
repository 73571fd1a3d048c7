// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <functional>
#include <string>

#include "vantage/core/run_context.h"

#include "batch/results_store.h"

namespace vantage::cli {

/// What was looked at in a batch's folder.
struct VerifyCounts {
  std::size_t records = 0;  ///< Of the store.
  std::size_t folders = 0;  ///< Of results that records name.
  std::size_t problems = 0;
};

/// Holds a batch's folder against its store: SQLite's own check; records that are sound; results that
/// are there, whole, and those of their record; folders of results that no record names.
/// \param take receives each problem, one sentence. \throw IoError, Cancelled
VerifyCounts verify_results(const std::string& folder, batch::ResultsStore& store,
                            const RunContext& run,
                            const std::function<void(const std::string&)>& take);

}  // namespace vantage::cli
