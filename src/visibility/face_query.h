// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "vantage/core/camera.h"
#include "vantage/core/run_context.h"
#include "vantage/mesh/measures.h"
#include "vantage/mesh/tri_mesh.h"
#include "vantage/visibility/face_visibility.h"

#include "mesh/surface_edges.h"
#include "spatial/cell_lists.h"
#include "spatial/face_clip.h"
#include "spatial/face_meetings.h"
#include "spatial/picture_cells.h"
#include "visibility/sample_query.h"

/// \file
/// What one eye sees of a surface's faces. What is seen of a face changes only where a *contour*
/// passes before it, an edge past which the surface turns away from the eye, or where another face
/// passes through it (Appel, "The notion of quantitative invisibility and the machine rendering of
/// solids", 1967). Such faces are cut there; all others are seen or hidden as their corners are.

namespace vantage {

/// Working memory of one query, lent to one after the other.
struct FaceQueryMemory {
  PictureCells picture{};
  CellLists hiding{}, contours{};  // faces, and places in `edges`
  FaceClip clip{};
  std::vector<PictureCells::Extent> extents{};       // of each face that hides or is turned
  std::vector<PictureCells::Extent> edge_extents{};  // of the contours
  std::vector<std::uint32_t> edges{};                // contours
  std::vector<std::uint32_t> seen_edges{};           // those of them that may be in view
  std::vector<std::uint8_t> on_contour{};            // of each sample, or touched
  std::vector<std::uint32_t> round{};                // in which each face was last found
  std::vector<std::uint32_t> order{};                // of each face of the mesh: where it is listed
  std::vector<double> along{};                       // see FaceSums
};

/// All that looks at a surface's faces share. Queries may run on many threads at once.
class FaceScene {
 public:
  FaceScene(const TriMesh& mesh, std::span<const FaceSides> sides);

  static constexpr std::uint32_t kNoFace = ~std::uint32_t{0};

  SampleScene samples;
  std::vector<Triangle> triangles;            ///< Of the mesh.
  std::vector<std::uint32_t> face_of_mesh{};  ///< Of each of these the surface's face, or kNoFace.
  Sphere sphere;                              ///< Of the mesh.
  double total_area = 0.0;                    ///< Model units squared.
  SurfaceEdges edges{};
  FaceMeetings meetings{};
  /// 1 for each sample where surfaces touch: what touches a sample does not hide it.
  std::vector<std::uint8_t> is_touched{};
  LentMemory<FaceQueryMemory> memory{};
};

/// All that an eye sees. \param local the eye in the surface's frame. \throw Cancelled
SeenSurface see_faces(FaceScene& scene, const Viewpoint& local, FaceDetail detail,
                      const RunContext& run);

}  // namespace vantage
