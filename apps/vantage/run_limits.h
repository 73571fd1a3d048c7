// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>

#include <CLI/CLI.hpp>

/// \file
/// What one run of the program may take of the machine.

namespace vantage::cli {

/// 0: as much as there is.
struct RunLimits {
  std::uint64_t memory_bytes = 0;  ///< Of data: heap, stacks and private mappings.
  double seconds = 0.0;            ///< Of wall time.
  std::size_t faces = 0;           ///< Of a model.
};

/// Adds --max-memory, --max-faces and --timeout; a command that has one of them keeps its own.
void add_limit_flags(CLI::App& app, RunLimits& limits);

/// Adds --max-faces alone.
void add_face_limit_flag(CLI::App& app, RunLimits& limits);

/// The limit of faces that was asked for, or what memory has room for.
std::size_t face_limit(const RunLimits& limits);

/// Holds the process to the limits from here on: allocations fail beyond the first, SIGALRM comes at
/// the second. What cannot take a failed allocation ends the process with one sentence.
void apply_limits(const RunLimits& limits);

}  // namespace vantage::cli
