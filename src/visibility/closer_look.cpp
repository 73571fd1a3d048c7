// SPDX-License-Identifier: MIT
#include "visibility/closer_look.h"

#include <cstddef>
#include <limits>

namespace vantage {
namespace {

// How far from its corner a tip is judged over how far the centroid of the part there is [ours], and
// its share of that part: where a straight edge hides some of the piece, corners that count for so
// much bring the sum of the shares that are seen nearest to the truth [docs/visibility.md].
constexpr double kNextTo = 1.0 / 16.0;
constexpr double kTipShare = 0.2;

}  // namespace

void CloserLook::add_part(const Vec3& place, double share, bool is_asked) {
  places.push_back(place);
  shares.push_back(share);
  asked.push_back(is_asked ? 1 : 0);
}

void CloserLook::add(std::uint32_t piece, std::uint32_t face, const std::array<Vec3, 3>& corners,
                     const std::array<Tip, 3>& tips, int parts) {
  pieces.push_back(piece);
  const std::size_t begin = places.size();
  first.push_back(static_cast<std::uint32_t>(begin));
  const Vec3& a = corners[0];
  const Vec3 right = (corners[1] - a) / parts;
  const Vec3 up = (corners[2] - a) / parts;
  const double share = 1.0 / (parts * parts);
  for (int i = 0; i < parts; ++i) {
    for (int j = 0; i + j < parts; ++j) {
      add_part(a + (i + 1.0 / 3.0) * right + (j + 1.0 / 3.0) * up, share, true);
      if (i + j + 1 < parts) {
        add_part(a + (i + 2.0 / 3.0) * right + (j + 2.0 / 3.0) * up, share, true);
      }
    }
  }
  // The parts at the corners, in the order above: the first, the last, and the end of the first
  // row.
  const std::array<std::size_t, 3> part_at{begin, places.size() - 1,
                                           begin + 2 * static_cast<std::size_t>(parts) - 2};
  for (std::size_t k = 0; k < 3; ++k) {
    if (tips[k] == Tip::Plain) {
      continue;
    }
    shares[part_at[k]] -= kTipShare * share;
    if (tips[k] == Tip::Hidden) {
      continue;
    }
    add_part(corners[k] + kNextTo * (places[part_at[k]] - corners[k]), kTipShare * share,
             tips[k] == Tip::Asked);
  }
  owner.resize(places.size(), face);
}

void CloserLook::end() {
  first.push_back(static_cast<std::uint32_t>(places.size()));
  pieces.push_back(std::numeric_limits<std::uint32_t>::max());
}

}  // namespace vantage
