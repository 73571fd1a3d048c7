// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <vector>

#include <gtest/gtest.h>

#include "vantage/core/error.h"
#include "vantage/render/render.h"

#include "support/shapes.h"

namespace vantage {
namespace {

Camera camera_of(const TriMesh& mesh, const Vec3& direction) {
  return frame_points(mesh.positions, {Projection::Perspective, 6.0 * direction.normalized()},
                      Vec3::Zero(), Vec3::UnitY(), 1.0, 0.15);
}

TriMesh centred_box() {
  TriMesh box = test::box(1, 1, 1, 1);
  for (Vec3& p : box.positions) {
    p -= Vec3::Constant(0.5);
  }
  return box;
}

RenderOptions look(Style style, int side = 96) {
  RenderOptions options;
  options.width = options.height = side;
  options.style = style;
  set_quality(options, Quality::Draft);
  return options;
}

int brightness(const Image& image, int x, int y) {
  const std::uint8_t* pixel = image.pixel(x, y);
  return (pixel[0] + pixel[1] + pixel[2]) / 3;
}

TEST(RenderStyle, ADrawingHasDarkLinesAlongItsEdgesAndPaperBetween) {
  const TriMesh box = centred_box();
  RenderOptions options = look(Style::Technical);
  options.background = Rgb8{255, 255, 255};
  const Image image = render(box, camera_of(box, Vec3(1, 1, 1)), {}, {}, options);
  // The corner nearest to the eye is in the middle: three lines meet there.
  int darkest = 255;
  for (int d = -2; d <= 2; ++d) {
    darkest = std::min(darkest, brightness(image, 48, 48 + d));
  }
  EXPECT_LT(darkest, 135);  // 1.1 px wide: where it lies between two pixels it covers half of both
  EXPECT_GT(brightness(image, 36, 40), 150);
  EXPECT_GT(brightness(image, 60, 40), 150);
}

TEST(RenderStyle, ADrawingHidesTheEdgesBehind) {
  const TriMesh box = centred_box();
  Camera camera = camera_of(box, Vec3(0, 0, 1));
  RenderOptions options = look(Style::Technical);
  options.background = Rgb8{255, 255, 255};
  const Image image = render(box, camera, {}, {}, options);
  // In perspective the far side lies inside the near one, which has nothing drawn on it.
  for (int y = 24; y < 72; ++y) {
    for (int x = 24; x < 72; ++x) {
      ASSERT_GT(brightness(image, x, y), 150) << x << " " << y;
    }
  }
}

TEST(RenderStyle, BesideItsLinesADrawingIsTransparent) {
  const TriMesh sphere = test::sphere(3);
  const Image image =
      render(sphere, camera_of(sphere, Vec3(0, 0, 1)), {}, {}, look(Style::Technical));
  EXPECT_EQ(image.pixel(1, 1)[3], 0);
  EXPECT_EQ(image.pixel(48, 48)[3], 255);
}

TEST(RenderStyle, AGradientRunsFromTheFirstColourToTheSecond) {
  const TriMesh sphere = test::sphere(2);
  RenderOptions options = look(Style::Clay);
  options.background = Rgb8{250, 100, 0};
  options.background_bottom = Rgb8{10, 100, 200};
  const Image image = render(sphere, camera_of(sphere, Vec3(0, 0, 1)), {}, {}, options);
  for (const int y : {0, 31, 95}) {
    const double share = (y + 0.5) / 96.0;
    EXPECT_NEAR(image.pixel(0, y)[0], 250.0 - 240.0 * share, 1.0);
    EXPECT_EQ(image.pixel(0, y)[1], 100);
    EXPECT_NEAR(image.pixel(0, y)[2], 200.0 * share, 1.0);
  }
}

TEST(RenderStyle, TheGroundShowsAShadowUnderTheModelAndNothingFarFromIt) {
  const TriMesh box = centred_box();
  const Camera camera = camera_of(box, Vec3(0.3, 0.5, 1));
  RenderOptions options = look(Style::Clay);
  const Image without = render(box, camera, {}, {}, options);
  options.ground = true;
  const Image with = render(box, camera, {}, {}, options);
  int darkened = 0;
  for (int y = 0; y < 96; ++y) {
    for (int x = 0; x < 96; ++x) {
      darkened += without.pixel(x, y)[3] == 0 && with.pixel(x, y)[3] > 20 ? 1 : 0;
      if (without.pixel(x, y)[3] == 0) {
        ASSERT_LE(with.pixel(x, y)[3], 255 * 0.73);
      }
    }
  }
  EXPECT_GT(darkened, 200);
  EXPECT_LE(with.pixel(0, 0)[3], 2);
  EXPECT_LE(with.pixel(95, 95)[3], 2);
}

TEST(RenderStyle, FromBelowTheGroundIsNotThere) {
  const TriMesh sphere = test::sphere(3);
  const Camera camera = camera_of(sphere, Vec3(0.2, -1.0, 0.3));
  RenderOptions options = look(Style::Clay);
  options.ambient_rays = 0;
  const Image without = render(sphere, camera, {}, {}, options);
  options.ground = true;
  EXPECT_EQ(render(sphere, camera, {}, {}, options).rgba, without.rgba);
}

TEST(RenderStyle, ACreaseOfNoughtShowsTheFacets) {
  const TriMesh sphere = test::sphere(2);
  const Camera camera = camera_of(sphere, Vec3(0, 0, 1));
  RenderOptions options = look(Style::Clay);
  options.ambient_rays = 0;
  options.samples = 1;
  const auto shades = [&](double crease) {
    options.crease_deg = crease;
    const Image image = render(sphere, camera, {}, {}, options);
    std::vector<int> values;
    for (int x = 10; x < 86; ++x) {
      values.push_back(brightness(image, x, 48));
    }
    values.erase(std::unique(values.begin(), values.end()), values.end());
    return values.size();
  };
  EXPECT_LT(shades(0.0), 20U);  // a row crosses about 16 of the 320 faces
  EXPECT_GT(shades(40.0), 40U);
}

TEST(RenderStyle, QualitiesHaveTheRaysThatTheManualSays) {
  const std::vector<std::array<int, 2>> rays{{9, 8}, {16, 8}, {64, 64}};  // docs/rendering.md
  std::vector<std::array<int, 2>> found;
  for (const Quality quality : {Quality::Draft, Quality::Normal, Quality::Fine}) {
    RenderOptions options = look(Style::Clay);
    set_quality(options, quality);
    found.push_back({options.samples, options.ambient_rays});
  }
  EXPECT_EQ(found, rays);
}

TEST(RenderStyle, AnUpThatIsNoDirectionIsRefused) {
  RenderOptions options = look(Style::Clay);
  options.up = Vec3::Zero();
  const TriMesh box = centred_box();
  EXPECT_THROW(render(box, camera_of(box, Vec3(1, 1, 1)), {}, {}, options), InvalidInput);
}

}  // namespace
}  // namespace vantage
