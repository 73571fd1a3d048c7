// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <stop_token>
#include <string_view>

/// \file
/// How a long computation runs, never what it computes: every byte of a result is the same for
/// any RunContext that lets it finish.

namespace vantage {

/// Progress, cancellation and threads of one computation. Cheap to copy.
struct RunContext {
  /// Called on the calling thread only, with a stage name and the fraction done in [0, 1].
  /// Fractions never decrease within one public call.
  std::function<void(std::string_view stage, double fraction)> report{};
  std::stop_token stop{};    ///< Request a stop to get Cancelled within about a second.
  int max_threads = 0;       ///< At most this many threads; 0 uses all cores.
  double share_begin = 0.0;  ///< Where this part begins in the whole, in [0, 1].
  double share_end = 1.0;    ///< Where this part ends in the whole, in [share_begin, 1].

  /// Reports `fraction` of this part as done.
  /// \throw Cancelled if a stop was requested.
  void advance(std::string_view stage, double fraction) const;

  /// Throws if a stop was requested; safe on any thread.
  /// \throw Cancelled
  void check() const;

  /// The same context reporting into [begin, end] of this part.
  [[nodiscard]] RunContext part(double begin, double end) const;

  /// The same context without reports: for a part whose progress is told otherwise.
  [[nodiscard]] RunContext quiet() const;

  /// The same without reports and on one thread.
  [[nodiscard]] RunContext alone() const;
};

}  // namespace vantage
