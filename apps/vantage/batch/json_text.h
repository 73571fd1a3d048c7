// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

#include <nlohmann/json.hpp>

namespace vantage::batch {

/// Members stay in the order in which they were put in.
using Json = nlohmann::ordered_json;

/// JSON as text. Bytes that are no UTF-8, as names of files may hold, are replaced, so that it stays JSON.
/// \param indent of each level; −1: all in one line.
std::string json_text(const Json& json, int indent = -1);

/// What a text says; is_discarded() if it is no JSON.
Json parsed_json(std::string_view text);

/// Writes JSON as one line, which is how a batch and its workers speak. \return false, and errno, if
/// nobody listens any more.
bool write_json_line(int descriptor, const Json& json);

}  // namespace vantage::batch
