// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <random>

#include "vantage/core/vec3.h"
#include "vantage/mesh/tri_mesh.h"

namespace vantage::test {

/// Triangles of all sizes and shapes drawn by lot, each apart, that pass through each other.
inline TriMesh random_soup(int faces, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> coordinate(-1.0, 1.0);
  std::uniform_real_distribution<double> aside(-0.7, 0.7);
  const auto place = [&](auto& of) { return Vec3(of(random), of(random), of(random)); };
  TriMesh mesh;
  for (std::uint32_t f = 0; f < static_cast<std::uint32_t>(faces); ++f) {
    const Vec3 middle = place(coordinate);
    for (int k = 0; k < 3; ++k) {
      mesh.positions.emplace_back(middle + place(aside));
    }
    mesh.triangles.push_back({3 * f, 3 * f + 1, 3 * f + 2});
  }
  return mesh;
}

}  // namespace vantage::test
