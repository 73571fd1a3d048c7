// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <optional>
#include <span>
#include <vector>

#include <Eigen/Geometry>

#include "vantage/mesh/measures.h"
#include "vantage/mesh/mesh_check.h"
#include "vantage/mesh/topology.h"
#include "vantage/visibility/vertex_visibility.h"

#include "core/parallel.h"
#include "mesh/disjoint_sets.h"
#include "mesh/triangle_corners.h"
#include "spatial/enclosing.h"
#include "spatial/ray_scene.h"

namespace vantage {
namespace {

// Rays that ask whether a shell is inside an odd number of others, and how many of them must tell: one
// that grazes an edge has no vote. A shell that is inside lies there whole, so one vote against it is enough.
constexpr int kRays = 40;
constexpr int kLeastVotes = 3;
// A crossing nearer to an edge, or a start nearer to a plane, than this is not trusted: relative to
// the products it is computed from; some thousand rounding errors.
constexpr double kErrorBound = 1e-12;

/// The faces of the mesh over welded vertices, grouped in shells that edges hold together.
struct Shells {
  std::vector<Vec3> positions{};          // in a UnitFrame
  std::vector<Triangle> faces{};          // of welded vertices
  std::vector<std::uint32_t> face_of{};   // face of the mesh that faces[i] was
  std::vector<std::uint32_t> shell_of{};  // of each face, numbered in order of first face
  std::vector<std::vector<std::uint32_t>> members{};  // faces of each shell
  std::vector<std::uint8_t> closed{};  // of each shell: as many faces run along each edge one
                                       // way as the other
};

/// +1 if the face runs along the edge from its lower to its higher vertex, −1 otherwise.
int sense(const Triangle& face, const std::array<std::uint32_t, 2>& edge) {
  return runs_from(face, edge[0], edge[1]) ? 1 : -1;
}

/// Of the faces that meet at the edge those of sets that run more often one way than the other.
std::vector<std::uint32_t> unbalanced(std::span<const std::uint32_t> faces_at_edge,
                                      const std::vector<Triangle>& faces,
                                      const std::array<std::uint32_t, 2>& edge,
                                      DisjointSets& sets) {
  std::vector<std::uint32_t> found;
  if (faces_at_edge.size() == 2 && sets.root(faces_at_edge[0]) == sets.root(faces_at_edge[1]) &&
      sense(faces[faces_at_edge[0]], edge) + sense(faces[faces_at_edge[1]], edge) == 0) {
    return found;  // as nearly everywhere
  }
  std::map<std::uint32_t, int> sum_of_set;
  for (const std::uint32_t f : faces_at_edge) {
    sum_of_set[sets.root(f)] += sense(faces[f], edge);
  }
  std::copy_if(faces_at_edge.begin(), faces_at_edge.end(), std::back_inserter(found),
               [&](std::uint32_t f) { return sum_of_set[sets.root(f)] != 0; });
  return found;
}

/// Joins faces across edges of two; across edges of more only those whose shells need each other to be
/// closed there: two cubes that share an edge remain two shells.
DisjointSets join_faces(const std::vector<Triangle>& faces, const EdgeTable& edges) {
  DisjointSets sets(faces.size());
  for (std::size_t e = 0; e < edges.edges.size(); ++e) {
    if (const auto at_edge = edges.faces_of_edge[e]; at_edge.size() == 2) {
      sets.join(at_edge[0], at_edge[1]);
    }
  }
  // What is joined here closes other edges: which ones are open was decided before, whatever their order.
  DisjointSets joined = sets;
  for (std::size_t e = 0; e < edges.edges.size(); ++e) {
    if (const auto at_edge = edges.faces_of_edge[e]; at_edge.size() > 2) {
      const std::vector<std::uint32_t> open = unbalanced(at_edge, faces, edges.edges[e], sets);
      for (const std::uint32_t f : open) {
        joined.join(open[0], f);
      }
    }
  }
  return joined;
}

Shells find_shells(const TriMesh& mesh, const WeldedMesh& welded, const RunContext& run) {
  Shells shells;
  const UnitFrame frame =
      unit_frame(referenced_points(welded.mesh));  // a lone vertex may be anywhere
  shells.positions = frame.to_frame(welded.mesh.positions);
  for (std::uint32_t f = 0; f < mesh.triangles.size(); ++f) {
    Triangle t = mesh.triangles[f];
    for (std::uint32_t& v : t) {
      v = welded.welded_of_vertex[v];
    }
    if (!names_a_vertex_twice(t)) {
      shells.faces.push_back(t);
      shells.face_of.push_back(f);
    }
  }
  run.check();
  const EdgeTable edges = build_edge_table({.positions = {}, .triangles = shells.faces});
  DisjointSets sets = join_faces(shells.faces, edges);
  run.check();
  shells.shell_of.resize(shells.faces.size());
  for (std::uint32_t f = 0; f < shells.faces.size(); ++f) {
    const std::uint32_t root = sets.root(f);
    if (root == f) {
      shells.shell_of[f] = static_cast<std::uint32_t>(shells.members.size());
      shells.members.emplace_back();
    }
    shells.shell_of[f] = shells.shell_of[root];
    shells.members[shells.shell_of[f]].push_back(f);
  }
  shells.closed.assign(shells.members.size(), 1);
  for (std::size_t e = 0; e < edges.edges.size(); ++e) {
    for (const std::uint32_t f :
         unbalanced(edges.faces_of_edge[e], shells.faces, edges.edges[e], sets)) {
      shells.closed[shells.shell_of[f]] = 0;
    }
  }
  return shells;
}

/// Sign of the enclosed volume: 1 wound outwards, −1 inwards, 0 no inside.
int winding(const Shells& shells, const std::vector<std::uint32_t>& members) {
  const Vec3 origin = shells.positions[shells.faces[members.front()][0]];
  double volume = 0.0;
  double area = 0.0;
  double size = 0.0;
  for (const std::uint32_t f : members) {
    const auto& [i, j, k] = shells.faces[f];
    const Vec3 a = shells.positions[i] - origin;
    const Vec3 b = shells.positions[j] - origin;
    const Vec3 c = shells.positions[k] - origin;
    volume += a.dot(b.cross(c)) / 6.0;
    area += 0.5 * (b - a).cross(c - a).norm();
    size = std::max({size, a.norm(), b.norm(), c.norm()});
  }
  if (std::abs(volume) <= kFlatShell * area * size) {
    return 0;
  }
  return volume > 0.0 ? 1 : -1;
}

enum class Crossing { None, Clear, Doubtful };

/// How the half-line from `start` meets the triangle.
Crossing crossing(const Vec3& start, const Vec3& direction, const Vec3& p, const Vec3& q,
                  const Vec3& r) {
  const Vec3 a = p - start;
  const Vec3 b = q - start;
  const Vec3 c = r - start;
  const double squared_size = std::max({a.squaredNorm(), b.squaredNorm(), c.squaredNorm()});
  const double error_bound = kErrorBound * squared_size;
  const std::array<double, 3> side{direction.dot(b.cross(c)), direction.dot(c.cross(a)),
                                   direction.dot(a.cross(b))};
  const auto [low, high] = std::minmax({side[0], side[1], side[2]});
  const bool passes_beside = low < -error_bound && high > error_bound;
  if (passes_beside) {
    return Crossing::None;
  }
  const Vec3 normal = (b - a).cross(c - a);
  const double height = normal.dot(a);
  const double slope = normal.dot(direction);
  const bool is_off_the_plane =
      std::abs(height) > kErrorBound * std::sqrt(squared_size) * normal.norm();
  const bool is_steep = std::abs(slope) > kErrorBound * normal.norm();
  const bool is_behind = (height > 0.0) != (slope > 0.0);
  if (is_behind && is_off_the_plane && is_steep) {
    return Crossing::None;
  }
  const bool passes_through = low > error_bound || high < -error_bound;
  return passes_through && is_off_the_plane ? Crossing::Clear : Crossing::Doubtful;
}

/// A direction that no modelling tool aligns anything with; `turn` selects one of a sequence that
/// fills the sphere evenly (golden ratio spiral).
Vec3 odd_direction(int turn) {
  const double z = 1.0 - 2.0 * std::fmod(0.5 + 0.7548776662466927 * (turn + 1), 1.0);
  const double angle = 2.3999632297286533 * (turn + 1);
  const double r = std::sqrt(std::max(0.0, 1.0 - z * z));
  return {r * std::cos(angle), r * std::sin(angle), z};
}

/// Tells for closed shells whether an odd number of other closed shells holds them, whole.
class Nesting {
 public:
  explicit Nesting(const Shells& shells) : shells_(shells) {
    if (std::count(shells.closed.begin(), shells.closed.end(), 1) > 1) {
      scene_.emplace(shells.positions, shells.faces);
    }
  }

  [[nodiscard]] bool odd(std::uint32_t shell) const {
    if (!scene_) {
      return false;  // there is no other one
    }
    int votes = 0;
    for (int turn = 0; turn < kRays; ++turn) {
      const std::optional<bool> is_inside = ask(shell, turn);
      if (is_inside == false) {
        return false;
      }
      votes += is_inside ? 1 : 0;
    }
    return votes >= kLeastVotes;
  }

 private:
  /// One ray from the middle of a face of the shell; nothing if it grazes an edge.
  [[nodiscard]] std::optional<bool> ask(std::uint32_t shell, int turn) const {
    const std::vector<std::uint32_t>& members = shells_.members[shell];
    const std::size_t pick = static_cast<std::size_t>(turn) * members.size() / kRays;
    const auto& [a, b, c] = shells_.faces[members[pick]];
    const Vec3 start = (shells_.positions[a] + shells_.positions[b] + shells_.positions[c]) / 3.0;
    const Vec3 direction = odd_direction(turn);
    bool is_inside = false;
    const bool doubtful = scene_->any(
        start, direction, std::numeric_limits<double>::infinity(), [&](std::uint32_t f) {
          const std::uint32_t other = shells_.shell_of[f];
          if (other == shell || shells_.closed[other] == 0) {
            return false;
          }
          const auto& [i, j, k] = shells_.faces[f];
          const Crossing kind = crossing(start, direction, shells_.positions[i],
                                         shells_.positions[j], shells_.positions[k]);
          if (kind == Crossing::Clear) {
            is_inside = !is_inside;
          }
          return kind == Crossing::Doubtful;
        });
    if (doubtful) {
      return std::nullopt;
    }
    return is_inside;
  }

  const Shells& shells_;
  std::optional<CandidateScene> scene_;
};

}  // namespace

OrientedMesh orient_shells(const TriMesh& mesh, const RunContext& run) {
  OrientedMesh result;
  result.mesh = mesh;
  const WeldedMesh welded = weld(mesh, run);
  const Shells shells = find_shells(mesh, welded, run);
  run.check();
  const Components components = connected_components(mesh);
  const Components welded_components = connected_components(welded.mesh);

  // One open shell makes both sides of its whole component count.
  std::vector<FaceSides> welded_sides(welded_components.count, FaceSides::Front);
  const auto component_of = [&](std::uint32_t face) {
    return welded_components.of_vertex[shells.faces[face][0]];
  };
  for (std::size_t s = 0; s < shells.members.size(); ++s) {
    if (shells.closed[s] == 0) {
      welded_sides[component_of(shells.members[s].front())] = FaceSides::Both;
    }
  }
  result.sides.assign(components.count, FaceSides::Both);
  for (std::uint32_t v = 0; v < mesh.positions.size(); ++v) {
    result.sides[components.of_vertex[v]] =
        welded_sides[welded_components.of_vertex[welded.welded_of_vertex[v]]];
  }

  if (shells.faces.empty()) {
    return result;
  }
  run.check();
  const Nesting nesting(shells);
  std::vector<std::uint8_t> turned(shells.members.size(), 0);
  const RunContext quiet = run.quiet();
  parallel_items(quiet, turned.size(), [&](std::size_t i, const RunContext& own) {
    own.check();
    const auto s = static_cast<std::uint32_t>(i);
    const int wound = shells.closed[s] != 0 ? winding(shells, shells.members[s]) : 0;
    turned[s] = wound != 0 && (wound < 0) != nesting.odd(s) ? 1 : 0;
  });
  for (std::size_t s = 0; s < turned.size(); ++s) {
    if (turned[s] != 0) {
      ++result.turned_shells;
      for (const std::uint32_t f : shells.members[s]) {
        Triangle& t = result.mesh.triangles[shells.face_of[f]];
        std::swap(t[1], t[2]);
      }
    }
  }
  return result;
}

}  // namespace vantage
