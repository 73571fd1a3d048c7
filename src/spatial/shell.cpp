// SPDX-License-Identifier: MIT
#include "spatial/shell.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include <Eigen/Geometry>

#include "vantage/mesh/measures.h"
#include "vantage/mesh/topology.h"

#include "spatial/enclosing.h"

namespace vantage {
namespace {

/// Faces that a way meets in a cell, in the mean, beyond which walls are looked for by rays: long faces
/// of thin tubes fill the same cells [ours].
constexpr double kMostMet = 500.0;
/// A ray from a vertex passes over the faces at that vertex: a ten-thousandth of the model.
constexpr double kSkip = 1e-4;
/// Parts of a segment shorter than this share of it are rounding errors of where it is cut.
constexpr double kRounding = 1e-9;
/// A point nearer to the surface than this share of the model is on it.
constexpr double kAside = 1e-6;
/// A segment that passes a face's plane farther than this share of the model from the face does not
/// meet it, unless it runs nearly along the plane, where rounding moves the place.
constexpr double kBeside = 1e-9;
constexpr double kAlongPlane = 1e-6;
/// Where a segment is looked at before it is cut.
constexpr std::array kFirstLooks{0.5, 0.25, 0.75, 0.125, 0.625, 0.375, 0.875};
constexpr double kFar = std::numeric_limits<double>::infinity();

TriMesh in_frame(const TriMesh& mesh, const UnitFrame& frame) {
  return {frame.to_frame(mesh.positions), mesh.triangles};
}

std::vector<Vec3> vertex_normals(const TriMesh& mesh) {
  std::vector<Vec3> normals(mesh.positions.size(), Vec3::Zero());
  for (const Triangle& t : mesh.triangles) {
    const Vec3 twice_area = area_vector(mesh, t);
    for (const std::uint32_t v : t) {
      normals[v] += twice_area;
    }
  }
  for (Vec3& n : normals) {
    n.stableNormalize();
  }
  return normals;
}

std::vector<Vec3> corners_of(const TriMesh& mesh, std::span<const std::uint32_t> faces) {
  std::vector<Vec3> corners;
  corners.reserve(3 * faces.size());
  for (const std::uint32_t f : faces) {
    for (const std::uint32_t v : mesh.triangles[f]) {
      corners.push_back(mesh.positions[v]);
    }
  }
  return corners;
}

}  // namespace

Shell::Shell(const TriMesh& mesh, std::span<const std::uint32_t> component_of_vertex,
             std::size_t most_walked)
    : mesh_(mesh), component_of_vertex_(component_of_vertex), normal_(vertex_normals(mesh)) {
  look_at_edges();
  sort_faces();
  if (mesh.triangles.size() > most_walked || whole_.faces_met() > kMostMet) {
    frame_ = unit_frame(referenced_points(mesh));
    rays_.emplace(in_frame(mesh, frame_));
  }
}

void Shell::look_at_edges() {
  const EdgeTable table = build_edge_table(mesh_);
  is_open_ = open_components(mesh_, table, component_of_vertex_);
  neighbours_ = vertex_neighbours(table, mesh_.positions.size());
}

/// A grid of all faces, where walls are looked for, and one of each closed component, where it is asked
/// what is inside: a grid over parts that are far apart has each of them in a few of its cells.
void Shell::sort_faces() {
  const Box box = bounding_box(referenced_points(mesh_));  // a lone vertex may be anywhere
  box.size().minCoeff(&up_);  // along the shortest side, projections overlap least
  size_ = box.longest_side();
  std::vector<std::uint32_t> all(mesh_.triangles.size());
  std::iota(all.begin(), all.end(), 0U);
  whole_ = FaceGrid(mesh_, all, box, up_);
  std::vector<std::vector<std::uint32_t>> of_component(is_open_.size());
  for (const std::uint32_t f : all) {
    const std::uint32_t component = component_of_vertex_[mesh_.triangles[f][0]];
    if (!is_open(component)) {
      of_component[component].push_back(f);
    }
  }
  if (std::any_of(of_component.begin(), of_component.end(),
                  [&](const auto& faces) { return faces.size() == all.size(); })) {
    return;  // of one component, which has all of the faces
  }
  for (const std::vector<std::uint32_t>& faces : of_component) {
    grids_.emplace_back(mesh_, faces, bounding_box(corners_of(mesh_, faces)), up_);
  }
}

/// +1 or −1 if the projected edge passes the projected point on one side, upwards or downwards; the
/// same decision for both faces at the edge, so that no point slips between two faces.
int Shell::crossing(std::uint32_t from, std::uint32_t to, const Vec3& p) const {
  const int x = (up_ + 1) % 3;
  const int y = (up_ + 2) % 3;
  const Vec3& a = mesh_.positions[std::min(from, to)];
  const Vec3& b = mesh_.positions[std::max(from, to)];
  const bool up = b[y] > p[y];
  if ((a[y] > p[y]) == up) {
    return 0;
  }
  const double side = (b[x] - a[x]) * (p[y] - a[y]) - (b[y] - a[y]) * (p[x] - a[x]);
  if (up ? !(side > 0.0) : !(side < 0.0)) {
    return 0;
  }
  return up == (from < to) ? 1 : -1;
}

/// How often the face, seen along the up axis, winds around the point, if it lies above it.
int Shell::winding_of_face(const Triangle& t, const Vec3& p) const {
  const Vec3& a = mesh_.positions[t[0]];
  const Vec3& b = mesh_.positions[t[1]];
  const Vec3& c = mesh_.positions[t[2]];
  const auto [low, high] = std::minmax({a[up_], b[up_], c[up_]});
  const int x = (up_ + 1) % 3;
  const int y = (up_ + 2) % 3;
  const bool above = a[y] > p[y];
  if (!(high > p[up_]) || (above == (b[y] > p[y]) && above == (c[y] > p[y]))) {
    return 0;  // below the point, or no edge passes it
  }
  const int winding = crossing(t[0], t[1], p) + crossing(t[1], t[2], p) + crossing(t[2], t[0], p);
  if (winding == 0) {
    return 0;
  }
  std::array<double, 3> share{};
  double total = 0.0;
  double height = 0.0;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3 u = mesh_.positions[t.at((i + 1) % 3)] - p;
    const Vec3 v = mesh_.positions[t.at((i + 2) % 3)] - p;
    share.at(i) = u[x] * v[y] - u[y] * v[x];
    total += share.at(i);
    height += share.at(i) * mesh_.positions[t.at(i)][up_];
  }
  height = total != 0.0 ? std::clamp(height / total, low, high) : high;
  return height > p[up_] ? winding : 0;
}

bool Shell::inside(std::uint32_t component, const Vec3& point) const {
  if (is_open(component)) {
    return true;
  }
  int winding = 0;
  grid_of(component).visit_at(point,
                              [&](const Triangle& t) { winding += winding_of_face(t, point); });
  return winding != 0;
}

bool Shell::well_inside(std::uint32_t component, const Vec3& point) const {
  for (int axis = 0; axis < 3; ++axis) {
    for (const double sense : {-1.0, 1.0}) {
      if (!inside(component, point + sense * kAside * size_ * Vec3::Unit(axis))) {
        return false;
      }
    }
  }
  return inside(component, point);
}

/// Whether a point of the face's plane lies in the face or next to it.
bool Shell::is_near(const Triangle& t, const Vec3& normal, const Vec3& p) const {
  const double beside = kBeside * size_;
  for (std::size_t c = 0; c < 3; ++c) {
    const Vec3& corner = mesh_.positions[t.at(c)];
    const Vec3 side = mesh_.positions[t.at((c + 1) % 3)] - corner;
    if (normal.dot(side.cross(p - corner)) < -beside * side.norm()) {
      return false;
    }
  }
  return true;
}

/// Where a segment passes the plane of a face.
struct Shell::Passage {
  Vec3 normal;   // of the face, as long as twice its area
  double place;  // share of the way
  double rise;   // of the segment over the plane, times the normal's length
};

/// Nothing if both ends of the segment lie on one side.
std::optional<Shell::Passage> Shell::passage(const Triangle& t, const Vec3& a,
                                             const Vec3& b) const {
  const Vec3& p = mesh_.positions[t[0]];
  const Vec3 normal = area_vector(mesh_, t);
  const double from = normal.dot(a - p);
  const double to = normal.dot(b - p);
  if ((from < 0.0) == (to < 0.0)) {
    return std::nullopt;
  }
  return Passage{normal, from / (from - to), std::abs(from - to)};
}

/// Where the segment from a (0) to b (1) passes through the component's surface, sorted; both ends
/// are among them.
std::vector<double> Shell::cuts(std::uint32_t component, const Vec3& a, const Vec3& b) const {
  const Vec3 way = b - a;
  std::vector<double> places{0.0, 1.0};
  const auto look_at = [&](const Triangle& t) {
    if (const auto passed = passage(t, a, b)) {
      const double length = passed->normal.norm();
      if (passed->rise < kAlongPlane * length * way.norm() ||
          is_near(t, passed->normal / length, a + passed->place * way)) {
        places.push_back(passed->place);
      }
    }
  };
  grid_of(component).walk(a, b, look_at, [](double) { return false; });
  std::sort(places.begin(), places.end());
  return places;
}

/// The share of the way from a to b, at least `nearest`, where it first meets a face; above 1 if
/// nowhere.
double Shell::first_hit(const Vec3& a, const Vec3& b, double nearest) const {
  const Vec3 way = b - a;
  double hit = kFar;
  const auto look_at = [&](const Triangle& t) {
    const auto passed = passage(t, a, b);
    if (passed && passed->place >= nearest && passed->place < hit &&
        is_near(t, passed->normal.stableNormalized(), a + passed->place * way)) {
      hit = passed->place;
    }
  };
  whole_.walk(a, b, look_at, [&](double share) { return hit <= share; });
  return hit;
}

double Shell::outside_length(std::uint32_t component, const Vec3& a, const Vec3& b) const {
  if (is_open(component)) {
    return 0.0;
  }
  const std::vector<double> places = cuts(component, a, b);
  double share = 0.0;
  for (std::size_t i = 1; i < places.size(); ++i) {
    const double width = places[i] - places[i - 1];
    const double s = 0.5 * (places[i] + places[i - 1]);
    if (width > kRounding && !inside(component, (1.0 - s) * a + s * b)) {
      share += width;
    }
  }
  return share * (b - a).norm();
}

bool Shell::inside(std::uint32_t component, const Vec3& a, const Vec3& b) const {
  if (is_open(component)) {
    return true;
  }
  // As outside_length(), but the first place outside decides. Most segments that leave the inside
  // do so for long enough to be seen at a few places, which are had for less than the cuts.
  for (const double s : kFirstLooks) {
    if (!inside(component, (1.0 - s) * a + s * b)) {
      return false;
    }
  }
  const std::vector<double> places = cuts(component, a, b);
  for (std::size_t i = 1; i < places.size(); ++i) {
    const double s = 0.5 * (places[i] + places[i - 1]);
    if (places[i] - places[i - 1] > kRounding && !inside(component, (1.0 - s) * a + s * b)) {
      return false;
    }
  }
  return true;
}

/// Length of the way from a vertex along a unit direction to the first face; infinite if none is met.
double Shell::way_to_wall(std::uint32_t vertex, const Vec3& direction) const {
  const Vec3& origin = mesh_.positions[vertex];
  if (rays_) {
    const Vec3f start = frame_.to_frame(origin).cast<float>();
    const RayHit hit = rays_->closest_hit(start, direction.cast<float>(),
                                          static_cast<float>(kSkip * size_ * frame_.scale));
    return hit ? static_cast<double>(hit.t) / frame_.scale : kFar;
  }
  const double reach = 2.0 * size_;  // farther than any two points of the box are apart
  return reach * first_hit(origin, origin + reach * direction, kSkip * size_ / reach);
}

std::optional<Vec3> Shell::wall_at(std::uint32_t vertex) const {
  if (normal_[vertex].isZero(0.0)) {
    return std::nullopt;
  }
  for (const double sense : {-1.0, 1.0}) {  // inwards, unless the surface is inside out
    const Vec3 direction = sense * normal_[vertex];
    const double length = way_to_wall(vertex, direction);
    if (length < kFar &&
        inside(component_of_vertex_[vertex], mesh_.positions[vertex] + 0.5 * length * direction)) {
      return length * direction;
    }
  }
  return std::nullopt;
}

std::optional<Vec3> Shell::middle_at(std::uint32_t vertex) const {
  const std::optional<Vec3> across = wall_at(vertex);
  return across ? std::optional<Vec3>(mesh_.positions[vertex] + 0.5 * *across) : std::nullopt;
}

}  // namespace vantage
