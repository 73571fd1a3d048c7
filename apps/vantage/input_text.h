// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace vantage::cli {

/// The bytes of a small file the user named, or of standard input for "-". \throw IoError
std::string read_text(const std::string& path);

}  // namespace vantage::cli
