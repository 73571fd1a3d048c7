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

/// Leaves out faces of the same three vertices as an earlier one, in whatever order. They stay in a
/// component that is closed with them and open without, as of cells that share a wall; but not where
/// each of its faces has its other side, too. Returns how many were left out.
/// \pre no face names a vertex twice.
std::size_t leave_out_copies(TriMesh& mesh);

}  // namespace vantage
