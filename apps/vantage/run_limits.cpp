// SPDX-License-Identifier: MIT
#include "run_limits.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <string_view>

#include <sys/resource.h>
#include <sys/time.h>
#include <unistd.h>

#include "vantage/io/model.h"

#include "value_checks.h"

namespace vantage::cli {
namespace {

constexpr double kLeastMemory = 64e6;  // bytes; with less hardly a command starts [ours]
constexpr double kMostMemory = 1e18;
constexpr double kLeastSeconds = 0.001;
constexpr double kMostSeconds = 1e7;
/// A run that has not ended by then, though it was asked to, is ended. [ours]
constexpr time_t kSecondAlarm = 5;

// The address sanitizer's shadow memory alone is terabytes.
#if defined(__SANITIZE_ADDRESS__)
constexpr bool kCanLimitMemory = false;
#else
constexpr bool kCanLimitMemory = true;
#endif

/// Some libraries end the process where an allocation fails on one of their threads.
[[noreturn]] void end_for_want_of_memory() {
  constexpr std::string_view kWords =
      "vantage: a library gave up; --max-memory leaves it too little, allow more\n";
  // There is nothing to do where not even this can be written.
  static_cast<void>(::write(STDERR_FILENO, kWords.data(), kWords.size()) < 0);
  ::_exit(1);
}

void limit_memory(std::uint64_t bytes) {
  if (!kCanLimitMemory) {
    return;
  }
  // Not the address space: libraries reserve much more of it than they ever use.
  rlimit both{};
  ::getrlimit(RLIMIT_DATA, &both);
  both.rlim_cur = std::min<rlim_t>(bytes, both.rlim_max);
  ::setrlimit(RLIMIT_DATA, &both);
  std::set_terminate(&end_for_want_of_memory);
}

void limit_time(double seconds) {
  itimerval alarm{};
  alarm.it_value.tv_sec = static_cast<time_t>(seconds);
  alarm.it_value.tv_usec = static_cast<suseconds_t>(1e6 * (seconds - std::floor(seconds)));
  alarm.it_interval.tv_sec = kSecondAlarm;
  ::setitimer(ITIMER_REAL, &alarm, nullptr);
}

}  // namespace

void add_limit_flags(CLI::App& app, RunLimits& limits) {
  const std::string group = "Common";
  if (app.get_option_no_throw("--max-memory") == nullptr) {
    app.add_option("--max-memory", limits.memory_bytes,
                   "fail rather than use more memory than this: bytes, or with a unit, as in 500MB "
                   "or 2GB")
        ->transform(size_in(1.0))
        ->check(within(kLeastMemory, kMostMemory))
        ->group(group);
  }
  add_face_limit_flag(app, limits);
  if (app.get_option_no_throw("--timeout") == nullptr) {
    app.add_option("--timeout", limits.seconds, "fail rather than run longer than so many seconds")
        ->check(within(kLeastSeconds, kMostSeconds))
        ->group(group);
  }
}

void add_face_limit_flag(CLI::App& app, RunLimits& limits) {
  if (app.get_option_no_throw("--max-faces") == nullptr) {
    app.add_option("--max-faces", limits.faces,
                   "refuse models of more faces, or points; default: as many as fit into memory, "
                   "two for each kB")
        ->check(within(std::size_t{1}, std::size_t{4'000'000'000}))
        ->group("Common");
  }
}

std::size_t face_limit(const RunLimits& limits) {
  return limits.faces > 0 ? limits.faces : faces_that_fit(usable_memory_bytes());
}

void apply_limits(const RunLimits& limits) {
  if (limits.memory_bytes > 0) {
    limit_memory(limits.memory_bytes);
  }
  if (limits.seconds > 0.0) {
    limit_time(limits.seconds);
  }
}

}  // namespace vantage::cli
