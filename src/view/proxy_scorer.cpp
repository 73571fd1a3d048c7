// SPDX-License-Identifier: MIT
#include "view/proxy_scorer.h"

#include <utility>

#include "vantage/mesh/topology.h"

#include "mesh/decimation.h"

namespace vantage {
namespace {

/// Vertices of the copy: fewer see too little of thin parts. [ours]
constexpr std::size_t kProxyVertices = 2500;
/// A surface of fewer vertices is scored exactly throughout; so is one of which more than this
/// share is left. [ours]
constexpr std::size_t kWorthwhile = 6000;
constexpr double kLargestShare = 0.5;

/// A surface without isolated vertices and broken faces.
struct Compact {
  TriMesh mesh{};
  std::vector<std::uint32_t> vertex_of_row{};
  std::vector<FaceSides> sides{};
};

Compact compact(const TriMesh& surface, const std::vector<FaceSides>& sides) {
  constexpr std::uint32_t kNone = ~std::uint32_t{0};
  std::vector<std::uint32_t> row(surface.positions.size(), kNone);
  std::vector<bool> named(surface.positions.size(), false);
  Compact result;
  for (const Triangle& t : surface.triangles) {
    if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0]) {
      named[t[0]] = named[t[1]] = named[t[2]] = true;
      result.mesh.triangles.push_back(t);
    }
  }
  for (std::uint32_t v = 0; v < row.size(); ++v) {
    if (named[v]) {
      row[v] = static_cast<std::uint32_t>(result.vertex_of_row.size());
      result.vertex_of_row.push_back(v);
      result.mesh.positions.push_back(surface.positions[v]);
    }
  }
  for (Triangle& t : result.mesh.triangles) {
    t = {row[t[0]], row[t[1]], row[t[2]]};
  }
  if (sides.size() == 1) {
    result.sides = sides;
    return result;
  }
  // Components are numbered by their lowest vertex, so that those left keep their order.
  const Components before = connected_components(surface);
  const Components after = connected_components(result.mesh);
  result.sides.resize(after.count, FaceSides::Both);
  for (std::size_t r = 0; r < result.vertex_of_row.size(); ++r) {
    result.sides[after.of_vertex[r]] = sides[before.of_vertex[result.vertex_of_row[r]]];
  }
  return result;
}

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
  const Compact whole = compact(surface, sides);
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
