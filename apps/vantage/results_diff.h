// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "vantage/core/run_context.h"

#include "batch/results_store.h"

namespace vantage::cli {

/// How one model differs between two batches.
struct Difference {
  /// A column and what it holds in A and in B.
  struct Change {
    std::string column{}, a{}, b{};
  };

  std::string key{};              ///< Of the model.
  std::string kind{};             ///< "removed" (only in A), "added" (only in B) or "changed".
  std::vector<Change> changes{};  ///< Of a changed one.
};

/// How many models are alike, and how many are not.
struct DiffCounts {
  std::size_t equal = 0;
  std::size_t changed = 0;
  std::size_t removed = 0;
  std::size_t added = 0;
};

/// Walks through two stores in the order of keys. What is compared: status, error, content,
/// counts of the surface, and the scores and the best view's camera, whose numbers may differ by `tolerance`
/// of the larger. \throw IoError, Cancelled
DiffCounts diff_results(batch::ResultsStore& a, batch::ResultsStore& b, double tolerance,
                        const RunContext& run, const std::function<void(const Difference&)>& take);

/// Whether a model of one store has the content of one of the other. \throw IoError, Cancelled
bool share_content(batch::ResultsStore& a, batch::ResultsStore& b, const RunContext& run);

std::string difference_line(const Difference& difference);     ///< For people.
nlohmann::ordered_json to_json(const Difference& difference);  ///< For programs.

}  // namespace vantage::cli
