// SPDX-License-Identifier: MIT
#include "view/proxy_scorer.h"

#include <utility>

#include "mesh/decimation.h"
#include "view/compact_surface.h"

namespace vantage {
namespace {

/// Vertices of the copy: fewer see too little of thin parts. [ours]
constexpr std::size_t kProxyVertices = 2500;
/// A surface of fewer vertices is scored exactly throughout; so is one of which more than this
/// share is left. [ours]
constexpr std::size_t kWorthwhile = 6000;
constexpr double kLargestShare = 0.5;

}  // namespace

struct ProxyScorer::Parts {
  std::vector<double> significance{};
  std::optional<VertexVisibility> visibility{};
  std::optional<ViewScorer> scorer{};
};

ProxyScorer::ProxyScorer(std::unique_ptr<Parts> parts) : parts_(std::move(parts)) {}

std::optional<ProxyScorer> ProxyScorer::make(const TriMesh& surface,
                                             const std::vector<FaceSides>& sides,
                                             std::span<const double> significance,
                                             const ScoringCamera& camera, const RunContext& run) {
  if (surface.positions.size() < kWorthwhile) {
    return std::nullopt;
  }
  const CompactSurface whole = compact_surface(surface, sides);
  const Decimation coarse = decimate(whole.mesh, kProxyVertices, run);
  const auto left = static_cast<double>(coarse.mesh.positions.size());
  if (left > kLargestShare * static_cast<double>(whole.mesh.positions.size())) {
    return std::nullopt;
  }
  // A collapse keeps components apart and their order, and so the sides.
  auto parts = std::make_unique<Parts>();
  parts->significance.assign(coarse.mesh.positions.size(), 0.0);
  for (std::size_t r = 0; r < whole.vertex_of_row.size(); ++r) {
    parts->significance[coarse.of_vertex[r]] += significance[whole.vertex_of_row[r]];
  }
  parts->visibility.emplace(coarse.mesh, whole.sides);
  parts->scorer.emplace(*parts->visibility, parts->significance, camera);
  return ProxyScorer(std::move(parts));
}

std::vector<double> ProxyScorer::score_all(std::span<const Vec3> directions,
                                           const RunContext& run) const {
  return parts_->scorer->score_all(directions, run);
}

}  // namespace vantage
