// SPDX-License-Identifier: MIT
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "vantage/core/error.h"
#include "vantage/render/render.h"

#include "support/shapes.h"

namespace vantage {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr double kExact = 1e-12;

/// Unit direction at an angle from +y, turned about y; azimuth 0 is the front, +z.
Vec3 direction_at(double from_pole_rad, double azimuth_rad) {
  return {std::sin(from_pole_rad) * std::sin(azimuth_rad), std::cos(from_pole_rad),
          std::sin(from_pole_rad) * std::cos(azimuth_rad)};
}

Viewpoint eye_at(const Vec3& position) {
  return {Projection::Perspective, position};
}

TEST(Upright, OfALevelViewIsTheModelsUp) {
  EXPECT_LT((upright(Vec3::UnitX(), Vec3::UnitY()) - Vec3::UnitY()).norm(), kExact);
}

TEST(Upright, IsAUnitVectorAcrossTheLineOfSight) {
  for (double angle = 0.0; angle <= std::numbers::pi; angle += 0.5 * kDegree) {
    for (double azimuth = 0.0; azimuth < 6.2; azimuth += 0.7) {
      const Vec3 direction = direction_at(angle, azimuth);
      const Vec3 up = upright(direction, Vec3::UnitY());
      EXPECT_NEAR(up.norm(), 1.0, kExact);
      EXPECT_NEAR(up.dot(direction), 0.0, kExact);
    }
  }
}

TEST(Upright, FromStraightAboveHasTheBackAtTheTop) {
  EXPECT_LT((upright(Vec3::UnitY(), Vec3::UnitY()) + Vec3::UnitZ()).norm(), kExact);
}

TEST(Upright, FromStraightBelowHasTheFrontAtTheTop) {
  EXPECT_LT((upright(-Vec3::UnitY(), Vec3::UnitY()) - Vec3::UnitZ()).norm(), kExact);
}

TEST(Upright, OfAZUpModelFromAboveHasPlusYAtTheTop) {
  EXPECT_LT((upright(Vec3::UnitZ(), Vec3::UnitZ()) - Vec3::UnitY()).norm(), kExact);
}

TEST(Upright, TurnsWithoutAJumpFromTheFrontOverThePole) {
  Vec3 previous = upright(direction_at(10.0 * kDegree, 0.0), Vec3::UnitY());
  for (double angle = 10.0 * kDegree; angle > 0.0; angle -= 0.01 * kDegree) {
    const Vec3 up = upright(direction_at(angle, 0.0), Vec3::UnitY());
    EXPECT_LT((up - previous).norm(), 0.001);
    previous = up;
  }
}

TEST(Upright, ChangesLittleOverSmallStepsFromTheSide) {
  // From the side up turns by 90° within 5°; a smooth step does at most 1.5 times that rate.
  const double step = 0.01 * kDegree;
  const double bound = 1.5 * (90.0 / 5.0) * step + step;
  Vec3 previous = upright(direction_at(6.0 * kDegree, 90.0 * kDegree), Vec3::UnitY());
  for (double angle = 6.0 * kDegree; angle > 0.0; angle -= step) {
    const Vec3 up = upright(direction_at(angle, 90.0 * kDegree), Vec3::UnitY());
    EXPECT_LT((up - previous).norm(), 1.05 * bound) << angle / kDegree;
    previous = up;
  }
}

TEST(Upright, IsContinuousWhereThePoleConeBegins) {
  for (double azimuth = 0.0; azimuth < 6.2; azimuth += 0.3) {
    const Vec3 outside = upright(direction_at(5.0001 * kDegree, azimuth), Vec3::UnitY());
    const Vec3 inside = upright(direction_at(4.9999 * kDegree, azimuth), Vec3::UnitY());
    EXPECT_LT((outside - inside).norm(), 1e-4) << azimuth;
  }
}

TEST(FramePoints, OfASphereHasItsTangentConeAsFieldOfView) {
  const TriMesh mesh = test::sphere(5);
  const double distance = 3.0;
  const Camera camera = frame_points(mesh.positions, eye_at(Vec3(0, 0, distance)), Vec3::Zero(),
                                     Vec3::UnitY(), 1.0, 0.0);
  const double expected = 2.0 * std::asin(1.0 / distance) / kDegree;
  EXPECT_NEAR(camera.fov_y_deg, expected, 0.001 * expected);
}

TEST(FramePoints, KeepsTheEye) {
  const TriMesh mesh = test::box(1, 2, 3, 1);
  const Vec3 eye(4, 5, 6);
  const Camera camera =
      frame_points(mesh.positions, eye_at(eye), Vec3(0.5, 1, 1.5), Vec3::UnitY(), 1.5);
  EXPECT_EQ(camera.eye, eye);
}

TEST(FramePoints, OfAnOrthographicCubeIsItsShadowAndTheMargin) {
  const TriMesh mesh = test::box(1, 1, 1, 1);
  const double margin = 0.1;
  const Camera camera =
      frame_points(mesh.positions, {Projection::Orthographic, Vec3(1, 1, 1).normalized()},
                   Vec3(0.5, 0.5, 0.5), Vec3::UnitY(), 2.0, margin);
  // Along (1,1,1) the corners' heights range over 2 √(2/3); twice the margin is left free.
  EXPECT_NEAR(camera.height, 2.0 * std::sqrt(2.0 / 3.0) / (1.0 - 2.0 * margin), kExact);
}

TEST(FramePoints, OfOnePointLooksStraightAtIt) {
  const std::vector<Vec3> points{Vec3(1, 2, 3)};
  const Camera camera =
      frame_points(points, eye_at(Vec3(1, 2, 9)), Vec3(1, 2, 0), Vec3::UnitY(), 1.0);
  EXPECT_LT((camera.target - Vec3(1, 2, 0)).norm(), 1e-6);
  EXPECT_GT(camera.fov_y_deg, 0.0);
}

TEST(FramePoints, RefusesAnEyeInsideThePoints) {
  const TriMesh mesh = test::sphere(2);
  EXPECT_THROW(
      frame_points(mesh.positions, eye_at(Vec3(0.1, 0, 0)), Vec3::Zero(), Vec3::UnitY(), 1.0),
      InvalidInput);
}

TEST(FramePoints, TellsNarrowPicturesFromNearEyes) {
  const auto reason = [](const Vec3& eye, double aspect,
                         const TriMesh& ball = test::sphere(2)) -> std::string {
    try {
      frame_points(ball.positions, eye_at(eye), Vec3::Zero(), Vec3::UnitY(), aspect);
    } catch (const InvalidInput& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_NE(reason(Vec3(0, 0, 3), 1e-3).find("narrow"), std::string::npos);
  EXPECT_NE(reason(Vec3(0, 0, 0.5), 1.0).find("too near"), std::string::npos);
  EXPECT_EQ(reason(Vec3(0, 0, 3), 0.1), "");
  // Just so near that the margin alone takes it beyond the widest field of view.
  const Vec3 away = Vec3(0.3, 0.5, 0.8).normalized();
  EXPECT_NE(reason(1.004 * away, 1.0, test::sphere(5)).find("too near"), std::string::npos);
  EXPECT_EQ(reason(1.0001 * least_distance() * away, 1.0, test::sphere(5)), "");
}

TEST(FramePoints, RefusesAPointAtTheEye) {
  const std::vector<Vec3> points{Vec3(0, 0, 5), Vec3(0, 0, 1)};
  EXPECT_THROW(frame_points(points, eye_at(Vec3(0, 0, 5)), Vec3::Zero(), Vec3::UnitY(), 1.0),
               InvalidInput);
}

TEST(FramePoints, FindsPointsThatAllLieBehindTheViewOfTheCentre) {
  const std::vector<Vec3> points{Vec3(-1, 0, 10), Vec3(1, 0, 10), Vec3(0, 1, 10)};
  const Camera camera =
      frame_points(points, eye_at(Vec3(0, 0, 5)), Vec3::Zero(), Vec3::UnitY(), 1.0);
  EXPECT_GT((camera.target - camera.eye).z(), 0.0);
}

TEST(FramePoints, RefusesArgumentsOutOfRange) {
  const std::vector<Vec3> points{Vec3(0, 0, 0), Vec3(1, 0, 0)};
  const Viewpoint eye = eye_at(Vec3(0, 0, 5));
  const Vec3 centre = Vec3::Zero();
  const Vec3 up = Vec3::UnitY();
  EXPECT_THROW(frame_points({}, eye, centre, up, 1.0), InvalidInput);
  EXPECT_THROW(frame_points(points, eye, centre, up, 0.0), InvalidInput);
  EXPECT_THROW(frame_points(points, eye, centre, up, 1.0, 0.5), InvalidInput);
  EXPECT_THROW(frame_points(points, eye, centre, up, 1.0, -0.1), InvalidInput);
  EXPECT_THROW(frame_points(points, eye_at(centre), centre, up, 1.0), InvalidInput);
  const std::vector<Vec3> broken{Vec3(0, std::numeric_limits<double>::quiet_NaN(), 0)};
  EXPECT_THROW(frame_points(broken, eye, centre, up, 1.0), InvalidInput);
}

TEST(FittingAspect, IsThatOfTheBoxAndItsMargin) {
  const std::vector<Vec3> wide{Vec3(-3, -2, 0), Vec3(3, 2, 0)};
  const std::vector<Vec3> tall{Vec3(-2, -3, 0), Vec3(2, 3, 0)};
  const Viewpoint along{Projection::Orthographic, Vec3::UnitZ()};
  for (const Viewpoint& eye : {along, eye_at(Vec3(0, 0, 50))}) {
    EXPECT_NEAR(fitting_aspect(wide, eye, Vec3::Zero(), Vec3::UnitY(), 0.0), 1.5, 1e-9);
    // A margin of a tenth of the height, 0.8 for the box: 0.8 · 1.5 + 0.2 wide.
    EXPECT_NEAR(fitting_aspect(wide, eye, Vec3::Zero(), Vec3::UnitY(), 0.1), 1.4, 1e-9);
    EXPECT_NEAR(fitting_aspect(tall, eye, Vec3::Zero(), Vec3::UnitY(), 0.1), 1.0 / 1.4, 1e-9);
  }
}

TEST(FittingAspect, OfALineHasNoEndAndOfAPointIsOne) {
  const Viewpoint along{Projection::Orthographic, Vec3::UnitZ()};
  const std::vector<Vec3> line{Vec3(-1, 0, 0), Vec3(1, 0, 0)};
  const std::vector<Vec3> upright_line{Vec3(0, -1, 0), Vec3(0, 1, 0)};
  const std::vector<Vec3> point{Vec3(1, 2, 3)};
  EXPECT_GT(fitting_aspect(line, along, Vec3::Zero(), Vec3::UnitY()), 1e9);
  EXPECT_LT(fitting_aspect(upright_line, along, Vec3::Zero(), Vec3::UnitY()), 1e-9);
  EXPECT_EQ(fitting_aspect(point, along, Vec3::Zero(), Vec3::UnitY()), 1.0);
  EXPECT_EQ(fitting_aspect(point, eye_at(Vec3(0, 0, 50)), Vec3::Zero(), Vec3::UnitY()), 1.0);
  EXPECT_THROW(fitting_aspect({}, along, Vec3::Zero(), Vec3::UnitY()), InvalidInput);
}

}  // namespace
}  // namespace vantage
