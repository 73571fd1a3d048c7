// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "vantage/core/image.h"
#include "vantage/core/vec3.h"

/// \file
/// Between sRGB bytes and linear light (IEC 61966-2-1).

namespace vantage {

/// Linear light of an sRGB value, both in [0, 1].
double linear_of_encoded(double value);

/// The reverse; clamped to [0, 1], NaN is 0.
double encoded_of_linear(double value);

/// Linear light in [0, 1] of an sRGB byte.
double linear_of_srgb(std::uint8_t byte);

/// Linear red, green, blue of a colour.
Vec3 linear_of_srgb(const Rgb8& colour);

/// Nearest sRGB byte of a linear value; clamped to [0, 1].
std::uint8_t srgb_of_linear(double value);

/// Nearest sRGB bytes of a linear colour, channel by channel.
Rgb8 srgb_of_linear(const Vec3& colour);

}  // namespace vantage
