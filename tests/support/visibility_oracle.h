// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "vantage/core/camera.h"
#include "vantage/mesh/tri_mesh.h"
#include "vantage/visibility/vertex_visibility.h"

/// \file
/// Visibility by trying every face for every vertex: slow, simple and independent of the library.

namespace vantage::test {

/// What brute force can say about a vertex.
enum class Seen {
  No,       ///< Hidden or turned away, by a clear margin.
  Yes,      ///< Visible, by a clear margin.
  Exactly,  ///< Exactly on a silhouette, an edge or a face to within rounding: either is right.
};

/// Asks about every vertex by the definition: extended precision, signed volumes, O(|V| |F|).
/// \param sides of every face. \param step asks about vertices 0, step, 2 step … only; the others
///              are called Exactly.
std::vector<Seen> brute_force_visibility(const TriMesh& mesh, FaceSides sides, const Viewpoint& eye,
                                         std::size_t step = 1);

/// The area of each face's picture on the plane through `centre` across the line from there to the
/// eye: what is seen of it on a line through the picture, summed over all lines. Extended precision,
/// independent of the library. \pre all is ahead of the eye.
std::vector<double> brute_force_areas(const TriMesh& mesh, FaceSides sides, const Viewpoint& eye,
                                      const Vec3& centre);

}  // namespace vantage::test
