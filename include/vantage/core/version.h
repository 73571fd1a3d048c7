// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

namespace vantage {

/// Semantic version of the library, e.g. "0.1.0".
std::string_view version();

/// One line with the versions of the libraries that shape the results.
std::string library_versions();

}  // namespace vantage
