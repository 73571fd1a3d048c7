// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "vantage/core/error.h"

namespace vantage {

/// \param what in the plural. \throw InvalidInput unless there are as many as `of`.
inline void require_count(std::size_t count, std::string_view what, std::size_t of,
                          std::string_view things) {
  if (count != of) {
    throw InvalidInput("the " + std::string(what) + " are " + std::to_string(count) +
                       ", but there are " + std::to_string(of) + " " + std::string(things));
  }
}

}  // namespace vantage
