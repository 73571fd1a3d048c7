// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "vantage/core/camera.h"

/// \file
/// Cameras in the formats other tools read.

namespace vantage {

/// Size of the picture a camera file describes.
struct PictureSize {
  int width = 800;   ///< px
  int height = 600;  ///< px
};

/// glTF 2.0 (JSON) with one camera node. \param near_far_scale size of the scene for znear, zfar.
std::string camera_gltf(const Camera& camera, PictureSize size, double near_far_scale);

/// NeRF-style transforms.json: camera-to-world row by row, OpenGL axes.
std::string camera_transforms_json(const Camera& camera, PictureSize size,
                                   std::string_view image_name);

/// Command line that opens `model` in f3d with this camera.
std::string camera_f3d(const Camera& camera, std::string_view model);

/// Reads a camera back: a glTF with a camera node, a transforms.json, or our view.json.
/// \throw FormatError
Camera parse_camera(std::string_view bytes, std::string_view name);

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

}  // namespace vantage
