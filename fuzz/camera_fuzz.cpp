// SPDX-License-Identifier: MIT
// Any bytes give a camera that can take a picture, or a FormatError.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "vantage/core/error.h"
#include "vantage/io/camera_files.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    const vantage::Camera camera = vantage::parse_camera(
        std::string_view(reinterpret_cast<const char*>(data), size), "fuzz.json");
    if (!camera.eye.allFinite() || !camera.up.allFinite() || camera.eye == camera.target) {
      std::abort();
    }
  } catch (const vantage::FormatError&) {
    return 0;
  }
  return 0;
}
