// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

#include "vantage/mesh/tri_mesh.h"

namespace vantage {

/// Components of next to no area around the others, as scans leave them: whoever frames the model frames
/// them too.
struct Specks {
  std::size_t count = 0;     ///< Components that reach out of the others' box.
  double enlargement = 1.0;  ///< Diagonal of the whole box over that of the others' box, ≥ 1.
};

/// Of the smallest components, which together hold a hundredth of the surface at most, those around the
/// others. None where all are of a size.
Specks find_specks(const TriMesh& mesh);

}  // namespace vantage
