// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "vantage/core/camera.h"
#include "vantage/core/run_context.h"
#include "vantage/mesh/measures.h"
#include "vantage/mesh/tri_mesh.h"

/// \file
/// How much of each face an eye sees, exactly. docs/visibility.md says how.

namespace vantage {

class FaceScene;

/// One face with something to see.
struct SeenFace {
  std::uint32_t face = 0;       ///< Of the mesh.
  double visible_area = 0.0;    ///< Of the surface, model units squared; > 0, at most the face's.
  double projected_area = 0.0;  ///< Of its picture, model units squared; see FaceVisibility.
  /// Integrals over what is seen of the barycentric coordinates of the face's corners: what a field
  /// linear in the face is worth there. They add up to `visible_area`.
  std::array<double, 3> of_corners{};
};

/// How a look tells what is seen of a face.
enum class FaceDetail {
  Exact,
  ByCorners,  ///< All of a face of which the eye sees two corners, else nothing: an estimate, which
              ///< takes a quarter of the time.
};

/// Everything that one look at a surface tells.
struct SeenSurface {
  /// Bins of `depths`, over the diameter of the enclosing sphere. [Secord 2011 leaves them open]
  static constexpr std::size_t kDepthBins = 64;

  std::vector<SeenFace> faces{};         ///< As seen_faces() gives them.
  std::vector<std::uint8_t> vertices{};  ///< 1 for each vertex seen, as VertexVisibility says.
  /// Projected area by depth: bin 0 begins where the enclosing sphere does, the last ends with it.
  std::array<double, kDepthBins> depths{};
  /// Greatest depth of what is seen, over the diameter; in [0, 1].
  double deepest = 0.0;
};

/// Tells what an eye sees of a surface's faces. A face is wholly seen, not seen, or clipped to the
/// polygons in view (docs/visibility.md). Immutable after construction; queries are const and may
/// run on many threads at once. Answers do not depend on the number of threads.
///
/// Projected areas are measured on a plane across the line of sight; seen in perspective, on the
/// one through the centre of the mesh's enclosing sphere, across the line from there to the eye. For
/// an eye inside that sphere, what is not ahead of it by a thousandth of the diameter has none.
class FaceVisibility {
 public:
  /// \param mesh vertices that share a position are treated as one.
  /// \param sides one entry per component of connected_components(mesh), or one for all.
  /// \throw InvalidInput
  FaceVisibility(const TriMesh& mesh, std::vector<FaceSides> sides);
  ~FaceVisibility();
  FaceVisibility(FaceVisibility&&) noexcept;             ///< Leaves the other unusable.
  FaceVisibility& operator=(FaceVisibility&&) noexcept;  ///< The same.

  [[nodiscard]] double total_area() const;  ///< Of all faces, model units squared.
  /// A power of two near total_area(), > 0: areas over it fit into a float, whatever the model's unit.
  [[nodiscard]] double area_unit() const;
  [[nodiscard]] std::size_t face_count() const;  ///< Of the mesh.

  /// Model units squared; 0 for faces that repeat another one. \param face of the mesh.
  /// \throw InvalidInput if there is none of that number.
  [[nodiscard]] double face_area(std::size_t face) const;

  /// The faces of which something is seen, by index. \throw Cancelled
  [[nodiscard]] std::vector<SeenFace> seen_faces(const Viewpoint& eye,
                                                 const RunContext& run = {}) const;

  /// The same faces with all else that one look tells. \throw Cancelled
  [[nodiscard]] SeenSurface seen_surface(const Viewpoint& eye, const RunContext& run = {},
                                         FaceDetail detail = FaceDetail::Exact) const;

  /// 1 for each vertex that the eye sees: what VertexVisibility answers. \throw Cancelled
  [[nodiscard]] std::vector<std::uint8_t> visible_vertices(const Viewpoint& eye,
                                                           const RunContext& run = {}) const;

  /// The integral over each face of a field that is given at the vertices and linear in each face;
  /// 0 for faces of no area and those that repeat another one.
  /// \pre the values are finite. \throw InvalidInput unless there is one per vertex.
  [[nodiscard]] std::vector<double> integrals(std::span<const double> of_vertex) const;

  /// The integral of such a field over what is seen. \param seen as one eye sees them. \throw InvalidInput
  [[nodiscard]] double visible_integral(std::span<const double> of_vertex,
                                        std::span<const SeenFace> seen) const;

 private:
  std::unique_ptr<FaceScene> scene_;
};

}  // namespace vantage
