// SPDX-License-Identifier: MIT
#include "contraction/refinement.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

#include "vantage/mesh/measures.h"
#include "vantage/mesh/topology.h"

#include "mesh/edge_splitting.h"
#include "mesh/triangle_corners.h"

namespace vantage {
namespace {

/// A face is coarse if an edge of it is longer than this, over the component's diameter [ours: two
/// skeleton samples].
constexpr double kCoarse = 0.04;
/// A component is refined if coarse faces hold more than this share of its area [ours].
constexpr double kCoarseShare = 0.5;
/// Edges are split down to this length, over the component's diameter [ours: trials in docs/lab].
constexpr double kFineEdge = 0.03;
/// Vertices that refinement may make of a component, about [ours]; its edges stay longer where that
/// is not enough.
constexpr double kMostVertices = 20'000.0;
/// Splitting made far too many vertices of a component from this multiple of the expected on; an even
/// mesh needs this share of the expected, at least so many [ours: trials in docs/lab].
constexpr double kFarMore = 1.5;
constexpr double kEvenShare = 0.5;
constexpr double kFewestExpected = 500.0;
constexpr double kCoarser = 1.25;  // factor on the edge length while that is exceeded
/// Vertices that it may make of all components, about. Where more are expected, components whose
/// diameter is below kSmallPart of the largest get edges of kLongEdge; the edges of all others grow by
/// one common factor, at most to kLongEdge. [ours: trials in docs/lab]
constexpr double kManyVertices = 30'000.0;
constexpr double kSmallPart = 0.25;
constexpr double kLongEdge = 0.08;  // over the component's diameter
/// Vertices that may be added in all, whatever was estimated: a bound on time and memory [ours].
constexpr std::size_t kMostAdded = 150'000;
/// Faces that turn by more than this at their edge meet at a crease. [ours]
constexpr double kCreaseCos = 0.94;  // of 20°

constexpr double kNoBound = std::numeric_limits<double>::infinity();  // an edge length of no bound

/// A component's faces, and how large it is.
struct CoarsePart {
  std::vector<std::uint32_t> faces{};
  double diameter = 0.0;
  double area = 0.0;
  double creases = 0.0;  ///< Length of its creases and borders.
  bool is_coarse = false;
  double edge = 0.0;  ///< Down to which its edges are to be split.
};

/// Measures the creases and borders of all parts, whichever way their faces are wound.
void measure_creases(const TriMesh& mesh, std::vector<CoarsePart>& parts) {
  std::vector<std::uint32_t> part_of(mesh.triangles.size(), 0);
  for (std::uint32_t p = 0; p < parts.size(); ++p) {
    for (const std::uint32_t f : parts[p].faces) {
      part_of[f] = p;
    }
  }
  const EdgeTable table = build_edge_table(mesh);
  for (std::size_t e = 0; e < table.edges.size(); ++e) {
    const auto faces = table.faces_of_edge[e];
    const auto normal = [&](std::size_t i) {
      return area_vector(mesh, mesh.triangles[faces[i]]).normalized();
    };
    if (faces.size() != 2 || std::abs(normal(0).dot(normal(1))) < kCreaseCos) {
      const auto [a, b] = table.edges[e];
      parts[part_of[faces[0]]].creases += (mesh.positions[a] - mesh.positions[b]).norm();
    }
  }
}

std::vector<CoarsePart> parts_of(const TriMesh& mesh) {
  const Components components = connected_components(mesh);
  std::vector<CoarsePart> parts(components.count);
  for (std::uint32_t f = 0; f < mesh.triangles.size(); ++f) {
    parts[components.of_vertex[mesh.triangles[f][0]]].faces.push_back(f);
  }
  for (CoarsePart& part : parts) {
    std::vector<Vec3> corners;
    for (const std::uint32_t f : part.faces) {
      for (const std::uint32_t v : mesh.triangles[f]) {
        corners.push_back(mesh.positions[v]);
      }
      part.area += 0.5 * area_vector(mesh, mesh.triangles[f]).norm();
    }
    part.diameter = corners.empty() ? 0.0 : enclosing_sphere(corners).diameter;
  }
  return parts;
}

bool is_coarse(const TriMesh& mesh, const CoarsePart& part) {
  double coarse = 0.0;
  for (const std::uint32_t f : part.faces) {
    if (longest_edge(mesh, mesh.triangles[f]) > kCoarse * part.diameter) {
      coarse += 0.5 * area_vector(mesh, mesh.triangles[f]).norm();
    }
  }
  return coarse > kCoarseShare * part.area;
}

/// About the number of vertices that splitting the part down to `edge` makes: those of its area, and
/// those along its creases, which long thin parts have more of. It depends on the surface, not on how
/// that is cut into triangles.
double estimated_vertices(const CoarsePart& part, double edge) {
  return edge > 0.0 ? 4.0 * part.area / (edge * edge) + 2.0 * part.creases / edge : 0.0;
}

/// Chooses the length down to which the part's edges are split.
void choose_edge(CoarsePart& part) {
  part.edge = kFineEdge * part.diameter;
  while (part.edge < part.diameter && estimated_vertices(part, part.edge) > kMostVertices) {
    part.edge *= kCoarser;
  }
}

double estimated_vertices(const std::vector<CoarsePart*>& parts) {
  return std::accumulate(parts.begin(), parts.end(), 0.0, [](double sum, const CoarsePart* part) {
    return sum + estimated_vertices(*part, part->edge);
  });
}

/// Where the parts make too many vertices, lengthens edges: those of small parts at once as far as a
/// part may need no more, so that many take nothing from a large one; of the others all alike.
void share_vertices(std::vector<CoarsePart>& parts) {
  double largest = 0.0;
  std::vector<CoarsePart*> all;
  for (CoarsePart& part : parts) {
    largest = std::max(largest, part.diameter);
    all.push_back(&part);
  }
  if (estimated_vertices(all) <= kManyVertices) {
    return;
  }
  std::vector<CoarsePart*> others;
  for (CoarsePart* part : all) {
    if (part->diameter < kSmallPart * largest) {
      part->edge = std::max(part->edge, kLongEdge * part->diameter);
    } else {
      others.push_back(part);
    }
  }
  for (double edge = kFineEdge;
       edge * kCoarser <= kLongEdge && estimated_vertices(others) > kManyVertices;
       edge *= kCoarser) {
    for (CoarsePart* part : others) {
      part->edge *= kCoarser;
    }
  }
}

/// Parts in the order in which they may be refined: the largest first; those whose areas differ by
/// rounding only in the order of the file.
std::vector<std::size_t> largest_first(const std::vector<CoarsePart>& parts) {
  std::vector<std::size_t> order(parts.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return static_cast<float>(parts[a].area) > static_cast<float>(parts[b].area);
  });
  return order;
}

/// Splits the faces of parts down to their edge lengths, times `unit`. Slivers side by side make more
/// vertices than was estimated: where they are too many all edges stay longer, alike.
TriMesh split_parts(const TriMesh& mesh, const std::vector<const CoarsePart*>& parts, double unit,
                    const RunContext& run) {
  for (double factor = unit;; factor *= kCoarser) {
    std::vector<double> longest(mesh.triangles.size(), kNoBound);
    for (const CoarsePart* part : parts) {
      for (const std::uint32_t f : part->faces) {
        longest[f] = factor * part->edge;
      }
    }
    if (std::optional<TriMesh> fine = split_long_edges(mesh, std::move(longest), kMostAdded, run)) {
      return *std::move(fine);
    }
  }
}

/// RefinedSurface::even_size of `mesh` split to `fine`.
std::vector<std::size_t> even_sizes(const TriMesh& mesh,
                                    const std::vector<const CoarsePart*>& parts,
                                    const TriMesh& fine) {
  const Components components = connected_components(fine);
  std::vector<double> made(components.count, 0.0);
  for (const std::uint32_t c : components.of_vertex) {
    made[c] += 1.0;
  }
  std::vector<std::size_t> sizes(mesh.positions.size(), 0);
  for (const CoarsePart* part : parts) {
    const double expected = estimated_vertices(*part, part->edge);
    const std::uint32_t c = components.of_vertex[mesh.triangles[part->faces.front()][0]];
    if (made[c] > kFarMore * std::max(expected, kFewestExpected)) {
      for (const std::uint32_t f : part->faces) {
        for (const std::uint32_t v : mesh.triangles[f]) {
          sizes[v] = static_cast<std::size_t>(std::max(kFewestExpected, kEvenShare * expected));
        }
      }
    }
  }
  return sizes;
}

/// The mesh around the origin, of diameter 1: areas of very large or small models have no double.
TriMesh unit_size(const TriMesh& mesh, const Sphere& sphere) {
  TriMesh unit = mesh;
  for (Vec3& p : unit.positions) {
    p = (p - sphere.centre) / sphere.diameter;
  }
  return unit;
}

}  // namespace

std::optional<RefinedSurface> refine_coarse_components(const TriMesh& mesh, const RunContext& run) {
  const Sphere sphere = enclosing_sphere(referenced_points(mesh));
  if (mesh.triangles.empty() || !(sphere.diameter > 0.0)) {
    return std::nullopt;
  }
  const TriMesh unit = unit_size(mesh, sphere);
  std::vector<CoarsePart> parts = parts_of(unit);
  for (CoarsePart& part : parts) {
    part.is_coarse = is_coarse(unit, part);
  }
  if (std::none_of(parts.begin(), parts.end(), [](const auto& part) { return part.is_coarse; })) {
    return std::nullopt;
  }
  measure_creases(unit, parts);
  std::for_each(parts.begin(), parts.end(), choose_edge);
  share_vertices(parts);
  std::vector<const CoarsePart*> chosen;
  double vertices = 0.0;
  for (const std::size_t p : largest_first(parts)) {
    vertices += estimated_vertices(parts[p], parts[p].edge);
    if (vertices > double{kMostTogether}) {
      break;  // the smaller ones stay as they are
    }
    if (parts[p].is_coarse) {
      chosen.push_back(&parts[p]);
    }
  }
  TriMesh fine = split_parts(mesh, chosen, sphere.diameter, run);
  std::vector<std::size_t> sizes = even_sizes(mesh, chosen, fine);
  return RefinedSurface{std::move(fine), std::move(sizes)};
}

TriMesh refine_whole(const TriMesh& scaled, const RunContext& run) {
  std::vector<CoarsePart> parts = parts_of(scaled);
  measure_creases(scaled, parts);
  std::vector<const CoarsePart*> chosen;
  for (CoarsePart& part : parts) {
    choose_edge(part);
    chosen.push_back(&part);
  }
  return split_parts(scaled, chosen, 1.0, run);
}

}  // namespace vantage
