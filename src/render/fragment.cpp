// SPDX-License-Identifier: MIT
#include "render/fragment.h"

#include <algorithm>
#include <array>

namespace vantage {
namespace {

/// How far neighbours may lie from the plane of a fragment, px. [ours]
constexpr float kNeighbourPx = 2.0F;
/// How much their colours may differ, over their brightness. [ours]
constexpr float kAlikeColour = 0.25F;
constexpr std::array<std::array<int, 2>, 4> kBeside{{{-1, 0}, {1, 0}, {0, -1}, {0, 1}}};

}  // namespace

bool FragmentRows::is_plain(int x, int y, std::size_t coat, float pixel) const {
  const Fragment& own = at(x, y);
  const CoatFragment& own_coat = at(x, y, coat);
  if (own.hit ? !(own.one_patch && own_coat.even) : own.line || own_coat.tube) {
    return false;
  }
  for (const auto& [right, down] : kBeside) {
    if (!has(x + right, y + down)) {
      continue;
    }
    const Fragment& other = at(x + right, y + down);
    const CoatFragment& other_coat = at(x + right, y + down, coat);
    if (other.line || other_coat.tube || other.full != own.hit || other.hit != own.hit) {
      return false;
    }
    if (!own.hit) {
      continue;
    }
    if (!same_patch(own.place, other.place, kNeighbourPx * pixel)) {
      return false;
    }
    const float most = kAlikeColour * (own_coat.albedo.maxCoeff() + kDarkestColour);
    if (other.one_patch && (own_coat.albedo - other_coat.albedo).cwiseAbs().maxCoeff() > most) {
      return false;
    }
  }
  return true;
}

bool FragmentRows::may_break(int x, int y, float tolerance) const {
  if (!has(x, y)) {
    return true;
  }
  const Fragment& own = at(x, y);
  if (own.hit && !(own.one_patch && own.off_plane <= tolerance)) {
    return true;
  }
  return std::any_of(kBeside.begin(), kBeside.end(), [&](const auto& step) {
    if (!has(x + step[0], y + step[1])) {
      return true;
    }
    const Fragment& other = at(x + step[0], y + step[1]);
    return other.hit != own.hit || other.full != own.hit ||
           (own.hit && !same_patch(own.place, other.place, tolerance));
  });
}

}  // namespace vantage
