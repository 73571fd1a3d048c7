// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <system_error>

#include "io/readers.h"

namespace vantage {

/// Where a file beside a model is, all links resolved; empty if it lies outside the model's folder.
/// \param error set if there is no such file.
std::filesystem::path place_beside(const std::string& model_path, const std::string& relative,
                                   std::error_code& error);

/// A file beside a model, named by a relative path, that the model can do without. Does not throw.
SideFile side_file(const std::string& model_path, const std::string& relative);

}  // namespace vantage
