// SPDX-License-Identifier: MIT
// Any bytes give finite points, or a FormatError.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "vantage/core/error.h"
#include "vantage/io/model.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    for (const vantage::Vec3& point :
         vantage::parse_points_csv(std::string_view(reinterpret_cast<const char*>(data), size),
                                   "fuzz.csv", {"dx", "dy", "dz"})) {
      if (!point.allFinite()) {
        std::abort();
      }
    }
  } catch (const vantage::FormatError&) {
    return 0;
  }
  return 0;
}
