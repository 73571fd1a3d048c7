// SPDX-License-Identifier: MIT
#include "vantage/view/outline.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>

#include <Eigen/Geometry>

#include "vantage/core/error.h"
#include "vantage/mesh/topology.h"

#include "core/shannon.h"

namespace vantage {
namespace {

// No face, or not just one, beyond an edge.
constexpr std::uint32_t kOpen = ~std::uint32_t{0};
// Empty lines around the disc, so that every outline closes inside the grid.
constexpr int kBorder = 2;
// Bins of turning angles: odd, so that straight on falls into the middle of one. [Page 2003]
constexpr std::size_t kTurningBins = 9;
// Where along a step the resampling begins: a corner turns at once or in two steps by chance, so the
// mean of several is taken. [ours]
constexpr int kPhases = 8;
// An eye this much nearer than the sphere's radius is inside, over the radius.
constexpr double kInside = 1e-6;

/// Where the shape begins and ends in each cell of the lines of one direction.
struct Reach {
  explicit Reach(std::size_t size) : begin(size, kFar), end(size, -kFar) {}

  static constexpr float kFar = std::numeric_limits<float>::max();
  std::vector<float> begin;  // least place in the cell where a face begins
  std::vector<float> end;    // largest place in the cell where a face ends
};

/// A square grid of sample points and, between neighbours, where the shape ends.
class ShapeGrid {
 public:
  explicit ShapeGrid(int lines)
      : side_(lines + 2 * kBorder + 1),
        inside_(static_cast<std::size_t>(side_) * static_cast<std::size_t>(side_), 0),
        along_x_(inside_.size()),
        along_y_(inside_.size()) {}

  /// Adds a triangle given in grid units.
  /// \param at_edge whether the shape may end at one of its edges.
  void add(const std::array<PicturePoint, 3>& corners, bool at_edge) {
    scan<0>(corners);
    if (at_edge) {
      scan<1>(corners);
    }
  }

  [[nodiscard]] Outline outline() const;

 private:
  /// A crossing of the outline with the grid: twice the index of the sample that its edge starts
  /// from, plus 1 if the edge runs along y.
  using Crossing = std::uint32_t;

  [[nodiscard]] std::size_t at(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(side_) +
           static_cast<std::size_t>(x);
  }

  /// Cuts the triangle with all grid lines along axis `Along` that it meets.
  template <int Along>
  void scan(const std::array<PicturePoint, 3>& corners) {
    constexpr int kAcross = 1 - Along;
    const auto [low, high] =
        std::minmax({corners[0][kAcross], corners[1][kAcross], corners[2][kAcross]});
    const int first = std::max(0, static_cast<int>(std::ceil(low)));
    const int last = std::min(side_ - 1, static_cast<int>(std::floor(high)));
    for (int line = first; line <= last; ++line) {
      double begin = std::numeric_limits<double>::max();
      double end = -begin;
      for (std::size_t k = 0; k < 3; ++k) {
        const PicturePoint& a = corners[k];
        const PicturePoint& b = corners[(k + 1) % 3];
        const double from = a[kAcross] - line;
        const double to = b[kAcross] - line;
        if ((from <= 0.0 && to >= 0.0) || (from >= 0.0 && to <= 0.0)) {
          const double t = from == to ? 0.0 : from / (from - to);
          const double place = a[Along] + t * (b[Along] - a[Along]);
          begin = std::min(begin, place);
          end = std::max(end, place);
          if (from == to) {
            begin = std::min(begin, b[Along]);
            end = std::max(end, b[Along]);
          }
        }
      }
      cover<Along>(line, begin, end);
    }
  }

  template <int Along>
  void cover(int line, double begin, double end) {
    const double most = side_ - 1;
    if (!(begin <= end) || end < 0.0 || begin > most) {
      return;
    }
    begin = std::clamp(begin, 0.0, most);
    end = std::clamp(end, 0.0, most);
    const int first = static_cast<int>(std::ceil(begin));
    const int last = static_cast<int>(std::floor(end));
    const auto cell = [&](int i) { return Along == 0 ? at(i, line) : at(line, i); };
    Reach& reach = Along == 0 ? along_x_ : along_y_;
    if (Along == 0) {
      for (int i = first; i <= last; ++i) {
        inside_[cell(i)] = 1;
      }
    }
    float& ends = reach.end[cell(last)];
    ends = std::max(ends, static_cast<float>(end));
    float& begins = reach.begin[cell(std::max(0, first - 1))];
    begins = std::min(begins, static_cast<float>(begin));
  }

  [[nodiscard]] PicturePoint place(Crossing crossing) const {
    const std::size_t sample = crossing / 2;
    const bool is_along_y = crossing % 2 == 1;
    const Reach& reach = is_along_y ? along_y_ : along_x_;
    const std::size_t column = sample % static_cast<std::size_t>(side_);
    const std::size_t row = sample / static_cast<std::size_t>(side_);
    const auto x = static_cast<double>(column);
    const auto y = static_cast<double>(row);
    const double start = is_along_y ? y : x;
    const double found = inside_[sample] != 0 ? reach.end[sample] : reach.begin[sample];
    // The two scans may differ by rounding about a sample; nothing found is nothing beyond it.
    const double cut = std::abs(found) == static_cast<double>(Reach::kFar)
                           ? start + 0.5
                           : std::clamp(found, start, start + 1.0);
    return is_along_y ? PicturePoint(x, cut) : PicturePoint(cut, y);
  }

  struct Step {
    Crossing from = 0;
    Crossing to = 0;
  };

  void add_steps(int x, int y, std::vector<Step>& steps) const;

  int side_;
  std::vector<std::uint8_t> inside_;
  Reach along_x_;
  Reach along_y_;
};

/// The outline's way through one cell, the shape on its left: from each edge where, going around
/// the cell counter-clockwise, the shape ends, to the next where it begins. Where only two opposite
/// corners are inside, that joins them.
void ShapeGrid::add_steps(int x, int y, std::vector<Step>& steps) const {
  const std::array<std::size_t, 4> corner{at(x, y), at(x + 1, y), at(x + 1, y + 1), at(x, y + 1)};
  const std::array<std::size_t, 4> edge{2 * corner[0], 2 * corner[1] + 1, 2 * corner[3],
                                        2 * corner[0] + 1};
  const auto is_in = [&](std::size_t k) { return inside_[corner[k % 4]] != 0; };
  for (std::size_t k = 0; k < 4; ++k) {
    if (is_in(k) && !is_in(k + 1)) {
      std::size_t next = k + 1;
      while (is_in(next) || !is_in(next + 1)) {
        ++next;
      }
      steps.push_back({static_cast<Crossing>(edge[k]), static_cast<Crossing>(edge[next % 4])});
    }
  }
}

Outline ShapeGrid::outline() const {
  std::vector<Step> steps;
  for (int y = 0; y + 1 < side_; ++y) {
    const std::uint8_t* low = &inside_[at(0, y)];
    const std::uint8_t* high = &inside_[at(0, y + 1)];
    for (int x = 0; x + 1 < side_; ++x) {
      if (((low[x] + low[x + 1] + high[x] + high[x + 1]) & 3) != 0) {
        add_steps(x, y, steps);
      }
    }
  }
  const auto before = [](const Step& a, const Step& b) { return a.from < b.from; };
  std::sort(steps.begin(), steps.end(), before);
  std::vector<std::uint8_t> used(steps.size(), 0);
  Outline outline;
  for (std::size_t first = 0; first < steps.size(); ++first) {
    std::vector<PicturePoint> loop;
    for (std::size_t i = first; i < steps.size() && used[i] == 0;) {
      used[i] = 1;
      loop.push_back(place(steps[i].from));
      const auto next = std::lower_bound(steps.begin(), steps.end(), Step{steps[i].to, 0}, before);
      i = static_cast<std::size_t>(next - steps.begin());
    }
    if (loop.size() > 2) {
      outline.push_back(std::move(loop));
    }
  }
  return outline;
}

double loop_length(const std::vector<PicturePoint>& loop) {
  double length = 0.0;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    length += (loop[(i + 1) % loop.size()] - loop[i]).norm();
  }
  return length;
}

/// `count` points at equal distances along the loop, the first `phase` of a distance after its start.
std::vector<PicturePoint> resampled(const std::vector<PicturePoint>& loop, double length,
                                    std::size_t count, double phase) {
  std::vector<PicturePoint> points;
  points.reserve(count);
  double passed = 0.0;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const PicturePoint way = loop[(i + 1) % loop.size()] - loop[i];
    const double step = way.norm();
    while (points.size() < count) {
      const double wanted =
          length * (static_cast<double>(points.size()) + phase) / static_cast<double>(count);
      if (wanted > passed + step || !(step > 0.0)) {
        break;
      }
      points.emplace_back(loop[i] + way * std::max(0.0, (wanted - passed) / step));
    }
    passed += step;
  }
  while (points.size() < count) {  // rounding at the very end
    points.push_back(loop.back());
  }
  return points;
}

double turning(const PicturePoint& before, const PicturePoint& after) {
  return std::atan2(before.x() * after.y() - before.y() * after.x(), before.dot(after));
}

using TurningBins = std::array<double, kTurningBins>;

/// Adds the turning angles of a closed polyline.
void add_turning(const std::vector<PicturePoint>& points, TurningBins& bins,
                 OutlineMeasures& measures) {
  const std::size_t count = points.size();
  for (std::size_t i = 0; i < count; ++i) {
    const PicturePoint& here = points[(i + 1) % count];
    const double angle = turning(here - points[i], points[(i + 2) % count] - here);
    const double bin = (angle / (2.0 * std::numbers::pi) + 0.5) * kTurningBins;
    bins[std::min(kTurningBins - 1, static_cast<std::size_t>(bin))] += 1.0;
    measures.curvature += std::abs(angle);
    measures.curvature_extrema += angle * angle;
  }
}

}  // namespace

SilhouetteDisc silhouette_disc(const Sphere& sphere, const Viewpoint& eye) {
  if (eye.projection == Projection::Orthographic) {
    return {eye.position.normalized(), sphere.diameter};
  }
  const Vec3 to_eye = eye.position - sphere.centre;
  const double distance = to_eye.norm();
  const double radius = 0.5 * sphere.diameter;
  SilhouetteDisc disc{distance > 0.0 ? Vec3(to_eye / distance) : Vec3::UnitZ(), sphere.diameter};
  if (distance > radius * (1.0 + kInside)) {
    const double sine = radius / distance;
    disc.diameter /= std::sqrt(1.0 - sine * sine);
  }
  return disc;
}

OutlineMeasures measure_outline(const Outline& outline) {
  OutlineMeasures measures;
  TurningBins bins{};
  double steps = 0.0;
  for (const auto& loop : outline) {
    const double length = loop_length(loop);
    measures.length += length;
    const auto count = static_cast<std::size_t>(std::lround(length * kTurningSteps));
    if (count < 3) {
      continue;
    }
    for (int phase = 0; phase < kPhases; ++phase) {
      add_turning(resampled(loop, length, count, static_cast<double>(phase) / kPhases), bins,
                  measures);
    }
    steps += static_cast<double>(count) * kPhases;
  }
  if (steps > 0.0) {
    measures.curvature /= steps;
    measures.curvature_extrema /= steps;
    measures.turning_entropy = histogram_entropy(bins);
  }
  return measures;
}

OutlineTracer::OutlineTracer(const TriMesh& mesh, std::span<const FaceSides> sides,
                             const Sphere& sphere, int lines)
    : mesh_(&mesh), sphere_(sphere), lines_(lines) {
  const Components components = connected_components(mesh);
  if (lines < 8 || !(sphere.diameter > 0.0) ||
      (sides.size() != 1 && sides.size() != components.count)) {
    throw InvalidInput("an outline needs an extent, 8 lines or more, one rule a component");
  }
  two_sided_.reserve(mesh.triangles.size());
  for (const Triangle& face : mesh.triangles) {
    const FaceSides side = sides.size() == 1 ? sides[0] : sides[components.of_vertex[face[0]]];
    two_sided_.push_back(side == FaceSides::Both ? 1 : 0);
  }
  const EdgeTable table = build_edge_table(mesh);
  std::vector<std::uint8_t> known(mesh.triangles.size(), 0);
  for (std::uint32_t f = 0; f < mesh.triangles.size(); ++f) {
    beyond_.push_back({kOpen, kOpen, kOpen});
  }
  for (std::size_t e = 0; e < table.edges.size(); ++e) {
    const auto faces = table.faces_of_edge[e];
    if (faces.size() == 2) {
      for (const std::size_t k : {std::size_t{0}, std::size_t{1}}) {
        beyond_[faces[k]][known[faces[k]]++] = faces[1 - k];
      }
    }
  }
}

Outline OutlineTracer::trace(const Viewpoint& eye) const {
  const SilhouetteDisc disc = silhouette_disc(sphere_, eye);
  const Vec3 right = disc.towards.unitOrthogonal();
  const Vec3 up = disc.towards.cross(right);
  const double distance = (eye.position - sphere_.centre).norm();
  const double scale = lines_ / disc.diameter;
  const double middle = 0.5 * lines_ + kBorder;
  std::vector<PicturePoint> places;
  std::vector<std::uint8_t> ahead(mesh_->positions.size(), 1);
  places.reserve(mesh_->positions.size());
  for (std::size_t v = 0; v < mesh_->positions.size(); ++v) {
    const Vec3 p = mesh_->positions[v] - sphere_.centre;
    double shrink = 1.0;
    if (eye.projection == Projection::Perspective) {
      const double depth = distance - p.dot(disc.towards);
      ahead[v] = depth > kInside * sphere_.diameter ? 1 : 0;
      shrink = ahead[v] != 0 ? distance / depth : 0.0;
    }
    places.emplace_back(middle + scale * shrink * p.dot(right),
                        middle + scale * shrink * p.dot(up));
  }
  std::vector<std::uint8_t> drawn(mesh_->triangles.size(), 0);
  for (std::size_t f = 0; f < mesh_->triangles.size(); ++f) {
    const auto& [a, b, c] = mesh_->triangles[f];
    const PicturePoint ab = places[b] - places[a];
    const PicturePoint ac = places[c] - places[a];
    const double twice = ab.x() * ac.y() - ab.y() * ac.x();
    const bool is_turned = two_sided_[f] != 0 || twice > 0.0;
    drawn[f] = is_turned && ahead[a] != 0 && ahead[b] != 0 && ahead[c] != 0 ? 1 : 0;
  }
  ShapeGrid grid(lines_);
  for (std::size_t f = 0; f < mesh_->triangles.size(); ++f) {
    if (drawn[f] != 0) {
      // Of surfaces with one side the shape ends only where a face that is drawn meets one that is
      // not; with two sides it may be folded anywhere.
      const bool is_inner = std::all_of(beyond_[f].begin(), beyond_[f].end(), [&](std::uint32_t g) {
        return g != kOpen && drawn[g] != 0;
      });
      const auto& [a, b, c] = mesh_->triangles[f];
      grid.add({places[a], places[b], places[c]}, !is_inner || two_sided_[f] != 0);
    }
  }
  Outline outline = grid.outline();
  for (auto& loop : outline) {
    for (PicturePoint& p : loop) {
      p = (p - PicturePoint(middle, middle)) / lines_;
    }
  }
  return outline;
}

}  // namespace vantage
