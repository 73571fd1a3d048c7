// SPDX-License-Identifier: MIT
#include "pipeline/coarse_copies.h"

#include <cstdint>
#include <utility>
#include <vector>

namespace vantage {
namespace {

// Eyes that a search asks the proxy and the coarse copy about, more or less.
constexpr std::size_t kProxyEyes = 300;
constexpr std::size_t kCoarseEyes = 2562;
// A surface that cannot be decimated to this share of its vertices gains nothing by a copy. [ours]
constexpr std::size_t kWorthwhile = 2;
// So many times larger than the coarse copy was to become is large. [ours]
constexpr std::size_t kSeveral = 4;

/// The coarse copy, made from the proxy if there is one.
CoarseSurface coarse_of(const ShapeAnalysis& shape, const CoarseSurface& proxy,
                        const RunContext& run) {
  if (proxy.of_vertex.empty()) {
    return coarse_surface(shape.surface, shape.sides, CoarseCopies::kCoarseVertices, run.quiet());
  }
  CoarseSurface coarse =
      coarse_surface(proxy.mesh, proxy.sides, CoarseCopies::kCoarseVertices, run.quiet());
  std::vector<std::uint32_t> of_vertex;
  of_vertex.reserve(proxy.of_vertex.size());
  for (const std::uint32_t v : proxy.of_vertex) {
    of_vertex.push_back(v == CoarseSurface::kNone ? v : coarse.of_vertex[v]);
  }
  coarse.of_vertex = std::move(of_vertex);
  return coarse;
}

bool is_worthwhile(const CoarseSurface& copy) {
  const std::size_t vertices = copy.of_vertex.size();
  return vertices > 0 && kWorthwhile * copy.mesh.positions.size() <= vertices;
}

}  // namespace

CoarseSurface proxy_of_large(const ShapeAnalysis& shape, const RunContext& run) {
  if (shape.surface.positions.size() <= CoarseCopies::kLargeSurface) {
    return {};
  }
  return coarse_surface(shape.surface, shape.sides, CoarseCopies::kProxyVertices, run.quiet());
}

CoarseCopies::CoarseCopies(const ShapeAnalysis& shape, const RunContext& run,
                           const std::optional<ScoringCamera>& survey_by)
    : proxy((run.check(), proxy_of_large(shape, run))),
      proxy_visibility(proxy.mesh, proxy.sides, kProxyEyes),
      coarse((run.check(), coarse_of(shape, proxy, run))),
      coarse_visibility(coarse.mesh, coarse.sides, kCoarseEyes) {
  if (survey_by && is_coarse()) {
    survey.emplace(coarse_visibility, *survey_by, survey_level(), run);
  }
}

bool CoarseCopies::is_coarse() const {
  return is_worthwhile(coarse);
}

bool CoarseCopies::has_proxy() const {
  return is_worthwhile(proxy);
}

bool CoarseCopies::is_sampled() const {
  return !is_coarse() && coarse.of_vertex.size() > kSeveral * kCoarseVertices;
}

int CoarseCopies::survey_level() const {
  const bool remains_large = coarse.mesh.positions.size() > kSeveral * kCoarseVertices;
  return is_sampled() || (is_coarse() && remains_large) ? 3 : 4;
}

}  // namespace vantage
