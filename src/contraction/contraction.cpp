// SPDX-License-Identifier: MIT
#include "vantage/contraction/contraction.h"

#include <algorithm>
#include <optional>
#include <span>
#include <string>
#include <utility>

#include "vantage/core/error.h"
#include "vantage/mesh/measures.h"
#include "vantage/mesh/topology.h"

#include "contraction/component_contraction.h"
#include "contraction/component_scaling.h"
#include "contraction/history_builder.h"
#include "contraction/hole_filling.h"
#include "contraction/hole_sides.h"
#include "contraction/missing_triangles.h"
#include "contraction/proxy.h"
#include "contraction/refinement.h"
#include "contraction/second_mesh.h"
#include "contraction/surface_contraction.h"
#include "core/counted.h"
#include "core/parallel.h"
#include "mesh/extent.h"
#include "mesh/pieces.h"

namespace vantage {
namespace {

/// A surface that is cut into pieces.
struct CutSurface {
  const TriMesh& mesh;
  /// Of the input's vertices, which come first: how many an even mesh of their component needs that
  /// splitting made too many of; 0 of other components. Empty: nothing was split.
  std::span<const std::size_t> even_size{};

  [[nodiscard]] bool is_refined(const Piece& piece) const {
    return !even_size.empty() && piece.vertices.back() >= even_size.size();
  }

  /// How large a proxy of the piece should be; 0 if it needs none.
  [[nodiscard]] std::size_t proxy_size(const Piece& piece,
                                       const ContractionOptions& options) const {
    if (options.method != ContractionMethod::Auto) {
      return 0;
    }
    const std::uint32_t first = piece.vertices.front();
    if (first < even_size.size() && even_size[first] > 0) {
      return even_size[first];
    }
    return piece.vertices.size() > kProxyFrom ? kProxySize : 0;
  }
};

PieceResult contract_piece(const CutSurface& cut, const Piece& piece,
                           const ContractionOptions& options, const RunContext& run) {
  TriMesh scaled{.positions = {}, .triangles = piece.triangles};
  scaled.positions.reserve(piece.vertices.size());
  for (const std::uint32_t v : piece.vertices) {
    scaled.positions.push_back(cut.mesh.positions[v]);
  }
  const ComponentScaling scaling(scaled.positions, options.scaling);
  for (Vec3& p : scaled.positions) {
    p = scaling.scaled(p);
  }
  PieceResult result;
  const std::size_t n = piece.vertices.size();
  if (const std::size_t size = cut.proxy_size(piece, options); size > 0) {
    Proxy proxy = make_proxy(scaled, std::min(kMergedSize, n), size, run);
    if (static_cast<double>(proxy.mesh.positions.size()) < kProxyShare * static_cast<double>(n)) {
      result.proxy = std::move(proxy);
    }
  }
  result.history = contract_surface(scaled, result.proxy, options, run.part(0.0, 0.7));
  if (result.proxy && result.history.summary.steps == 0) {
    result.proxy.reset();
    result.history = contract_surface(scaled, result.proxy, options, run.part(0.7, 0.8));
  }
  if (options.second_mesh) {
    result.second = contract_second_mesh(result.proxy ? result.proxy->mesh : scaled, result.history,
                                         options, run.part(0.8, 1.0));
  }
  result.history.strategy.refined_to = cut.is_refined(piece) ? n : 0;
  const auto to_model = [&scaling](std::vector<Vec3>& points) {
    for (Vec3& p : points) {
      p = scaling.unscaled(p);
    }
  };
  std::for_each(result.history.levels.begin(), result.history.levels.end(), to_model);
  to_model(result.history.thinned);
  to_model(result.second.mesh.positions);
  for (auto* levels : {&result.second.levels, &result.second.here, &result.second.there}) {
    std::for_each(levels->begin(), levels->end(), to_model);
  }
  return result;
}

/// The first pieces, as many as have kMostTogether vertices at most; at least one.
std::span<const Piece> next_together(std::span<const Piece> pieces) {
  std::size_t count = 0;
  std::size_t vertices = 0;
  while (count < pieces.size() &&
         (count == 0 || vertices + pieces[count].vertices.size() <= kMostTogether)) {
    vertices += pieces[count++].vertices.size();
  }
  return pieces.first(count);
}

/// Contracts pieces side by side; a single one with all threads and with its own progress.
std::vector<PieceResult> contract_together(const CutSurface& cut, std::span<const Piece> pieces,
                                           const ContractionOptions& options,
                                           const RunContext& run) {
  std::vector<PieceResult> results(pieces.size());
  std::vector<std::size_t> sizes;
  for (const Piece& piece : pieces) {
    sizes.push_back(piece.vertices.size());
  }
  parallel_items(run, "contracting", sizes, [&](std::size_t i, const RunContext& own) {
    results[i] = contract_piece(cut, pieces[i], options, own);
  });
  return results;
}

ContractionHistory contract_pieces(const TriMesh& mesh, std::span<const std::size_t> even_size,
                                   const ContractionOptions& options, const RunContext& run) {
  const CutSurface cut{.mesh = mesh, .even_size = even_size};
  Pieces pieces = cut_into_pieces(mesh);
  const bool has_proxies =
      std::any_of(pieces.all.begin(), pieces.all.end(),
                  [&](const Piece& piece) { return cut.proxy_size(piece, options) > 0; });
  HistoryBuilder builder(mesh, std::move(pieces.of_vertex), has_proxies, run);
  const auto total = static_cast<double>(mesh.positions.size());
  double done = 0.0;
  for (std::span<const Piece> left(pieces.all); !left.empty();) {
    const std::span<const Piece> together = next_together(left);
    left = left.subspan(together.size());
    double after = done;
    for (const Piece& piece : together) {
      after += static_cast<double>(piece.vertices.size());
    }
    std::vector<PieceResult> results =
        contract_together(cut, together, options, run.part(done / total, after / total));
    for (std::size_t i = 0; i < together.size(); ++i) {
      builder.add(together[i], std::move(results[i]));
    }
    done = after;
  }
  run.advance("contracting", 1.0);
  return std::move(builder).finish();
}

/// The history of the vertices of `mesh`, which come first in the refined surface.
ContractionHistory of_refined(const TriMesh& mesh, RefinedSurface surface,
                              const ContractionOptions& options, const RunContext& run) {
  ContractionHistory history = contract_pieces(surface.mesh, surface.even_size, options, run);
  TriMesh& refined = surface.mesh;
  const std::size_t n = mesh.positions.size();
  for (std::size_t v = n; v < refined.positions.size(); ++v) {
    --history.components[history.component_of_vertex[v]].vertices;
  }
  ContractedRefinement all{std::move(refined), std::exchange(history.levels, {}),
                           std::exchange(history.component_of_vertex, {}),
                           std::exchange(history.thinned, {})};
  const auto first = [n](const auto& of_all) {
    return std::span(of_all).first(std::min(n, of_all.size()));
  };
  for (const auto& level : all.levels) {
    const auto own = first(level);
    history.levels.emplace_back(own.begin(), own.end());
  }
  const auto thinned = first(all.thinned);
  history.thinned.assign(thinned.begin(), thinned.end());
  const auto components = first(all.component_of_vertex);
  history.component_of_vertex.assign(components.begin(), components.end());
  history.refinement = std::move(all);
  return history;
}

/// Closes holes of components that lack little, and single missing triangles of others. \return how many.
std::size_t close_holes(TriMesh& mesh) {
  const std::size_t filled = fill_holes(mesh);
  const std::vector<Triangle> missing = missing_triangles(mesh);
  mesh.triangles.insert(mesh.triangles.end(), missing.begin(), missing.end());
  return filled + missing.size();
}

ContractionHistory contract_by_area(const TriMesh& mesh, const ContractionOptions& options,
                                    const RunContext& run) {
  TriMesh whole;
  std::size_t holes = 0;
  if (!hole_sides(mesh, build_edge_table(mesh)).empty()) {
    whole = mesh;
    holes = close_holes(whole);
  }
  std::optional<RefinedSurface> refined = refine_coarse_components(holes > 0 ? whole : mesh, run);
  if (!refined && holes > 0) {
    refined = RefinedSurface{.mesh = std::move(whole)};
  }
  ContractionHistory history = refined ? of_refined(mesh, std::move(*refined), options, run)
                                       : contract_pieces(mesh, {}, options, run);
  if (holes > 0) {
    history.warnings.push_back(counted(holes, "hole in the surface was",
                                       "holes in the surface were",
                                       " closed before the contraction"));
  }
  return history;
}

}  // namespace

ContractionHistory contract(const TriMesh& mesh, const ContractionOptions& options,
                            const RunContext& run) {
  check_fields(options, kContractionFields);
  if (const std::string problem = finite_problem(mesh.positions); !problem.empty()) {
    throw InvalidInput(problem);
  }
  ContractionOptions resolved = options;
  if (options.weights == ContractionWeights::Auto) {
    resolved.weights = options.method == ContractionMethod::Exact ? ContractionWeights::Vertex
                                                                  : ContractionWeights::Area;
  }
  return resolved.weights == ContractionWeights::Area ? contract_by_area(mesh, resolved, run)
                                                      : contract_pieces(mesh, {}, resolved, run);
}

}  // namespace vantage
