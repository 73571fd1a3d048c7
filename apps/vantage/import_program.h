// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "vantage/io/import_stream.h"

#include "run_limits.h"

/// \file
/// The program `vantage-import`, which reads CAD and game formats by the libraries of others: a package of
/// its own that need not be there.

namespace vantage::cli {

/// Where it is: beside this program, in ../libexec/vantage of it, or on the search path. Empty: nowhere.
std::string import_program();

/// What it is made of and what confines it, one line; or that it is not there.
std::string import_program_version();

/// Starts it for each file, holds it to its limits, and gives what it sent. Where it is not there, fails,
/// crashes or takes too much, a FormatError says so.
/// \param limits of this run; they hold for it too, those of memory and time in place of its own.
ModelImporter model_importer(const RunLimits& limits);

}  // namespace vantage::cli
