// SPDX-License-Identifier: MIT
// Any bytes give a model with valid indices and finite points, or a FormatError.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "vantage/core/error.h"
#include "vantage/io/model.h"
#include "vantage/mesh/mesh_check.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    const vantage::Model model =
        vantage::parse_model(std::string_view(reinterpret_cast<const char*>(data), size),
                             VANTAGE_FUZZ_NAME, {}, {.appearance = true});
    for (const vantage::Triangle& triangle : model.mesh.triangles) {
      for (const std::uint32_t v : triangle) {
        if (v >= model.mesh.positions.size()) {
          std::abort();
        }
      }
    }
    for (const vantage::Vec3& point : model.mesh.positions) {
      if (!point.allFinite()) {
        std::abort();
      }
    }
    if (vantage::check_mesh(model.mesh).faces != model.mesh.triangles.size()) {
      std::abort();
    }
  } catch (const vantage::FormatError&) {
    return 0;
  }
  return 0;
}
