// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace vantage::batch {

/// Puts a finished folder in its place in one step: what was there before is exchanged with it and
/// removed. \throw IoError
void move_into_place(const std::string& finished, const std::string& place);

}  // namespace vantage::batch
