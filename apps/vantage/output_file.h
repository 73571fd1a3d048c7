// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <CLI/CLI.hpp>

#include "session.h"

/// \file
/// Files under names that the user gave, and what may be replaced there.

namespace vantage::cli {

/// Of a file's name, in small letters, with its point; empty if it has none.
std::string suffix_of(const std::string& path);

/// The files that a command line says to read.
std::vector<std::string> named_inputs(CLI::App& command);

/// What is written to a file.
enum class OutputKind { Picture, Shape, Table };

/// Adds --force to a command that writes under names of the user's choice.
void add_force_flag(CLI::App& app, CommonFlags& flags);

/// A file that an option names; an empty path: none.
struct NamedOutput {
  std::string_view option{};
  std::string path{};
};

/// Refuses outputs of one run that would replace each other, also under names that differ, before any
/// work. \throw CLI::ValidationError
void require_distinct(const std::vector<NamedOutput>& outputs);

/// Refuses to replace a file that may be somebody's input, before any work. Replaced are files whose
/// extension says that they only ever are output (pictures: .png, .webp; shapes: .swc, .graphml,
/// .npy), empty ones, and what Vantage wrote of the same kind, which shows in its content; with --force
/// any file but the inputs. \throw IoError, CLI::ValidationError
void check_output(const std::string& path, OutputKind kind, const CommonFlags& flags);

/// The same for a file of a folder of results, where a link is replaced and not written through.
void check_result(const std::string& path, OutputKind kind, const CommonFlags& flags);

/// The same for all files level-NN.ply of a folder, which no other output of the run may be.
/// \throw IoError, CLI::ValidationError
void check_levels(const std::string& folder, const std::vector<NamedOutput>& others,
                  const CommonFlags& flags);

/// Writes to a name that the user gave, "-" for standard output. A signal ends the program while a
/// pipe waits for a reader. \throw IoError
void write_output(const std::string& path, std::string_view bytes);

/// Whether a file is there and has these bytes: to write them again loses nothing.
bool is_already(const std::string& path, std::string_view bytes);

}  // namespace vantage::cli
