// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

#include "vantage/core/error.h"
#include "vantage/io/model.h"

namespace vantage::test {

/// What parse_model() complains about, or "nothing" if it reads the bytes.
inline std::string error_text(std::string_view bytes, std::string_view name,
                              const ReadOptions& options = {}) {
  try {
    parse_model(bytes, name, {}, options);
  } catch (const FormatError& error) {
    return error.what();
  }
  return "nothing";
}

}  // namespace vantage::test
