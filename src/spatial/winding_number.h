// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>

#include "vantage/core/vec3.h"
#include "vantage/mesh/tri_mesh.h"

namespace vantage {

/// How often faces that close wind around a point: the sum of the solid angles that they are seen
/// under over 4π, positive where their inner sides are seen (van Oosterom and Strackee 1983, eq. 8).
/// A whole number off the faces; on one of them, which then must not be among `faces`, the mean of
/// its two sides. Not rounded: doubtful near edges and corners.
/// \param faces indices of the mesh's triangles.
double winding_number(const TriMesh& mesh, std::span<const std::uint32_t> faces, const Vec3& point);

}  // namespace vantage
