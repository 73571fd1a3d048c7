// SPDX-License-Identifier: MIT
#include "vantage/mesh/mesh_check.h"

#include <algorithm>
#include <numeric>
#include <vector>

#include "vantage/mesh/measures.h"
#include "vantage/mesh/topology.h"

#include "mesh/disjoint_sets.h"
#include "mesh/triangle_corners.h"

namespace vantage {
namespace {

/// Area below which a face counts as empty, relative to D²: what rounding leaves of a flat
/// triangle whose sides are as long as the model.
constexpr double kZeroArea = 1e-12;

std::size_t count_unnamed_vertices(const TriMesh& mesh) {
  std::vector<bool> named(mesh.positions.size(), false);
  for (const Triangle& t : mesh.triangles) {
    named[t[0]] = named[t[1]] = named[t[2]] = true;
  }
  return static_cast<std::size_t>(std::count(named.begin(), named.end(), false));
}

/// Faces of the same three vertices as another one, all but one of each.
std::size_t count_duplicate_faces(const TriMesh& mesh, const EdgeTable& table) {
  std::size_t duplicates = 0;
  std::vector<std::uint32_t> highest;  // corners of the faces whose lowest side is this edge
  for (std::size_t e = 0; e < table.edges.size(); ++e) {
    highest.clear();
    for (const std::uint32_t f : table.faces_of_edge[e]) {
      const Triangle& t = mesh.triangles[f];
      const std::uint32_t last = std::max({t[0], t[1], t[2]});
      if (last > table.edges[e][1]) {
        highest.push_back(last);
      }
    }
    std::sort(highest.begin(), highest.end());
    const auto end = std::unique(highest.begin(), highest.end());
    duplicates += static_cast<std::size_t>(highest.end() - end);
  }
  std::vector<Triangle> collapsed;  // these have no sides in the table
  for (Triangle t : mesh.triangles) {
    if (names_a_vertex_twice(t)) {
      std::sort(t.begin(), t.end());
      collapsed.push_back(t);
    }
  }
  std::sort(collapsed.begin(), collapsed.end());
  const auto end = std::unique(collapsed.begin(), collapsed.end());
  return duplicates + static_cast<std::size_t>(collapsed.end() - end);
}

void count_faces(const TriMesh& mesh, const EdgeTable& table, MeshReport& report) {
  const double diameter = enclosing_sphere(referenced_points(mesh)).diameter;
  const double empty = kZeroArea * diameter * diameter;
  for (const Triangle& t : mesh.triangles) {
    const bool repeated = names_a_vertex_twice(t);
    report.repeated_index_faces += repeated ? 1 : 0;
    report.zero_area_faces += repeated || 0.5 * area_vector(mesh, t).norm() <= empty ? 1 : 0;
  }
  report.duplicate_faces = count_duplicate_faces(mesh, table);
}

/// Connected groups of the edges that have one face.
std::size_t count_boundary_loops(const TriMesh& mesh, const EdgeTable& table) {
  DisjointSets groups(mesh.positions.size());
  std::vector<bool> on_boundary(mesh.positions.size(), false);
  for (std::size_t e = 0; e < table.edges.size(); ++e) {
    if (table.faces_of_edge[e].size() == 1) {
      const auto [a, b] = table.edges[e];
      groups.join(a, b);
      on_boundary[a] = on_boundary[b] = true;
    }
  }
  std::size_t loops = 0;
  for (std::uint32_t v = 0; v < on_boundary.size(); ++v) {
    loops += on_boundary[v] && groups.root(v) == v ? 1 : 0;
  }
  return loops;
}

void count_edges(const TriMesh& mesh, const EdgeTable& table, MeshReport& report) {
  for (std::size_t e = 0; e < table.edges.size(); ++e) {
    const auto [a, b] = table.edges[e];
    const auto faces = table.faces_of_edge[e];
    if (faces.size() == 1) {
      ++report.boundary_edges;
    } else if (faces.size() > 2) {
      ++report.non_manifold_edges;
    } else if (runs_from(mesh.triangles[faces[0]], a, b) ==
               runs_from(mesh.triangles[faces[1]], a, b)) {
      ++report.inconsistent_edges;
    }
  }
  report.boundary_loops = count_boundary_loops(mesh, table);
}

/// Whether the faces can be turned so that no edge is run twice the same way.
bool is_orientable(const TriMesh& mesh, const EdgeTable& table) {
  const auto face_count = static_cast<std::uint32_t>(mesh.triangles.size());
  DisjointSets sides(2 * mesh.triangles.size());  // face f as it is, and turned (f + face_count)
  for (std::size_t e = 0; e < table.edges.size(); ++e) {
    const auto [a, b] = table.edges[e];
    const auto faces = table.faces_of_edge[e];
    const bool turned =
        runs_from(mesh.triangles[faces[0]], a, b) == runs_from(mesh.triangles[faces[1]], a, b);
    sides.join(faces[0], faces[1] + (turned ? face_count : 0));
    sides.join(faces[0] + face_count, faces[1] + (turned ? 0 : face_count));
  }
  for (std::uint32_t f = 0; f < face_count; ++f) {
    if (sides.root(f) == sides.root(f + face_count)) {
      return false;
    }
  }
  return true;
}

/// Sum of the genera of a closed orientable surface, shells − χ / 2. Where sheets only touch in a
/// vertex they are taken apart: every fan counts as a vertex, and shells are joined over edges.
/// Faces that name a vertex twice have no edges in the table and do not count.
std::size_t total_genus(const TriMesh& mesh, const EdgeTable& table,
                        const std::vector<std::uint32_t>& fans) {
  DisjointSets shells(mesh.triangles.size());
  for (std::size_t e = 0; e < table.edges.size(); ++e) {
    shells.join(table.faces_of_edge[e][0], table.faces_of_edge[e][1]);
  }
  std::size_t faces = 0;
  std::size_t shell_count = 0;
  for (std::uint32_t f = 0; f < mesh.triangles.size(); ++f) {
    if (!names_a_vertex_twice(mesh.triangles[f])) {
      ++faces;
      shell_count += shells.root(f) == f ? 1 : 0;
    }
  }
  const std::size_t vertices = std::accumulate(fans.begin(), fans.end(), std::size_t{0});
  return (2 * shell_count + table.edges.size() - vertices - faces) / 2;
}

}  // namespace

MeshReport check_mesh(const TriMesh& mesh, const RunContext& run) {
  MeshReport report;
  report.vertices = mesh.positions.size();
  report.faces = mesh.triangles.size();
  report.duplicate_vertices = weld(mesh, run).merged_vertices;
  report.isolated_vertices = count_unnamed_vertices(mesh);
  report.components = connected_components(mesh).count - report.isolated_vertices;
  run.check();
  const EdgeTable table = build_edge_table(mesh);
  run.check();
  count_faces(mesh, table, report);
  run.check();
  count_edges(mesh, table, report);
  run.check();
  const std::vector<std::uint32_t> fans = count_fans(mesh);
  report.non_manifold_vertices = static_cast<std::size_t>(
      std::count_if(fans.begin(), fans.end(), [](std::uint32_t count) { return count > 1; }));
  report.closed =
      !table.edges.empty() && report.boundary_edges == 0 && report.non_manifold_edges == 0;
  report.oriented =
      !table.edges.empty() && report.non_manifold_edges == 0 && report.inconsistent_edges == 0;
  run.check();
  report.signed_volume = signed_volume(mesh);
  if (report.closed && (report.oriented || is_orientable(mesh, table))) {
    report.genus = total_genus(mesh, table, fans);
  }
  return report;
}

}  // namespace vantage
