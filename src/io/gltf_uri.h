// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace vantage {

bool is_data_uri(std::string_view uri);

/// The bytes of a "data:…,…" URI, percent-encoded and maybe in base64; nothing if it is not well formed.
std::optional<std::string> decode_data_uri(std::string_view uri);

/// The text with each %XX as a byte; nothing if a percent sign stands before anything else.
std::optional<std::string> decode_percent(std::string_view text);

/// The relative path a URI names, percent signs decoded; nothing if it has a scheme, is absolute,
/// or leads out of the folder with "..".
std::optional<std::string> relative_path_of_uri(std::string_view uri);

}  // namespace vantage
