// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "vantage/core/vec3.h"
#include "vantage/io/write.h"

/// \file
/// Numbers as the page report.html reads them: viewer/README.md.

namespace vantage {

/// Model coordinates to radii of the enclosing sphere around its centre, which the page works in.
struct PageFrame {
  Vec3 centre = Vec3::Zero();
  double radius = 1.0;

  [[nodiscard]] Vec3 to(const Vec3& p) const { return (p - centre) / radius; }
};

/// The values' bytes as they are in memory.
template <class Value>
std::string base64_of(const std::vector<Value>& values) {
  const auto* bytes = static_cast<const char*>(static_cast<const void*>(values.data()));
  return base64({bytes, values.size() * sizeof(Value)});
}

/// Some of the positions, 16 bit a coordinate, in base64.
std::string packed_positions(const std::vector<Vec3>& positions,
                             const std::vector<std::uint32_t>& rows, const PageFrame& frame);

}  // namespace vantage
