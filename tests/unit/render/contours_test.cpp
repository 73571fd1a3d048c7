// SPDX-License-Identifier: MIT
#include "render/contours.h"

#include <cmath>
#include <numeric>

#include <gtest/gtest.h>

#include "support/shapes.h"

namespace vantage {
namespace {

constexpr int kSide = 100;
constexpr double kLine = 2.0;

/// What Contours needs, looking along −z at [−2, 2]².
class Seen {
 public:
  explicit Seen(TriMesh mesh) : scene_(mesh), rays_(front(), UnitFrame{}, 4.0, kSide, kSide) {}

  [[nodiscard]] std::vector<double> coverage(int first = 0, int rows = kSide) const {
    return Contours(scene_, rays_, kSide, 4, kLine, 0.05)
        .coverage(first, rows, [](int, int) { return true; }, {});
  }

 private:
  static Camera front() {
    Camera camera;
    camera.projection = Projection::Orthographic;
    camera.eye = Vec3(0, 0, 10);
    camera.target = Vec3::Zero();
    camera.up = Vec3::UnitY();
    camera.height = 4.0;
    return camera;
  }

  RayScene scene_;
  PictureRays rays_;
};

double total(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0);
}

TEST(Contours, OfASphereAreARingAsWideAsAsked) {
  const std::vector<double> ink = Seen(test::sphere(5)).coverage();
  const double radius_px = kSide / 4.0;
  // The line lies on the outline, half in and half out.
  const double area = 2.0 * std::acos(-1.0) * radius_px * kLine;
  EXPECT_NEAR(total(ink), area,
              0.12 * area);  // samples are a quarter of a pixel, an eighth of the line
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x) {
      const double away = std::hypot(x + 0.5 - 50.0, y + 0.5 - 50.0) - radius_px;
      if (std::abs(away) > 0.5 * kLine + 1.0) {
        ASSERT_EQ(ink[static_cast<std::size_t>(y * kSide + x)], 0.0) << x << " " << y;
      }
    }
  }
}

TEST(Contours, FollowWhatHidesSomethingBehindIt) {
  TriMesh back = test::sheet(3, 3, 1);
  TriMesh front = test::sheet(1, 1, 1);
  for (Vec3& p : back.positions) {
    p += Vec3(-1.5, -1.5, 0);
  }
  const double alone = total(Seen(back).coverage());
  const double both = total(Seen(test::together(back, front, Vec3(-0.5, -0.5, 0.2))).coverage());
  const double outline_px = 4.0 * 1.0 * kSide / 4.0;
  EXPECT_NEAR(both - alone, outline_px * kLine, 0.12 * outline_px * kLine);
}

TEST(Contours, DoNotMarkABendOrASlope) {
  TriMesh roof;  // a ridge along y, sides at 80°, filling the picture
  const double drop = 5.0 * std::tan(80.0 * std::acos(-1.0) / 180.0);
  roof.positions = {{0, -5, 0},    {0, 5, 0},       {5, -5, -drop},
                    {5, 5, -drop}, {-5, -5, -drop}, {-5, 5, -drop}};
  roof.triangles = {{0, 2, 1}, {1, 2, 3}, {0, 1, 4}, {1, 5, 4}};
  for (Vec3& p : roof.positions) {
    p.z() += 1.0;
  }
  const std::vector<double> ink = Seen(roof).coverage();
  double inside = 0.0;
  for (int y = 0; y < kSide; ++y) {
    for (int x = 30; x < 70; ++x) {
      inside += ink[static_cast<std::size_t>(y * kSide + x)];
    }
  }
  EXPECT_EQ(inside, 0.0);
}

TEST(Contours, DoNotDependOnHowThePictureIsCut) {
  const Seen seen(test::torus(1.0, 0.4, 40, 20));
  const std::vector<double> whole = seen.coverage();
  std::vector<double> pieces;
  for (const auto& [first, rows] : {std::pair{0, 37}, std::pair{37, 1}, std::pair{38, 62}}) {
    const std::vector<double> piece = seen.coverage(first, rows);
    pieces.insert(pieces.end(), piece.begin(), piece.end());
  }
  EXPECT_EQ(pieces, whole);
}

}  // namespace
}  // namespace vantage
