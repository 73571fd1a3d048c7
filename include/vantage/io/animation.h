// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "vantage/core/camera.h"
#include "vantage/core/image.h"
#include "vantage/io/camera_files.h"

/// \file
/// Several cameras in one file, moving cameras, and moving pictures.

namespace vantage {

/// A camera and the picture it belongs to.
struct NamedCamera {
  Camera camera{};           ///< Where the picture was taken.
  std::string image_name{};  ///< File name, beside the transforms.json.
};

/// NeRF-style transforms.json for all cameras: each frame with its own intrinsics, as Nerfstudio
/// reads them (camera-to-world row by row, OpenGL axes).
std::string views_transforms_json(std::span<const NamedCamera> cameras, PictureSize size);

/// glTF 2.0 (JSON, buffer inside) with one perspective or orthographic camera that passes all poses
/// in `seconds` at equal intervals and returns to the first, interpolated linearly.
/// \param cameras at least two, alike in all but eye, target and up. \param seconds > 0.
/// \param near_far_scale size of the scene for znear, zfar. \throw InvalidInput
std::string camera_animation_gltf(std::span<const Camera> cameras, double seconds, PictureSize size,
                                  double near_far_scale);

/// Formats of moving pictures.
enum class AnimationFormat {
  Apng,  ///< Lossless, 8 bit RGBA; programs that know no APNG show the first frame.
  WebP,  ///< Lossy colour, lossless alpha, a tenth of the size.
};

/// Encodes the frames of an endless loop one by one, so that only one need be kept.
class AnimationEncoder {
 public:
  /// \param frame_count of frames that will follow, ≥ 1. \param fps frames a second, 1–60.
  /// \throw InvalidInput also for sides that the format cannot hold (WebP: 16383 px).
  AnimationEncoder(AnimationFormat format, int width, int height, int frame_count, int fps);
  ~AnimationEncoder();
  AnimationEncoder(AnimationEncoder&&) noexcept;             ///< Leaves the other unusable.
  AnimationEncoder& operator=(AnimationEncoder&&) noexcept;  ///< The same.

  /// Adds the next frame. \throw InvalidInput if its size differs. \throw IoError
  void add(const Image& frame);

  /// The whole file. \pre all frames were added. \throw InvalidInput, IoError
  std::string finish();

  /// What an encoder of one format does; private to the library.
  class Implementation;

 private:
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace vantage
