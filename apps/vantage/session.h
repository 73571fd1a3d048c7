// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <stop_token>
#include <string>
#include <type_traits>
#include <vector>

#include <oneapi/tbb/global_control.h>

#include "vantage/core/run_context.h"
#include "vantage/io/model.h"

#include "progress.h"
#include "run_limits.h"

/// \file
/// What every command shares: the common flags, signals, progress, and how a failure ends.

namespace vantage {
struct IdleOptions;
}

namespace vantage::cli {

// Exit codes of the program.
inline constexpr int kDone = 0;
inline constexpr int kFailed = 1;
inline constexpr int kWrongUsage = 2;
inline constexpr int kUnreadableInput = 3;
inline constexpr int kSomeFailed = 4;
inline constexpr int kTryAgain = 75;
inline constexpr int kInterrupted = 130;

/// Flags that every command has.
struct CommonFlags {
  bool json = false;
  bool quiet = false;
  bool verbose = false;
  bool force = false;
  int threads = 0;
  std::uint64_t seed = 0;
  RunLimits limits{};
  std::vector<std::string>
      inputs{};  ///< Files that the command line says to read; no output may be one.
};

/// While one lives, nothing is being written, so a program that does not answer a signal in time may
/// be ended without ceremony: some library calls cannot be interrupted. At most one lives at a time.
class Abandonable {
 public:
  Abandonable();
  ~Abandonable();
  Abandonable(const Abandonable&) = delete;
  Abandonable& operator=(const Abandonable&) = delete;
};

/// One run of the program.
class Session {
 public:
  /// Starts to listen for SIGINT and SIGTERM; the second one ends the process at once.
  Session();
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  CommonFlags flags{};
  int exit_code = kDone;     ///< Of a run that ends without an exception.
  std::string if_stopped{};  ///< Ends the sentence on a signal: what can be done then.

  /// The context to pass to the library: progress to a terminal, stop on signals, threads.
  [[nodiscard]] RunContext run();

  /// Holds the process to the limits that were asked for; before any work.
  void apply_limits() const { cli::apply_limits(flags.limits); }

  /// Sets what the command line left open, from the environment and --config.
  void configure(CLI::App& command);

  /// Refuses flags of the command line that would do nothing; settings may be meant for other commands.
  /// \param why they would. \throw CLI::ValidationError naming the first of them that was given.
  void refuse_idle(bool are_idle, const std::vector<std::string>& names,
                   const std::string& why) const;
  /// The same of options that are known to.
  void refuse_idle(const std::vector<IdleOptions>& idle) const;

  /// Reads a model; a failure in here means exit code 3.
  Model load(const std::string& path, const ReadOptions& options = {});

  /// Reads something small that the user named; like load().
  template <class Step>
  auto read(Step&& step) {
    return reading([&] { return computing(step); });
  }

  /// Runs a step that reads the user's input; a failure in here means exit code 3.
  template <class Step>
  auto reading(Step&& step) {
    reading_input_ = true;
    if constexpr (std::is_void_v<decltype(step())>) {
      step();
      reading_input_ = false;
    } else {
      auto result = step();
      reading_input_ = false;
      return result;
    }
  }

  /// Runs a step that computes and writes nothing; a signal ends it within a second, come what may.
  template <class Step>
  auto computing(Step&& step) {
    const Abandonable abandonable;
    return step();
  }

  /// Writes a message to standard error unless `-q` was given.
  void say(const std::string& text);
  /// Leaves standard output to a file that goes there.
  /// \param path `-` if it does. \param option that names it.
  /// \throw CLI::ValidationError if `--json` would write there, too.
  void leave_output_to(const std::string& path, const std::string& option);

  /// Writes a result to standard output unless `-q` or `--json` was given, or a file goes there.
  void tell(const std::string& text);
  /// The same for text that drives the terminal, a picture.
  void show(const std::string& text);

  /// Clears the progress line.
  void end_progress() { progress_.finish(); }

  /// Whether it is --timeout that asked it to stop.
  static bool is_out_of_time();

  /// Prints what went wrong, in one sentence, and gives the exit code. Call inside a catch.
  int report_failure();

 private:
  std::stop_source stop_{};
  bool output_is_taken_ = false;
  std::vector<std::string> given_{};  ///< Flags of the command line.
  Progress progress_{};
  void limit_threads();

  bool reading_input_ = false;
  /// Holds libraries that start threads of their own (Embree) to --threads too.
  std::unique_ptr<tbb::global_control> thread_limit_{};
  int limited_to_ = 0;
};

}  // namespace vantage::cli
