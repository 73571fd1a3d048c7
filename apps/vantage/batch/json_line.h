// SPDX-License-Identifier: MIT
#pragma once

#include <cerrno>
#include <cstddef>
#include <string>

#include <nlohmann/json.hpp>
#include <unistd.h>

namespace vantage::batch {

/// Writes JSON as one line, which is how a batch and its workers speak. \return false, and errno, if
/// nobody listens any more.
inline bool write_json_line(int descriptor, const nlohmann::ordered_json& json) {
  using Handler = nlohmann::ordered_json::error_handler_t;
  const std::string text = json.dump(-1, ' ', false, Handler::replace) + "\n";
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
