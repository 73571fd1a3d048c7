// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "vantage/contraction/history.h"
#include "vantage/core/run_context.h"
#include "vantage/mesh/tri_mesh.h"

#include "contraction/component_contraction.h"
#include "contraction/proxy.h"
#include "mesh/pieces.h"

namespace vantage {

/// What one piece's contraction gave, in model units.
struct PieceResult {
  ComponentHistory history{};
  std::optional<Proxy> proxy{};  ///< What `history` is of, if not of the piece itself.
  SecondMesh second{};           ///< The same meshed anew.
};

/// Makes the history of a surface of those of its pieces.
class HistoryBuilder {
 public:
  /// \param piece_of_vertex as in Pieces. \param has_proxies whether a piece may have one.
  HistoryBuilder(const TriMesh& mesh, std::vector<std::uint32_t> piece_of_vertex, bool has_proxies,
                 const RunContext& run);

  /// Adds the next piece.
  void add(const Piece& piece, PieceResult result);

  /// \pre all pieces were added.
  [[nodiscard]] ContractionHistory finish() &&;

 private:
  void add_levels(const Piece& piece, const PieceResult& result);
  void add_merged(const Piece& piece, const std::optional<Proxy>& proxy);
  void fill_thinned();

  const RunContext& run_;
  ContractionHistory history_{};
  std::vector<ComponentHistory> parts_{};  ///< Of each piece what summarise() reads: no levels.
};

}  // namespace vantage
