// SPDX-License-Identifier: MIT
#include "vantage/render/render.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <stop_token>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "vantage/core/error.h"

#include "support/shapes.h"

namespace vantage {
namespace {

/// Orthographic camera from `direction` at `centre`, `height` model units high.
Camera orthographic(const Vec3& direction, const Vec3& centre, double height) {
  Camera camera;
  camera.projection = Projection::Orthographic;
  camera.eye = centre + 10.0 * direction;
  camera.target = centre;
  const Vec3 unit = direction.normalized();
  camera.up = (Vec3::UnitY() - unit.y() * unit).normalized();
  camera.height = height;
  return camera;
}

Camera front(double height) {
  return orthographic(Vec3::UnitZ(), Vec3::Zero(), height);
}

RenderOptions square(int side_px, int samples = 16) {
  return {.width = side_px, .height = side_px, .samples = samples};
}

/// Sum of alpha over the picture, as a fraction of all of it.
double coverage(const Image& image) {
  double sum = 0.0;
  for (std::size_t i = 3; i < image.rgba.size(); i += 4) {
    sum += image.rgba[i] / 255.0;
  }
  return sum / (static_cast<double>(image.width) * image.height);
}

int largest_difference(const Image& a, const Image& b) {
  int worst = a.rgba.size() == b.rgba.size() ? 0 : 256;
  for (std::size_t i = 0; i < std::min(a.rgba.size(), b.rgba.size()); ++i) {
    worst = std::max(worst, std::abs(a.rgba[i] - b.rgba[i]));
  }
  return worst;
}

TEST(Render, TheShadowOfTheUnitCubeAlongItsDiagonalHasAreaRootThree) {
  const double height = 2.0;
  const Camera camera = orthographic(Vec3(1, 1, 1), Vec3(0.5, 0.5, 0.5), height);
  const Image image = render(test::box(1, 1, 1, 1), camera, {}, {}, square(256));
  const double area = coverage(image) * height * height;
  // The outline is 6 √(2/3) long; 16 samples a pixel leave well under a tenth of a pixel along it.
  const double tolerance = 0.1 * (height / 256) * 6.0 * std::sqrt(2.0 / 3.0);
  EXPECT_NEAR(area, std::sqrt(3.0), tolerance);
}

TEST(Render, TheSilhouetteOfASphereIsADisc) {
  const int side = 128;
  const Image image = render(test::sphere(5), front(2.5), {}, {}, square(side));
  const double radius_px = side / 2.5;
  int least_inside = 255;
  int most_outside = 0;
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) {
      const double from_centre = std::hypot(x + 0.5 - side / 2.0, y + 0.5 - side / 2.0);
      const int alpha = image.pixel(x, y)[3];
      // A pixel's samples lie within 0.75 px of its centre both ways, 1.07 px along the diagonal;
      // the faceted sphere ends up to 0.1 px inside the true one.
      if (from_centre < radius_px - 1.2) {
        least_inside = std::min(least_inside, alpha);
      } else if (from_centre > radius_px + 1.1) {
        most_outside = std::max(most_outside, alpha);
      }
    }
  }
  EXPECT_EQ(least_inside, 255);
  EXPECT_EQ(most_outside, 0);
}

TEST(Render, SharedEdgesLetNoRayThrough) {
  // Far from the origin of the model's own coordinates, obliquely, with perspective.
  const Vec3 shift(1e5, -2e5, 3e4);
  const TriMesh mesh = test::moved(test::box(2, 2, 2, 40), 1.0, 0.7, Vec3(1, 2, 3).normalized(),
                                   shift - Vec3(1, 1, 1));
  Camera camera;
  Vec3 centre = Vec3::Zero();
  for (const Vec3& p : mesh.positions) {
    centre += p / static_cast<double>(mesh.positions.size());
  }
  camera.target = centre;
  camera.eye = centre + Vec3(0, 0, 6);
  camera.fov_y_deg = 8.0;  // sees the middle of the box only
  const Image image = render(mesh, camera, {}, {}, square(200));
  EXPECT_DOUBLE_EQ(coverage(image), 1.0);
}

TEST(Render, AConvexBodyHasNoAmbientOcclusion) {
  RenderOptions with = square(64, 4);
  with.ambient_rays = 16;
  for (const TriMesh& mesh : {test::sphere(2), test::moved(test::box(1, 1, 1, 1), 1.0, 0.6,
                                                           Vec3::UnitX(), Vec3(-0.5, -0.5, 0))}) {
    const Camera camera = orthographic(Vec3(1, 2, 3), Vec3::Zero(), 3.0);
    EXPECT_EQ(largest_difference(render(mesh, camera, {}, {}, square(64, 4)),
                                 render(mesh, camera, {}, {}, with)),
              0);
  }
}

TEST(Render, TheInsideOfATubeIsDarkerWithAmbientOcclusion) {
  RenderOptions with = square(64, 4);
  with.ambient_rays = 16;
  const TriMesh tube = test::open_cylinder(0.3, 2.0, 48, 8);
  const Camera camera = orthographic(Vec3(0.4, 0.3, 1), Vec3(0, 0, 2), 0.5);
  const Image plain = render(tube, camera, {}, {}, square(64, 4));
  const Image occluded = render(tube, camera, {}, {}, with);
  EXPECT_LT(occluded.pixel(32, 32)[0] + 10, plain.pixel(32, 32)[0]);
}

TEST(Render, EdgesOfATransparentPictureHaveNoDarkFringe) {
  // A sheet seen straight on has one colour; where an edge covers a pixel in part the colour stays.
  TriMesh sheet = test::moved(test::sheet(1, 1, 1), 1.0, 0.3, Vec3::UnitZ(), Vec3::Zero());
  const Image image =
      render(sheet, orthographic(Vec3::UnitZ(), Vec3(0.33, 0.62, 0), 2.0), {}, {}, square(64));
  const std::uint8_t* inside = image.pixel(32, 32);
  ASSERT_EQ(inside[3], 255);
  int partial = 0;
  int worst = 0;
  for (std::size_t i = 0; i < image.rgba.size(); i += 4) {
    const std::uint8_t* pixel = image.rgba.data() + i;
    if (pixel[3] > 8 && pixel[3] < 247) {
      ++partial;
      for (int c = 0; c < 3; ++c) {
        worst = std::max(worst, std::abs(pixel[c] - inside[c]));
      }
    }
  }
  EXPECT_LE(worst, 1);
  EXPECT_GT(partial, 50);
}

/// A line across the picture covers `wide` of each column of pixels, px. \param rise of its right end, px.
void expect_covered(double low, double wide, double rise, double tolerance) {
  constexpr int kPictureSide = 100;
  TriMesh line;
  line.positions = {
      {-40, low, 0}, {40, low + rise, 0}, {40, low + rise + wide, 0}, {-40, low + wide, 0}};
  line.triangles = {{0, 1, 2}, {0, 2, 3}};
  const Image image = render(line, front(kPictureSide), {}, {}, square(kPictureSide));
  for (int x = 20; x < 80; ++x) {
    double column = 0.0;
    for (int y = 0; y < kPictureSide; ++y) {
      column += image.pixel(x, y)[3] / 255.0;
    }
    EXPECT_NEAR(column, wide, tolerance) << x;
  }
}

TEST(Render, ALineHalfAPixelWideHasNoGaps) {
  // It passes between the middles of pixels for most of its length.
  expect_covered(0.0, 0.5, 3.0, 0.15);
}

TEST(Render, ALineBetweenTwoRowsOfPixelsIsSeen) {
  // Neither the middles of the pixels nor the few samples around them meet it, their corners do.
  expect_covered(-0.1, 0.2, 0.0, 0.1);
}

TEST(PictureSurface, TakesThePicturesOfSeveralPaintsAndCamerasThatEachWouldTakeAlone) {
  const TriMesh mesh = test::torus(1.0, 0.35, 48, 24);
  std::vector<Rgb8> colours;
  for (const Vec3& p : mesh.positions) {
    colours.push_back(p.x() > 0.0 ? Rgb8{220, 20, 20} : Rgb8{20, 20, 220});
  }
  const CurveGraph graph{{Vec3(-1, 0, 0), Vec3(1, 0, 0)}, {{0, 1}}};
  const TubeOverlay overlay{.graph = &graph, .radius = 0.05};
  RenderOptions options = square(64);
  options.ambient_rays = 8;
  const std::vector<Paint> paints{{}, {colours, {}, nullptr}, {{}, overlay, nullptr}};
  const PictureSurface surface(mesh);
  for (const Camera& camera :
       {front(3.0), orthographic(Vec3(1, 2, 3).normalized(), Vec3::Zero(), 3.0)}) {
    const std::vector<Image> images = surface.render(camera, paints, options);
    ASSERT_EQ(images.size(), 3U);
    EXPECT_EQ(images[0].rgba, render(mesh, camera, {}, {}, options).rgba);
    EXPECT_EQ(images[1].rgba, render(mesh, camera, colours, {}, options).rgba);
    EXPECT_EQ(images[2].rgba, render(mesh, camera, {}, overlay, options).rgba);
  }
}

TEST(Render, AMapHasWithinAFaceTheColoursOfItsScale) {
  const TriMesh face{.positions = {Vec3(-1, -1, 0), Vec3(1, -1, 0), Vec3(0, 1, 0)},
                     .triangles = {{0, 1, 2}}};
  const std::vector<double> values{0.0, 10.0, 10.0};
  const std::vector<double> fine{0.0, 2.5, 5.0, 7.5, 10.0};
  const Image image = render_painted(face, front(2.2), {.vertex_values = values}, square(64));
  // Halfway the scale is green; blue and red mixed are not.
  const auto* middle = image.pixel(26, 32);
  EXPECT_GT(middle[1], middle[0]);
  EXPECT_GT(middle[1], middle[2]);
  EXPECT_THROW((void)render_painted(face, front(2.2), {.vertex_values = fine}, square(64)),
               InvalidInput);
}

TEST(Render, ABackgroundMakesThePictureOpaque) {
  RenderOptions options = square(32);
  options.background = Rgb8{10, 200, 30};
  const Image image = render(test::sphere(2), front(3.0), {}, {}, options);
  EXPECT_DOUBLE_EQ(coverage(image), 1.0);
  EXPECT_THAT(std::vector<int>(image.pixel(0, 0), image.pixel(0, 0) + 3),
              testing::ElementsAre(10, 200, 30));
}

TEST(Render, BothSidesOfASheetAreLitAlike) {
  const TriMesh sheet = test::sheet(1, 1, 1);
  const Camera camera = orthographic(Vec3::UnitZ(), Vec3(0.5, 0.5, 0), 1.2);
  EXPECT_EQ(render(sheet, camera, {}, {}, square(32)).rgba,
            render(test::inside_out(sheet), camera, {}, {}, square(32)).rgba);
}

TEST(Render, VertexColoursShowUnderTheirVertices) {
  const TriMesh sheet = test::sheet(1, 1, 1);
  std::vector<Rgb8> colours;
  for (const Vec3& p : sheet.positions) {
    colours.push_back(p.x() > 0.5 ? Rgb8{220, 20, 20} : Rgb8{20, 20, 220});
  }
  const Camera camera = orthographic(Vec3::UnitZ(), Vec3(0.5, 0.5, 0), 1.2);
  const Image image = render(sheet, camera, colours, {}, square(32));
  EXPECT_GT(image.pixel(4, 16)[2], 2 * image.pixel(4, 16)[0]);
  EXPECT_GT(image.pixel(27, 16)[0], 2 * image.pixel(27, 16)[2]);
}

TEST(Render, AnOverlaidTubeShowsThroughTheSurface) {
  const CurveGraph graph{{Vec3(-0.5, 0, 0), Vec3(0.5, 0, 0)}, {{0, 1}}};
  const TubeOverlay overlay{.graph = &graph, .radius = 0.05};
  const Image image = render(test::sphere(3), front(2.5), {}, overlay, square(100));
  const std::uint8_t* on_tube = image.pixel(50, 50);
  EXPECT_EQ(on_tube[3], 255);
  EXPECT_GT(on_tube[0], on_tube[1] + 60);
}

TEST(Render, ASurfaceUnderAnOverlayIsTranslucent) {
  const CurveGraph graph{{Vec3(-0.5, 0, 0), Vec3(0.5, 0, 0)}, {{0, 1}}};
  const TubeOverlay overlay{.graph = &graph, .radius = 0.05};
  const Image image = render(test::sphere(3), front(2.5), {}, overlay, square(100));
  EXPECT_GT(image.pixel(50, 35)[3], 64);
  EXPECT_LT(image.pixel(50, 35)[3], 192);
}

TEST(Render, AnEyeInsideTheModelSeesItsInside) {
  Camera camera;
  camera.eye = Vec3::Zero();
  camera.target = Vec3(0, 0, -1);
  const Image image = render(test::sphere(3), camera, {}, {}, square(32, 4));
  EXPECT_DOUBLE_EQ(coverage(image), 1.0);
}

TEST(Render, RefusesAnEmptyModel) {
  EXPECT_THROW(render(TriMesh{}, front(2.0)), InvalidInput);
}

TEST(Render, RefusesPointsWithoutFacesAndSaysWhatToDo) {
  TriMesh points;
  points.positions = {Vec3::Zero(), Vec3::UnitX()};
  try {
    render(points, front(2.0));
    FAIL() << "nothing was thrown";
  } catch (const InvalidInput& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("make a surface"));
  }
}

TEST(Render, RefusesOptionsOutOfRange) {
  const TriMesh mesh = test::sphere(1);
  EXPECT_THROW(render(mesh, front(2.0), {}, {}, square(0)), InvalidInput);
  EXPECT_THROW(render(mesh, front(2.0), {}, {}, square(8, 0)), InvalidInput);
  EXPECT_THROW(render(mesh, front(2.0), {}, {}, square(100000)), InvalidInput);
}

TEST(Render, RefusesColoursOfAnotherModel) {
  const std::vector<Rgb8> colours(3);
  EXPECT_THROW(render(test::sphere(1), front(2.0), colours), InvalidInput);
}

TEST(Render, RefusesCamerasThatShowNothing) {
  const TriMesh mesh = test::sphere(1);
  Camera camera;
  camera.target = camera.eye;
  EXPECT_THROW(render(mesh, camera), InvalidInput);
  Camera wide;
  wide.fov_y_deg = 180.0;
  EXPECT_THROW(render(mesh, wide), InvalidInput);
  Camera upside;
  upside.up = Vec3::UnitZ();
  EXPECT_THROW(render(mesh, upside), InvalidInput);
}

TEST(Render, RefusesTubesWithoutThickness) {
  const CurveGraph graph{{Vec3::Zero()}, {}};
  EXPECT_THROW(render(test::sphere(1), front(2.0), {}, {.graph = &graph}), InvalidInput);
}

TEST(Render, StopsOnRequest) {
  std::stop_source source;
  source.request_stop();
  EXPECT_THROW(render(test::sphere(1), front(2.0), {}, {}, {}, {.stop = source.get_token()}),
               Cancelled);
}

TEST(Render, ReportsProgressThatNeverFalls) {
  std::vector<double> fractions;
  RunContext run;
  run.report = [&](std::string_view, double fraction) { fractions.push_back(fraction); };
  render(test::sphere(1), front(2.0), {}, {}, square(200, 1), run);
  EXPECT_TRUE(std::is_sorted(fractions.begin(), fractions.end()));
  ASSERT_FALSE(fractions.empty());
  EXPECT_EQ(fractions.back(), 1.0);
}

}  // namespace
}  // namespace vantage
