// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

namespace vantage {

/// Vertices and corners that a file may show in any case, however small it is …
inline constexpr std::size_t kMostInSmallFile = 1'000'000;
/// … and so many more for each of its bytes, since it may show one mesh many times. [ours]
inline constexpr std::size_t kMostPerByte = 64;

}  // namespace vantage
