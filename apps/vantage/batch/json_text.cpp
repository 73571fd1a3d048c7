// SPDX-License-Identifier: MIT
#include "batch/json_text.h"

#include "batch/descriptor.h"

namespace vantage::batch {

std::string json_text(const Json& json, int indent) {
  return json.dump(indent, ' ', false, Json::error_handler_t::replace);
}

Json parsed_json(std::string_view text) {
  return Json::parse(text, nullptr, false);
}

bool write_json_line(int descriptor, const Json& json) {
  return write_all(descriptor, json_text(json) + "\n") == 0;
}

}  // namespace vantage::batch
