// SPDX-License-Identifier: MIT
#include "vantage/contraction/contraction.h"

#include <algorithm>

#include "vantage/mesh/measures.h"
#include "vantage/mesh/topology.h"

#include "contraction/component_contraction.h"

namespace vantage {
namespace {

constexpr double kSphereSide = 2.0;  // ours: D = 2
constexpr double kBoxSide = 1.6;     // Cao 2010: the longest side of the box

/// One component cut out of the mesh, and where its vertices came from.
struct Piece {
  std::vector<std::uint32_t> vertices{};
  std::vector<Triangle> triangles{};  // in indices of `vertices`
};

/// x_scaled = (x − centre) · factor.
struct Scaling {
  Vec3 centre = Vec3::Zero();
  double factor = 1.0;
};

Scaling scaling_of(const std::vector<Vec3>& points, ContractionScaling kind) {
  if (kind == ContractionScaling::Box) {
    const Box box = bounding_box(points);
    const double side = box.longest_side();
    return {box.low + 0.5 * box.size(), side > 0.0 ? kBoxSide / side : 1.0};
  }
  const Sphere sphere = enclosing_sphere(points);
  return {sphere.centre, sphere.diameter > 0.0 ? kSphereSide / sphere.diameter : 1.0};
}

std::vector<Piece> cut_into_pieces(const TriMesh& mesh, std::vector<std::uint32_t>& of_vertex) {
  const Components components = connected_components(mesh);
  std::vector<bool> has_faces(components.count, false);
  for (const Triangle& t : mesh.triangles) {
    has_faces[components.of_vertex[t[0]]] = true;
  }
  std::vector<std::uint32_t> piece_of_component(components.count, ContractionHistory::kIsolated);
  std::vector<Piece> pieces;
  std::vector<std::uint32_t> local(mesh.positions.size(), 0);
  of_vertex.assign(mesh.positions.size(), ContractionHistory::kIsolated);
  for (std::uint32_t v = 0; v < mesh.positions.size(); ++v) {
    const std::uint32_t component = components.of_vertex[v];
    if (!has_faces[component]) {
      continue;
    }
    if (piece_of_component[component] == ContractionHistory::kIsolated) {
      piece_of_component[component] = static_cast<std::uint32_t>(pieces.size());
      pieces.emplace_back();
    }
    Piece& piece = pieces[piece_of_component[component]];
    of_vertex[v] = piece_of_component[component];
    local[v] = static_cast<std::uint32_t>(piece.vertices.size());
    piece.vertices.push_back(v);
  }
  for (const Triangle& t : mesh.triangles) {
    if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0]) {
      pieces[of_vertex[t[0]]].triangles.push_back({local[t[0]], local[t[1]], local[t[2]]});
    }
  }
  return pieces;
}

ComponentHistory contract_piece(const TriMesh& mesh, const Piece& piece,
                                const ContractionOptions& options, const RunContext& run) {
  TriMesh scaled{.positions = {}, .triangles = piece.triangles};
  for (const std::uint32_t v : piece.vertices) {
    scaled.positions.push_back(mesh.positions[v]);
  }
  const Scaling scaling = scaling_of(scaled.positions, options.scaling);
  for (Vec3& p : scaled.positions) {
    p = (p - scaling.centre) * scaling.factor;
  }
  if (scaled.triangles.empty()) {
    return {.levels = {scaled.positions},
            .shrinkage = {1.0},
            .summary = {.vertices = scaled.positions.size()}};
  }
  ComponentHistory history = contract_component(scaled, options, run);
  for (auto& level : history.levels) {
    for (Vec3& p : level) {
      p = p / scaling.factor + scaling.centre;
    }
  }
  return history;
}

/// Writes a piece's levels into the history of all vertices, adding levels as needed.
void place(const Piece& piece, const ComponentHistory& part, const TriMesh& mesh,
           ContractionHistory& history) {
  while (history.levels.size() < part.levels.size()) {
    history.levels.push_back(history.levels.empty() ? mesh.positions : history.levels.back());
  }
  for (std::size_t level = 1; level < history.levels.size(); ++level) {
    const auto& from = part.levels[std::min(level, part.levels.size() - 1)];
    if (part.levels.size() == 1) {
      continue;  // stays at its exact input position
    }
    for (std::size_t i = 0; i < piece.vertices.size(); ++i) {
      history.levels[level][piece.vertices[i]] = from[i];
    }
  }
}

void summarise(const std::vector<ComponentHistory>& parts, ContractionHistory& history) {
  std::size_t failed = 0;
  std::size_t regularised = 0;
  history.shrinkage.assign(history.levels.size(), 0.0);
  double vertices = 0.0;
  for (const ComponentHistory& part : parts) {
    const auto weight = static_cast<double>(part.summary.vertices);
    vertices += weight;
    for (std::size_t level = 0; level < history.levels.size(); ++level) {
      history.shrinkage[level] +=
          weight * part.shrinkage[std::min(level, part.shrinkage.size() - 1)];
    }
    failed += part.summary.stop == ContractionStop::SolverFailed ? 1 : 0;
    regularised += part.summary.regularised_steps > 0 ? 1 : 0;
    history.components.push_back(part.summary);
  }
  for (double& a : history.shrinkage) {
    a = vertices > 0.0 ? a / vertices : 1.0;
  }
  if (regularised > 0) {
    history.warnings.push_back(
        "slivers made the contraction ill-conditioned; regularised steps in " +
        std::to_string(regularised) + " component(s)");
  }
  if (failed > 0) {
    history.warnings.push_back("the contraction of " + std::to_string(failed) +
                               " component(s) ended early because its system could not be solved");
  }
}

}  // namespace

std::string_view stop_name(ContractionStop stop) {
  switch (stop) {
    case ContractionStop::Shrunk:
      return "shrunk";
    case ContractionStop::Grew:
      return "grew";
    case ContractionStop::StepLimit:
      return "step-limit";
    case ContractionStop::NothingToMove:
      return "nothing-to-move";
    case ContractionStop::SolverFailed:
      return "solver-failed";
  }
  return "unknown";
}

ContractionHistory contract(const TriMesh& mesh, const ContractionOptions& options,
                            const RunContext& run) {
  check_fields(options, kContractionFields);
  ContractionHistory history;
  const std::vector<Piece> pieces = cut_into_pieces(mesh, history.component_of_vertex);
  history.levels.push_back(mesh.positions);
  std::vector<ComponentHistory> parts;
  parts.reserve(pieces.size());
  double done = 0.0;
  const auto total = static_cast<double>(mesh.positions.size());
  for (const Piece& piece : pieces) {
    const double share = static_cast<double>(piece.vertices.size()) / total;
    parts.push_back(
        contract_piece(mesh, piece, options, run.part(done, std::min(1.0, done + share))));
    done = std::min(1.0, done + share);
    place(piece, parts.back(), mesh, history);
    parts.back().levels.clear();  // now in `history`; keeps the peak at one copy
  }
  summarise(parts, history);
  run.advance("contracting", 1.0);
  return history;
}

}  // namespace vantage
