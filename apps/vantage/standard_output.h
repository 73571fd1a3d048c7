// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace vantage::cli {

/// Writes a text to standard output. \throw IoError if that fails
void write_standard_output(const std::string& text);

/// Writes what is still held back for standard output. \throw IoError if any of what was printed so
/// far could not be written.
void finish_standard_output();

/// Whether standard output is a pipe that nobody reads any more, as after `| head`.
bool reader_has_gone();

/// Ends the process without a word, as other tools end when their reader has gone: by SIGPIPE.
[[noreturn]] void end_by_closed_pipe();

}  // namespace vantage::cli
