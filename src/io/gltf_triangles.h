// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "io/model_builder.h"

namespace vantage {

/// Adds the triangles of a primitive. Those that only join strips are left out.
/// \param corners in drawing order, counted from 0 within the primitive.
/// \param mode TINYGLTF_MODE_TRIANGLES, …_TRIANGLE_STRIP or …_TRIANGLE_FAN.
/// \param first the builder's number of the primitive's vertex 0.
/// \param mirrored the node turns the surface inside out, which the format takes back.
void add_gltf_triangles(const std::vector<std::uint64_t>& corners, int mode, std::size_t first,
                        bool mirrored, ModelBuilder& builder);

}  // namespace vantage
