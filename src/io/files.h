// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace vantage {

/// All bytes of a regular file, or of standard input for "-".
/// \throw IoError if it cannot be read, is a folder, or is not a regular file (a device, a pipe).
std::string read_file(const std::string& path);

}  // namespace vantage
