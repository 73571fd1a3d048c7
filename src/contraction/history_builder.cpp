// SPDX-License-Identifier: MIT
#include "contraction/history_builder.h"

#include <algorithm>
#include <utility>

#include "contraction/history_summary.h"
#include "contraction/second_mesh.h"

namespace vantage {

static_assert(Pieces::kIsolated == ContractionHistory::kIsolated);

HistoryBuilder::HistoryBuilder(const TriMesh& mesh, std::vector<std::uint32_t> piece_of_vertex,
                               bool has_proxies, const RunContext& run)
    : run_(run) {
  history_.levels.push_back(mesh.positions);
  history_.component_of_vertex = std::move(piece_of_vertex);
  if (!has_proxies) {
    return;
  }
  MergedSurface& merged = history_.merged.emplace();
  merged.of_vertex.resize(mesh.positions.size());
  for (std::size_t v = 0; v < merged.of_vertex.size(); ++v) {
    if (history_.component_of_vertex[v] == ContractionHistory::kIsolated) {
      merged.of_vertex[v] = static_cast<std::uint32_t>(merged.vertex_count++);
    }
  }
}

void HistoryBuilder::add(const Piece& piece, PieceResult result) {
  add_levels(piece, result);
  if (!result.second.levels.empty()) {
    append(std::move(result.second), history_.second);
  }
  if (history_.merged) {
    add_merged(piece, result.proxy);
  }
  // Its points are in `history_` now: the peak is what is contracted at once.
  parts_.push_back({.shrinkage = std::move(result.history.shrinkage),
                    .summary = std::move(result.history.summary),
                    .strategy = std::move(result.history.strategy)});
}

ContractionHistory HistoryBuilder::finish() && {
  fill_thinned();
  summarise(parts_, history_);
  return std::move(history_);
}

/// Writes a piece's levels into those of all vertices, of which there may be more by then.
void HistoryBuilder::add_levels(const Piece& piece, const PieceResult& result) {
  const auto& levels = result.history.levels;
  while (history_.levels.size() < levels.size()) {
    history_.levels.push_back(history_.levels.back());
  }
  const auto carry = [&](const std::vector<Vec3>& from, std::vector<Vec3>& to) {
    std::vector<Vec3> fine;
    if (result.proxy) {
      fine = carried(*result.proxy, from, run_);
    }
    const std::vector<Vec3>& own = result.proxy ? fine : from;
    for (std::size_t i = 0; i < piece.vertices.size(); ++i) {
      to[piece.vertices[i]] = own[i];
    }
  };
  // What takes no step stays at its exact input position.
  for (std::size_t level = 1; levels.size() > 1 && level < history_.levels.size(); ++level) {
    carry(levels[std::min(level, levels.size() - 1)], history_.levels[level]);
  }
  if (!result.history.thinned.empty()) {
    history_.thinned.resize(history_.component_of_vertex.size());
    carry(result.history.thinned, history_.thinned);
  }
}

/// Adds a piece as it was merged, or as it is.
void HistoryBuilder::add_merged(const Piece& piece, const std::optional<Proxy>& proxy) {
  MergedSurface& merged = *history_.merged;
  const auto first = static_cast<std::uint32_t>(merged.vertex_count);
  for (std::uint32_t i = 0; i < piece.vertices.size(); ++i) {
    merged.of_vertex[piece.vertices[i]] = first + (proxy ? proxy->merged.of_vertex[i] : i);
  }
  for (const Triangle& t : proxy ? proxy->merged.triangles : piece.triangles) {
    merged.triangles.push_back({first + t[0], first + t[1], first + t[2]});
  }
  merged.vertex_count += proxy ? proxy->merged.vertex_count : piece.vertices.size();
}

/// What was not thinned stands in `thinned` as at the last level, if it has anything.
void HistoryBuilder::fill_thinned() {
  for (std::size_t v = 0; v < history_.thinned.size(); ++v) {
    const std::uint32_t piece = history_.component_of_vertex[v];
    if (piece == ContractionHistory::kIsolated || !parts_[piece].strategy.is_thinned) {
      history_.thinned[v] = history_.levels.back()[v];
    }
  }
}

}  // namespace vantage
