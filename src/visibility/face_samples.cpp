// SPDX-License-Identifier: MIT
#include "visibility/face_samples.h"

#include <algorithm>
#include <cmath>

#include "visibility/hiding_backs.h"

namespace vantage {
namespace {

// Pieces grow when the surface is so folded that more than this many would be needed. [ours]
constexpr double kMaxPieces = 4e6;

}  // namespace

FaceSamples::FaceSamples(const TriMesh& mesh, std::span<const FaceSides> sides, double spacing)
    : sight_(prepare_surface(mesh, sides)),
      triangles_(mesh.triangles),
      sphere_(enclosing_sphere(referenced_points(mesh))) {
  const double unit = surface().frame.scale;
  for (const double twice : surface().twice_areas) {
    total_area_ += 0.5 * twice / (unit * unit);
  }
  // About 6 pieces a squared side.
  const double least_side = std::sqrt(6.0 * total_area_ / kMaxPieces);
  pieces_ = cut_faces(surface(), unit * std::max(spacing * sphere_.diameter, least_side));
}

const FaceSamples::Neighbourhood& FaceSamples::neighbourhood() {
  std::call_once(once_, [&] {
    auto& [net, edges, backs, slivers] = neighbourhood_;
    net = piece_net(surface(), pieces_);
    // Of an open surface corners do not tell enough.
    for (std::size_t f = 0; f < surface().faces.size(); ++f) {
      const bool is_plain = net.is_plain[f] != 0 && surface().sides[f] == FaceSides::Front;
      net.is_plain[f] = is_plain ? 1 : 0;
    }
    if (!surface().faces.empty()) {
      edges = surface_edges(surface());
      const CandidateScene scene(surface().sites, surface().faces);
      backs = hiding_backs(surface(), edges);
      slivers.emplace(surface(), edges, scene, backs);
    }
  });
  return neighbourhood_;
}

}  // namespace vantage
