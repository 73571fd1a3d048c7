// SPDX-License-Identifier: MIT
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <numbers>
#include <vector>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "vantage/io/camera_files.h"

// As src/io/gltf_document.cpp, which has the loader's code.
#define TINYGLTF_NO_STB_IMAGE
#define TINYGLTF_NO_STB_IMAGE_WRITE
#define TINYGLTF_NO_EXTERNAL_IMAGE
#define TINYGLTF_NO_FS
#include <tiny_gltf.h>

#include "vantage/core/error.h"
#include "vantage/io/write.h"

#include "core/json_text.h"

namespace vantage {
namespace {

/// A camera going round y, `count` poses.
std::vector<Camera> round_trip(std::size_t count) {
  std::vector<Camera> cameras;
  for (std::size_t i = 0; i < count; ++i) {
    const double at = 2.0 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(count);
    cameras.push_back({.eye = 5.0 * Vec3(std::sin(at), 0.0, std::cos(at))});
  }
  return cameras;
}

tinygltf::Model loaded(const std::string& text) {
  tinygltf::TinyGLTF loader;
  tinygltf::Model model;
  std::string error;
  std::string warning;
  EXPECT_TRUE(loader.LoadASCIIFromString(&model, &error, &warning, text.data(),
                                         static_cast<unsigned>(text.size()), ""))
      << error;
  EXPECT_EQ(warning, "");
  return model;
}

std::vector<float> values(const tinygltf::Model& model, int accessor) {
  const auto& a = model.accessors.at(static_cast<std::size_t>(accessor));
  const auto& view = model.bufferViews.at(static_cast<std::size_t>(a.bufferView));
  std::vector<float> result(view.byteLength / 4);
  std::memcpy(result.data(), model.buffers.at(0).data.data() + view.byteOffset, view.byteLength);
  return result;
}

TEST(CameraAnimation, IsAGltfThatMovesOneCameraNode) {
  const auto model = loaded(camera_animation_gltf(round_trip(8), 4.0, {}, 2.0));
  ASSERT_EQ(model.animations.size(), 1U);
  ASSERT_EQ(model.animations[0].channels.size(), 2U);
  EXPECT_EQ(model.animations[0].channels[0].target_path, "translation");
  EXPECT_EQ(model.animations[0].channels[1].target_path, "rotation");
  EXPECT_EQ(model.nodes.at(0).camera, 0);
  EXPECT_TRUE(model.nodes[0].matrix.empty());  // animated nodes must not have one
  EXPECT_EQ(model.cameras.at(0).type, "perspective");
}

TEST(CameraAnimation, KeysAreEvenlySpacedAndCloseTheLoop) {
  const auto model = loaded(camera_animation_gltf(round_trip(8), 4.0, {}, 2.0));
  const auto& samplers = model.animations.at(0).samplers;
  const std::vector<float> times = values(model, samplers.at(0).input);
  const std::vector<float> places = values(model, samplers.at(0).output);
  ASSERT_EQ(times.size(), 9U);
  ASSERT_EQ(places.size(), 27U);
  for (std::size_t i = 0; i < 9; ++i) {
    EXPECT_FLOAT_EQ(times[i], 0.5F * static_cast<float>(i));
  }
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_EQ(places[k], places[24 + k]);
  }
  const auto& accessor = model.accessors.at(static_cast<std::size_t>(samplers[0].input));
  EXPECT_EQ(accessor.minValues.at(0), 0.0);
  EXPECT_EQ(accessor.maxValues.at(0), 4.0);
}

TEST(CameraAnimation, EveryKeyLooksAtTheTargetAndTurnsTheShortWay) {
  const std::vector<Camera> cameras = round_trip(8);
  const auto model = loaded(camera_animation_gltf(cameras, 4.0, {}, 2.0));
  const std::vector<float> q = values(model, model.animations.at(0).samplers.at(1).output);
  ASSERT_EQ(q.size(), 36U);
  for (std::size_t i = 0; i < 9; ++i) {
    const Eigen::Quaternionf turn(q[4 * i + 3], q[4 * i], q[4 * i + 1], q[4 * i + 2]);
    const Eigen::Vector3d forward = (turn * Eigen::Vector3f(0, 0, -1)).cast<double>();
    EXPECT_NEAR((forward + cameras[i % 8].eye.normalized()).norm(), 0.0, 1e-6);
    if (i > 0) {
      const Eigen::Quaternionf last(q[4 * i - 1], q[4 * i - 4], q[4 * i - 3], q[4 * i - 2]);
      EXPECT_GT(turn.dot(last), 0.0F);
    }
  }
}

TEST(CameraAnimation, RefusesOnePoseAndNoTime) {
  EXPECT_THROW(camera_animation_gltf(round_trip(1), 4.0, {}, 2.0), InvalidInput);
  EXPECT_THROW(camera_animation_gltf(round_trip(4), 0.0, {}, 2.0), InvalidInput);
}

TEST(ViewsTransforms, GivesEachFrameItsOwnLens) {
  std::vector<NamedCamera> cameras{{round_trip(2)[0], "a.png", {200, 100}},
                                   {round_trip(2)[1], "b.png", {100, 300}}};
  cameras[1].camera.fov_y_deg = 60.0;
  const auto json = parsed_json(views_transforms_json(cameras));
  ASSERT_EQ(json["frames"].size(), 2U);
  EXPECT_EQ(json["frames"][0]["file_path"], "a.png");
  EXPECT_EQ(json["frames"][1]["file_path"], "b.png");
  // Focal length in pixels: half the height over tan(fov / 2).
  EXPECT_NEAR(json["frames"][0]["fl_y"], 50.0 / std::tan(std::numbers::pi / 12.0), 1e-9);
  EXPECT_NEAR(json["frames"][1]["fl_y"], 150.0 / std::tan(std::numbers::pi / 6.0), 1e-9);
  EXPECT_EQ(json["frames"][1]["w"], 100);
  EXPECT_EQ(json["h"], 100);
}

Image plain(int width, int height, std::uint8_t grey) {
  Image image{width, height, {}};
  image.rgba.assign(static_cast<std::size_t>(4 * width * height), grey);
  return image;
}

std::string animation(AnimationFormat format, int frames, int fps) {
  AnimationEncoder encoder(format, 16, 8, frames, fps);
  for (int i = 0; i < frames; ++i) {
    encoder.add(plain(16, 8, static_cast<std::uint8_t>(40 * i)));
  }
  return encoder.finish();
}

std::uint32_t number_at(const std::string& bytes, std::size_t at, bool big_endian, int count = 4) {
  std::uint32_t value = 0;
  for (int k = 0; k < count; ++k) {
    const int byte = big_endian ? k : count - 1 - k;
    value = value << 8U | static_cast<unsigned char>(bytes.at(at + static_cast<std::size_t>(byte)));
  }
  return value;
}

struct Chunk {
  std::string type;
  std::string data;
};

std::vector<Chunk> png_chunks(const std::string& bytes) {
  std::vector<Chunk> chunks;
  for (std::size_t at = 8; at < bytes.size();) {
    const std::size_t size = number_at(bytes, at, true);
    chunks.push_back({bytes.substr(at + 4, 4), bytes.substr(at + 8, size)});
    at += 12 + size;
  }
  return chunks;
}

TEST(Apng, NumbersItsFrameChunksInOrder) {
  std::uint32_t sequence = 0;
  std::size_t controls = 0;
  for (const Chunk& chunk : png_chunks(animation(AnimationFormat::Apng, 3, 25))) {
    if (chunk.type == "acTL") {
      EXPECT_EQ(number_at(chunk.data, 0, true), 3U);
      EXPECT_EQ(number_at(chunk.data, 4, true), 0U);  // for ever
    }
    if (chunk.type == "fcTL" || chunk.type == "fdAT") {
      EXPECT_EQ(number_at(chunk.data, 0, true), sequence++);
    }
    if (chunk.type == "fcTL") {
      ++controls;
      EXPECT_EQ(number_at(chunk.data, 4, true), 16U);
      EXPECT_EQ(number_at(chunk.data, 8, true), 8U);
      EXPECT_EQ(number_at(chunk.data, 20, true, 2), 1U);  // 1/25 of a second
      EXPECT_EQ(number_at(chunk.data, 22, true, 2), 25U);
    }
  }
  EXPECT_EQ(controls, 3U);
}

TEST(Apng, FirstFrameIsThePictureThatOtherProgramsShow) {
  const std::vector<Chunk> still = png_chunks(png_bytes(plain(16, 8, 0)));
  std::vector<Chunk> moving;
  for (const Chunk& chunk : png_chunks(animation(AnimationFormat::Apng, 2, 10))) {
    if (chunk.type != "acTL" && chunk.type != "fcTL" && chunk.type != "fdAT") {
      moving.push_back(chunk);
    }
  }
  ASSERT_EQ(moving.size(), still.size());
  for (std::size_t i = 0; i < still.size(); ++i) {
    EXPECT_EQ(moving[i].type, still[i].type);
    EXPECT_EQ(moving[i].data, still[i].data);
  }
}

TEST(AnimatedWebp, HoldsEveryFrameForItsTime) {
  const std::string bytes = animation(AnimationFormat::WebP, 3, 30);
  EXPECT_EQ(bytes.substr(0, 4), "RIFF");
  EXPECT_EQ(bytes.substr(8, 4), "WEBP");
  std::vector<std::uint32_t> milliseconds;
  for (std::size_t at = 12; at + 8 <= bytes.size();) {
    const std::string type = bytes.substr(at, 4);
    const std::size_t size = number_at(bytes, at + 4, false);
    if (type == "VP8X") {
      EXPECT_EQ(number_at(bytes, at + 12, false, 3) + 1, 16U);
      EXPECT_EQ(number_at(bytes, at + 15, false, 3) + 1, 8U);
    }
    if (type == "ANMF") {
      milliseconds.push_back(number_at(bytes, at + 8 + 12, false, 3));
    }
    at += 8 + size + size % 2;
  }
  // Frames begin at 0, 33, 67 and end at 100 ms.
  EXPECT_EQ(milliseconds, (std::vector<std::uint32_t>{33, 34, 33}));
}

class EveryFormat : public testing::TestWithParam<AnimationFormat> {};

INSTANTIATE_TEST_SUITE_P(Animation, EveryFormat,
                         testing::Values(AnimationFormat::Apng, AnimationFormat::WebP));

TEST_P(EveryFormat, GivesTheSameBytesForTheSameFrames) {
  EXPECT_EQ(animation(GetParam(), 3, 12), animation(GetParam(), 3, 12));
}

TEST_P(EveryFormat, RefusesAFrameOfAnotherSize) {
  AnimationEncoder encoder(GetParam(), 16, 8, 2, 10);
  EXPECT_THROW(encoder.add(plain(8, 16, 0)), InvalidInput);
}

TEST_P(EveryFormat, RefusesFewerOrMoreFramesThanSaid) {
  AnimationEncoder encoder(GetParam(), 16, 8, 1, 10);
  EXPECT_THROW(encoder.finish(), InvalidInput);
  encoder.add(plain(16, 8, 0));
  EXPECT_THROW(encoder.add(plain(16, 8, 0)), InvalidInput);
}

TEST_P(EveryFormat, RefusesSizesAndSpeedsOutOfRange) {
  EXPECT_THROW(AnimationEncoder(GetParam(), 0, 8, 1, 10), InvalidInput);
  EXPECT_THROW(AnimationEncoder(GetParam(), 20000, 8, 1, 10), InvalidInput);
  EXPECT_THROW(AnimationEncoder(GetParam(), 16, 8, 0, 10), InvalidInput);
  EXPECT_THROW(AnimationEncoder(GetParam(), 16, 8, 1, 61), InvalidInput);
}

}  // namespace
}  // namespace vantage
