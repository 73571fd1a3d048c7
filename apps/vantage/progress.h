// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <string_view>

namespace vantage::cli {

/// A one-line bar on standard error, only if that is a terminal, and only for work that takes more
/// than a second.
class Progress {
 public:
  Progress();

  /// Shows how much of all work is done, in [0, 1]; negative: nobody knows, only `stage` is shown.
  void show(std::string_view stage, double fraction);
  /// Removes the bar.
  void finish();

 private:
  using Clock = std::chrono::steady_clock;

  bool terminal_ = false;
  bool shown_ = false;
  Clock::time_point start_{};
  Clock::time_point last_{};
};

}  // namespace vantage::cli
