// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "vantage/core/camera.h"

/// \file
/// Cameras in the formats other tools read.
/// Cameras for the web component <model-viewer>, which shows glTF files on web pages.

namespace vantage {

/// Size of the picture a camera file describes.
struct PictureSize {
  int width = 800;   ///< px
  int height = 600;  ///< px
};

/// A camera of a turned model, for the file that the model was read from. \param turn Model::turn
Camera camera_of_file(const Camera& camera, const Eigen::Matrix3d& turn);

/// glTF 2.0 (JSON) with one camera node. \param near_far_scale size of the scene for znear, zfar.
std::string camera_gltf(const Camera& camera, PictureSize size, double near_far_scale);

/// NeRF-style transforms.json: camera-to-world row by row, OpenGL axes.
std::string camera_transforms_json(const Camera& camera, PictureSize size,
                                   std::string_view image_name);

/// Command line that opens `model` in f3d with this camera, in a window of that size. An orthographic
/// camera becomes one from far away, as f3d has no height for it. \param of_points the model has no faces.
std::string camera_f3d(const Camera& camera, PictureSize size, std::string_view model,
                       bool of_points = false);

/// Reads a camera back: a glTF with a camera node, a transforms.json, or our view.json.
/// \throw FormatError
Camera parse_camera(std::string_view bytes, std::string_view name);

/// Width over height of the picture that such a file's camera is of; none where it does not say.
/// \throw FormatError
std::optional<double> parse_camera_aspect(std::string_view bytes, std::string_view name);

/// A camera and the picture it belongs to.
struct NamedCamera {
  Camera camera{};           ///< Where the picture was taken.
  std::string image_name{};  ///< File name, beside the transforms.json.
  PictureSize size{};        ///< Of that picture.
};

/// NeRF-style transforms.json for all cameras: each frame with its own intrinsics, as Nerfstudio
/// reads them (camera-to-world row by row, OpenGL axes). The file's own w and h are the first's.
std::string views_transforms_json(std::span<const NamedCamera> cameras);

/// glTF 2.0 (JSON, buffer inside) with one perspective or orthographic camera that passes all poses
/// in `seconds` at equal intervals and returns to the first, interpolated linearly.
/// \param cameras at least two, alike in all but eye, target and up. \param seconds > 0.
/// \param near_far_scale size of the scene for znear, zfar. \throw InvalidInput
std::string camera_animation_gltf(std::span<const Camera> cameras, double seconds, PictureSize size,
                                  double near_far_scale);

/// Attributes of a <model-viewer> element, by name, that show the model as the picture does in an
/// element of the picture's shape: camera-orbit, camera-target and field-of-view, and the limits
/// that would hold these back otherwise. Angles to 0.0001°, lengths to 10⁻⁷ of the distance.
///
/// The element keeps y up and does not roll: the degree or two by which a picture is rolled is left
/// out. So a model whose up is another axis is turned by
/// `orientation`, about x if up is z: leave that attribute out for a copy of the model that a
/// converter has turned so. A camera that is rolled by 10° or more turns the model instead.
/// \param up direction. \return empty for an orthographic camera, which the element does not have.
/// \throw InvalidInput if the camera looks nowhere, or along its own up.
std::vector<std::pair<std::string, std::string>> model_viewer_attributes(const Camera& camera,
                                                                         const Vec3& up);

/// The element as a line of HTML, for `model`. \pre perspective
std::string camera_model_viewer(const Camera& camera, const Vec3& up, std::string_view model);

}  // namespace vantage
