// SPDX-License-Identifier: MIT
#include "batch/json_text.h"

#include <cerrno>
#include <cstddef>

#include <unistd.h>

namespace vantage::batch {

std::string json_text(const Json& json, int indent) {
  return json.dump(indent, ' ', false, Json::error_handler_t::replace);
}

Json parsed_json(std::string_view text) {
  return Json::parse(text, nullptr, false);
}

bool write_json_line(int descriptor, const Json& json) {
  const std::string text = json_text(json) + "\n";
  for (std::size_t done = 0; done < text.size();) {
    const ssize_t count = ::write(descriptor, text.data() + done, text.size() - done);
    if (count < 0 && errno != EINTR) {
      return false;
    }
    done += count > 0 ? static_cast<std::size_t>(count) : 0;
  }
  return true;
}

}  // namespace vantage::batch
