// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "vantage/core/camera.h"
#include "vantage/core/fields.h"
#include "vantage/core/run_context.h"
#include "vantage/mesh/measures.h"
#include "vantage/mesh/tri_mesh.h"
#include "vantage/visibility/face_visibility.h"
#include "vantage/visibility/vertex_visibility.h"

/// \file
/// The score of a view: the significance it sees.

namespace vantage {

/// What a score adds up.
enum class Weight {
  Vertex,  ///< The significance of each vertex seen [paper].
  Area,  ///< Its integral over the surface seen, over the whole area: not a matter of tessellation.
};

/// The camera that scores: its eye stands at distance R from the centre, towards a direction.
///
/// Of a direction, here and wherever the library takes one, only where it points counts, not its length.
/// \throw InvalidInput where one is zero or not finite.
struct ScoringCamera {
  Sphere sphere{};                                  ///< Enclosing sphere of the model; D > 0.
  Projection projection = Projection::Perspective;  ///< Perspective unless asked.
  double fov_y_deg = 30.0;                          ///< Vertical field of view, in (0, 180).
  std::optional<double> distance_factor{};          ///< R over D/2, > 1; unset: 1 / sin(fov/2).

  [[nodiscard]] double distance() const;  ///< R in model units.
  /// Position of the eye. \throw InvalidInput
  [[nodiscard]] Vec3 eye(const Vec3& direction) const;
  /// What visibility is asked. \throw InvalidInput
  [[nodiscard]] Viewpoint viewpoint(const Vec3& direction) const;
  /// viewpoint() of each. \throw InvalidInput
  [[nodiscard]] std::vector<Viewpoint> viewpoints(std::span<const Vec3> directions) const;
};

/// Sum of `significance` over the vertices marked visible, added in vertex order.
/// \throw InvalidInput if the sizes differ.
double visible_sum(std::span<const double> significance, std::span<const std::uint8_t> visible);

/// Scores view directions on one model. Holds references: mesh, map and visibility must outlive it.
class ViewScorer {
 public:
  /// \pre significance has one finite value ≥ 0 per vertex.
  ViewScorer(const VertexVisibility& visibility, std::span<const double> significance,
             const ScoringCamera& camera);

  /// Scores by area: (1/A) ∫ of the significance, linear in each face, over the visible surface.
  /// \param faces of the surface whose vertices the significance belongs to.
  ViewScorer(const FaceVisibility& faces, std::span<const double> significance,
             const ScoringCamera& camera);

  /// The score seen from any viewpoint. \throw Cancelled
  [[nodiscard]] double score_from(const Viewpoint& eye, const RunContext& run = {}) const;

  /// score(vp) = Σ of the significance of the visible vertices, or its integral.
  /// \throw InvalidInput if the direction points nowhere, as all that take one do; Cancelled
  [[nodiscard]] double score(const Vec3& direction, const RunContext& run = {}) const;

  /// score() of each direction, in parallel over directions. \throw InvalidInput, Cancelled
  [[nodiscard]] std::vector<double> score_all(std::span<const Vec3> directions,
                                              const RunContext& run = {}) const;

  /// The score if everything were visible.
  [[nodiscard]] double total() const { return total_; }

  [[nodiscard]] const ScoringCamera& camera() const { return camera_; }  ///< As given.

  /// Of a score by area; null for one by vertices.
  [[nodiscard]] const FaceVisibility* faces() const { return faces_; }

  /// What each vertex, or by area each face of faces(), adds to a score that sees all of it.
  [[nodiscard]] std::span<const double> shares() const {
    return faces_ != nullptr ? std::span<const double>(of_face_) : significance_;
  }

 private:
  ViewScorer(std::span<const double> significance, const ScoringCamera& camera);

  const VertexVisibility* visibility_ = nullptr;  // of a score by vertices
  const FaceVisibility* faces_ = nullptr;         // of a score by area
  std::span<const double> significance_;
  std::vector<std::uint8_t> asked_{};  // 1 for each vertex of significance; none if most are
  std::vector<double> of_face_{};      // share of each face of `faces_`
  ScoringCamera camera_;
  double total_ = 0.0;
};

}  // namespace vantage
