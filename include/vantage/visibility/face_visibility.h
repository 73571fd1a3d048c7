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
#include "vantage/visibility/vertex_visibility.h"

/// \file
/// How much of each face an eye sees, whatever the tessellation. docs/visibility.md says how.

namespace vantage {

class FaceSamples;

/// One face with something to see.
struct SeenFace {
  std::uint32_t face = 0;       ///< Of the mesh.
  double visible_area = 0.0;    ///< Of the surface, model units squared; > 0, at most the face's.
  double projected_area = 0.0;  ///< Of its picture, model units squared; see FaceVisibility.
};

/// Everything that one look at a surface tells.
struct SeenSurface {
  /// Bins of `depths`, over the diameter of the enclosing sphere. [Secord 2011 leaves them open]
  static constexpr std::size_t kDepthBins = 64;

  std::vector<SeenFace> faces{};         ///< As seen_faces() gives them.
  std::vector<std::uint8_t> vertices{};  ///< 1 for each vertex seen, as VertexVisibility says.
  /// Projected area by depth: bin 0 begins where the enclosing sphere does, the last ends with it.
  std::array<double, kDepthBins> depths{};
  /// Greatest depth of the vertices, parts of faces and of edges seen, over the diameter; in [0, 1].
  double deepest = 0.0;
};

/// Samples a surface and asks which samples an eye sees: every face is cut into pieces, and each
/// piece is judged by its centroid. Where areas and depths are asked for, faces that may be seen in
/// part are clipped: what is seen of them is exact (docs/visibility.md). Of more than 60 000 faces,
/// and from an eye that has some of the surface behind it, pieces that may be seen in part are
/// divided again instead, and their parts are judged so. Immutable after construction; queries are
/// const and may run on many threads at once. Answers do not depend on the number of threads.
///
/// Projected areas are measured on a plane across the line of sight; seen in perspective, on the
/// one through the centre of the mesh's enclosing sphere, across the line from there to the eye. An
/// eye inside the model has no projected area of what is not ahead of it.
class FaceVisibility {
 public:
  /// Largest side of a piece over the sphere's diameter, below which measures of all shapes of many
  /// faces that were tried are converged (docs/visibility.md). [ours]
  static constexpr double kSpacing = 1.0 / 96.0;

  /// The same for this surface: where that gives fewer than about 80 000 pieces each weighs much, and
  /// sides are up to half as long. \return in [kSpacing / 2, kSpacing].
  static double enough_spacing(const TriMesh& mesh);

  /// With the spacing that is enough. \param mesh vertices that share a position are treated as one.
  /// \param sides one entry per component of connected_components(mesh), or one for all.
  /// \throw InvalidInput
  FaceVisibility(const TriMesh& mesh, std::vector<FaceSides> sides);
  /// \param spacing pieces are cut until no side is longer than this share of the diameter of the
  ///                enclosing sphere, in (0, 1]; needle-like pieces of little area stay longer.
  /// \throw InvalidInput
  FaceVisibility(const TriMesh& mesh, std::vector<FaceSides> sides, double spacing);
  ~FaceVisibility();
  FaceVisibility(FaceVisibility&&) noexcept;             ///< Leaves the other unusable.
  FaceVisibility& operator=(FaceVisibility&&) noexcept;  ///< The same.

  [[nodiscard]] double total_area() const;         ///< Of all faces, model units squared.
  [[nodiscard]] std::size_t sample_count() const;  ///< At least one per face that has area.

  /// The faces of which something is seen, by index. \throw Cancelled
  [[nodiscard]] std::vector<SeenFace> seen_faces(const Viewpoint& eye,
                                                 const RunContext& run = {}) const;

  /// The same faces with all else that one look tells. \throw Cancelled
  [[nodiscard]] SeenSurface seen_surface(const Viewpoint& eye, const RunContext& run = {}) const;

  /// 1 for each vertex that the eye sees: what VertexVisibility answers. \throw Cancelled
  [[nodiscard]] std::vector<std::uint8_t> visible_vertices(const Viewpoint& eye,
                                                           const RunContext& run = {}) const;

  /// The integral over each sample's piece of a field that is given at the vertices and linear in
  /// each face. \pre one finite value per vertex.
  [[nodiscard]] std::vector<double> integrals(std::span<const double> of_vertex) const;

  /// 1 for each sample seen: for each piece that faces were cut into first. \throw Cancelled
  [[nodiscard]] std::vector<std::uint8_t> seen_samples(const Viewpoint& eye,
                                                       const RunContext& run = {}) const;

  /// Sum of a quantity over the samples seen, in sample order. \pre one value per sample.
  [[nodiscard]] double visible_sum(std::span<const double> of_sample, const Viewpoint& eye,
                                   const RunContext& run = {}) const;

 private:
  std::unique_ptr<FaceSamples> samples_;
};

}  // namespace vantage
