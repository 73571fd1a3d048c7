// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

#include <nlohmann/json.hpp>

namespace vantage {

/// Members stay in the order in which they were put in.
using OrderedJson = nlohmann::ordered_json;

/// JSON as text. Bytes that are no UTF-8, as names may hold, are replaced, so that it stays JSON.
/// \param indent of each level; −1: all in one line.
std::string json_text(const OrderedJson& json, int indent = -1);

/// What a text says; is_discarded() if it is no JSON.
OrderedJson parsed_json(std::string_view text);

}  // namespace vantage
