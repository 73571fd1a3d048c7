// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <vector>

#include "vantage/report/evaluation.h"

namespace vantage {

/// A data set listed in a JSON file; docs/evidence.md has the format. Paths in it are relative to it.
/// \throw IoError, FormatError
std::vector<RecordedModel> read_manifest(const std::filesystem::path& file);

/// Numbers of a text file, one a line. \throw IoError, FormatError naming the line
std::vector<double> read_gaze_values(const std::filesystem::path& file);

}  // namespace vantage
