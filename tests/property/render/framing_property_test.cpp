// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "vantage/mesh/measures.h"
#include "vantage/render/render.h"

#include "core/random.h"
#include "support/shapes.h"
#include "support/worst.h"

namespace vantage {
namespace {

constexpr double kMargin = 0.05;
constexpr double kPicturePx = 1000.0;  // shorter side

/// Free borders of a picture, in pixels when the shorter side has kPicturePx.
struct Borders {
  double left = std::numeric_limits<double>::infinity();
  double right = left;
  double top = left;
  double bottom = left;
};

/// Projects all points by the definition of the camera, independently of the renderer.
Borders borders_of(const TriMesh& mesh, const Camera& camera, double aspect) {
  const Vec3 forward = (camera.target - camera.eye).normalized();
  const Vec3 right = forward.cross(camera.up);
  const double half = camera.projection == Projection::Perspective
                          ? std::tan(camera.fov_y_deg * std::numbers::pi / 360.0)
                          : 0.5 * camera.height;
  const double height_px = kPicturePx / std::min(aspect, 1.0);
  Borders borders;
  for (const Vec3& point : mesh.positions) {
    const Vec3 offset = point - camera.eye;
    const double depth = camera.projection == Projection::Perspective ? offset.dot(forward) : 1.0;
    EXPECT_GT(offset.dot(forward), 0.0);
    const double x = offset.dot(right) / (depth * half);
    const double y = offset.dot(camera.up) / (depth * half);
    borders.left = test::smaller(borders.left, 0.5 * height_px * (aspect + x));
    borders.right = test::smaller(borders.right, 0.5 * height_px * (aspect - x));
    borders.top = test::smaller(borders.top, 0.5 * height_px * (1.0 - y));
    borders.bottom = test::smaller(borders.bottom, 0.5 * height_px * (1.0 + y));
  }
  return borders;
}

class Framing : public testing::TestWithParam<unsigned> {
 protected:
  /// A random shape, placed anywhere, of any size.
  static TriMesh shape(Pcg32& random) {
    const double scale = std::pow(10.0, 12.0 * random.uniform() - 6.0);
    const Vec3 axis =
        Vec3(random.uniform() - 0.5, random.uniform() - 0.5, random.uniform() - 0.5).normalized();
    const Vec3 shift = scale * 20.0 * Vec3(random.uniform(), random.uniform(), random.uniform());
    const double length = 0.2 + 4.0 * random.uniform();
    const TriMesh body = random.below(2) == 0
                             ? test::box(1.0, length, 0.3, 3)
                             : test::torus(1.0, 0.1 + 0.3 * random.uniform(), 32, 12);
    return test::moved(body, scale, 6.0 * random.uniform(), axis, shift);
  }

  static Vec3 direction(Pcg32& random) {
    const double z = 2.0 * random.uniform() - 1.0;
    const double angle = 2.0 * std::numbers::pi * random.uniform();
    const double r = std::sqrt(1.0 - z * z);
    return {r * std::cos(angle), r * std::sin(angle), z};
  }
};

/// Where a test fails: the field names are read in its message.
struct Worst {
  double clipped_px = 0.0;     ///< How far anything reaches into the margin.
  double unfilled_px = 0.0;    ///< Free space beyond the margin both ways.
  double off_centre_px = 0.0;  ///< Difference between opposite borders.
  double up_off_square = 0.0;  ///< Cosine between up and the line of sight.

  void add(const Borders& borders, const Camera& camera) {
    const double margin_px = kMargin * kPicturePx;
    const double least = test::smaller(test::smaller(borders.left, borders.right),
                                       test::smaller(borders.top, borders.bottom));
    clipped_px = test::larger(clipped_px, margin_px - least);
    const double across = test::larger(borders.left, borders.right);
    const double down = test::larger(borders.top, borders.bottom);
    unfilled_px = test::larger(unfilled_px, test::smaller(across, down) - margin_px);
    off_centre_px =
        test::larger(off_centre_px, test::larger(std::abs(borders.left - borders.right),
                                                 std::abs(borders.top - borders.bottom)));
    up_off_square = test::larger(
        up_off_square, std::abs(camera.up.dot((camera.target - camera.eye).normalized())));
  }
};

TEST_P(Framing, TouchesTheMarginOnTwoOppositeSidesAndClipsNothing) {
  Pcg32 random(GetParam());
  Worst worst;
  for (int trial = 0; trial < 20; ++trial) {
    const TriMesh mesh = shape(random);
    const Sphere sphere = enclosing_sphere(mesh.positions);
    const Vec3 to_eye = direction(random);
    const double aspect = std::pow(4.0, 2.0 * random.uniform() - 1.0);
    // From 1.2 radii, with the sphere filling 113°, to the scoring camera's 3.9 and beyond.
    const double distance = 0.5 * sphere.diameter * (1.2 + 5.0 * random.uniform());
    const bool perspective = random.below(3) != 0;
    const Viewpoint eye =
        perspective ? Viewpoint{Projection::Perspective, sphere.centre + distance * to_eye}
                    : Viewpoint{Projection::Orthographic, to_eye};
    const Camera camera =
        frame_points(mesh.positions, eye, sphere.centre, Vec3::UnitY(), aspect, kMargin);
    worst.add(borders_of(mesh, camera, aspect), camera);
  }
  EXPECT_LT(worst.clipped_px, 1e-3);
  EXPECT_LT(worst.unfilled_px, 1.0);
  EXPECT_LT(worst.off_centre_px, 1.0);
  EXPECT_LT(worst.up_off_square, 1e-9);
}

INSTANTIATE_TEST_SUITE_P(Seeds, Framing, testing::Range(1U, 9U));

}  // namespace
}  // namespace vantage
