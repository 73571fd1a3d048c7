// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

#include <CLI/CLI.hpp>

#include "session.h"

/// \file
/// Files under names that the user gave, and what may be replaced there.

namespace vantage::cli {

/// What is written to a file.
enum class OutputKind { Picture, Shape, Table };

/// Adds --force to a command that writes under names of the user's choice.
void add_force_flag(CLI::App& app, CommonFlags& flags);

/// Refuses to replace a file that may be somebody's input, before any work. Replaced are files whose
/// extension says that they only ever are output (pictures: .png, .webp; shapes: .json, .swc,
/// .graphml, .npy), empty ones, and what Vantage wrote of the same kind, which shows in its first
/// bytes; any file with --force. \throw IoError
void check_output(const std::string& path, OutputKind kind, const CommonFlags& flags);

/// The same for a file of a folder of results, where a link is replaced and not written through.
void check_result(const std::string& path, OutputKind kind, const CommonFlags& flags);

/// The same for all files level-NN.ply of a folder.
void check_levels(const std::string& folder, const CommonFlags& flags);

/// Writes to a name that the user gave, "-" for standard output. A signal ends the program while a
/// pipe waits for a reader. \throw IoError
void write_output(const std::string& path, std::string_view bytes);

}  // namespace vantage::cli
