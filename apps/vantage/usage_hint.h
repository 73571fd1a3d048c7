// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

/// \file
/// What is wrong with a command line, said better than the parser can: it names words that it did not
/// expect from the last to the first, and knows nothing of what was meant.

namespace vantage::cli {

/// A sentence about the first command, flag or argument that the program does not know, with the one
/// that was probably meant. Nothing if all of them are known, or the parser's own complaint is about
/// an earlier one.
/// \param words without the program's name. \param complaint the parser's.
std::optional<std::string> unknown_word(const CLI::App& program,
                                        const std::vector<std::string>& words,
                                        const std::string& complaint);

/// The parser's complaint about an option that is given too often, or without its value, in plain words; others
/// as they are.
std::string plain_mismatch(const CLI::App& program, const std::string& complaint);

/// The known word that was probably meant: one that differs by few letters, or the only one that
/// begins so. Empty if there is none.
std::string nearest_word(const std::string& word, const std::vector<std::string>& known);

}  // namespace vantage::cli
