// SPDX-License-Identifier: MIT
#include "vantage/core/run_context.h"

#include <algorithm>

#include "vantage/core/error.h"

namespace vantage {

void RunContext::check() const {
  if (stop.stop_requested()) {
    throw Cancelled();
  }
}

void RunContext::advance(std::string_view stage, double fraction) const {
  check();
  if (report) {
    const double inside = std::clamp(fraction, 0.0, 1.0);
    report(stage, share_begin + inside * (share_end - share_begin));
  }
}

RunContext RunContext::part(double begin, double end) const {
  RunContext piece = *this;
  const double width = share_end - share_begin;
  piece.share_begin = share_begin + begin * width;
  piece.share_end = share_begin + end * width;
  return piece;
}

RunContext RunContext::quiet() const {
  return {.stop = stop, .max_threads = max_threads};
}

RunContext RunContext::alone() const {
  return {.stop = stop, .max_threads = 1};
}

}  // namespace vantage
