// SPDX-License-Identifier: MIT
// What the element itself makes of these attributes is looked at in tests/viewer/model_viewer.test.mjs.
#include <map>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "vantage/core/error.h"
#include "vantage/io/camera_files.h"

namespace vantage {
namespace {

using Attributes = std::map<std::string, std::string>;

Attributes attributes(const Vec3& eye, const Vec3& up_in_picture, const Vec3& up,
                      const Vec3& target = Vec3::Zero()) {
  Camera camera;
  camera.eye = target + eye;
  camera.target = target;
  camera.up = up_in_picture;
  camera.fov_y_deg = 20.0;
  const auto list = model_viewer_attributes(camera, up);
  return {list.begin(), list.end()};
}

TEST(ModelViewerCamera, CountsTheAzimuthFromZTowardsXAndThePolarAngleFromY) {
  const Attributes front = attributes({0, 0, 2}, Vec3::UnitY(), Vec3::UnitY(), {1, 2.5, -3});
  EXPECT_EQ(front.at("camera-orbit"), "0deg 90deg 2m");
  EXPECT_EQ(front.at("camera-target"), "1m 2.5m -3m");
  EXPECT_EQ(front.at("field-of-view"), "20deg");
  EXPECT_FALSE(front.contains("orientation"));
  EXPECT_EQ(attributes({2, 0, 0}, Vec3::UnitY(), Vec3::UnitY()).at("camera-orbit"),
            "90deg 90deg 2m");
  EXPECT_EQ(attributes({-2, 0, 0}, Vec3::UnitY(), Vec3::UnitY()).at("camera-orbit"),
            "270deg 90deg 2m");
  EXPECT_EQ(attributes({0, 3, 3}, Vec3(0, 1, -1).normalized(), Vec3::UnitY()).at("camera-orbit"),
            "0deg 45deg 4.2426407m");
}

TEST(ModelViewerCamera, TakesTheAzimuthFromThePictureWhereItLooksStraightDown) {
  // What is up in the picture lies opposite to where the camera would stand if it came down.
  EXPECT_EQ(attributes({0, 2, 0}, -Vec3::UnitX(), Vec3::UnitY()).at("camera-orbit"),
            "90deg 0deg 2m");
  EXPECT_EQ(attributes({0, -2, 0}, Vec3::UnitX(), Vec3::UnitY()).at("camera-orbit"),
            "90deg 180deg 2m");
}

TEST(ModelViewerCamera, TurnsAModelWhoseUpIsZAboutX) {
  // Its front, −y, becomes +z, as converters to glTF turn it.
  const Attributes front = attributes({0, -2, 0}, Vec3::UnitZ(), Vec3::UnitZ(), {1, 2, 3});
  EXPECT_EQ(front.at("orientation"), "0deg -90deg 0deg");
  EXPECT_EQ(front.at("camera-orbit"), "0deg 90deg 2m");
  EXPECT_EQ(front.at("camera-target"), "1m 3m -2m");
}

TEST(ModelViewerCamera, TurnsTheModelIfTheCameraIsRolled) {
  const Attributes rolled = attributes({0, 0, 2}, Vec3::UnitX(), Vec3::UnitY());
  EXPECT_EQ(rolled.at("camera-orbit"), "0deg 90deg 2m");
  EXPECT_EQ(rolled.at("orientation"), "90deg 0deg 0deg");
}

TEST(ModelViewerCamera, LeavesOutARollOfADegree) {
  const Attributes rolled = attributes({0, 0, 2}, Vec3(0.017, 1, 0).normalized(), Vec3::UnitY());
  EXPECT_EQ(rolled.at("camera-orbit"), "0deg 90deg 2m");
  EXPECT_FALSE(rolled.contains("orientation"));
}

TEST(ModelViewerCamera, WritesLengthsOfAnyUnitWithoutExponents) {
  EXPECT_EQ(attributes({0, 0, 3e-9}, Vec3::UnitY(), Vec3::UnitY()).at("camera-orbit"),
            "0deg 90deg 0.000000003m");
  EXPECT_EQ(attributes({0, 0, 3e9}, Vec3::UnitY(), Vec3::UnitY()).at("camera-orbit"),
            "0deg 90deg 3000000000m");
}

TEST(ModelViewerCamera, HasNothingForAnOrthographicCameraAndRefusesOneThatLooksNowhere) {
  Camera camera;
  camera.projection = Projection::Orthographic;
  EXPECT_THAT(model_viewer_attributes(camera, Vec3::UnitY()), testing::IsEmpty());
  camera = {};
  camera.target = camera.eye;
  EXPECT_THROW((void)model_viewer_attributes(camera, Vec3::UnitY()), InvalidInput);
}

TEST(ModelViewerCamera, EncodesTheNameOfTheModelForAnAddressInHtml) {
  EXPECT_THAT(camera_model_viewer({}, Vec3::UnitY(), "a\"<&.glb"),
              testing::StartsWith("<model-viewer src=\"a%22%3C&amp;.glb\" camera-orbit="));
}

}  // namespace
}  // namespace vantage
