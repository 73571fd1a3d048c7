// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <cstdint>
#include <string>

#include "vantage/core/run_context.h"

#include "batch/runner.h"

namespace vantage::cli {

/// How a batch is getting on, in one line: models ended, rate, time left, failures.
class BatchProgress {
 public:
  /// \param total number of models; negative if nobody knows.
  BatchProgress(const RunContext& run, std::int64_t total) : run_(run), total_(total) {}

  void show(const batch::RunnerCounts& counts) const;

 private:
  using Clock = std::chrono::steady_clock;

  const RunContext& run_;
  std::int64_t total_;
  Clock::time_point start_ = Clock::now();
};

/// How a batch has ended, for people.
std::string counts_text(const batch::RunnerCounts& counts);

/// 75 → "1 min 15 s".
std::string duration_text(double seconds);

}  // namespace vantage::cli
