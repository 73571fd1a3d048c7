// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <vector>

#include <gtest/gtest.h>

#include "vantage/mesh/measures.h"
#include "vantage/render/render.h"

#include "support/many_threads.h"
#include "support/shapes.h"

namespace vantage {
namespace {

/// A torus with colours and a tube through it, seen from the scoring camera's distance.
Image picture(const TriMesh& mesh, const Vec3& direction, const Vec3& up, int threads) {
  std::vector<double> values;
  const Sphere sphere = enclosing_sphere(mesh.positions);
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    values.push_back(std::sin(0.1 * static_cast<double>(v)));
  }
  const CurveGraph graph{{mesh.positions[0], sphere.centre, mesh.positions[100]}, {{0, 1}, {1, 2}}};
  const Viewpoint eye{Projection::Perspective, sphere.centre + 2.0 * sphere.diameter * direction};
  const Camera camera = frame_points(mesh.positions, eye, sphere.centre, up, 1.2);
  return render(
      mesh, camera, colour_map(values), {.graph = &graph, .radius = 0.02 * sphere.diameter},
      {.width = 120, .height = 100, .samples = 4, .ambient_rays = 4}, {.max_threads = threads});
}

/// Fraction of bytes that differ by more than `step`.
double differing(const Image& a, const Image& b, int step) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < a.rgba.size(); ++i) {
    count += std::abs(a.rgba[i] - b.rgba[i]) > step ? 1 : 0;
  }
  return static_cast<double>(count) / static_cast<double>(a.rgba.size());
}

const Vec3 kDirection = Vec3(0.5, 0.6, 0.7).normalized();

TEST(RenderedPixels, AreTheSameForAnyNumberOfThreads) {
  const TriMesh mesh = test::torus(1.0, 0.35, 48, 24);
  const Image one = picture(mesh, kDirection, Vec3::UnitZ(), 1);
  for (const int threads : {2, 3, 8}) {
    const Image image =
        test::with_many_threads([&] { return picture(mesh, kDirection, Vec3::UnitZ(), threads); });
    EXPECT_EQ(image.rgba, one.rgba) << threads;
  }
}

TEST(RenderedPixels, AreTheSameForAnyNumberOfThreadsInEveryStyle) {
  const TriMesh mesh = test::torus(1.0, 0.35, 48, 24);
  const Viewpoint eye{Projection::Perspective, 6.0 * kDirection};
  const Camera camera = frame_points(mesh.positions, eye, Vec3::Zero(), Vec3::UnitZ(), 1.2);
  for (const Style style : {Style::Clay, Style::Technical}) {
    const RenderOptions look{.width = 120,
                             .height = 100,
                             .samples = 4,
                             .ambient_rays = 2,
                             .style = style,
                             .ground = true,
                             .up = Vec3::UnitZ()};
    const Image one = render(mesh, camera, {}, {}, look, {.max_threads = 1});
    for (const int threads : {2, 3, 8}) {
      const Image image = test::with_many_threads(
          [&] { return render(mesh, camera, {}, {}, look, {.max_threads = threads}); });
      EXPECT_EQ(image.rgba, one.rgba);
    }
  }
}

class Similarity : public testing::TestWithParam<std::array<double, 2>> {};

TEST_P(Similarity, LeavesThePictureAsItIs) {
  const auto [scale, offset] = GetParam();
  const TriMesh mesh = test::torus(1.0, 0.35, 48, 24);
  const TriMesh moved =
      test::moved(mesh, scale, 0.0, Vec3::UnitX(), scale * offset * Vec3(1, -2, 0.5));
  const Image here = picture(mesh, kDirection, Vec3::UnitZ(), 0);
  const Image there = picture(moved, kDirection, Vec3::UnitZ(), 0);
  // Rounding moves a sample across an outline, or an occlusion ray past an edge, now and then: one
  // of the 4 samples, or of the 16 rays of a pixel, in a few pixels of a thousand.
  EXPECT_LT(differing(here, there, 2), 0.01);
  EXPECT_EQ(differing(here, there, 96), 0.0);
}

INSTANTIATE_TEST_SUITE_P(ScaleAndOffset, Similarity,
                         testing::Values(std::array{1e-6, 0.0}, std::array{1e6, 0.0},
                                         std::array{1e-6, 3.0}, std::array{3.7, 1000.0},
                                         std::array{1e6, 1000.0}, std::array{0.25, 10.0}));

TEST(Rotation, OfModelAndCameraTogetherLeavesThePictureAsItIs) {
  const TriMesh mesh = test::torus(1.0, 0.35, 48, 24);
  // A third of a turn about (1,1,1) takes z to x, exactly in directions and nearly in positions.
  const auto turn = [](const Vec3& v) { return Vec3(v.z(), v.x(), v.y()); };
  TriMesh turned = mesh;
  std::transform(mesh.positions.begin(), mesh.positions.end(), turned.positions.begin(), turn);
  const Image here = picture(mesh, kDirection, Vec3::UnitZ(), 0);
  const Image there = picture(turned, turn(kDirection), turn(Vec3::UnitZ()), 0);
  // Occlusion directions hang on the axes, so ambient light differs by its noise.
  EXPECT_LT(differing(here, there, 24), 0.01);
}

TEST(Coverage, ConvergesToTheProjectedAreaAtFirstOrder) {
  // A unit square turned in its plane, a sample a pixel: the error is at most that of a band of
  // √2/2 px along the outline, so it falls with the pixel.
  const TriMesh sheet = test::moved(test::sheet(1, 1, 1), 1.0, 0.4, Vec3::UnitZ(), Vec3::Zero());
  const Box box = bounding_box(sheet.positions);
  Camera camera;
  camera.projection = Projection::Orthographic;
  camera.target = 0.5 * (box.low + box.high);
  camera.eye = camera.target + Vec3::UnitZ();
  camera.height = 1.9;
  for (const int side : {32, 64, 128, 256, 512}) {
    const Image image =
        render(sheet, camera, {}, {}, {.width = side, .height = side, .samples = 1});
    double area = 0.0;
    const double pixel = camera.height / side;
    for (std::size_t i = 3; i < image.rgba.size(); i += 4) {
      area += image.rgba[i] / 255.0 * pixel * pixel;
    }
    EXPECT_NEAR(area, 1.0, 4.0 * 0.5 * std::sqrt(2.0) * pixel * 0.25) << side;
  }
}

}  // namespace
}  // namespace vantage
