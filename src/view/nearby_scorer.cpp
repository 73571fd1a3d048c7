// SPDX-License-Identifier: MIT
#include "view/nearby_scorer.h"

#include <algorithm>
#include <bit>
#include <utility>

#include "core/parallel.h"
#include "visibility/nearby_sight.h"

namespace vantage {
namespace {

constexpr std::size_t kBits = 64;
// What was seen is remembered for so many bytes: a search of three million vertices fits. [ours]
constexpr std::size_t kMostBytes = std::size_t{128} << 20;
// Directions around which much is made ready at a time: a search has a few hills in hand. [ours]
constexpr std::size_t kMostMidsts = 8;

std::array<std::uint64_t, 3> bits_of(const Vec3& direction) {
  return {std::bit_cast<std::uint64_t>(direction.x()), std::bit_cast<std::uint64_t>(direction.y()),
          std::bit_cast<std::uint64_t>(direction.z())};
}

std::vector<Viewpoint> eyes_of(const ScoringCamera& camera, std::span<const Vec3> directions) {
  std::vector<Viewpoint> eyes;
  for (const Vec3& direction : directions) {
    eyes.push_back(camera.viewpoint(direction));
  }
  return eyes;
}

}  // namespace

/// What is ready for directions in the midst of some.
struct NearbyScorer::Midst {
  std::vector<Vec3> others;
  double sum;                           // of what all of them see
  std::vector<std::uint32_t> disputed;  // seen by some of them
  NearbySight sight;
};

NearbyScorer::NearbyScorer(const VertexVisibility& visibility, std::span<const double> significance,
                           const ScoringCamera& camera)
    : visibility_(visibility), significance_(significance), camera_(camera) {}

NearbyScorer::~NearbyScorer() = default;

NearbyScorer::Seen NearbyScorer::look(const Vec3& direction) const {
  const RunContext alone{.max_threads = 1};
  const std::vector<std::uint8_t> visible =
      visibility_.visible_vertices(camera_.viewpoint(direction), alone);
  Seen seen((visible.size() + kBits - 1) / kBits, 0);
  for (std::size_t v = 0; v < visible.size(); ++v) {
    seen[v / kBits] |= static_cast<std::uint64_t>(visible[v]) << (v % kBits);
  }
  return seen;
}

/// visible_sum(), in its order.
double NearbyScorer::sum_of(const Seen& seen) const {
  double sum = 0.0;
  for (std::size_t v = 0; v < significance_.size(); ++v) {
    sum += (seen[v / kBits] >> (v % kBits) & 1U) != 0 ? significance_[v] : 0.0;
  }
  return sum;
}

void NearbyScorer::forget_if_full() {
  const std::size_t bytes = (significance_.size() + kBits - 1) / kBits * sizeof(std::uint64_t);
  if (remembered_.size() * bytes > kMostBytes) {
    remembered_.clear();
  }
}

std::vector<double> NearbyScorer::score_all(std::span<const Vec3> directions,
                                            const RunContext& run) {
  std::vector<Seen> seen(directions.size());
  std::vector<double> scores(directions.size(), 0.0);
  parallel_for(run, directions.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      seen[i] = look(directions[i]);
      scores[i] = sum_of(seen[i]);
    }
  });
  forget_if_full();
  for (std::size_t i = 0; i < seen.size(); ++i) {
    remembered_.try_emplace(bits_of(directions[i]), std::move(seen[i]));
  }
  return scores;
}

const NearbyScorer::Seen& NearbyScorer::seen_from(const Vec3& direction) {
  const auto [at, is_new] = remembered_.try_emplace(bits_of(direction));
  if (is_new) {
    at->second = look(direction);
  }
  return at->second;
}

const NearbyScorer::Midst& NearbyScorer::midst_of(std::span<const Vec3> others) {
  const auto known = std::find_if(midsts_.begin(), midsts_.end(), [&](const auto& midst) {
    return std::equal(midst->others.begin(), midst->others.end(), others.begin(), others.end());
  });
  if (known != midsts_.end()) {
    return **known;
  }
  Seen by_all = seen_from(others.front());
  Seen by_some = by_all;
  for (const Vec3& other : others.subspan(1)) {
    const Seen& seen = seen_from(other);
    for (std::size_t w = 0; w < seen.size(); ++w) {
      by_all[w] &= seen[w];
      by_some[w] |= seen[w];
    }
  }
  std::vector<std::uint32_t> disputed;
  for (std::uint32_t v = 0; v < significance_.size(); ++v) {
    if (((by_some[v / kBits] & ~by_all[v / kBits]) >> (v % kBits) & 1U) != 0) {
      disputed.push_back(v);
    }
  }
  if (midsts_.size() == kMostMidsts) {
    midsts_.erase(midsts_.begin());
  }
  NearbySight sight(visibility_, disputed, eyes_of(camera_, others));
  midsts_.push_back(std::make_unique<Midst>(Midst{
      {others.begin(), others.end()}, sum_of(by_all), std::move(disputed), std::move(sight)}));
  return *midsts_.back();
}

std::vector<double> NearbyScorer::score_amid(std::span<const Vec3> others,
                                             std::span<const Vec3> directions,
                                             const RunContext& run) {
  const Midst& midst = midst_of(others);
  std::vector<double> scores(directions.size(), 0.0);
  parallel_for(run, directions.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const Viewpoint eye = camera_.viewpoint(directions[i]);
      if (!midst.sight.covers(eye)) {
        scores[i] = sum_of(look(directions[i]));
        continue;
      }
      const std::vector<std::uint8_t> seen = midst.sight.seen(eye);
      scores[i] = midst.sum;
      for (std::size_t k = 0; k < seen.size(); ++k) {
        scores[i] += seen[k] != 0 ? significance_[midst.disputed[k]] : 0.0;
      }
    }
  });
  return scores;
}

}  // namespace vantage
