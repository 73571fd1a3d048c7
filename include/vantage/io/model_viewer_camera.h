// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "vantage/core/camera.h"

/// \file
/// Cameras for the web component <model-viewer>, which shows glTF files on web pages.

namespace vantage {

/// Attributes of a <model-viewer> element, by name, that show the model as the picture does in an
/// element of the picture's shape: camera-orbit, camera-target and field-of-view, and the limits
/// that would hold these back otherwise. Angles to 0.0001°, lengths to 10⁻⁷ of the distance.
///
/// The element keeps y up and does not roll: the degree or two by which a picture is rolled is left
/// out. So a model whose up is another axis is turned by
/// `orientation`, about x if up is z: leave that attribute out for a copy of the model that a
/// converter has turned so. A camera that is rolled by 10° or more turns the model instead.
/// \param up a unit axis of the model. \return empty for an orthographic camera, which the element
/// does not have. \throw InvalidInput if the camera looks nowhere, or along its own up.
std::vector<std::pair<std::string, std::string>> model_viewer_attributes(const Camera& camera,
                                                                         const Vec3& up);

/// The element as a line of HTML, for `model`. \pre perspective
std::string camera_model_viewer(const Camera& camera, const Vec3& up, std::string_view model);

}  // namespace vantage
