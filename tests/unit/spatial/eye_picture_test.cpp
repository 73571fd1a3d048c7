// SPDX-License-Identifier: MIT
#include "spatial/eye_picture.h"

#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

#include "vantage/core/vec3.h"
#include "vantage/spatial/directions.h"

#include "core/random.h"

namespace vantage {
namespace {

constexpr std::size_t kBalls = 40;
constexpr std::size_t kPointsOfBall = 50;

void add(FloatPoints& points, const Vec3& p) {
  points.x.push_back(static_cast<float>(p.x()));
  points.y.push_back(static_cast<float>(p.y()));
  points.z.push_back(static_cast<float>(p.z()));
}

/// Balls of all sizes in the unit cube around the origin, and points drawn by lot on each.
struct Balls {
  FloatBalls balls{};
  FloatPoints points{};

  Balls() {
    Pcg32 random(11);
    const auto within = [&] { return 2.0 * random.uniform() - 1.0; };
    const auto place = [&] {
      const double x = within();
      const double y = within();
      return Vec3(x, y, within());
    };
    for (std::size_t k = 0; k < kBalls; ++k) {
      const Vec3 centre = 0.5 * place();
      const double radius = 0.3 * random.uniform() * random.uniform();
      add(balls.centres, centre);
      balls.radius.push_back(static_cast<float>(radius * 1.000001 + 1e-6));
      for (std::size_t i = 0; i < kPointsOfBall; ++i) {
        add(points, centre + radius * place().normalized());
      }
    }
  }
};

std::vector<Viewpoint> eyes() {
  std::vector<Viewpoint> all;
  for (const Vec3& towards : direction_set(ViewSphereBase::Icosahedron, 0).directions) {
    all.push_back({Projection::Orthographic, towards});
    for (const double distance : {1.5, 4.0, 1e3}) {
      all.push_back({Projection::Perspective, distance * towards});
    }
  }
  return all;
}

TEST(EyePicture, HoldsAllPointsInItsCellsAndThoseOfABallInItsOutline) {
  const Balls scene;
  EyePicture picture;
  for (const Viewpoint& eye : eyes()) {
    ASSERT_TRUE(picture.aim(eye, scene.points, {}));
    for (const std::size_t count : {std::size_t{100}, kBalls * kPointsOfBall}) {
      picture.lay_out(count, scene.balls, {});
      const std::size_t cells = std::size_t{picture.columns()} * picture.rows();
      EXPECT_GE(2 * cells, count);
      EXPECT_LE(cells, 2 * count);
      for (std::size_t i = 0; i < picture.places().size(); ++i) {
        const EyePicture::Place& place = picture.places()[i];
        const EyePicture::Extent& extent = picture.extent_of(i / kPointsOfBall);
        for (int axis = 0; axis < 3; ++axis) {
          EXPECT_LE(extent.low[axis], place[axis]) << i;
          EXPECT_GE(extent.high[axis], place[axis]) << i;
        }
        const EyePicture::CellRange at = picture.cells_of({place, place});
        EXPECT_LT(at.left, picture.columns());
        EXPECT_LT(at.top, picture.rows());
        EXPECT_EQ(at.left, static_cast<std::uint32_t>(place[0]));
        EXPECT_EQ(at.top, static_cast<std::uint32_t>(place[1]));
      }
    }
  }
}

TEST(EyePicture, DepthsAreDistancesAlongTheAxis) {
  const Balls scene;
  EyePicture picture;
  for (const Viewpoint& eye : eyes()) {
    ASSERT_TRUE(picture.aim(eye, scene.points, {}));
    picture.lay_out(100, scene.balls, {});
    const Vec3 towards = eye.position.normalized();
    for (std::size_t i = 0; i < picture.places().size(); ++i) {
      const Vec3 p(scene.points.x[i], scene.points.y[i], scene.points.z[i]);
      EXPECT_NEAR(picture.places()[i][2], -p.dot(towards), EyePicture::kAxisError);
    }
  }
}

TEST(EyePicture, IsNoneOfAnEyeAmongThePoints) {
  const Balls scene;
  EyePicture picture;
  EXPECT_FALSE(picture.aim({Projection::Perspective, Vec3(0.1, 0.1, 0.1)}, scene.points, {}));
  EXPECT_FALSE(picture.aim({Projection::Perspective, Vec3(0.0, 0.0, 0.0)}, scene.points, {}));
  EXPECT_FALSE(picture.aim({Projection::Perspective, Vec3(0.0, 0.0, 3.0)}, {}, {}));
}

}  // namespace
}  // namespace vantage
