// SPDX-License-Identifier: MIT
#pragma once

#include <pybind11/pybind11.h>

#include "vantage/core/camera.h"

namespace vantage::python {

/// The fields of vantage.Camera.
pybind11::dict camera_dict(const Camera& camera);

/// A camera of an object with those fields. \throw InvalidInput for a camera that takes no picture.
Camera camera_of(const pybind11::object& object);

}  // namespace vantage::python
