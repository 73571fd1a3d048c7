// SPDX-License-Identifier: MIT
#include "spatial/shell.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Geometry>

#include "vantage/mesh/measures.h"
#include "vantage/mesh/topology.h"

#include "spatial/enclosing.h"

namespace vantage {
namespace {

/// Faces a cell of the grid, on average, if all were the same size.
constexpr double kFacesPerCell = 2.0;
constexpr int kMostCellsAlong = 2048;  // along one side
/// Entries of the grid for each face, beyond which its cells are made larger: large faces that lie
/// over one another touch every cell, and thousands of them fill gigabytes [ours].
constexpr std::size_t kMostEntries = 64;
/// Faces that a way meets in a cell, in the mean, beyond which walls are looked for by rays: long faces
/// of thin tubes fill the same cells [ours].
constexpr double kMostMet = 500.0;
/// A ray from a vertex passes over the faces at that vertex: a ten-thousandth of the model.
constexpr double kSkip = 1e-4;
/// Parts of a segment shorter than this share of it are rounding errors of where it is cut.
constexpr double kRounding = 1e-9;
/// A point nearer to the surface than this share of the model is on it.
constexpr double kAside = 1e-6;
/// Rows of cells are taken this much wider, in cells, so that rounding loses no face.
constexpr double kSlack = 0.01;
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

}  // namespace

Shell::Shell(const TriMesh& mesh, std::span<const std::uint32_t> component_of_vertex,
             std::size_t most_walked)
    : mesh_(mesh), component_of_vertex_(component_of_vertex), normal_(vertex_normals(mesh)) {
  look_at_edges();
  sort_into_cells();
  if (mesh.triangles.size() > most_walked || faces_met() > kMostMet) {
    frame_ = unit_frame(referenced_points(mesh));
    rays_.emplace(in_frame(mesh, frame_));
  }
}

/// How many faces lie in the cell of one, in the mean over all faces and their cells.
double Shell::faces_met() const {
  double squares = 0.0;
  for (std::size_t cell = 1; cell < offsets_.size(); ++cell) {
    const double faces = offsets_[cell] - offsets_[cell - 1];
    squares += faces * faces;
  }
  return faces_.empty() ? 0.0 : squares / static_cast<double>(faces_.size());
}

void Shell::look_at_edges() {
  const EdgeTable table = build_edge_table(mesh_);
  is_open_ = open_components(mesh_, table, component_of_vertex_);
  neighbours_ = vertex_neighbours(table, mesh_.positions.size());
}

void Shell::sort_into_cells() {
  const Box box = bounding_box(referenced_points(mesh_));  // a lone vertex may be anywhere
  const Vec3 size = box.size();
  size.minCoeff(&up_);  // along the shortest side, projections overlap least
  low_ = box.low;
  size_ = size.maxCoeff();
  const double width = size[(up_ + 1) % 3];
  const double height = size[(up_ + 2) % 3];
  const double wanted = std::max(1.0, static_cast<double>(mesh_.triangles.size()) / kFacesPerCell);
  double cell_size =
      std::max(std::sqrt(width * height / wanted), std::max(width, height) / kMostCellsAlong);
  if (!(cell_size > 0.0)) {
    cell_size = 1.0;
  }
  while (!fill_cells(width, height, cell_size)) {
    cell_size *= 2.0;
  }
}

/// Sorts the faces into cells of this size; false if they had more than kMostEntries for each face.
bool Shell::fill_cells(double width, double height, double cell_size) {
  cell_size_ = cell_size;
  cells_ = {static_cast<int>(width / cell_size_) + 1, static_cast<int>(height / cell_size_) + 1};
  // Cells grow with coordinates, so those of a face's box are between those of its corners.
  std::vector<std::array<int, 2>> cell_of_vertex;
  cell_of_vertex.reserve(mesh_.positions.size());
  for (const Vec3& p : mesh_.positions) {
    cell_of_vertex.push_back(cell_of(p));
  }
  const auto for_each_cell = [&](const Triangle& t, const auto& visit) {
    const auto& a = cell_of_vertex[t[0]];
    const auto& b = cell_of_vertex[t[1]];
    const auto& c = cell_of_vertex[t[2]];
    const auto [left, right] = std::minmax({a[0], b[0], c[0]});
    const auto [bottom, top] = std::minmax({a[1], b[1], c[1]});
    const bool slanted = right - left > 2 && top - bottom > 2;
    for (int y = bottom; y <= top; ++y) {
      const auto [first, last] = slanted ? cells_in_row(t, y) : std::array{left, right};
      for (int x = first; x <= last; ++x) {
        visit(static_cast<std::size_t>(y) * static_cast<std::size_t>(cells_[0]) +
              static_cast<std::size_t>(x));
      }
    }
  };
  offsets_.assign(static_cast<std::size_t>(cells_[0]) * static_cast<std::size_t>(cells_[1]) + 1, 0);
  const std::size_t most = kMostEntries * mesh_.triangles.size();
  std::size_t entries = 0;
  for (const Triangle& t : mesh_.triangles) {
    for_each_cell(t, [&](std::size_t cell) {
      ++offsets_[cell + 1];
      ++entries;
    });
    if (entries > most) {
      return false;
    }
  }
  for (std::size_t cell = 1; cell < offsets_.size(); ++cell) {
    offsets_[cell] += offsets_[cell - 1];
  }
  faces_.resize(offsets_.back());
  std::vector<std::uint32_t> cursor(offsets_.begin(), offsets_.end() - 1);
  for (std::uint32_t f = 0; f < mesh_.triangles.size(); ++f) {
    for_each_cell(mesh_.triangles[f], [&](std::size_t cell) { faces_[cursor[cell]++] = f; });
  }
  return true;
}

/// The first and the last cell of a row that the face's projection touches; a needle that lies askew
/// fills few of the cells of its box.
std::array<int, 2> Shell::cells_in_row(const Triangle& t, int row) const {
  const int across = (up_ + 1) % 3;
  const int along = (up_ + 2) % 3;
  // Points beyond the grid count to its outermost cells.
  const double bottom = row == 0 ? -kFar : low_[along] + (row - kSlack) * cell_size_;
  const double top = row + 1 == cells_[1] ? kFar : low_[along] + (row + 1 + kSlack) * cell_size_;
  Vec3 left = Vec3::Constant(kFar);
  Vec3 right = Vec3::Constant(-kFar);
  const auto touch = [&](double x) {
    left[across] = std::min(left[across], x);
    right[across] = std::max(right[across], x);
  };
  for (std::size_t c = 0; c < 3; ++c) {
    const Vec3& p = mesh_.positions[t.at(c)];
    const Vec3& q = mesh_.positions[t.at((c + 1) % 3)];
    if (p[along] >= bottom && p[along] <= top) {
      touch(p[across]);
    }
    for (const double border : {bottom, top}) {
      if ((p[along] < border) != (q[along] < border)) {
        touch(p[across] + (border - p[along]) / (q[along] - p[along]) * (q[across] - p[across]));
      }
    }
  }
  const Vec3 margin = Vec3::Constant(kSlack * cell_size_);
  return {cell_of(left - margin)[0], cell_of(right + margin)[0]};
}

std::array<int, 2> Shell::cell_of(const Vec3& p) const {
  std::array<int, 2> cell{};
  for (int a = 0; a < 2; ++a) {
    const int axis = (up_ + 1 + a) % 3;
    const double place = std::floor((p[axis] - low_[axis]) / cell_size_);
    const auto last = static_cast<double>(cells_.at(static_cast<std::size_t>(a)) - 1);
    // A place that is not a number counts to the first cell.
    cell.at(static_cast<std::size_t>(a)) =
        place > 0.0 ? static_cast<int>(std::min(place, last)) : 0;
  }
  return cell;
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
  const auto [x, y] = cell_of(point);
  const std::size_t cell = static_cast<std::size_t>(y) * static_cast<std::size_t>(cells_[0]) +
                           static_cast<std::size_t>(x);
  int winding = 0;
  for (std::uint32_t i = offsets_[cell]; i < offsets_[cell + 1]; ++i) {
    const Triangle& t = mesh_.triangles[faces_[i]];
    if (component_of_vertex_[t[0]] == component) {
      winding += winding_of_face(t, point);
    }
  }
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

/// What of the segment lies in a slab of cells across one of the grid's two axes.
Shell::Stretch Shell::stretch_in(int slab, std::size_t axis, const Vec3& a, const Vec3& b) const {
  const int across = (up_ + 1 + static_cast<int>(axis)) % 3;
  const Vec3 way = b - a;
  const Vec3 margin = Vec3::Constant(kSlack * cell_size_);
  double enter = 0.0;
  double leave = 1.0;
  if (cell_of(a).at(axis) != cell_of(b).at(axis)) {
    const double border = low_[across] + slab * cell_size_ - a[across];
    const double s = (border - margin[across]) / way[across];
    const double t = (border + cell_size_ + margin[across]) / way[across];
    enter = slab == cell_of(a).at(axis) ? 0.0 : std::clamp(std::min(s, t), 0.0, 1.0);
    leave = slab == cell_of(b).at(axis) ? 1.0 : std::clamp(std::max(s, t), 0.0, 1.0);
  }
  const Vec3 in = a + enter * way;
  const Vec3 out = a + leave * way;
  return {.leave = leave, .low = in.cwiseMin(out) - margin, .high = in.cwiseMax(out) + margin};
}

/// Visits the faces in the cells along a segment, slab by slab of cells across its longer way, until
/// `done(share)` says after a slab that it is enough: all faces that may be met up to that share of
/// the way were visited, some more than once.
template <class Visit, class Done>
void Shell::walk(const Vec3& a, const Vec3& b, const Visit& visit, const Done& done) const {
  const Vec3 way = (b - a).cwiseAbs();
  const std::size_t major = way[(up_ + 1) % 3] > way[(up_ + 2) % 3] ? 0 : 1;
  const int last = cell_of(b).at(major);
  const int step = cell_of(a).at(major) <= last ? 1 : -1;
  for (int slab = cell_of(a).at(major); slab != last + step; slab += step) {
    const Stretch stretch = stretch_in(slab, major, a, b);
    auto low = cell_of(stretch.low);
    auto high = cell_of(stretch.high);
    low.at(major) = slab;
    high.at(major) = slab;
    for (int y = low[1]; y <= high[1]; ++y) {
      for (int x = low[0]; x <= high[0]; ++x) {
        visit_cell(x, y, stretch, visit);
      }
    }
    if (done(stretch.leave)) {
      return;
    }
  }
}

/// Visits the faces of a cell but for those that are wholly below or above a stretch.
template <class Visit>
void Shell::visit_cell(int x, int y, const Stretch& stretch, const Visit& visit) const {
  const double bottom = stretch.low[up_];
  const double top = stretch.high[up_];
  const std::size_t cell = static_cast<std::size_t>(y) * static_cast<std::size_t>(cells_[0]) +
                           static_cast<std::size_t>(x);
  for (std::uint32_t i = offsets_[cell]; i < offsets_[cell + 1]; ++i) {
    const Triangle& t = mesh_.triangles[faces_[i]];
    const double p = mesh_.positions[t[0]][up_];
    const double q = mesh_.positions[t[1]][up_];
    const double r = mesh_.positions[t[2]][up_];
    if (!((p < bottom && q < bottom && r < bottom) || (p > top && q > top && r > top))) {
      visit(t);
    }
  }
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
    if (component_of_vertex_[t[0]] != component) {
      return;
    }
    if (const auto passed = passage(t, a, b)) {
      const double length = passed->normal.norm();
      if (passed->rise < kAlongPlane * length * way.norm() ||
          is_near(t, passed->normal / length, a + passed->place * way)) {
        places.push_back(passed->place);
      }
    }
  };
  walk(a, b, look_at, [](double) { return false; });
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
  walk(a, b, look_at, [&](double share) { return hit <= share; });
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

bool Shell::middle_at(std::uint32_t vertex, Vec3& middle) const {
  const std::optional<Vec3> across = wall_at(vertex);
  if (across) {
    middle = mesh_.positions[vertex] + 0.5 * *across;
  }
  return across.has_value();
}

}  // namespace vantage
