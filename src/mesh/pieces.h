// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "vantage/mesh/tri_mesh.h"

namespace vantage {

/// One component cut out of a mesh, and where its vertices came from.
struct Piece {
  std::vector<std::uint32_t> vertices{};  ///< Ascending.
  std::vector<Triangle> triangles{};      ///< In indices of `vertices`.
};

/// A mesh by components that have faces, in the order of their first vertices. Faces that name a vertex
/// twice are left out.
struct Pieces {
  static constexpr std::uint32_t kIsolated = 0xffffffffu;  ///< Of a vertex without faces.

  std::vector<Piece> all{};
  std::vector<std::uint32_t> of_vertex{};  ///< |V| pieces, or kIsolated.
  std::vector<std::uint32_t> local{};      ///< |V| indices in the piece's `vertices`.
};

Pieces cut_into_pieces(const TriMesh& mesh);

}  // namespace vantage
