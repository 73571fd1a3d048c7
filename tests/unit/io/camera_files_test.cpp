// SPDX-License-Identifier: MIT
#include "vantage/io/camera_files.h"

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include <Eigen/Geometry>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "vantage/core/error.h"

#include "core/degrees.h"
#include "core/json_text.h"

namespace vantage::test {
namespace {

using testing::HasSubstr;
using testing::Not;

/// An eye at (3, 4, 5) that looks at (1, 1, 1).
Camera slanted(Projection projection) {
  Camera camera;
  camera.projection = projection;
  camera.eye = Vec3(3, 4, 5);
  camera.target = Vec3(1, 1, 1);
  const Vec3 back = (camera.eye - camera.target).normalized();
  camera.up = back.cross(Vec3::UnitY().cross(back)).normalized();
  camera.fov_y_deg = 24.0;
  camera.height = 7.0;
  return camera;
}

/// How much two cameras differ, in model units and degrees; 0 for the same.
double difference(const Camera& a, const Camera& b) {
  const double lens = a.projection == Projection::Perspective ? std::abs(a.fov_y_deg - b.fov_y_deg)
                                                              : std::abs(a.height - b.height);
  return (a.eye - b.eye).norm() + (a.target - b.target).norm() + (a.up - b.up).norm() + lens;
}

void expect_same(const Camera& a, const Camera& b) {
  EXPECT_EQ(a.projection, b.projection);
  EXPECT_LT(difference(a, b), 1e-12);  // degrees to radians and back, and a cross product
}

bool is_refused(std::string_view text) {
  try {
    parse_camera(text, "c.json");
  } catch (const FormatError&) {
    return true;
  }
  return false;
}

class CameraFile : public testing::TestWithParam<Projection> {};

TEST_P(CameraFile, GltfReadsBack) {
  const Camera camera = slanted(GetParam());
  expect_same(parse_camera(camera_gltf(camera, {640, 480}, 2.0), "c.gltf"), camera);
}

TEST_P(CameraFile, TransformsReadBack) {
  const Camera camera = slanted(GetParam());
  expect_same(parse_camera(camera_transforms_json(camera, {640, 480}, "a.png"), "t.json"), camera);
}

INSTANTIATE_TEST_SUITE_P(BothProjections, CameraFile,
                         testing::Values(Projection::Perspective, Projection::Orthographic));

TEST(CameraGltf, LooksAlongMinusZOfItsNode) {
  const Camera camera = slanted(Projection::Perspective);
  const auto file = parsed_json(camera_gltf(camera, {640, 480}, 2.0));
  const auto matrix = file["nodes"][0]["matrix"].get<std::vector<double>>();
  const Vec3 z(matrix[8], matrix[9], matrix[10]);  // third column
  EXPECT_LT((z - (camera.eye - camera.target).normalized()).norm(), 1e-15);
  EXPECT_EQ(Vec3(matrix[12], matrix[13], matrix[14]), camera.eye);
}

TEST(CameraGltf, EnclosesTheSceneBetweenItsPlanes) {
  const Camera camera = slanted(Projection::Perspective);
  const auto file = parsed_json(camera_gltf(camera, {640, 480}, 2.0));
  const auto& lens = file["cameras"][0]["perspective"];
  const double distance = std::sqrt(2.0 * 2 + 3 * 3 + 4 * 4);
  EXPECT_NEAR(lens["znear"].get<double>(), distance - 2.0, 1e-12);
  EXPECT_NEAR(lens["zfar"].get<double>(), distance + 2.0, 1e-12);
  EXPECT_NEAR(lens["aspectRatio"].get<double>(), 640.0 / 480.0, 1e-15);
}

TEST(CameraTransforms, GiveTheHorizontalAngleInRadians) {
  Camera camera = slanted(Projection::Perspective);
  camera.fov_y_deg = 90.0;  // half the height is 1 at distance 1, half the width 2
  const auto file = parsed_json(camera_transforms_json(camera, {800, 400}, "a.png"));
  EXPECT_NEAR(file["camera_angle_x"].get<double>(), 2.0 * std::atan(2.0), 1e-12);
  EXPECT_NEAR(file["fl_x"].get<double>(), 200.0, 1e-9);
}

TEST(CameraTransforms, OfOtherToolsNeedOnlyTheHorizontalAngle) {
  const Camera camera = parse_camera(
      R"({"camera_angle_x": 1.5707963267948966, "w": 400, "h": 400, "frames": [{"transform_matrix":
          [[1,0,0,0],[0,1,0,0],[0,0,1,5],[0,0,0,1]]}]})",
      "t.json");
  EXPECT_NEAR(camera.fov_y_deg, 90.0, 1e-12);
  EXPECT_EQ(camera.target, Vec3(0, 0, 4));
}

TEST(CameraTransforms, WithoutASizeAreOfSquarePictures) {
  const Camera camera = parse_camera(
      R"({"camera_angle_x": 1.5707963267948966, "frames": [{"transform_matrix":
          [[1,0,0,0],[0,1,0,0],[0,0,1,5],[0,0,0,1]]}]})",
      "t.json");
  EXPECT_NEAR(camera.fov_y_deg, 90.0, 1e-12);
}

TEST(CameraTransforms, OfNerfstudioSayFocalLengths) {
  const std::string pose = R"("transform_matrix":[[1,0,0,0],[0,1,0,0],[0,0,1,4],[0,0,0,1]])";
  const double expected = 2.0 * std::atan(300.0 / 500.0) * 180.0 / std::numbers::pi;
  for (const std::string& text :
       {R"({"fl_x":400,"fl_y":500,"w":800,"h":600,"frames":[{)" + pose + "}]}",
        R"({"frames":[{"fl_x":400,"fl_y":500,"w":800,"h":600,)" + pose + "}]}",
        R"({"fl_x":500,"w":800,"h":600,"frames":[{)" + pose + "}]}"}) {
    const Camera camera = parse_camera(text, "transforms.json");
    EXPECT_NEAR(camera.fov_y_deg, expected, 1e-12) << text;
    EXPECT_EQ(camera.eye, Vec3(0, 0, 4));
  }
  EXPECT_TRUE(is_refused(R"({"fl_y":0,"h":600,"frames":[{)" + pose + "}]}"));
  EXPECT_TRUE(is_refused(R"({"w":800,"h":600,"frames":[{)" + pose + "}]}"));
}

TEST(CameraGltf, StandsWhereTheNodesAboveItsOwnPutIt) {
  // Moved to (0, 0, 5), its parent turned from z to x, and that one's doubled and moved by (0, 1, 0).
  const std::string text = R"({"asset":{"version":"2.0"},
    "cameras":[{"type":"perspective","perspective":{"yfov":0.5,"znear":1}}],
    "nodes":[{"children":[1],"scale":[2,2,2],"translation":[0,1,0]},
      {"children":[2],"matrix":[0,0,-1,0, 0,1,0,0, 1,0,0,0, 0,0,0,1]},
      {"camera":0,"translation":[0,0,5],"extras":{"target":[7,7,7]}}]})";
  const Camera camera = parse_camera(text, "c.gltf");
  EXPECT_LT((camera.eye - Vec3(10, 1, 0)).norm(), 1e-12);
  EXPECT_LT(((camera.target - camera.eye).normalized() - Vec3(-1, 0, 0)).norm(), 1e-12);
  EXPECT_LT((camera.up - Vec3(0, 1, 0)).norm(), 1e-12);
}

TEST(CameraGltf, IsRefusedBelowItself) {
  EXPECT_TRUE(is_refused(R"({"cameras":[{"perspective":{"yfov":0.5}}],
    "nodes":[{"children":[1]},{"children":[0],"camera":0}]})"));
}

TEST(CameraF3d, QuotesTheNameOfTheModel) {
  const std::string line =
      camera_f3d(slanted(Projection::Perspective), {640, 480}, "it's mine.obj");
  EXPECT_THAT(line, HasSubstr("f3d 'it'\\''s mine.obj' --camera-position=3,4,5 "
                              "--camera-focal-point=1,1,1 "));
  EXPECT_THAT(line, HasSubstr("--camera-view-angle=24"));
  EXPECT_THAT(line, HasSubstr("--resolution=640,480"));
}

TEST(CameraF3d, ShowsAnOrthographicPictureFromFarAway) {
  Camera camera = slanted(Projection::Orthographic);
  camera.eye = Vec3(0, 0, 7);
  camera.target = Vec3(0, 0, 2);
  camera.up = Vec3::UnitY();
  camera.height = 3.0;
  const std::string line = camera_f3d(camera, {640, 480}, "a.obj");
  EXPECT_THAT(line, HasSubstr(" --camera-position=0,0,3002 --camera-focal-point=0,0,2 "));
  const std::string angle = " --camera-view-angle=";
  ASSERT_THAT(line, HasSubstr(angle));
  const double degrees = std::stod(line.substr(line.find(angle) + angle.size()));
  EXPECT_NEAR(2.0 * 3000.0 * std::tan(0.5 * degrees * kRadPerDeg), 3.0, 1e-9);
  EXPECT_THAT(line, Not(HasSubstr("orthographic")));  // f3d 1.3 ends at an option that it has not
}

TEST(CameraF3d, ShowsPointsOfClouds) {
  const Camera camera = slanted(Projection::Perspective);
  EXPECT_THAT(camera_f3d(camera, {640, 480}, "a.ply", true), HasSubstr(" --point-sprites\n"));
  EXPECT_THAT(camera_f3d(camera, {640, 480}, "a.ply"), Not(HasSubstr("points")));
}

TEST(CameraF3d, NamesNoModelAsAnOption) {
  EXPECT_THAT(camera_f3d(slanted(Projection::Perspective), {640, 480}, "-x.obj"),
              HasSubstr("f3d './-x.obj' --camera-position"));
}

TEST(CameraF3d, HoldsNothingThatDrivesATerminal) {
  const std::string line =
      camera_f3d(slanted(Projection::Perspective), {640, 480}, "it's\x1B[31m\\\xC3\xA9\n.obj");
  EXPECT_THAT(line, HasSubstr("f3d $'it\\'s\\033[31m\\\\\\303\\251\\012.obj' --camera-position"));
}

TEST(ParseCamera, ReadsThePictureOfTheBestViewFromAViewJson) {
  const Camera camera = parse_camera(
      R"({"camera":{"projection":"perspective","fov_y_deg":30,"target":[0,0,0],"distance":4},
          "best":{"eye":[0,0,4],"up":[0,1,0.2],"frame":{"target":[0,0.5,0],"fov_y_deg":21}}})",
      "view.json");
  Camera expected;
  expected.eye = Vec3(0, 0, 4);
  expected.target = Vec3(0, 0.5, 0);
  expected.fov_y_deg = 21.0;
  expected.up =
      Vec3(0, 4, 0.5) / std::sqrt(4.0 * 4.0 + 0.5 * 0.5);  // across (0, −0.5, 4), up in it
  expect_same(camera, expected);
}

TEST_P(CameraFile, SaysTheAspectOfItsPicture) {
  const Camera camera = slanted(GetParam());
  EXPECT_NEAR(parse_camera_aspect(camera_gltf(camera, {640, 400}, 2.0), "c.gltf").value(), 1.6,
              1e-12);
  EXPECT_NEAR(
      parse_camera_aspect(camera_transforms_json(camera, {640, 400}, "a.png"), "t.json").value(),
      1.6, 1e-12);
}

TEST(ParseCamera, TakesTheAspectOfAViewJsonFromTheSizeOfItsBestView) {
  EXPECT_NEAR(parse_camera_aspect(R"({"best":{"size":[300,200]}})", "view.json").value(), 1.5,
              1e-12);
  EXPECT_FALSE(parse_camera_aspect(R"({"best":{}})", "view.json").has_value());  // of 0.3
  EXPECT_FALSE(parse_camera_aspect(R"({"best":{"size":[300,0]}})", "view.json").has_value());
  EXPECT_THROW(parse_camera_aspect(R"({"best":{"size":[300]}})", "view.json"), FormatError);
  EXPECT_THROW(parse_camera_aspect(R"({"best":{"size":["a",2]}})", "view.json"), FormatError);
}

TEST(ParseCamera, OfAnOrthographicViewJsonLooksTheWayOfTheView) {
  const Camera camera = parse_camera(
      R"({"camera":{"projection":"orthographic","target":[1,0,0],"distance":4},
          "best":{"eye":[1,0,4],"up":[0,1,0],"frame":{"target":[2,0.5,0],"height":3}}})",
      "view.json");
  EXPECT_EQ(camera.projection, Projection::Orthographic);
  EXPECT_EQ(camera.eye, Vec3(2, 0.5, 4));  // along z, as the view is
  EXPECT_EQ(camera.target, Vec3(2, 0.5, 0));
  EXPECT_EQ(camera.height, 3.0);
}

TEST_P(CameraFile, OfSeveralViewsIsTheFirst) {
  Camera other = slanted(GetParam());
  other.eye = Vec3(9, 9, 9);
  const std::vector<NamedCamera> cameras{{slanted(GetParam()), "1.png", {640, 400}},
                                         {other, "2.png", {200, 300}}};
  const std::string file = views_transforms_json(cameras);
  expect_same(parse_camera(file, "views.transforms.json"), slanted(GetParam()));
  EXPECT_NEAR(parse_camera_aspect(file, "views.transforms.json").value(), 1.6, 1e-12);
}

TEST_P(CameraFile, OfATourIsWhereItBegins) {
  Camera other = slanted(GetParam());
  other.eye = Vec3(9, 9, 9);
  const std::vector<Camera> cameras{slanted(GetParam()), other};
  const Camera read =
      parse_camera(camera_animation_gltf(cameras, 3.0, {640, 480}, 2.0), "tour.gltf");
  EXPECT_LT(difference(read, slanted(GetParam())), 1e-9);
}

TEST(CameraFiles, AreNotWrittenOfACameraThatLooksAtItsOwnEyeOrAlongItsUp) {
  Camera nowhere = slanted(Projection::Perspective);
  nowhere.target = nowhere.eye;
  Camera along = slanted(Projection::Perspective);
  along.up = along.eye - along.target;
  for (const Camera& camera : {nowhere, along}) {
    EXPECT_THROW((void)camera_gltf(camera, {64, 48}, 1.0), InvalidInput);
    EXPECT_THROW((void)camera_transforms_json(camera, {64, 48}, "a.png"), InvalidInput);
    EXPECT_THROW(
        (void)camera_animation_gltf(std::vector<Camera>{camera, camera}, 1.0, {64, 48}, 1.0),
        InvalidInput);
  }
}

TEST(ParseCamera, RefusesWhatHoldsNoCamera) {
  for (const char* text :
       {"{", "[]", "{}", R"({"frames":[]})", R"({"frames":[{"transform_matrix":[1]}]})",
        R"({"cameras":[],"nodes":[{"camera":0,"matrix":[]}]})", R"({"best":{},"camera":{}})",
        R"({"cameras":[{}],"nodes":[{"camera":-1}]})"}) {
    EXPECT_TRUE(is_refused(text)) << text;
  }
}

TEST(ParseCamera, RefusesACameraThatSeesNothing) {
  EXPECT_THROW(parse_camera(R"({"camera":{},"best":{"eye":[0,0,4],"up":[0,0,1],
                       "frame":{"target":[0,0,0],"fov_y_deg":21}}})",
                            "view.json"),
               FormatError);
}

TEST(CameraGltf, IsOneOfTheSceneThatIsShown) {
  const auto eye = [](const std::string& scenes) {
    return parse_camera(R"({"cameras":[{"perspective":{"yfov":0.5,"aspectRatio":2}},
        {"perspective":{"yfov":0.5,"aspectRatio":3}}],"nodes":[
        {"camera":0,"translation":[0,0,5]},{"children":[2]},{"camera":1,"translation":[0,0,9]}])" +
                            scenes + "}",
                        "c.gltf")
        .eye.z();
  };
  EXPECT_EQ(eye(R"(,"scene":1,"scenes":[{"nodes":[0]},{"nodes":[1]}])"), 9.0);
  EXPECT_EQ(eye(R"(,"scenes":[{"nodes":[1]},{"nodes":[0]}])"), 9.0);
  EXPECT_EQ(eye(R"(,"scenes":[{"nodes":[1,0]}])"), 5.0);  // the first of several
  EXPECT_EQ(eye(""), 5.0);
  EXPECT_EQ(eye(R"(,"scene":7,"scenes":[{"nodes":[1]}])"), 5.0);  // better any than none
  EXPECT_EQ(eye(R"(,"scenes":[{"nodes":[7,-1,"a"]},{"nodes":3}])"), 5.0);
  EXPECT_NEAR(parse_camera_aspect(
                  R"({"cameras":[{"perspective":{"yfov":0.5,"aspectRatio":2}},
                      {"perspective":{"yfov":0.5,"aspectRatio":3}}],"nodes":[{"camera":0},
                      {"camera":1}],"scenes":[{"nodes":[1]}]})",
                  "c.gltf")
                  .value(),
              3.0, 1e-15);
}

}  // namespace
}  // namespace vantage::test
