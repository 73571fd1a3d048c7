// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

namespace vantage::batch {

/// How another program ended and what it printed.
struct ProgramResult {
  int exit_code = 0;       ///< 128 + signal if a signal ended it.
  std::string output{};    ///< Standard output.
  std::string messages{};  ///< Standard error.
};

/// Runs a program of the search path with these arguments, no shell between, and waits for it.
/// \throw IoError if it cannot be started.
ProgramResult call_program(const std::vector<std::string>& command);

}  // namespace vantage::batch
