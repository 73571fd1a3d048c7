// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "vantage/core/camera.h"
#include "vantage/core/run_context.h"
#include "vantage/mesh/tri_mesh.h"

/// \file
/// Which vertices an eye sees. docs/visibility.md defines it and says how it is decided.

namespace vantage {

/// Answers visibility queries on one surface. Immutable after construction; queries are const and
/// may run on many threads at once. Answers are the same at any scale and position of the model
/// (up to the rounding of its coordinates) and for any number of threads.
class VertexVisibility {
 public:
  /// Builds the search structure; O(|F| log |F|).
  /// \param mesh  vertices that share a position are treated as one.
  /// \param sides one entry per component of connected_components(mesh), or a single entry for all.
  /// \param eyes  how many will be asked about, more or less. For many this takes longer and they
  /// take less each; the answers are the same.
  explicit VertexVisibility(const TriMesh& mesh, std::vector<FaceSides> sides,
                            std::size_t eyes = 1);
  ~VertexVisibility();
  VertexVisibility(VertexVisibility&&) noexcept;             ///< Leaves the other unusable.
  VertexVisibility& operator=(VertexVisibility&&) noexcept;  ///< The same.

  /// 1 for each vertex with an unblocked segment to the eye and an incident face turned to the
  /// eye, else 0. Faces at the vertex, or at another one of equal position, do not block it.
  [[nodiscard]] std::vector<std::uint8_t> visible_vertices(const Viewpoint& eye,
                                                           const RunContext& run = {}) const;

  /// The same of some vertices, in less time. \param asked one value a vertex of the mesh, 0 for
  /// those not asked about: the answer is 0 for them. \throw InvalidInput if it has another size. \throw Cancelled
  [[nodiscard]] std::vector<std::uint8_t> visible_among(std::span<const std::uint8_t> asked,
                                                        const Viewpoint& eye,
                                                        const RunContext& run = {}) const;

  /// The same answers as visible_among(), found another way: each vertex's segment to the eye goes
  /// through a hierarchy in space and is decided in double precision. Slower; to check the others.
  [[nodiscard]] std::vector<std::uint8_t> visible_by_segments(std::span<const std::uint8_t> asked,
                                                              const Viewpoint& eye,
                                                              const RunContext& run = {}) const;

 private:
  struct Scene;
  std::unique_ptr<Scene> scene_;
};

/// A surface wound so that closed shells face outwards.
struct OrientedMesh {
  TriMesh mesh{};                  ///< Same vertices; faces of some components reversed.
  std::vector<FaceSides> sides{};  ///< One per component of connected_components(mesh).
  std::size_t turned_shells = 0;   ///< Closed shells that were inside out.
};

/// Turns closed, consistently wound shells that are inside out; a component may have several. A shell
/// inside an odd number of other closed shells bounds a cavity and should be wound inwards; an even
/// number, outwards.
/// \throw Cancelled
OrientedMesh orient_shells(const TriMesh& mesh, const RunContext& run = {});

/// Which vertices of a mesh an eye sees; all there is to call for a single view of triangles from
/// anywhere. Closed shells that are inside out are turned first, and open or inconsistently wound
/// components are seen from both sides, as everywhere in this library. For several eyes build a
/// VertexVisibility once.
/// \param mesh of any units; vertices that share a position are treated as one.
/// \param eye  position in the mesh's coordinates, outside or inside the model.
/// \return 1 for each visible vertex, else 0. \throw InvalidInput if the eye is not finite.
std::vector<std::uint8_t> visible_vertices(const TriMesh& mesh, const Vec3& eye);

}  // namespace vantage
