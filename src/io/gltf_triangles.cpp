// SPDX-License-Identifier: MIT
#include "io/gltf_triangles.h"

#include <string>

#include <tiny_gltf.h>

namespace vantage {

void add_gltf_triangles(const std::vector<std::uint64_t>& corners, int mode, std::size_t first,
                        bool mirrored, ModelBuilder& builder) {
  const Place place{"vertex", first};
  const auto add = [&](std::size_t a, std::size_t b, std::size_t c) {
    const std::uint64_t second = corners[mirrored ? c : b];
    const std::uint64_t third = corners[mirrored ? b : c];
    builder.add_triangle(first + corners[a], first + second, first + third, place);
  };
  if (mode == TINYGLTF_MODE_TRIANGLES) {
    if (corners.size() % 3 != 0) {
      builder.note("corners beyond the last whole triangle left out: " +
                   std::to_string(corners.size() % 3));
    }
    for (std::size_t i = 0; i + 2 < corners.size(); i += 3) {
      add(i, i + 1, i + 2);
    }
    return;
  }
  for (std::size_t i = 0; i + 2 < corners.size(); ++i) {
    const bool is_fan = mode == TINYGLTF_MODE_TRIANGLE_FAN;
    const std::size_t a = is_fan ? 0 : i;
    const bool joins_strips = corners[a] == corners[i + 1] || corners[i + 1] == corners[i + 2] ||
                              corners[i + 2] == corners[a];
    if (!joins_strips) {
      is_fan || i % 2 == 0 ? add(a, i + 1, i + 2) : add(i + 1, i, i + 2);
    }
  }
}

}  // namespace vantage
