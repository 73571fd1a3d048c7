// SPDX-License-Identifier: MIT
// Any bytes give a picture of the size it says, or a problem.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "io/picture_decoding.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  constexpr std::size_t kMostPixels = 1 << 16;  // so that a run is quick
  const vantage::DecodedPicture picture = vantage::decode_picture(
      std::string_view(reinterpret_cast<const char*>(data), size), kMostPixels);
  if (picture.image.has_value() != picture.problem.empty()) {
    std::abort();
  }
  if (picture.image && picture.image->rgba.size() !=
                           std::size_t{4} * static_cast<std::size_t>(picture.image->width) *
                               static_cast<std::size_t>(picture.image->height)) {
    std::abort();
  }
  return 0;
}
