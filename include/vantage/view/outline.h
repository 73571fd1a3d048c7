// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "vantage/core/camera.h"
#include "vantage/mesh/measures.h"
#include "vantage/mesh/topology.h"
#include "vantage/mesh/tri_mesh.h"
#include "vantage/visibility/vertex_visibility.h"

/// \file
/// The outline of the shape that an eye sees, and what measures make of it. Lengths are in
/// diameters of the silhouette disc: the picture of the model's enclosing sphere. docs/measures.md.

namespace vantage {

/// The picture of a sphere on the plane through its centre across the line of sight. In perspective
/// it is larger than the sphere's own disc; from within the sphere it is taken to be that disc.
struct SilhouetteDisc {
  Vec3 towards = Vec3::UnitZ();  ///< Unit, from the sphere's centre to the eye.
  double diameter = 1.0;         ///< Model units, on that plane; > 0.
};

/// \pre sphere.diameter > 0. An eye at the very centre looks along −z.
SilhouetteDisc silhouette_disc(const Sphere& sphere, const Viewpoint& eye);

/// A point of the picture in disc diameters, the disc's centre at the origin.
using PicturePoint = Eigen::Vector2d;

/// Closed polylines with the shape on their left: outer outlines run counter-clockwise, those of
/// holes clockwise. The last point is joined to the first.
using Outline = std::vector<std::vector<PicturePoint>>;

/// What outlines are measured by; all 0 without an outline.
struct OutlineMeasures {
  double length = 0.0;             ///< Of all loops, disc diameters.
  double turning_entropy = 0.0;    ///< Of the turning angles in nine bins over [−π, π], bits.
  double curvature = 0.0;          ///< Mean of |turning| a step, radians.
  double curvature_extrema = 0.0;  ///< Mean of its square, radians squared.
};

/// Steps a disc diameter that turning is measured over, on each loop as equal as it can be divided;
/// loops shorter than three steps have no turning.
inline constexpr double kTurningSteps = 256.0;

/// Places a step at which turning is measured: a corner turns in one step or in two by chance, so
/// that the mean over places is taken. Measures of all shapes tried are converged
/// (docs/measures.md). [ours]
inline constexpr int kTurningPhases = 16;

/// Measures an outline. \param phases at least 1.
OutlineMeasures measure_outline(const Outline& outline, int phases = kTurningPhases);

/// Traces outlines of one surface: not on a grid, but along the edges where layers of the surface
/// end, so that they are exact but for rounding. Holds references: the mesh must outlive it.
/// Queries are const and may run on many threads at once.
class OutlineTracer {
 public:
  /// \param sides as for VertexVisibility. \param sphere of the mesh. \throw InvalidInput
  OutlineTracer(const TriMesh& mesh, std::span<const FaceSides> sides, const Sphere& sphere);

  /// The outline of all that the eye could see. Faces that reach behind the eye are left out, and
  /// what lies outside the square around the disc, if the eye is within the sphere.
  [[nodiscard]] Outline trace(const Viewpoint& eye) const;

 private:
  [[nodiscard]] std::vector<PicturePoint> places(const Viewpoint& eye,
                                                 std::vector<std::uint8_t>& ahead) const;

  const TriMesh* mesh_;
  Sphere sphere_;
  std::vector<std::uint8_t> two_sided_{};              // of each face
  std::vector<std::array<std::uint32_t, 2>> edges_{};  // lower vertex first
  // Where two faces run along an edge, each in its own sense: the one in its sense, then the other.
  std::vector<std::array<std::uint32_t, 2>> beside_{};
  IndexLists faces_of_edge_{};
  std::vector<std::int8_t> follows_{};  // of each of these: 1 if it has the edge in that sense
};

}  // namespace vantage
