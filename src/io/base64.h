// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

namespace vantage {

/// The bytes in base64 (RFC 4648, section 4), padded, without line breaks.
std::string base64(std::string_view bytes);

}  // namespace vantage
