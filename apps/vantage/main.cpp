// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cstdio>
#include <iostream>
#include <sstream>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fcntl.h>
#include <unistd.h>

#ifdef __GLIBC__
#include <malloc.h>
#endif

#include "vantage/core/error.h"
#include "vantage/core/version.h"

#include "commands.h"
#include "import_program.h"
#include "option_text.h"
#include "session.h"
#include "standard_output.h"
#include "terminal.h"
#include "usage_hint.h"
#include "value_checks.h"

namespace {

constexpr const char* kAbout =
    "Finds the view of a 3D model that tells most about its shape, and the one that tells least.";

constexpr const char* kFooter =
    "Reads OBJ, OFF, PLY, STL, glTF, GLB, 3MF, AMF and point clouds (XYZ, PTS, PWN, PCD); - reads\n"
    "standard input. With the package vantage-import also STEP, IGES, FBX, COLLADA, 3DS, X, BLEND "
    "and more.\n"
    "\n"
    "Exit codes: 0 done; 1 failed; 2 wrong usage; 3 input unreadable; 4 some models of a batch "
    "failed; 75 try again; 130 interrupted.\n"
    "\n"
    "Try: vantage view horse.ply";

/// One sentence on standard error for a command line that makes no sense.
int report_usage(const CLI::App& program, const std::vector<std::string>& words,
                 const CLI::ParseError& error) {
  std::string problem = error.what();
  problem = vantage::cli::unknown_word(program, words, problem)
                .value_or(vantage::cli::plain_mismatch(program, problem));
  while (!problem.empty() && (problem.back() == '\n' || problem.back() == '.')) {
    problem.pop_back();
  }
  std::replace(problem.begin(), problem.end(), '\n', ' ');
  const char* remedy = problem.find("; ") == std::string::npos ? "; see --help" : "";
  std::fprintf(stderr, "vantage: %s%s\n", vantage::printable(problem).c_str(), remedy);
  return vantage::cli::kWrongUsage;
}

/// The stages of a run ask for the same tens of megabytes again and again. glibc gives such memory back
/// and fetches it anew, page by page: half of a run's page faults, 4 to 8 % of the time of `view`.
void keep_freed_memory() {
#ifdef __GLIBC__
  constexpr int kMegabyte = 1 << 20;
  mallopt(M_MMAP_THRESHOLD, 32 * kMegabyte);
  mallopt(M_TRIM_THRESHOLD, 256 * kMegabyte);
#endif
}

/// Where standard input, output or error is closed, the first files that are opened would be taken for them.
/// What stands there instead can neither be read from nor written to as they are, so that errors remain.
void reserve_standard_files() {
  for (const int number : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    if (::fcntl(number, F_GETFD) < 0) {
      ::open("/dev/null", number == STDIN_FILENO ? O_WRONLY : O_RDONLY);  // takes the lowest number
    }
  }
}

/// The words of a command line, where `help view` asks for what `view --help` does. A command that is
/// none is left to be complained about: the parser prints help before it looks at it.
std::vector<std::string> words_of(const CLI::App& program, int argc, char** argv) {
  std::vector<std::string> words{argv + std::min(1, argc), argv + argc};
  if (words.empty() || words.front() != "help") {
    return words;
  }
  words.erase(words.begin());
  const auto is_asked_for = [&](const CLI::App* command) {
    return command->check_name(words.front());
  };
  if (words.empty() || !program.get_subcommands(is_asked_for).empty()) {
    words.emplace_back("--help");
  }
  return words;
}

}  // namespace

// NOLINTNEXTLINE(bugprone-exception-escape): out of memory while reporting a failure may end it
int main(int argc, char** argv) {
  using namespace vantage::cli;
  reserve_standard_files();
  keep_freed_memory();
  Session session;
  CLI::App program{kAbout, "vantage"};
  std::vector<std::string> words;
  const auto versions = [] {
    return "vantage " + std::string(vantage::version()) + "\n" + vantage::library_versions() +
           "\n" + import_program_version();
  };
  program.set_version_flag("-V,--version", versions, "print the versions and exit");
  program.set_help_flag("-h,--help", "print this help and exit");
  program.set_help_all_flag("--help-all", "print help with every option and exit");
  program.require_subcommand(1);
  program.footer(kFooter);
  program.formatter(help_formatter());  // commands inherit it
  try {
    add_view_command(program, session);
    add_skeleton_command(program, session);
    add_map_command(program, session);
    add_score_command(program, session);
    add_compare_command(program, session);
    add_eval_command(program, session);
    add_measures_command(program, session);
    add_render_command(program, session);
    add_thumb_command(program, session);
    add_info_command(program, session);
    add_orient_command(program, session);
    add_batch_command(program, session);
    add_batch_worker_commands(program, session);
    add_results_command(program, session);
    add_serve_command(program, session);
    add_figures_command(program, session);
    add_completion_command(program, session);
    add_manual_command(program, session);
    check_values(program);
    words = words_of(program, argc, argv);
    try {
      program.parse(std::vector<std::string>(words.rbegin(), words.rend()));  // the last first
    } catch (const CLI::Success& request) {                                   // --help, --version
      std::ostringstream text;
      program.exit(request, text, std::cerr);
      write_standard_output(text.str());
    }
    session.end_progress();
    finish_standard_output();
    return session.exit_code;
  } catch (const CLI::ParseError& error) {
    return report_usage(program, words, error);
  } catch (...) {
    return session.report_failure();
  }
}
