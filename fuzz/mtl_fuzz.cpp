// SPDX-License-Identifier: MIT
// Any text gives materials with finite numbers in their ranges.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "io/mtl.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  for (const auto& [name, material] : vantage::parse_mtl(text)) {
    for (const double channel : material.colour) {
      if (!(channel >= 0.0 && channel <= 1.0)) {
        std::abort();
      }
    }
    if (!(material.opacity >= 0.0 && material.opacity <= 1.0) ||
        !std::isfinite(material.picture.scale[0]) || !std::isfinite(material.mask.offset[1])) {
      std::abort();
    }
  }
  return 0;
}
