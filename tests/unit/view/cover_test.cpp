// SPDX-License-Identifier: MIT
#include "view/cover.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include <gtest/gtest.h>

#include "vantage/core/error.h"

#include "core/random.h"

namespace vantage {
namespace {

/// A random instance: every view sees each vertex with the probability `density`.
struct Instance {
  VisibleSets sets;
  std::vector<double> weights{};

  Instance(std::size_t views, std::size_t vertices, double density, std::uint64_t seed)
      : sets(views, vertices) {
    Pcg32 random(seed);
    for (std::size_t i = 0; i < views; ++i) {
      std::vector<std::uint8_t> visible;
      for (std::size_t v = 0; v < vertices; ++v) {
        visible.push_back(random.uniform() < density ? 1 : 0);
      }
      sets.set(i, visible);
    }
    for (std::size_t v = 0; v < vertices; ++v) {
      weights.push_back(random.uniform());
    }
  }

  [[nodiscard]] double covered(const std::vector<std::size_t>& views) const {
    double sum = 0.0;
    for (std::size_t v = 0; v < weights.size(); ++v) {
      const bool seen =
          std::any_of(views.begin(), views.end(), [&](auto i) { return sets.sees(i, v); });
      sum += seen ? weights[v] : 0.0;
    }
    return sum;
  }
};

bool any(std::uint32_t /*view*/) {
  return true;
}

/// The greedy choice that looks at every view every time.
std::vector<std::size_t> plain_greedy(const Instance& instance, std::size_t count) {
  std::vector<std::size_t> chosen;
  std::vector<bool> seen(instance.weights.size(), false);
  while (chosen.size() < count) {
    std::size_t best = 0;
    double most = 0.0;
    for (std::size_t i = 0; i < instance.sets.view_count(); ++i) {
      double gain = 0.0;
      for (std::size_t v = 0; v < seen.size(); ++v) {
        gain += !seen[v] && instance.sets.sees(i, v) ? instance.weights[v] : 0.0;
      }
      if (gain > most) {
        most = gain;
        best = i;
      }
    }
    if (most == 0.0) {
      break;
    }
    chosen.push_back(best);
    for (std::size_t v = 0; v < seen.size(); ++v) {
      seen[v] = seen[v] || instance.sets.sees(best, v);
    }
  }
  return chosen;
}

std::vector<std::size_t> lazy_greedy(const Instance& instance, std::size_t count) {
  GreedyCover cover(instance.sets, instance.weights);
  std::vector<std::size_t> chosen;
  while (chosen.size() < count) {
    const GreedyCover::Pick pick = cover.next(any);
    if (pick.view == GreedyCover::kNone) {
      break;
    }
    chosen.push_back(pick.view);
    cover.mark_seen(instance.sets.row(pick.view));
  }
  return chosen;
}

/// Best coverage of any `count` of the views, by trying all.
double best_of_all(const Instance& instance, std::size_t count) {
  std::vector<std::uint8_t> taken(instance.sets.view_count(), 0);
  std::fill(taken.end() - static_cast<std::ptrdiff_t>(count), taken.end(), 1);
  double best = 0.0;
  do {
    std::vector<std::size_t> views;
    for (std::size_t i = 0; i < taken.size(); ++i) {
      if (taken[i] != 0) {
        views.push_back(i);
      }
    }
    best = std::max(best, instance.covered(views));
  } while (std::next_permutation(taken.begin(), taken.end()));
  return best;
}

TEST(GreedyCover, OffersAViewAgainWhereAnotherWasTakenInItsPlace) {
  VisibleSets sets(2, 3);
  sets.set(0, std::vector<std::uint8_t>{1, 1, 0});
  sets.set(1, std::vector<std::uint8_t>{0, 0, 1});
  GreedyCover cover(sets, std::vector<double>{1.0, 1.0, 4.0});
  ASSERT_EQ(cover.next(any).view, 1U);
  VisibleSets beside(1, 3);
  beside.set(0, std::vector<std::uint8_t>{1, 0, 0});
  cover.mark_seen(beside.row(0));
  EXPECT_EQ(cover.next(any).view, 1U);
  cover.mark_seen(sets.row(1));
  const GreedyCover::Pick last = cover.next(any);
  EXPECT_EQ(last.view, 0U);
  EXPECT_EQ(last.gain, 1.0);
  cover.mark_seen(sets.row(0));
  EXPECT_EQ(cover.next(any).view, GreedyCover::kNone);
}

TEST(VisibleSets, KeepsEveryFlagAcrossWords) {
  VisibleSets sets(2, 130);
  std::vector<std::uint8_t> visible(130, 0);
  visible[0] = visible[63] = visible[64] = visible[129] = 1;
  sets.set(1, visible);
  for (std::size_t v = 0; v < 130; ++v) {
    EXPECT_EQ(sets.sees(1, v), visible[v] != 0) << v;
    EXPECT_FALSE(sets.sees(0, v));
  }
}

TEST(VisibleSets, RefusesARowOfAnotherSize) {
  VisibleSets sets(1, 3);
  EXPECT_THROW(sets.set(0, std::vector<std::uint8_t>(4, 1)), InvalidInput);
}

TEST(GreedyCover, LazyChoiceIsThePlainChoice) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const Instance instance(60, 200, 0.1, seed);
    EXPECT_EQ(lazy_greedy(instance, 60), plain_greedy(instance, 60)) << seed;
  }
}

TEST(GreedyCover, TakesTheLowestIndexOfEquals) {
  VisibleSets sets(3, 4);
  sets.set(0, std::vector<std::uint8_t>{1, 0, 0, 0});
  sets.set(1, std::vector<std::uint8_t>{0, 1, 1, 0});
  sets.set(2, std::vector<std::uint8_t>{1, 0, 0, 1});
  GreedyCover cover(sets, std::vector<double>{1.0, 1.0, 1.0, 1.0});
  EXPECT_EQ(cover.next(any).view, 1U);
}

TEST(GreedyCover, ReachesTheClassicShareOfTheBestChoice) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const Instance instance(10, 40, 0.2, seed);
    for (std::size_t count = 1; count <= 4; ++count) {
      EXPECT_GE(instance.covered(lazy_greedy(instance, count)),
                (1.0 - 1.0 / std::numbers::e) * best_of_all(instance, count));
    }
  }
}

TEST(GreedyCover, RefusedViewsAreNotChosen) {
  const Instance instance(10, 40, 0.5, 1);
  GreedyCover cover(instance.sets, instance.weights);
  const std::size_t first = lazy_greedy(instance, 1).front();
  EXPECT_NE(cover.next([&](std::uint32_t i) { return i != first; }).view, first);
}

TEST(GreedyCover, EndsWhenNothingNewIsSeen) {
  VisibleSets sets(2, 2);
  sets.set(0, std::vector<std::uint8_t>{1, 1});
  sets.set(1, std::vector<std::uint8_t>{0, 1});
  GreedyCover cover(sets, std::vector<double>{1.0, 2.0});
  EXPECT_EQ(cover.next(any).gain, 3.0);
  cover.mark_seen(sets.row(0));
  EXPECT_EQ(cover.next(any).view, GreedyCover::kNone);
}

TEST(GreedyCover, RefusesWeightsThatAreNoWeights) {
  const VisibleSets sets(1, 2);
  EXPECT_THROW(GreedyCover(sets, std::vector<double>{1.0}), InvalidInput);
  EXPECT_THROW(GreedyCover(sets, std::vector<double>{1.0, -1.0}), InvalidInput);
  EXPECT_THROW(GreedyCover(sets, std::vector<double>{1.0, std::nan("")}), InvalidInput);
}

TEST(CoverBound, NoChoiceBeatsIt) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const Instance instance(10, 40, 0.2, seed);
    GreedyCover cover(instance.sets, instance.weights);
    CoverBound bound;
    bound.add_state(0.0, cover.gains());
    double seen = 0.0;
    for (int i = 0; i < 3; ++i) {
      const GreedyCover::Pick pick = cover.next(any);
      cover.mark_seen(instance.sets.row(pick.view));
      seen += pick.gain;
      bound.add_state(seen, cover.gains());
    }
    for (std::size_t count = 1; count <= 4; ++count) {
      const double best = best_of_all(instance, count);
      EXPECT_GE(bound.most_covered(count), best);
      EXPECT_LE(bound.least_views(best), count);
    }
  }
}

TEST(CoverBound, CountsDisjointViewsExactly) {
  VisibleSets sets(4, 4);
  for (std::size_t i = 0; i < 4; ++i) {
    std::vector<std::uint8_t> visible(4, 0);
    visible[i] = 1;
    sets.set(i, visible);
  }
  const GreedyCover cover(sets, std::vector<double>(4, 1.0));
  CoverBound bound;
  bound.add_state(0.0, cover.gains());
  // Each view sees one vertex that no other sees: three are needed for three.
  EXPECT_EQ(bound.least_views(3.0), 3U);
}

TEST(CoverBound, AsksForNoViewWhereNothingIsWanted) {
  VisibleSets sets(1, 1);
  sets.set(0, std::vector<std::uint8_t>(1, 1));
  const GreedyCover cover(sets, std::vector<double>(1, 1.0));
  CoverBound bound;
  bound.add_state(0.0, cover.gains());
  EXPECT_EQ(bound.least_views(0.0), 0U);
}

}  // namespace
}  // namespace vantage
