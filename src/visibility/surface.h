// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "vantage/core/camera.h"
#include "vantage/core/run_context.h"
#include "vantage/mesh/tri_mesh.h"

#include "spatial/eye_picture.h"
#include "spatial/ray_scene.h"

/// \file
/// A mesh made ready for visibility queries: in a UnitFrame, one vertex per position, without
/// faces of zero area and repeated ones, everything in an order in which neighbours in space are close in memory.

namespace vantage {

/// Planes of faces, rounded: the points p with unit normal · p = offset.
struct FacePlanes {
  std::vector<float> x{}, y{}, z{}, offset{};
};

/// Balls around runs of faces, which are near each other because faces are in Morton order, and
/// cones around their normals, which small surfaces do without.
struct FaceBlocks {
  /// Faces a block. [ours, by measurement]
  static constexpr std::size_t kFaces = 32;

  FloatBalls balls{};
  FloatPoints axes{};           ///< Of the cones, unit.
  std::vector<float> cosine{};  ///< Of a cone's half angle, in (0, 1]; 0 for one that is too wide.
};

/// A vertex here is a *sample*: a position that at least one face of positive area uses.
struct Surface {
  static constexpr std::uint32_t kNoSample = ~std::uint32_t{0};

  UnitFrame frame{};
  std::vector<Vec3> samples{};                    ///< In the frame, along a Morton curve.
  std::vector<std::uint32_t> sample_of_vertex{};  ///< Of each vertex of the mesh, or kNoSample.
  std::vector<Triangle> faces{};                  ///< Of samples, along a Morton curve.
  std::vector<Vec3> area_vectors{};               ///< Of each face, in the frame.
  std::vector<double> twice_areas{};              ///< Their lengths; > 0.
  std::vector<FaceSides> sides{};                 ///< Of each face.
  std::vector<std::uint32_t> face_of_mesh{};      ///< The mesh's face that each face was.
  UnitFrame rounding{};                           ///< In it are, seen from the samples' frame:
  FloatPoints rounded{};                          ///< the samples,
  FacePlanes planes{};                            ///< of each face,
  FaceBlocks blocks{};                            ///< of faces 0 … kFaces−1 and so on.
  std::vector<std::uint8_t> back_faces{};  ///< FaceMeetings::occluding_back_faces; none: not known.
};

/// Which side of a surface's faces is turned to an eye: 1 the front, 2 the back, 0 neither.
struct TurnedFaces {
  std::vector<std::uint8_t> of_face{};
  std::vector<std::uint8_t> of_block{};  ///< Of all faces of each block; 0 if that is not clear.
};

/// Finds that of an eye in the surface's frame. \param turned is given it, and the memory it has.
void find_turned(const Surface& surface, const Viewpoint& eye, TurnedFaces& turned,
                 const RunContext& run);

/// The points in single precision.
FloatPoints rounded_points(std::span<const Vec3> points);

/// An eye in the frame of a surface; orthographic directions get unit length.
/// \throw InvalidInput if it is not finite, or an orthographic direction is zero.
Viewpoint eye_in_frame(const Viewpoint& eye, const UnitFrame& frame);

/// Welds, and leaves out faces without area and repeated ones: for queries alone, the mesh stays as it is.
/// \param sides one per component of connected_components(mesh), or a single one for all.
/// \throw InvalidInput if there are neither.
Surface visibility_surface(const TriMesh& mesh, std::span<const FaceSides> sides);

/// Some samples of a surface and the faces between them, rounded in a frame of their own: what is decided in double
/// is decided as for the whole. \param samples ascending. \param faces the faces between them, ascending
Surface part_of(const Surface& whole, std::span<const std::uint32_t> samples,
                std::span<const std::uint32_t> faces);

/// The eye of a query where the surface's rounded points are.
Viewpoint eye_of_rounded(const Surface& surface, const Viewpoint& eye);

/// The faces of the mesh that visibility_surface() leaves out because an earlier one stands in their
/// place, ascending. \param sides as there. \throw InvalidInput as there
std::vector<std::uint32_t> repeated_faces(const TriMesh& mesh, std::span<const FaceSides> sides);

/// One value for each vertex of the mesh, that of its sample; 0 for vertices without a sample.
/// \param of_sample at least one value a sample; more are not looked at.
std::vector<std::uint8_t> vertices_of_samples(const Surface& surface,
                                              std::span<const std::uint8_t> of_sample);

/// The indices 0 … |points|−1 in the order of a Morton curve through their bounding box.
std::vector<std::uint32_t> morton_order(std::span<const Vec3> points);

}  // namespace vantage
