// SPDX-License-Identifier: MIT
// The picture shows what the visible set says, from the same eye.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "vantage/mesh/measures.h"
#include "vantage/render/render.h"
#include "vantage/visibility/vertex_visibility.h"

#include "support/shapes.h"

namespace vantage {
namespace {

constexpr int kSide = 200;

struct Shot {
  TriMesh mesh;
  Camera camera;
  std::vector<std::uint8_t> visible;
};

Shot shot_of(const TriMesh& mesh, const Vec3& direction) {
  const Sphere sphere = enclosing_sphere(mesh.positions);
  const Viewpoint eye{Projection::Perspective,
                      sphere.centre + 2.0 * sphere.diameter * direction.normalized()};
  const Camera camera = frame_points(mesh.positions, eye, sphere.centre, Vec3::UnitY(), 1.0);
  return {mesh, camera, visible_vertices(mesh, camera.eye)};
}

/// Where a point falls, px.
std::array<double, 2> projected(const Camera& camera, const Vec3& point) {
  const Vec3 back = (camera.eye - camera.target).normalized();
  const Vec3 right = camera.up.cross(back).normalized();
  const Vec3 up = back.cross(right);
  const Vec3 offset = point - camera.eye;
  const double half = std::tan(camera.fov_y_deg * std::numbers::pi / 360.0);
  const double depth = -offset.dot(back);
  return {0.5 * kSide * (1.0 + offset.dot(right) / (depth * half)),
          0.5 * kSide * (1.0 - offset.dot(up) / (depth * half))};
}

class Silhouette : public testing::TestWithParam<int> {
 protected:
  [[nodiscard]] static Shot shot() {
    const int seed = GetParam();
    const Vec3 direction(std::sin(1.7 * seed), std::cos(2.3 * seed) + 0.1,
                         std::sin(0.9 * seed + 1));
    return seed % 2 == 0 ? shot_of(test::y_of_tubes(0.2, 40), direction)
                         : shot_of(test::torus(1.0, 0.35, 96, 48), direction);
  }

  static RenderOptions options() {
    RenderOptions options{.width = kSide, .height = kSide, .samples = 4};
    options.crease_deg = 0.0;
    return options;
  }
};

TEST_P(Silhouette, CoversEveryVertexThatIsVisible) {
  const Shot s = shot();
  const Image image = render(s.mesh, s.camera, {}, {}, options());
  for (std::size_t v = 0; v < s.visible.size(); ++v) {
    if (s.visible[v] == 0) {
      continue;
    }
    const auto [x, y] = projected(s.camera, s.mesh.positions[v]);
    int most = 0;  // a vertex on the outline may fall beside its pixel's samples
    for (int j = static_cast<int>(y) - 1; j <= static_cast<int>(y) + 1; ++j) {
      for (int i = static_cast<int>(x) - 1; i <= static_cast<int>(x) + 1; ++i) {
        most = std::max<int>(most, image.pixel(i, j)[3]);
      }
    }
    EXPECT_GT(most, 0) << "vertex " << v;
  }
}

TEST_P(Silhouette, ShowsNoFaceOfWhichNoVertexIsVisible) {
  const Shot s = shot();
  // Faces of their own colour: red where no corner is visible. The mesh is taken apart for that.
  const TriMesh apart = test::soup(s.mesh);
  std::vector<Rgb8> colours;
  for (const Triangle& t : s.mesh.triangles) {
    const bool seen = std::any_of(t.begin(), t.end(), [&](auto v) { return s.visible[v] != 0; });
    colours.insert(colours.end(), 3, seen ? Rgb8{0, 0, 255} : Rgb8{255, 0, 0});
  }
  const Image image = render(apart, s.camera, colours, {}, options());
  int shown = 0;
  int wrong = 0;
  for (std::size_t i = 0; i < image.rgba.size(); i += 4) {
    shown += image.rgba[i + 3] > 0 ? 1 : 0;
    wrong += image.rgba[i + 3] > 127 && image.rgba[i] > image.rgba[i + 2] ? 1 : 0;
  }
  EXPECT_GT(shown, kSide * kSide / 10);
  // Behind an edge that hides all three corners a sliver of a face may still show.
  EXPECT_LE(wrong, shown / 200);
}

INSTANTIATE_TEST_SUITE_P(Views, Silhouette, testing::Range(0, 6));

}  // namespace
}  // namespace vantage
