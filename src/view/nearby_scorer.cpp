// SPDX-License-Identifier: MIT
#include "view/nearby_scorer.h"

#include <algorithm>
#include <bit>
#include <iterator>
#include <optional>
#include <utility>

#include <Eigen/Geometry>

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

/// Whether a direction is inside of a circle or on it; what is outside may see what nobody on the
/// circle does.
bool is_within(const std::vector<Vec3>& circle, const Vec3& direction) {
  constexpr double kOnEdge = 1e-9;
  const Vec3& middle = circle.front();
  for (std::size_t k = 1; k < circle.size(); ++k) {
    const Vec3 edge = circle[k].cross(circle[k + 1 < circle.size() ? k + 1 : 1]);
    if (edge.dot(direction) * edge.dot(middle) < -kOnEdge * edge.squaredNorm()) {
      return false;
    }
  }
  return direction.dot(middle) > 0.0;
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
  using Bytes = std::vector<std::uint8_t>;

  double sum = 0.0;                       // of what all of them see
  std::vector<std::uint32_t> disputed{};  // vertices that some of them see and others do not
  std::optional<NearbySight> sight{};     // of these
  std::shared_ptr<Midst> wider{};         // the midst that this one is in, if any
  std::map<Key, Bytes> seen{};            // of the disputed, from the directions asked about

  Circles circles{};

  /// Looks in some directions; those too far out are left.
  void look(std::span<const Vec3> directions, const ScoringCamera& camera, const RunContext& run);

  [[nodiscard]] double score(const Bytes& of_disputed, std::span<const double> significance) const {
    double score = sum;
    for (std::size_t k = 0; k < disputed.size(); ++k) {
      score += of_disputed[k] != 0 ? significance[disputed[k]] : 0.0;
    }
    return score;
  }
};

void NearbyScorer::Midst::look(std::span<const Vec3> directions, const ScoringCamera& camera,
                               const RunContext& run) {
  std::vector<std::pair<Viewpoint, Bytes*>> fresh;
  for (const Vec3& direction : directions) {
    const Viewpoint eye = camera.viewpoint(direction);
    if (is_within(circles.back(), direction) && sight->covers(eye)) {
      const auto [at, is_new] = seen.try_emplace(bits_of(direction));
      if (is_new) {
        fresh.emplace_back(eye, &at->second);
      }
    }
  }
  parallel_for(run, fresh.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      *fresh[i].second = sight->seen(fresh[i].first);
    }
  });
}

NearbyScorer::NearbyScorer(const VertexVisibility& visibility, std::span<const double> significance,
                           const ScoringCamera& camera)
    : visibility_(visibility), significance_(significance), camera_(camera) {}

NearbyScorer::~NearbyScorer() = default;

NearbyScorer::Seen NearbyScorer::look(const Vec3& direction, const RunContext& run) const {
  const std::vector<std::uint8_t> visible =
      visibility_.visible_vertices(camera_.viewpoint(direction), run);
  Seen seen((visible.size() + kBits - 1) / kBits, 0);
  for (std::size_t v = 0; v < visible.size(); ++v) {
    seen[v / kBits] |= static_cast<std::uint64_t>(visible[v]) << (v % kBits);
  }
  return seen;
}

/// visible_sum(), in its order.
double NearbyScorer::sum_of(const Seen& seen) const {
  double sum = 0.0;
  for (std::size_t w = 0; w < seen.size(); ++w) {
    for (std::uint64_t left = seen[w]; left != 0; left &= left - 1) {
      sum += significance_[w * kBits + static_cast<std::size_t>(std::countr_zero(left))];
    }
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
  parallel_items(run, directions.size(), [&](std::size_t i, const RunContext& own) {
    seen[i] = look(directions[i], own);
    scores[i] = sum_of(seen[i]);
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
    at->second = look(direction, {});
  }
  return at->second;
}

std::vector<const NearbyScorer::Seen*> NearbyScorer::seen_from(const std::vector<Vec3>& circle) {
  std::vector<const Seen*> seen;
  seen.reserve(circle.size());
  for (const Vec3& direction : circle) {
    seen.push_back(&seen_from(direction));  // stays where it is in the map
  }
  return seen;
}

std::shared_ptr<NearbyScorer::Midst> NearbyScorer::midst_of_scored(
    const std::vector<Vec3>& circle, std::span<const Seen* const> seen) const {
  Seen by_all = *seen.front();
  Seen by_some = by_all;
  for (const Seen* one : seen) {
    for (std::size_t w = 0; w < one->size(); ++w) {
      by_all[w] &= (*one)[w];
      by_some[w] |= (*one)[w];
    }
  }
  auto midst = std::make_shared<Midst>();
  midst->circles = {circle};
  midst->sum = sum_of(by_all);
  for (std::size_t w = 0; w < by_all.size(); ++w) {
    for (std::uint64_t left = by_some[w] & ~by_all[w]; left != 0; left &= left - 1) {
      midst->disputed.push_back(
          static_cast<std::uint32_t>(w * kBits + static_cast<std::size_t>(std::countr_zero(left))));
    }
  }
  midst->sight.emplace(visibility_, midst->disputed, eyes_of(camera_, circle));
  return midst;
}

/// \return the wider one itself if some of the circle are too far out of it.
std::shared_ptr<NearbyScorer::Midst> NearbyScorer::midst_within(
    std::shared_ptr<Midst> wider, const std::vector<Vec3>& circle) const {
  wider->look(circle, camera_, {.max_threads = 1});
  std::vector<const Midst::Bytes*> seen;
  for (const Vec3& direction : circle) {
    const auto known = wider->seen.find(bits_of(direction));
    if (known == wider->seen.end()) {
      return wider;
    }
    seen.push_back(&known->second);
  }
  auto midst = std::make_shared<Midst>();
  midst->circles = wider->circles;
  midst->circles.push_back(circle);
  midst->sum = wider->sum;
  std::vector<std::uint32_t> chosen;
  for (std::uint32_t k = 0; k < wider->disputed.size(); ++k) {
    const auto count = std::count_if(seen.begin(), seen.end(),
                                     [&](const Midst::Bytes* one) { return (*one)[k] != 0; });
    const std::uint32_t v = wider->disputed[k];
    if (count == static_cast<std::ptrdiff_t>(seen.size())) {
      midst->sum += significance_[v];
    } else if (count > 0) {
      chosen.push_back(k);
      midst->disputed.push_back(v);
    }
  }
  midst->sight.emplace(*wider->sight, chosen, eyes_of(camera_, circle));
  midst->wider = std::move(wider);
  return midst;
}

std::shared_ptr<NearbyScorer::Midst> NearbyScorer::known_midst(const Circles& circles) const {
  const auto known = std::find_if(midsts_.begin(), midsts_.end(),
                                  [&](const auto& midst) { return midst->circles == circles; });
  return known != midsts_.end() ? *known : nullptr;
}

void NearbyScorer::remember(std::shared_ptr<Midst> midst) {
  if (std::find(midsts_.begin(), midsts_.end(), midst) != midsts_.end()) {
    return;  // a wider one, again
  }
  if (midsts_.size() == kMostMidsts) {
    midsts_.erase(midsts_.begin());
  }
  midsts_.push_back(std::move(midst));
}

std::shared_ptr<NearbyScorer::Midst> NearbyScorer::midst_of(const Circles& circles) {
  std::shared_ptr<Midst> midst = known_midst(circles);
  if (midst == nullptr) {
    midst = circles.size() == 1
                ? midst_of_scored(circles.front(), seen_from(circles.front()))
                : midst_within(midst_of({circles.begin(), circles.end() - 1}), circles.back());
    remember(midst);
  }
  return midst;
}

void NearbyScorer::expect(std::span<const Circles> all, const RunContext& run) {
  struct Job {
    const std::vector<Vec3>* circle;
    std::vector<const Seen*> seen{};  // from a circle without a wider one
    std::shared_ptr<Midst> wider{};   // else
    std::shared_ptr<Midst> made{};
  };

  std::vector<Vec3> missing;
  for (const Circles& circles : all) {
    std::copy_if(circles.front().begin(), circles.front().end(), std::back_inserter(missing),
                 [&](const Vec3& direction) {
                   return circles.size() == 1 && !remembered_.contains(bits_of(direction));
                 });
  }
  score_all(missing, run);
  std::vector<Job> jobs;
  for (const Circles& circles : all) {
    Job job{&circles.back()};
    if (circles.size() == 1) {
      job.seen = seen_from(circles.back());
    } else {
      job.wider = midst_of({circles.begin(), circles.end() - 1});
    }
    // Two in the midst of one would both look through it; the second is made when it is asked for.
    const bool is_alone = std::none_of(jobs.begin(), jobs.end(), [&](const Job& other) {
      return job.wider != nullptr && other.wider == job.wider;
    });
    if (is_alone && known_midst(circles) == nullptr) {
      jobs.push_back(std::move(job));
    }
  }
  parallel_for(run, jobs.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      Job& job = jobs[i];
      job.made = job.wider == nullptr ? midst_of_scored(*job.circle, job.seen)
                                      : midst_within(job.wider, *job.circle);
    }
  });
  for (Job& job : jobs) {
    remember(std::move(job.made));
  }
}

std::vector<double> NearbyScorer::score_amid(const Circles& circles,
                                             std::span<const Vec3> directions,
                                             const RunContext& run) {
  std::vector<std::optional<double>> found(directions.size());
  std::vector<Vec3> left(directions.begin(), directions.end());
  for (auto midst = midst_of(circles); midst != nullptr && !left.empty(); midst = midst->wider) {
    midst->look(left, camera_, run);
    left.clear();
    for (std::size_t i = 0; i < directions.size(); ++i) {
      const auto seen = midst->seen.find(bits_of(directions[i]));
      if (!found[i] && seen != midst->seen.end()) {
        found[i] = midst->score(seen->second, significance_);
      } else if (!found[i]) {
        left.push_back(directions[i]);
      }
    }
  }
  const std::vector<double> exact = score_all(left, run);
  std::size_t next = 0;
  std::vector<double> scores;
  scores.reserve(directions.size());
  for (const std::optional<double>& score : found) {
    scores.push_back(score ? *score : exact[next++]);
  }
  return scores;
}

}  // namespace vantage
