// SPDX-License-Identifier: MIT
#include "render/fragment.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace vantage {
namespace {

/// How far neighbours may lie from the plane of a fragment, px. [ours]
constexpr float kNeighbourPx = 2.0F;
/// Least cosine between the normals of neighbours that one sample stands for. [ours]
constexpr float kOnePatch = 0.96F;
/// How much their colours may differ, over their brightness. [ours]
constexpr float kAlikeColour = 0.12F;
/// Weight of a neighbour along a row or column; with it the mean over 3 × 3 pixels spreads as far
/// as the tent of sample_pattern(), whose variance is 0.75² / 6.
constexpr float kBesideShare = 0.047F;

constexpr std::array<std::array<int, 2>, 4> kBeside{{{-1, 0}, {1, 0}, {0, -1}, {0, 1}}};

/// Weighted mean over 3 × 3 pixels, without those that are not there.
template <class ValueAt>
Vec3f mixed(const FragmentRows& rows, int x, int y, const ValueAt& value_at) {
  Vec3f sum = Vec3f::Zero();
  float weights = 0.0F;
  for (int j = y - 1; j <= y + 1; ++j) {
    for (int i = x - 1; i <= x + 1; ++i) {
      if (rows.has(i, j) && rows.at(i, j).hit) {
        const float weight = (i == x ? 1.0F - 2.0F * kBesideShare : kBesideShare) *
                             (j == y ? 1.0F - 2.0F * kBesideShare : kBesideShare);
        sum += weight * value_at(i, j);
        weights += weight;
      }
    }
  }
  return sum / weights;
}

}  // namespace

SampleNeed FragmentRows::need(int x, int y, float pixel) const {
  const Fragment& own = at(x, y);
  SampleNeed need = own.line || own.breaks ? SampleNeed::All : SampleNeed::One;
  // Breaks are found at a pixel's lower right corner: those above and to the left share one with it.
  if (has(x - 1, y - 1) && at(x - 1, y - 1).breaks) {
    need = SampleNeed::All;
  }
  for (const auto& [right, down] : kBeside) {
    if (need == SampleNeed::All || !has(x + right, y + down)) {
      continue;
    }
    const Fragment& other = at(x + right, y + down);
    if (other.line || other.breaks || other.hit != own.hit) {
      need = SampleNeed::All;
    } else if (own.hit) {
      const float off = own.place.normal.dot(other.place.position - own.place.position);
      const bool is_bent = own.place.normal.dot(other.place.normal) < kOnePatch;
      need = std::abs(off) > kNeighbourPx * pixel ? SampleNeed::All
             : is_bent                            ? SampleNeed::Few
                                                  : need;
    }
  }
  return need;
}

SampleNeed FragmentRows::need_of_paint(int x, int y, std::size_t paint,
                                       SampleNeed of_surface) const {
  const PaintFragment& own = at(x, y, paint);
  const bool is_hit = at(x, y).hit;
  const float most = kAlikeColour * ((own.albedo + own.emission).maxCoeff() + kDarkestColour);
  const auto differs = [most](const Vec3f& a, const Vec3f& b) {
    return (a - b).cwiseAbs().maxCoeff() > most;
  };
  SampleNeed need = own.tube || (is_hit && !own.opaque) ? SampleNeed::Few : SampleNeed::One;
  for (const auto& [right, down] : kBeside) {
    if (!has(x + right, y + down)) {
      continue;
    }
    const PaintFragment& other = at(x + right, y + down, paint);
    if (other.tube != own.tube) {
      return SampleNeed::All;
    }
    if (is_hit && (other.opaque != own.opaque || differs(own.albedo, other.albedo) ||
                   differs(own.emission, other.emission))) {
      need = SampleNeed::Few;
    }
  }
  return std::max(need, of_surface);
}

Vec3f FragmentRows::mixed_normal(int x, int y) const {
  return mixed(*this, x, y, [this](int i, int j) { return at(i, j).place.normal; }).normalized();
}

Vec3f FragmentRows::mixed_albedo(int x, int y, std::size_t paint) const {
  return mixed(*this, x, y, [this, paint](int i, int j) { return at(i, j, paint).albedo; });
}

Vec3f FragmentRows::mixed_emission(int x, int y, std::size_t paint) const {
  return mixed(*this, x, y, [this, paint](int i, int j) { return at(i, j, paint).emission; });
}

bool FragmentRows::may_break(int x, int y, float tolerance) const {
  if (!has(x, y)) {
    return true;
  }
  const Fragment& own = at(x, y);
  for (int j = y - 1; j <= y + 1; ++j) {
    for (int i = x - 1; i <= x + 1; ++i) {
      if (!has(i, j) || at(i, j).hit != own.hit || at(i, j).breaks ||
          (own.hit && !same_patch(own.place, at(i, j).place, tolerance))) {
        return true;
      }
    }
  }
  return false;
}

}  // namespace vantage
