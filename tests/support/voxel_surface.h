// SPDX-License-Identifier: MIT
#pragma once

#include <functional>

#include "vantage/mesh/tri_mesh.h"

namespace vantage::test {

/// Surface of the unit cells (i, j, k), each below its size, for which `solid` holds; every side of a
/// cell is split into parts × parts quads of two triangles. Closed, wound outwards. A manifold as
/// long as no two solid cells touch only in an edge or a corner.
TriMesh voxel_surface(int size_x, int size_y, int size_z,
                      const std::function<bool(int i, int j, int k)>& solid, int parts = 1);

/// A plate with `holes` square holes in a row: genus = holes. Bars are 2 thick, holes 3 wide.
TriMesh plate_with_holes(int holes);

/// The twelve edges of a cube as bars 2 thick and 8 long: genus 5.
TriMesh cube_frame();

}  // namespace vantage::test
