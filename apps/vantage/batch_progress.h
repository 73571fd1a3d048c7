// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>

#include "vantage/core/run_context.h"

#include "batch/runner.h"

namespace vantage::cli {

/// How a batch is getting on, in one line: models ended, rate, time left, failures.
class BatchProgress {
 public:
  /// \param total number of models; negative if nobody knows.
  BatchProgress(const RunContext& run, std::int64_t total);

  void show(const batch::RunnerCounts& counts);

  /// The same for a log, now and then: after half a minute, then each half minute or tenth of the time,
  /// whichever is longer. Nothing where nobody wants to see progress.
  std::optional<std::string> due(const batch::RunnerCounts& counts);

 private:
  using Clock = std::chrono::steady_clock;

  [[nodiscard]] std::string line_of(const batch::RunnerCounts& counts) const;

  const RunContext& run_;
  std::int64_t total_;
  double due_s_;
  Clock::time_point start_ = Clock::now();
};

/// How a batch has ended, for people.
std::string counts_text(const batch::RunnerCounts& counts);

/// Which answers should not be trusted: the first ones, and how many more.
std::string doubted_text(const batch::RunnerCounts& counts);

/// 75 → "1 min 15 s".
std::string duration_text(double seconds);

}  // namespace vantage::cli
