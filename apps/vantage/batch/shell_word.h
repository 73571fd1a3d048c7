// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace vantage::batch {

/// The text as one word of a POSIX shell: as it is where that is safe, else in quotes.
std::string shell_word(const std::string& text);

}  // namespace vantage::batch
