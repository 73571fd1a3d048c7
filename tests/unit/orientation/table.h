// SPDX-License-Identifier: MIT
#pragma once

#include "support/shapes.h"

namespace vantage::test {

/// A board of 2 x 1 at height 0.8 on four legs, upright in z.
inline TriMesh table() {
  TriMesh mesh = together(TriMesh{}, box(2.0, 1.0, 0.1, 2), {0.0, 0.0, 0.8});
  for (const double x : {0.0, 1.9}) {
    for (const double y : {0.0, 0.9}) {
      mesh = together(mesh, box(0.1, 0.1, 0.8, 1), {x, y, 0.0});
    }
  }
  return mesh;
}

}  // namespace vantage::test
