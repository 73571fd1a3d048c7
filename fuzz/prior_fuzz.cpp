// SPDX-License-Identifier: MIT
// Any text gives a prior whose factors are finite and not negative, or a FormatError.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "vantage/core/error.h"
#include "vantage/view/prior.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    const vantage::ViewPrior prior = vantage::parse_prior(
        std::string_view(reinterpret_cast<const char*>(data), size), "fuzz.json");
    const vantage::UprightFrame frame = vantage::upright_frame(vantage::Vec3::UnitY());
    for (const vantage::Vec3& direction :
         {vantage::Vec3(1.0, 0.0, 0.0), vantage::Vec3(0.0, 1.0, 0.0),
          vantage::Vec3(0.6, 0.0, 0.8)}) {
      const double factor = prior.factor(frame, direction);
      if (!std::isfinite(factor) || factor < 0.0) {
        std::abort();
      }
    }
  } catch (const vantage::FormatError&) {
    return 0;
  }
  return 0;
}
