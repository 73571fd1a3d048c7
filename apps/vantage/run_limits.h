// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include <CLI/CLI.hpp>

/// \file
/// What one run of the program may take of the machine.

namespace vantage::cli {

/// 0: as much as there is.
struct RunLimits {
  std::uint64_t memory_bytes = 0;  ///< Of data: heap, stacks and private mappings.
  double seconds = 0.0;            ///< Of wall time.
};

/// Adds --max-memory and --timeout; a command that has one of them already keeps its own.
void add_limit_flags(CLI::App& app, RunLimits& limits);

/// Holds the process to the limits from here on: allocations fail beyond the first, SIGALRM comes at
/// the second. What cannot take a failed allocation ends the process with one sentence.
void apply_limits(const RunLimits& limits);

}  // namespace vantage::cli
