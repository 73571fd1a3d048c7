// SPDX-License-Identifier: MIT
#include "contraction/second_mesh.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "contraction/proxy.h"
#include "contraction/surface_contraction.h"

namespace vantage {
namespace {

/// Vertices of a second mesh: at most this many, and at most this share of the first mesh's [ours:
/// trials in docs/lab].
constexpr std::size_t kSecondSize = 1'500;
constexpr double kSecondShare = 1.0 / 3.0;
/// Components of fewer vertices are not meshed anew.
constexpr std::size_t kFewest = 32;

/// The vertex nearest to each second one, of those merged in it.
std::vector<std::uint32_t> nearest_merged(const TriMesh& first, const Proxy& second) {
  const std::size_t count = second.mesh.positions.size();
  std::vector<std::uint32_t> nearest(count, 0);
  std::vector<double> least(count, std::numeric_limits<double>::infinity());
  for (std::uint32_t v = 0; v < first.positions.size(); ++v) {
    const std::uint32_t to = second.of_vertex[v];
    const double distance = (first.positions[v] - second.mesh.positions[to]).squaredNorm();
    if (distance < least[to]) {
      least[to] = distance;
      nearest[to] = v;
    }
  }
  return nearest;
}

/// A component that is not meshed anew.
SecondMesh itself(const TriMesh& first, const ComponentHistory& history) {
  return {.mesh = first,
          .levels = history.levels,
          .component_of_vertex = std::vector<std::uint32_t>(first.positions.size(), 0),
          .here = history.levels,
          .there = history.levels,
          .remeshing = {Remeshing::None}};
}

/// Repeats the last level until there are so many. \pre levels not empty.
void pad(std::vector<std::vector<Vec3>>& levels, std::size_t count) {
  while (levels.size() < count) {
    levels.push_back(levels.back());
  }
}

/// Appends to each level.
void append_levels(std::vector<std::vector<Vec3>> part, std::vector<std::vector<Vec3>>& all,
                   std::size_t count) {
  pad(part, count);
  if (all.empty()) {
    all.resize(count);
  }
  pad(all, count);
  for (std::size_t level = 0; level < count; ++level) {
    all[level].insert(all[level].end(), part[level].begin(), part[level].end());
  }
}

}  // namespace

SecondMesh contract_second_mesh(const TriMesh& first, const ComponentHistory& history,
                                const ContractionOptions& options, const RunContext& run) {
  const auto share =
      static_cast<std::size_t>(kSecondShare * static_cast<double>(first.positions.size()));
  if (first.positions.size() < kFewest || history.summary.steps == 0) {
    return itself(first, history);
  }
  const std::size_t target = std::min(kSecondSize, share);
  const Proxy second = make_proxy(first, target, target, run);
  const std::vector<std::uint32_t> points = nearest_merged(first, second);
  ComponentHistory other = contract_surface(second.mesh, std::nullopt, options, run);
  SecondMesh result{
      .mesh = second.mesh,
      .levels = std::move(other.levels),
      .component_of_vertex = std::vector<std::uint32_t>(second.mesh.positions.size(), 0)};
  const auto vertices = static_cast<double>(second.mesh.positions.size());
  const bool is_hardly = vertices > kProxyShare * static_cast<double>(first.positions.size());
  result.remeshing = {is_hardly ? Remeshing::Hardly : Remeshing::Coarser};
  for (std::size_t level = 0; level < history.levels.size(); ++level) {
    const std::vector<Vec3>& at = result.levels[std::min(level, result.levels.size() - 1)];
    auto& by_first = result.here.emplace_back();
    auto& by_second = result.there.emplace_back();
    for (const std::uint32_t v : points) {
      by_first.push_back(history.levels[level][v]);
      by_second.push_back(position_of(second.place[v], second.mesh, at));
    }
  }
  return result;
}

void append(SecondMesh part, SecondMesh& all) {
  const auto first = static_cast<std::uint32_t>(all.mesh.positions.size());
  const std::uint32_t component =
      all.component_of_vertex.empty() ? 0 : all.component_of_vertex.back() + 1;
  const std::size_t own = std::max(part.levels.size(), all.levels.size());
  const std::size_t count = std::max(part.here.size(), all.here.size());
  all.mesh.positions.insert(all.mesh.positions.end(), part.mesh.positions.begin(),
                            part.mesh.positions.end());
  for (const Triangle& t : part.mesh.triangles) {
    all.mesh.triangles.push_back({first + t[0], first + t[1], first + t[2]});
  }
  all.component_of_vertex.insert(all.component_of_vertex.end(), part.mesh.positions.size(),
                                 component);
  all.remeshing.insert(all.remeshing.end(), part.remeshing.begin(), part.remeshing.end());
  append_levels(std::move(part.levels), all.levels, own);
  append_levels(std::move(part.here), all.here, count);
  append_levels(std::move(part.there), all.there, count);
}

}  // namespace vantage
