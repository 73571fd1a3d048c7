// SPDX-License-Identifier: MIT
#include "progress.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>

#include <unistd.h>

#include "vantage/core/error.h"

#include "terminal.h"

namespace vantage::cli {
namespace {

constexpr std::chrono::milliseconds kPatience{1000};  // nobody wants a bar for less
constexpr std::chrono::milliseconds kRefresh{80};
constexpr int kWidth = 28;

}  // namespace

Progress::Progress() : start_(Clock::now()) {
  const char* term = std::getenv("TERM");
  terminal_ = isatty(STDERR_FILENO) != 0 && (term == nullptr || std::string_view(term) != "dumb");
}

void Progress::show(std::string_view stage, double fraction) {
  const auto now = Clock::now();
  if (!terminal_ || now - start_ < kPatience || (shown_ && now - last_ < kRefresh)) {
    return;
  }
  const std::string name = printable(stage);
  if (fraction < 0.0) {  // of an unknown whole
    std::fprintf(stderr, "\r\033[K%s", name.c_str());
    std::fflush(stderr);
    shown_ = true;
    last_ = now;
    return;
  }
  const int filled = static_cast<int>(std::lround(std::clamp(fraction, 0.0, 1.0) * kWidth));
  std::string bar;
  for (int i = 0; i < kWidth; ++i) {
    bar += i < filled ? "━" : "─";
  }
  std::fprintf(stderr, "\r\033[K%s %3.0f %%  %s", bar.c_str(), 100.0 * fraction, name.c_str());
  std::fflush(stderr);
  shown_ = true;
  last_ = now;
}

void Progress::finish() {
  if (shown_) {
    std::fputs("\r\033[K", stderr);
    std::fflush(stderr);
    shown_ = false;
  }
}

}  // namespace vantage::cli
