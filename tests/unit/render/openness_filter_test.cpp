// SPDX-License-Identifier: MIT
#include "render/openness_filter.h"

#include <cmath>

#include <gtest/gtest.h>

namespace vantage {
namespace {

constexpr int kSide = 9;

/// A flat patch seen straight on, one unit a pixel, all open.
std::vector<SurfaceProbe> flat() {
  std::vector<SurfaceProbe> probes;
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x) {
      probes.push_back({Vec3(x, -y, 0), Vec3::UnitZ(), 1.0, true});
    }
  }
  return probes;
}

SurfaceProbe& at(std::vector<SurfaceProbe>& probes, int x, int y) {
  return probes[static_cast<std::size_t>(y * kSide + x)];
}

TEST(SmoothOpenness, LeavesAnOpenSurfaceExactlyOpen) {
  std::vector<SurfaceProbe> probes = flat();
  smooth_openness(probes, kSide, 1.0);
  for (const SurfaceProbe& probe : probes) {
    ASSERT_EQ(probe.openness, 1.0);
  }
}

TEST(SmoothOpenness, SpreadsOneDarkProbeAndKeepsItsAmount) {
  std::vector<SurfaceProbe> probes = flat();
  at(probes, 4, 4).openness = 0.0;
  smooth_openness(probes, kSide, 1.0);
  double missing = 0.0;
  for (const SurfaceProbe& probe : probes) {
    missing += 1.0 - probe.openness;
  }
  EXPECT_NEAR(missing, 1.0, 1e-12);
  EXPECT_NEAR(at(probes, 4, 4).openness, 1.0 - 9.0 / 81.0, 1e-12);  // (1 2 3 2 1)² has sum 81
  EXPECT_EQ(at(probes, 4, 7).openness, 1.0);
}

TEST(SmoothOpenness, DoesNotReachAcrossAStep) {
  std::vector<SurfaceProbe> probes = flat();
  for (int y = 0; y < kSide; ++y) {
    for (int x = 5; x < kSide; ++x) {
      at(probes, x, y).position.z() = 3.0;
      at(probes, x, y).openness = 0.0;
    }
  }
  smooth_openness(probes, kSide, 1.0);
  EXPECT_EQ(at(probes, 4, 4).openness, 1.0);
  EXPECT_EQ(at(probes, 5, 4).openness, 0.0);
}

TEST(SmoothOpenness, DoesNotReachRoundACorner) {
  std::vector<SurfaceProbe> probes = flat();
  at(probes, 5, 4).normal = Vec3::UnitX();
  at(probes, 5, 4).openness = 0.0;
  smooth_openness(probes, kSide, 1.0);
  EXPECT_EQ(at(probes, 4, 4).openness, 1.0);
}

TEST(SmoothOpenness, IgnoresPixelsWithoutSurface) {
  std::vector<SurfaceProbe> probes = flat();
  at(probes, 5, 4) = SurfaceProbe{};
  at(probes, 5, 4).openness = 0.0;
  smooth_openness(probes, kSide, 1.0);
  EXPECT_EQ(at(probes, 4, 4).openness, 1.0);
  EXPECT_EQ(at(probes, 5, 4).openness, 1.0);
}

}  // namespace
}  // namespace vantage
