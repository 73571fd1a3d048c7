// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <mutex>
#include <optional>
#include <span>
#include <vector>

#include "vantage/mesh/measures.h"
#include "vantage/mesh/tri_mesh.h"
#include "vantage/visibility/vertex_visibility.h"

#include "visibility/face_pieces.h"
#include "visibility/sight.h"
#include "visibility/slivers.h"

/// \file
/// All that looks at a surface's areas share: its samples, and what they need to know of its edges.

namespace vantage {

/// Queries may run on many threads at once.
class FaceSamples {
 public:
  /// Cuts every face into pieces. \param spacing as FaceVisibility takes it.
  FaceSamples(const TriMesh& mesh, std::span<const FaceSides> sides, double spacing);

  [[nodiscard]] Sight& sight() { return sight_; }

  [[nodiscard]] const Surface& surface() const { return sight_.surface(); }

  [[nodiscard]] const std::vector<Triangle>& triangles() const { return triangles_; }

  [[nodiscard]] const Sphere& sphere() const { return sphere_; }

  [[nodiscard]] const FacePieces& pieces() const { return pieces_; }

  [[nodiscard]] double total_area() const { return total_area_; }

  /// The centroids of all pieces, to be asked about.
  [[nodiscard]] SurfacePoints points() const {
    return {.exact = pieces_.places, .rounded = &pieces_.rounded, .owner = pieces_.owner};
  }

  /// Whether the face is a single piece.
  [[nodiscard]] bool is_whole(std::size_t f) const {
    return pieces_.first[f + 1] - pieces_.first[f] == 1;
  }

  /// Found out by the first who asks.
  struct Neighbourhood {
    PieceNet net{};
    SurfaceEdges edges{};
    std::vector<std::uint8_t> backs{};      ///< hiding_backs().
    std::optional<SliverSearch> slivers{};  ///< Unless there are no faces.
  };

  const Neighbourhood& neighbourhood();

 private:
  Sight sight_;
  std::vector<Triangle> triangles_;  // of the mesh
  Sphere sphere_;                    // of the mesh
  FacePieces pieces_{};
  double total_area_ = 0.0;  // model units squared
  std::once_flag once_{};
  Neighbourhood neighbourhood_{};
};

}  // namespace vantage
