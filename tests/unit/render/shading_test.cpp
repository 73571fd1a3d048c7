// SPDX-License-Identifier: MIT
#include "render/shading.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include <gtest/gtest.h>

#include "vantage/spatial/directions.h"

namespace vantage {
namespace {

std::vector<SurfacePoint> points(double albedo, double openness) {
  std::vector<SurfacePoint> result;
  for (const Vec3& normal : direction_set(ViewSphereBase::Icosahedron, 3).directions) {
    if (normal.z() > 0.02) {
      result.push_back(
          {normal, Vec3::UnitZ(), lifted_from_black(Vec3::Constant(albedo)), openness});
    }
  }
  return result;
}

using Shade = Vec3 (*)(const SurfacePoint&);
constexpr std::array<Shade, 2> kShades{shade_surface, shade_drawing};

TEST(Shading, NeverGivesMoreLightThanWhiteNorLessThanNone) {
  for (const Shade shade : kShades) {
    for (const double albedo : {0.0, 0.5, 1.0}) {
      for (const double openness : {0.0, 0.3, 1.0}) {
        for (const SurfacePoint& point : points(albedo, openness)) {
          const Vec3 colour = shade(point);
          ASSERT_TRUE((colour.array() >= 0.0).all() && (colour.array() <= 1.0).all());
        }
      }
    }
  }
}

TEST(Shading, OcclusionOnlyDarkens) {
  for (const Shade shade : kShades) {
    const std::vector<SurfacePoint> open = points(0.6, 1.0);
    const std::vector<SurfacePoint> closed = points(0.6, 0.4);
    for (std::size_t i = 0; i < open.size(); ++i) {
      ASSERT_LT(shade(closed[i]).sum(), shade(open[i]).sum());
    }
  }
}

TEST(Shading, ABlackSurfaceStaysDarkAndIsShadedAllTheSame) {
  double darkest = 1.0;
  double brightest = 0.0;
  for (const SurfacePoint& point : points(0.0, 1.0)) {
    const double channel = shade_surface(point).maxCoeff<Eigen::PropagateNaN>();
    ASSERT_LT(channel, 0.12);
    darkest = std::min(darkest, channel);
    brightest = std::max(brightest, channel);
  }
  EXPECT_GT(brightest, 5.0 * darkest);
  EXPECT_GT(darkest, 0.004);  // sRGB 13 of 255
}

TEST(Shading, DarkSurfacesDifferAndOthersAreShownAsTheyAre) {
  const std::vector<double> albedos{0.0, 0.02, 0.04, 0.06, 0.12, 0.24};
  for (std::size_t k = 0; k < points(0.0, 1.0).size(); ++k) {
    std::vector<double> greens;
    for (const double albedo : albedos) {
      greens.push_back(shade_surface(points(albedo, 1.0)[k]).y());
    }
    EXPECT_TRUE(std::is_sorted(greens.begin(), greens.end(), std::less_equal<>()));
    // In proportion to albedos, but for the sheen, which is the same on all.
    EXPECT_NEAR(greens[5] - greens[4], 2.0 * (greens[4] - greens[3]), 1e-12);
  }
}

TEST(Shading, DarkColoursKeepTheirHueAndNoiseInBlackDoesNotGetOne) {
  const Vec3 brown = lifted_from_black(Vec3(0.012, 0.006, 0.003));
  EXPECT_GT(brown.x(), 1.5 * brown.y());
  EXPECT_GT(brown.y(), brown.z());
  const Vec3 noise = lifted_from_black(Vec3(0.0003, 0.0, 0.0));
  EXPECT_LT(noise.x(), 1.05 * noise.y());
  const Vec3 red(0.06, 0.01, 0.0);
  EXPECT_EQ(lifted_from_black(red), red);
}

TEST(Shading, EveryDirectionStaysReadable) {
  for (const SurfacePoint& point : points(0.55, 1.0)) {
    ASSERT_GT(shade_surface(point).minCoeff<Eigen::PropagateNaN>(), 0.02);  // sRGB 39 of 255
  }
}

}  // namespace
}  // namespace vantage
