// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "vantage/mesh/tri_mesh.h"

#include "support/shapes.h"

namespace vantage::test {

/// The face of `mesh` that reaches farthest along x in the sense of `sign`, by its corners' mean.
inline std::size_t extreme_face(const TriMesh& mesh, double sign) {
  const auto reach = [&](const Triangle& t) {
    return sign * (mesh.positions[t[0]] + mesh.positions[t[1]] + mesh.positions[t[2]]).x();
  };
  const auto best =
      std::max_element(mesh.triangles.begin(), mesh.triangles.end(),
                       [&](const Triangle& s, const Triangle& t) { return reach(s) < reach(t); });
  return static_cast<std::size_t>(best - mesh.triangles.begin());
}

/// Connected sum: `second`, moved by `shift` along x, joined to `first` by a prism of six triangles
/// in place of the facing pair of triangles. Vertices of `first` keep their indices, those of
/// `second` follow. Oriented if both are.
inline TriMesh joined(const TriMesh& first, const TriMesh& second, double shift) {
  TriMesh mesh = together(first, second, Vec3(shift, 0.0, 0.0));
  const std::size_t i = extreme_face(first, 1.0);
  const std::size_t j = first.triangles.size() + extreme_face(second, -1.0);
  const Triangle a = mesh.triangles[i];
  const Triangle b = mesh.triangles[j];
  mesh.triangles.erase(mesh.triangles.begin() + static_cast<std::ptrdiff_t>(j));
  mesh.triangles.erase(mesh.triangles.begin() + static_cast<std::ptrdiff_t>(i));
  // Opposite corners run the other way round; of the three ways take the least twisted.
  std::size_t best = 0;
  double least = 1e300;
  for (std::size_t turn = 0; turn < 3; ++turn) {
    double sum = 0.0;
    for (std::size_t c = 0; c < 3; ++c) {
      sum += (mesh.positions[a[c]] - mesh.positions[b[(turn + 3 - c) % 3]]).norm();
    }
    if (sum < least) {
      least = sum;
      best = turn;
    }
  }
  for (std::size_t c = 0; c < 3; ++c) {
    const std::uint32_t p = a[c];
    const std::uint32_t q = a[(c + 1) % 3];
    const std::uint32_t across_p = b[(best + 3 - c) % 3];
    const std::uint32_t across_q = b[(best + 5 - c) % 3];
    mesh.triangles.push_back({p, q, across_q});
    mesh.triangles.push_back({p, across_q, across_p});
  }
  return mesh;
}

/// Two tori side by side, joined: genus 2.
inline TriMesh genus_two(int major_segments, int minor_segments) {
  const TriMesh half = torus(1.0, 0.35, major_segments, minor_segments);
  return joined(half, half, 2.0 * 1.35 + 0.2);
}

}  // namespace vantage::test
