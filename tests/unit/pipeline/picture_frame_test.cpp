// SPDX-License-Identifier: MIT

#include <algorithm>
#include <array>
#include <cmath>

#include <gtest/gtest.h>

#include "vantage/pipeline/find_views.h"
#include "vantage/report/view_report.h"

#include "core/degrees.h"
#include "support/model_of.h"
#include "support/shapes.h"
#include "support/unrefined.h"

namespace vantage::test {
namespace {

ShapeAnalysis prepared(const TriMesh& mesh) {
  Model model;
  model.mesh = mesh;
  return prepare_surface(model);
}

ViewOptions fitting(const char* size = "auto") {
  ViewOptions options;
  set_size(options, size);
  return options;
}

double aspect(PictureSize size) {
  return static_cast<double>(size.width) / size.height;
}

/// Empty pixels left, right, above and below what a picture shows.
std::array<int, 4> borders(const Image& image) {
  int left = image.width;
  int right = -1;
  int top = image.height;
  int bottom = -1;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      if (image.pixel(x, y)[3] > 0) {
        left = std::min(left, x);
        right = std::max(right, x);
        top = std::min(top, y);
        bottom = y;
      }
    }
  }
  return {left, image.width - 1 - right, top, image.height - 1 - bottom};
}

TEST(FramePicture, IsExactlyAsLargeAsASizeSays) {
  ViewOptions options;
  set_size(options, "300x200");
  const PictureFrame frame =
      frame_picture(prepared(box(1.0, 5.0, 1.0, 2)), Vec3::UnitZ(), UpAxis::Y, options);
  EXPECT_EQ(frame.size.width, 300);
  EXPECT_EQ(frame.size.height, 200);
}

TEST(FramePicture, FillsItsPictureUpToTheMarginOnAllFourSides) {
  const ShapeAnalysis shape = prepared(box(1.0, 1.5, 1.0, 2));
  for (const Projection projection : {Projection::Perspective, Projection::Orthographic}) {
    ViewOptions options = fitting("auto:100");
    options.projection = projection;
    for (const Vec3& direction :
         {Vec3(0.0, 0.0, 1.0), Vec3(0.6, 0.0, 0.8), Vec3(0.48, 0.6, 0.64)}) {
      const PictureFrame frame = frame_picture(shape, direction, UpAxis::Y, options);
      const Image image =
          take_picture(shape, frame.camera, Picture::Plain, with_size(options, frame.size));
      const double margin = 0.04 * std::min(frame.size.width, frame.size.height);
      for (const int border : borders(image)) {
        EXPECT_NEAR(border, margin, 1.5) << direction.transpose();
      }
    }
  }
}

TEST(FramePicture, KeepsTheNumberOfPixels) {
  for (const double height : {0.3, 0.7, 1.0, 1.9, 4.0}) {
    const PictureFrame frame = frame_picture(prepared(box(1.0, height, 1.0, 2)),
                                             Vec3(0.6, 0.0, 0.8), UpAxis::Y, fitting());
    EXPECT_NEAR(frame.size.width * frame.size.height, 800 * 600, 0.002 * 800 * 600);
  }
}

TEST(FramePicture, IsNoLongerThanTwiceItsShorterSide) {
  const ShapeAnalysis shape = prepared(box(20.0, 1.0, 1.0, 2));
  const PictureFrame wide = frame_picture(shape, Vec3::UnitZ(), UpAxis::Y, fitting());
  EXPECT_NEAR(aspect(wide.size), 2.0, 0.005);
  const PictureFrame tall = frame_picture(shape, Vec3::UnitZ(), UpAxis::X, fitting());
  EXPECT_NEAR(aspect(tall.size), 0.5, 0.005);
  const PictureFrame end_on = frame_picture(shape, Vec3::UnitX(), UpAxis::Y, fitting());
  EXPECT_NEAR(aspect(end_on.size), 1.0, 0.005);
}

TEST(FramePicture, FramesThePointsThatNoTriangleJoins) {
  ViewOptions options;
  set_size(options, "100x100");
  const ShapeAnalysis shape = prepared(points_of_ball_and_pole());
  const PictureFrame frame = frame_picture(shape, Vec3::UnitZ(), UpAxis::Y, options);
  const Image image = take_picture(shape, frame.camera, Picture::Plain, options);
  EXPECT_NEAR(borders(image)[2], 4.0, 1.5);
  EXPECT_NEAR(borders(image)[3], 4.0, 1.5);
  EXPECT_GT(borders(image)[0], 25);  // the ball is two fifths of the height
}

/// The least border of a round of cameras, of the shorter side.
double least_border(const ShapeAnalysis& shape, const ViewReport& report, double aspect,
                    double margin) {
  double least = 1.0;
  for (const Camera& camera :
       tour_cameras(shape, *report.set, report.camera, UpAxis::Y, aspect, 40, 100.0 * margin)) {
    const Vec3 back = (camera.eye - camera.target).normalized();
    const Vec3 right = camera.up.cross(back);
    for (const Vec3& p : shape.surface.positions) {
      const Vec3 offset = p - camera.eye;
      const double half = camera.projection == Projection::Perspective
                              ? -offset.dot(back) * std::tan(camera.fov_y_deg * kRadPerDeg / 2)
                              : camera.height / 2;
      // Halves of the picture's height.
      const double x = aspect - std::abs(offset.dot(right)) / half;
      const double y = 1.0 - std::abs(offset.dot(camera.up)) / half;
      least = std::min(least, std::min(x, y) / (2.0 * std::min(aspect, 1.0)));
    }
  }
  return least;
}

TEST(TourCameras, LeaveTheMarginOfTheShorterSideInAnyAspect) {
  ViewOptions options = unrefined();
  options.search.strategy = SearchStrategy::Exhaustive;
  options.search.subdivisions = 1;
  options.objective = Objective::Significance;
  options.view_set.emplace().set.views = 3;
  constexpr double kMargin = 0.1;
  for (const TriMesh& mesh : {y_of_tubes(0.2, 16), points_of_ball_and_pole()}) {
    for (const Projection projection : {Projection::Perspective, Projection::Orthographic}) {
      options.projection = projection;
      const ShapeAnalysis shape = analyse_shape(model_of(mesh), options);
      const ViewReport report = find_views(shape, ModelFrame(UpAxis::Y), options);
      for (const double aspect : {0.25, 1.0, 4.0}) {
        EXPECT_NEAR(least_border(shape, report, aspect, kMargin), kMargin, 1e-9) << aspect;
      }
    }
  }
}

TEST(SizeWithAspect, OfASizeItGaveIsThatSize) {
  // So a camera written with its size is read back for the same picture.
  const ViewOptions options = fitting();
  for (double wanted = 0.5; wanted <= 2.0; wanted += 0.001) {
    const PictureSize size = size_with_aspect(options, wanted);
    const PictureSize again = size_with_aspect(options, aspect(size));
    EXPECT_EQ(again.width, size.width) << wanted;
    EXPECT_EQ(again.height, size.height) << wanted;
  }
}

TEST(SizeWithAspect, HasNoSideBeyondThePixelsOfAPicture) {
  const PictureSize wide = size_with_aspect(fitting("auto:16384"), 1e9);
  EXPECT_EQ(wide.width, 16384);
  EXPECT_EQ(wide.height, 1);
}

TEST(CameraFor, ShowsInAnotherSizeAllThatTheViewsPictureShows) {
  const ShapeAnalysis shape = prepared(box(4.0, 1.0, 2.0, 2));
  for (const Projection projection : {Projection::Perspective, Projection::Orthographic}) {
    ViewOptions options = fitting("auto:160");
    options.projection = projection;
    ReportedView view;
    const PictureFrame frame = frame_picture(shape, Vec3(0.6, 0.0, 0.8), UpAxis::Y, options);
    view.picture = frame.camera;
    view.size = frame.size;
    for (const PictureSize size : {PictureSize{100, 100}, PictureSize{60, 120}, frame.size}) {
      const Image image =
          take_picture(shape, camera_for(view, size), Picture::Plain, with_size(options, size));
      for (const int border : borders(image)) {
        EXPECT_GE(border, 1);
      }
    }
    EXPECT_EQ(camera_for(view, frame.size).fov_y_deg, frame.camera.fov_y_deg);
    EXPECT_EQ(camera_for(view, {400, 100}).height, frame.camera.height);  // room enough
  }
}

}  // namespace
}  // namespace vantage::test
