// SPDX-License-Identifier: MIT
#include "core/json_text.h"

namespace vantage {

std::string json_text(const OrderedJson& json, int indent) {
  return json.dump(indent, ' ', false, OrderedJson::error_handler_t::replace);
}

OrderedJson parsed_json(std::string_view text) {
  return OrderedJson::parse(text, nullptr, false);
}

}  // namespace vantage
