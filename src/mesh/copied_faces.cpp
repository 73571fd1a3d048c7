// SPDX-License-Identifier: MIT
#include "mesh/copied_faces.h"

#include <algorithm>
#include <bit>
#include <utility>

namespace vantage {
namespace {

/// The finaliser of SplitMix64: Steele, Lea, Flood, "Fast Splittable Pseudorandom Number Generators", 2014.
std::uint64_t mixed(std::uint64_t x) {
  x = (x ^ (x >> 30U)) * 0xbf58476d1ce4e5b9U;
  x = (x ^ (x >> 27U)) * 0x94d049bb133111ebU;
  return x ^ (x >> 31U);
}

std::vector<std::uint64_t> hashes_of_places(const std::vector<Vec3>& positions) {
  std::vector<std::uint64_t> hashes;
  hashes.reserve(positions.size());
  for (const Vec3& p : positions) {
    std::uint64_t hash = 0;
    for (const double c : {p.x(), p.y(), p.z()}) {
      hash = mixed(hash + std::bit_cast<std::uint64_t>(c + 0.0));  // −0 is 0
    }
    hashes.push_back(hash);
  }
  return hashes;
}

}  // namespace

std::vector<std::uint32_t> faces_beyond_copies(const TriMesh& mesh) {
  const std::vector<std::uint64_t> hashes = hashes_of_places(mesh.positions);
  const auto key = [&](std::size_t f) {
    const Triangle& t = mesh.triangles[f];
    return hashes[t[0]] + hashes[t[1]] + hashes[t[2]];
  };
  // Eight faces of different places in a counter in the mean: more than kMostCopies are copies.
  const std::size_t faces = mesh.triangles.size();
  std::vector<std::uint32_t> counts(std::bit_ceil(faces / 8 + 1), 0);
  const std::size_t mask = counts.size() - 1;
  for (std::size_t f = 0; f < faces; ++f) {
    ++counts[key(f) & mask];
  }
  std::vector<std::pair<std::uint64_t, std::uint32_t>> suspects;
  for (std::size_t f = 0; f < faces; ++f) {
    if (counts[key(f) & mask] > kMostCopies) {
      suspects.emplace_back(key(f), static_cast<std::uint32_t>(f));
    }
  }
  std::sort(suspects.begin(), suspects.end());
  std::vector<std::uint32_t> beyond;
  for (std::size_t i = kMostCopies; i < suspects.size(); ++i) {
    if (suspects[i].first == suspects[i - kMostCopies].first) {
      beyond.push_back(suspects[i].second);
    }
  }
  std::sort(beyond.begin(), beyond.end());
  return beyond;
}

}  // namespace vantage
