// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

#include "vantage/mesh/tri_mesh.h"

namespace vantage {

/// Components of next to no area around the others, as scans leave them: whoever frames the model frames
/// them too.
struct Specks {
  std::size_t count = 0;     ///< Components that reach out of the others' box.
  double area_share = 0.0;   ///< What they hold of the surface, in [0, kMostSpeckArea].
  double enlargement = 1.0;  ///< Diagonal of the whole box over that of the others' box, ≥ 1.
};

/// The smallest components that together hold no more of the surface are specks. [ours]
inline constexpr double kMostSpeckArea = 0.01;

/// The specks of a surface of any number of components; none where all are of a size.
Specks find_specks(const TriMesh& mesh);

}  // namespace vantage
