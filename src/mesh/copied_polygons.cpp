// SPDX-License-Identifier: MIT
#include "mesh/copied_polygons.h"

#include <algorithm>
#include <bit>
#include <optional>

#include "mesh/place_hash.h"

namespace vantage {
namespace {

/// A polygon of four or more corners.
struct HashedPolygon {
  std::uint64_t hash = 0;  // of its places, in whatever order
  std::size_t polygon = 0;
  std::size_t first_corner = 0;
};

std::vector<HashedPolygon> hashed_polygons(std::span<const std::uint32_t> corners,
                                           std::span<const std::uint32_t> counts,
                                           std::span<const Vec3> positions) {
  std::vector<HashedPolygon> polygons;
  std::size_t first = 0;
  for (std::size_t p = 0; p < counts.size(); first += counts[p++]) {
    if (counts[p] > 3) {
      std::uint64_t hash = 0;
      for (const std::uint32_t vertex : corners.subspan(first, counts[p])) {
        hash += place_hash(positions[vertex]);
      }
      polygons.push_back({hash, p, first});
    }
  }
  return polygons;
}

/// Keeps those whose hash another one may have, by hash: sorting all would take longer than to cut them.
void keep_alike(std::vector<HashedPolygon>& polygons) {
  const std::size_t mask = std::bit_ceil(16 * polygons.size() + 1) - 1;
  std::vector<bool> is_met(mask + 1, false);
  std::vector<bool> is_met_again(mask + 1, false);
  for (const HashedPolygon& p : polygons) {
    const std::size_t slot = p.hash & mask;
    is_met_again[slot] = is_met[slot];
    is_met[slot] = true;
  }
  std::erase_if(polygons, [&](const HashedPolygon& p) { return !is_met_again[p.hash & mask]; });
  std::stable_sort(polygons.begin(), polygons.end(),
                   [](const auto& a, const auto& b) { return a.hash < b.hash; });
}

/// How a polygon goes around the places of another of as many corners, if it does.
class Alignment {
 public:
  Alignment(std::span<const std::uint32_t> earlier, std::span<const std::uint32_t> later,
            std::span<const Vec3> positions)
      : earlier_(earlier), later_(later), positions_(positions), steps_left_(16 * later.size()) {}

  /// \return without the polygon's number
  std::optional<CopiedPolygon> find() {
    for (std::uint32_t start = 0; start < later_.size() && steps_left_ > 0; ++start) {
      for (const bool is_reversed : {false, true}) {
        if (fits(start, is_reversed)) {
          return CopiedPolygon{0, start, is_reversed};
        }
      }
    }
    return std::nullopt;
  }

 private:
  bool fits(std::size_t start, bool is_reversed) {
    const std::size_t n = later_.size();
    for (std::size_t i = 0; i < n; ++i) {
      if (steps_left_ == 0) {
        return false;
      }
      --steps_left_;
      const std::size_t at = (start + (is_reversed ? n - i : i)) % n;
      if (positions_[earlier_[i]] != positions_[later_[at]]) {
        return false;
      }
    }
    return true;
  }

  std::span<const std::uint32_t> earlier_;
  std::span<const std::uint32_t> later_;
  std::span<const Vec3> positions_;
  std::size_t steps_left_;  // where few places repeat, each start may fit nearly to the end
};

}  // namespace

std::vector<CopiedPolygon> copied_polygons(std::span<const std::uint32_t> corners,
                                           std::span<const std::uint32_t> counts,
                                           std::span<const Vec3> positions) {
  std::vector<HashedPolygon> polygons = hashed_polygons(corners, counts, positions);
  keep_alike(polygons);
  std::vector<CopiedPolygon> copies;
  const HashedPolygon* first = nullptr;  // of a hash
  for (const HashedPolygon& p : polygons) {
    if (first == nullptr || first->hash != p.hash || counts[first->polygon] != counts[p.polygon]) {
      first = &p;
      continue;
    }
    Alignment alignment(corners.subspan(first->first_corner, counts[p.polygon]),
                        corners.subspan(p.first_corner, counts[p.polygon]), positions);
    if (std::optional<CopiedPolygon> copy = alignment.find()) {
      copy->polygon = p.polygon;
      copies.push_back(*copy);
    }
  }
  std::sort(copies.begin(), copies.end(),
            [](const auto& a, const auto& b) { return a.polygon < b.polygon; });
  return copies;
}

}  // namespace vantage
