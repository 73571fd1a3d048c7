// SPDX-License-Identifier: MIT
#include "session.h"

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <exception>
#include <new>
#include <string_view>
#include <thread>
#include <utility>

#include <pthread.h>
#include <unistd.h>

#include "vantage/core/error.h"
#include "vantage/pipeline/option_table.h"

#include "import_program.h"
#include "output_file.h"
#include "settings.h"
#include "standard_output.h"
#include "terminal.h"

namespace vantage::cli {
namespace {

std::atomic<int> first_signal{0};

/// How long a computation may take to notice a signal.
constexpr std::chrono::milliseconds kGrace{700};

/// Whether the program may be ended at any moment. Once it is being ended it stays so.
enum class Phase { Writing, Computing, Ending };
std::atomic<Phase> phase{Phase::Writing};

sigset_t watched_signals() {
  sigset_t set;
  sigemptyset(&set);
  sigaddset(&set, SIGINT);
  sigaddset(&set, SIGTERM);
  sigaddset(&set, SIGALRM);
  return set;
}

int code_of_signal(int number) {
  return number == SIGTERM ? kTryAgain : number == SIGALRM ? kFailed : kInterrupted;
}

const char* words_of_signal(int number) {
  return number == SIGTERM ? "stopped by SIGTERM before the end; nothing was left half written"
         : number == SIGALRM
             ? "stopped: it took longer than --timeout allows; give it more, or a smaller model"
             : "interrupted; nothing was left half written";
}

/// Waits for signals in a thread of its own, where more than an async-signal-safe flag is allowed.
void watch_signals(const std::stop_source& stop) {
  const sigset_t set = watched_signals();
  for (;;) {
    int number = 0;
    if (sigwait(&set, &number) != 0) {
      return;
    }
    if (first_signal.exchange(number) != 0) {
      _exit(code_of_signal(number));
    }
    stop.request_stop();
    std::this_thread::sleep_for(kGrace);
    Phase computing = Phase::Computing;
    if (phase.compare_exchange_strong(computing, Phase::Ending)) {
      std::fprintf(stderr, "vantage: %s\n", words_of_signal(number));
      _exit(code_of_signal(number));
    }
  }
}

}  // namespace

Abandonable::Abandonable() {
  phase = Phase::Computing;
}

Abandonable::~Abandonable() {
  for (Phase now = Phase::Computing; !phase.compare_exchange_strong(now, Phase::Writing);
       now = Phase::Computing) {
    ::pause();  // the process is being ended
  }
}

Session::Session() {
  // Blocked here, before any other thread exists, so that only the watcher receives them.
  const sigset_t set = watched_signals();
  pthread_sigmask(SIG_BLOCK, &set, nullptr);
  std::signal(SIGPIPE, SIG_IGN);  // a closed pipe is a failed write; see report_failure()
  std::signal(SIGXFSZ, SIG_IGN);  // and so is a file that grows beyond what is allowed
  std::thread(watch_signals, stop_).detach();
}

RunContext Session::run() {
  RunContext context;
  context.stop = stop_.get_token();
  context.max_threads = flags.threads;
  limit_threads();
  if (!flags.quiet && !flags.json) {
    context.report = [this](std::string_view stage, double fraction) {
      progress_.show(stage, fraction);
    };
  }
  return context;
}

void Session::limit_threads() {
  if (flags.threads == limited_to_) {
    return;
  }
  thread_limit_.reset();  // of two limits the smaller one would count
  if (flags.threads > 0) {
    thread_limit_ = std::make_unique<tbb::global_control>(
        tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(flags.threads));
  }
  limited_to_ = flags.threads;
}

void Session::configure(CLI::App& command) {
  const Abandonable abandonable;
  for (const CLI::Option* option : command.get_options({})) {
    if (option->count() > 0 && !option->get_lnames().empty()) {
      given_.push_back("--" + option->get_lnames().front());
    }
  }
  for (const std::string& warning : apply_settings(command)) {
    say("warning: " + warning);
  }
  flags.inputs = named_inputs(command);
  if (std::count(flags.inputs.begin(), flags.inputs.end(), "-") > 1) {
    throw CLI::ValidationError("-",
                               "is standard input, which is read once; name a file for the other");
  }
}

void Session::refuse_idle(const std::vector<IdleOptions>& idle) const {
  for (const IdleOptions& options : idle) {
    std::vector<std::string> names;
    for (const std::string& name : options.names) {
      names.push_back(flag_of(find_option(name)));
    }
    refuse_idle(true, names, options.why);
  }
}

void Session::refuse_idle(bool are_idle, const std::vector<std::string>& names,
                          const std::string& why) const {
  const auto given = std::find_first_of(names.begin(), names.end(), given_.begin(), given_.end());
  if (are_idle && given != names.end()) {
    throw CLI::ValidationError(*given, why);
  }
}

Model Session::load(const std::string& path, const ReadOptions& options) {
  return read([&] {
    ReadOptions wanted = options;
    wanted.importer = model_importer(flags.limits);
    wanted.max_faces = face_limit(flags.limits);
    return load_model(path, run(), wanted);
  });
}

void Session::say(const std::string& text) {
  progress_.finish();
  if (!flags.quiet) {
    std::fprintf(stderr, "%s\n", printable(text).c_str());
  }
}

void Session::leave_output_to(const std::string& path, const std::string& option) {
  if (path == "-" && flags.json) {
    throw CLI::ValidationError(
        option,
        "- is standard output, where --json writes: give it a file, or leave "
        "--json out");
  }
  output_is_taken_ = output_is_taken_ || path == "-";
}

void Session::tell(const std::string& text) {
  show(printable_lines(text));
}

void Session::show(const std::string& text) {
  progress_.finish();
  if (!flags.quiet && !flags.json && !output_is_taken_) {
    std::printf("%s\n", text.c_str());
  }
}

bool Session::is_out_of_time() {
  return first_signal == SIGALRM;
}

int Session::report_failure() {
  progress_.finish();
  const bool is_of_input = std::exchange(reading_input_, false);
  const auto complain = [](const std::string& problem) {
    std::fprintf(stderr, "vantage: %s\n", printable(problem).c_str());
  };
  const auto memory_remedy = [this] {
    const std::uint64_t limit = flags.limits.memory_bytes;
    return limit == 0
               ? std::string("; try a smaller model, or a machine with more")
               : "; --max-memory allows " + rounded(static_cast<double>(limit) / 1e6) + " MB";
  };
  try {
    throw;
  } catch (const Cancelled&) {
    const int number = first_signal.load();
    complain(words_of_signal(number) + (number == SIGALRM ? std::string() : if_stopped));
    return code_of_signal(number);
  } catch (const IoError& error) {
    if (std::string_view(error.what()).starts_with("standard output") && reader_has_gone()) {
      end_by_closed_pipe();
    }
    complain(error.error_number() == ENOMEM ? error.what() + memory_remedy()
                                            : std::string(error.what()));
    if (error.error_number() == ENOSPC || error.error_number() == EDQUOT) {
      return kTryAgain;
    }
    return is_of_input ? kUnreadableInput : kFailed;
  } catch (const FormatError& error) {
    complain(error.what());
    return kUnreadableInput;
  } catch (const std::bad_alloc&) {
    complain("out of memory" + memory_remedy());
    return is_of_input ? kUnreadableInput : kFailed;
  } catch (const std::exception& error) {
    complain(error.what());
    return is_of_input ? kUnreadableInput : kFailed;
  }
}

}  // namespace vantage::cli
