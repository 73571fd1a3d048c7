// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "vantage/mesh/tri_mesh.h"

namespace vantage {

/// So many copies of a face in one place are looked at: no picture looks through more layers, and each
/// ray would be held against all of them.
constexpr std::size_t kMostCopies = 32;

/// Faces whose three corners lie exactly where those of at least kMostCopies earlier ones do, in
/// whatever order, ascending.
std::vector<std::uint32_t> faces_beyond_copies(const TriMesh& mesh);

}  // namespace vantage
