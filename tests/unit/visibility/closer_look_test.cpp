// SPDX-License-Identifier: MIT
#include "visibility/closer_look.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "vantage/core/vec3.h"

namespace vantage {
namespace {

/// A triangle with sides of 1.
const std::array<Vec3, 3> kCorners{Vec3(0.0, 0.0, 0.0), Vec3(1.0, 0.0, 0.0),
                                   Vec3(0.5, std::sqrt(0.75), 0.0)};

/// What a straight edge leaves in view: where the value is positive.
struct HalfPlane {
  Vec3 normal = Vec3::UnitX();
  double offset = 0.0;

  [[nodiscard]] double value(const Vec3& place) const { return normal.dot(place) - offset; }

  /// Share of the triangle: a corner on one side alone cuts off a triangle like it.
  [[nodiscard]] double share() const {
    std::array<double, 3> at{value(kCorners[0]), value(kCorners[1]), value(kCorners[2])};
    std::sort(at.begin(), at.end());
    const auto cut_off = [](double corner, double one, double other) {
      return corner / (corner - one) * corner / (corner - other);
    };
    if (at[0] >= 0.0 || at[2] <= 0.0) {
      return at[0] >= 0.0 ? 1.0 : 0.0;
    }
    return at[1] <= 0.0 ? cut_off(at[2], at[0], at[1]) : 1.0 - cut_off(at[0], at[1], at[2]);
  }
};

/// Root of the mean squared error of the share that parts add up to, over edges that fall on the
/// triangle at random.
double error_of_share(int parts, bool has_tips) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> angle(0.0, 6.283185307179586);
  std::uniform_real_distribution<double> offset(-0.6, 0.6);
  double squares = 0.0;
  int count = 0;
  while (count < 20000) {
    const double a = angle(random);
    HalfPlane seen{Vec3(std::cos(a), std::sin(a), 0.0)};
    seen.offset = seen.normal.dot((kCorners[0] + kCorners[1] + kCorners[2]) / 3.0) + offset(random);
    const double truth = seen.share();
    if (truth <= 0.0 || truth >= 1.0) {
      continue;
    }
    std::array<Tip, 3> tips{};
    std::transform(kCorners.begin(), kCorners.end(), tips.begin(), [&](const Vec3& corner) {
      return !has_tips ? Tip::Plain : seen.value(corner) > 0.0 ? Tip::Seen : Tip::Hidden;
    });
    CloserLook closer;
    closer.add(0, 0, kCorners, tips, parts);
    double sum = 0.0;
    for (std::size_t i = 0; i < closer.places.size(); ++i) {
      const bool is_seen = closer.asked[i] == 0 || seen.value(closer.places[i]) > 0.0;
      sum += is_seen ? closer.shares[i] : 0.0;
    }
    squares += (sum - truth) * (sum - truth);
    ++count;
  }
  return std::sqrt(squares / count);
}

TEST(CloserLook, PartsAndTipsTellTheShareOfATriangleThatAStraightEdgeLeavesInView) {
  // The best that least squares over the share of tips can do is .865 and .953.
  EXPECT_LT(error_of_share(2, true), 0.88 * error_of_share(2, false));
  EXPECT_LT(error_of_share(4, true), 0.965 * error_of_share(4, false));
}

TEST(CloserLook, SharesAddUpToAllButHiddenTips) {
  CloserLook tipless;
  tipless.add(0, 0, kCorners, {Tip::Hidden, Tip::Hidden, Tip::Hidden}, 2);
  EXPECT_EQ(tipless.shares, std::vector<double>({0.2, 0.25, 0.2, 0.2}));
  for (const int parts : {1, 2, 3, 5}) {
    CloserLook closer;
    closer.add(0, 0, kCorners, {Tip::Seen, Tip::Asked, Tip::Plain}, parts);
    double sum = 0.0;
    for (const double share : closer.shares) {
      EXPECT_GT(share, 0.0);
      sum += share;
    }
    EXPECT_NEAR(sum, 1.0, 1e-14);
  }
}

}  // namespace
}  // namespace vantage
