// SPDX-License-Identifier: MIT
#include "visibility/face_clip.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include <Eigen/Geometry>

#include "visibility/segment.h"

namespace vantage {
namespace {

// Of more faces in the same place of the picture samples tell enough: the face is large. [ours]
constexpr std::size_t kMostNear = 3000;

// Cells of the picture over faces. [ours, by measurement]
constexpr double kCellsPerFace = 0.5;
// Places along a contour where it is asked what is seen: more where faces are few, as each weighs
// much. At least, at most, and how many times the number of faces. [ours, by measurement]
constexpr double kLeastPlaces = 5.0, kMostPlaces = 16.0, kPlacesByFaces = 1.6e5;
// Places in cells over faces: where faces are so long or so many in one place that more would be
// needed, cells are larger.
constexpr std::size_t kMostInCells = 16;
// Steps of work for one eye, some tenths of a second: models tried take a hundredth of it. What
// is not clipped by then is left to samples.
constexpr std::size_t kPatience = 60'000'000;
constexpr std::size_t kStepsPerPart = 8;  // of cutting a polygon, over those of passing a face

/// In homogeneous barycentric coordinates of a face, as it is seen from the eye; the fourth is the
/// height over the face's plane on the eye's side.
using Corner = Eigen::Vector4d;

/// The corners of a triangle that was cut by four planes at most. Each cut adds one to a convex
/// polygon; where rounding has bent it, of 3, 4, 6 and 9 corners 4, 6, 9 and 13 may be made.
template <typename Point>
class FewPoints {
 public:
  static constexpr std::size_t kMost = 13;

  [[nodiscard]] std::size_t size() const { return count_; }

  [[nodiscard]] const Point& operator[](std::size_t k) const { return points_[k]; }

  void clear() { count_ = 0; }

  void push_back(const Point& point) { points_[count_++] = point; }

 private:
  std::array<Point, kMost> points_;
  std::size_t count_ = 0;
};

/// What a face hides another one by.
class Shadow {
 public:
  Shadow(const Surface& surface, const Viewpoint& eye, std::uint32_t face)
      : surface_(surface), on_(surface.faces[face]) {
    const std::array<Vec3, 3> corners{surface.sites[on_[0]], surface.sites[on_[1]],
                                      surface.sites[on_[2]]};
    origin_ = corners[0];
    normal_ = surface.area_vectors[face] / surface.twice_areas[face];
    if (normal_.dot(sight_line(origin_, eye)) < 0.0) {
      normal_ = -normal_;
    }
    // The plane through the eye and a side; its value at the corner opposite is 1.
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3& a = corners[(k + 1) % 3];
      const Vec3& b = corners[(k + 2) % 3];
      sides_[k] = (b - a).cross(sight_line(a, eye));
      from_[k] = a;
      sides_[k] /= sides_[k].dot(corners[k] - a);
    }
  }

  /// Adds what falls on the face, if anything does. \return its share of the face's area.
  double add(std::uint32_t other, Polygons& shadows) {
    const Triangle& sites = surface_.faces[other];
    const std::array<double, 3> heights{height(sites[0]), height(sites[1]), height(sites[2])};
    if (std::max({heights[0], heights[1], heights[2]}) <= 0.0) {
      return 0.0;  // behind
    }
    FewPoints<Corner>* polygon = &corners_;
    FewPoints<Corner>* cut = &cut_;
    polygon->clear();
    for (std::size_t k = 0; k < 3; ++k) {
      polygon->push_back(corner(sites[k], heights[k]));
    }
    const Corner low = (*polygon)[0].cwiseMin((*polygon)[1]).cwiseMin((*polygon)[2]);
    const Corner high = (*polygon)[0].cwiseMax((*polygon)[1]).cwiseMax((*polygon)[2]);
    if (!(high.minCoeff() > 0.0)) {
      return 0.0;  // beside
    }
    for (const Eigen::Index k : {3, 0, 1, 2}) {
      if (low[k] >= 0.0) {
        continue;
      }
      cut_polygon(
          *polygon, [k](const Corner& c) { return c[k]; }, *cut, [](const Corner&) {});
      std::swap(polygon, cut);
      if (polygon->size() < 3) {
        return 0.0;
      }
    }
    std::array<Eigen::Vector2d, FewPoints<Corner>::kMost> shadow;
    for (std::size_t k = 0; k < polygon->size(); ++k) {
      shadow[k] = (*polygon)[k].head<2>() / (*polygon)[k].head<3>().sum();
    }
    const std::span points = std::span(shadow).first(polygon->size());
    const double area = twice_area(points);
    if (area < 0.0) {
      std::reverse(points.begin(), points.end());
    }
    if (!(std::abs(area) > kNoArea)) {
      return 0.0;
    }
    shadows.add(points);
    return std::abs(area);
  }

 private:
  /// Over the plane, more than a touch.
  [[nodiscard]] double height(std::uint32_t site) const {
    const bool is_own = on_[0] == site || on_[1] == site || on_[2] == site;
    return is_own ? 0.0 : normal_.dot(surface_.sites[site] - origin_) - Segment::kContact;
  }

  [[nodiscard]] Corner corner(std::uint32_t site, double height) const {
    const Vec3& place = surface_.sites[site];
    Corner corner = Corner::Zero();
    for (std::size_t k = 0; k < 3; ++k) {
      const bool on_side = on_[(k + 1) % 3] == site || on_[(k + 2) % 3] == site;
      corner[static_cast<Eigen::Index>(k)] = on_[k] == site ? 1.0
                                             : on_side      ? 0.0
                                                            : sides_[k].dot(place - from_[k]);
    }
    corner[3] = height;
    return corner;
  }

  const Surface& surface_;
  Triangle on_;
  Vec3 origin_ = Vec3::Zero();
  Vec3 normal_ = Vec3::Zero();
  std::array<Vec3, 3> sides_{}, from_{};
  FewPoints<Corner> corners_{}, cut_{};
};

}  // namespace

FaceClip::FaceClip(const Surface& surface, const SitePicture& picture, const Viewpoint& eye,
                   const std::vector<std::uint8_t>& turned, const std::vector<std::uint8_t>& backs)
    : surface_(surface), picture_(picture), eye_(eye) {
  lay_grid(turned, backs);
}

FaceClip::CellRange FaceClip::cells(const SitePicture::Box& box) const {
  CellRange range{};
  const auto last = static_cast<double>(side_ - 1);
  for (Eigen::Index k = 0; k < 2; ++k) {
    const auto cell = [&](double place) {
      return static_cast<std::size_t>(
          std::clamp((place - box_.min()[k]) * per_cell_[k], 0.0, last));
    };
    range[static_cast<std::size_t>(k)] = {cell(box.min()[k]), cell(box.max()[k])};
  }
  return range;
}

void FaceClip::set_cells(std::size_t side) {
  side_ = side;
  for (Eigen::Index k = 0; k < 2; ++k) {
    const double extent = box_.sizes()[k];
    per_cell_[k] = extent > 0.0 ? static_cast<double>(side_) / extent : 0.0;
  }
}

/// \return false if that is more work than it is worth.
bool FaceClip::spend(std::size_t steps) {
  steps_ += steps;
  return steps_ <= kPatience;
}

void FaceClip::lay_grid(const std::vector<std::uint8_t>& turned,
                        const std::vector<std::uint8_t>& backs) {
  seats_.reserve(surface_.faces.size());
  for (const Triangle& face : surface_.faces) {
    const auto& [a, b, c] = face;
    const std::vector<double>& nearness = picture_.nearness;
    seats_.push_back({picture_.box(face), std::max({nearness[a], nearness[b], nearness[c]})});
    box_.extend(seats_.back().box);
  }
  const auto hides = [&](std::uint32_t f) {
    return turned[f] == 1 || (turned[f] == 2 && backs[f] != 0);
  };
  const auto over_cells = [&](std::uint32_t f, const auto& each) {
    if (hides(f)) {
      const auto [columns, rows] = cells(seats_[f].box);
      for (std::size_t row = rows[0]; row <= rows[1]; ++row) {
        for (std::size_t column = columns[0]; column <= columns[1]; ++column) {
          each(row * side_ + column);
        }
      }
    }
  };
  const auto places = [&] {
    std::size_t sum = 0;
    for (std::uint32_t f = 0; f < seats_.size(); ++f) {
      if (hides(f)) {
        const auto [columns, rows] = cells(seats_[f].box);
        sum += (columns[1] + 1 - columns[0]) * (rows[1] + 1 - rows[0]);
      }
    }
    return sum;
  };
  const double wanted = kCellsPerFace * static_cast<double>(seats_.size() + 1);
  set_cells(static_cast<std::size_t>(std::ceil(std::sqrt(wanted))));
  while (side_ > 1 && places() > kMostInCells * seats_.size()) {
    set_cells(side_ / 2);
  }
  first_.assign(side_ * side_ + 1, 0);
  for (std::uint32_t f = 0; f < seats_.size(); ++f) {
    over_cells(f, [&](std::size_t cell) { ++first_[cell]; });
  }
  std::inclusive_scan(first_.begin(), first_.end(), first_.begin());
  in_cells_.resize(first_.back());
  for (std::uint32_t f = 0; f < seats_.size(); ++f) {
    over_cells(f, [&](std::size_t cell) { in_cells_[--first_[cell]] = f; });
  }
}

/// Lists faces that may hide some of this one. \return false if they are too many.
bool FaceClip::list_near(std::uint32_t face) {
  near_.clear();
  ++round_;
  const auto& [a, b, c] = surface_.faces[face];
  const std::vector<double>& nearness = picture_.nearness;
  const double farthest = std::min({nearness[a], nearness[b], nearness[c]});
  const SitePicture::Box& box = seats_[face].box;
  const auto [columns, rows] = cells(box);
  for (std::size_t row = rows[0]; row <= rows[1]; ++row) {
    const std::uint32_t begin = first_[row * side_ + columns[0]];
    const std::uint32_t end = first_[row * side_ + columns[1] + 1];
    if (near_.size() > kMostNear || !spend(end - begin)) {
      return false;
    }
    for (std::uint32_t i = begin; i < end; ++i) {
      const std::uint32_t f = in_cells_[i];
      Seat& seat = seats_[f];
      if (seat.nearest > farthest && seat.round != round_ && f != face &&
          seat.box.intersects(box)) {
        seat.round = round_;
        near_.push_back(f);
      }
    }
  }
  return near_.size() <= kMostNear;
}

/// The face next to the eye, or one before the nearness.
FaceClip::Found FaceClip::first_at(const Eigen::Vector2d& place, double nearness) {
  Found first{Surface::kNoSite, -std::numeric_limits<double>::infinity()};
  const auto [columns, rows] = cells(SitePicture::Box(place));
  const std::size_t cell = rows[0] * side_ + columns[0];
  if (!spend(first_[cell + 1] - first_[cell])) {
    return first;
  }
  for (std::uint32_t i = first_[cell]; i < first_[cell + 1]; ++i) {
    const std::uint32_t f = in_cells_[i];
    if (!(seats_[f].nearest > first.nearness) || !seats_[f].box.contains(place)) {
      continue;
    }
    const auto& [a, b, c] = surface_.faces[f];
    const Eigen::Vector2d to_a = picture_.places[a] - place;
    const Eigen::Vector2d to_b = picture_.places[b] - place;
    const Eigen::Vector2d to_c = picture_.places[c] - place;
    const Vec3 shares(cross(to_b, to_c), cross(to_c, to_a), cross(to_a, to_b));
    if (shares.minCoeff() < 0.0 && shares.maxCoeff() > 0.0) {
      continue;
    }
    const Vec3 of_corners(picture_.nearness[a], picture_.nearness[b], picture_.nearness[c]);
    const double here = shares.dot(of_corners) / shares.sum();
    if (here > first.nearness) {
      first = {f, here};
    }
    if (here > nearness) {
      break;
    }
  }
  return first;
}

bool FaceClip::list_past(const std::array<std::uint32_t, 2>& edge, std::uint32_t beside,
                         std::vector<std::uint32_t>& faces) {
  constexpr double kStep = 1e-7;  // of the edge's length
  const Eigen::Vector2d& from = picture_.places[edge[0]];
  const Eigen::Vector2d way = picture_.places[edge[1]] - from;
  const double side = cross(way, picture_.places[beside] - from);
  const Eigen::Vector2d across = std::copysign(kStep, side) * Eigen::Vector2d(way.y(), -way.x());
  const double nearness = picture_.nearness[edge[0]];
  const double change = picture_.nearness[edge[1]] - nearness;
  const auto count = static_cast<double>(seats_.size());
  const double places = std::clamp(std::floor(kPlacesByFaces / count), kLeastPlaces, kMostPlaces);
  bool is_seen = false;
  for (double k = 0.5; k < places; ++k) {
    const double share = k / places;
    const double here = nearness + share * change;
    const Found found = first_at(from + share * way + across, here);
    is_seen = is_seen || !(found.nearness > here);
    if (found.face != Surface::kNoSite && found.nearness < here) {
      faces.push_back(found.face);
    }
  }
  return is_seen;
}

void FaceClip::list_behind(const std::array<std::uint32_t, 2>& edge,
                           std::span<const std::uint8_t> wanted,
                           std::vector<std::uint32_t>& faces) {
  constexpr double kLeast = 1e-9;  // share of the edge: less is a touch
  const Eigen::Vector2d& from = picture_.places[edge[0]];
  const Eigen::Vector2d way = picture_.places[edge[1]] - from;
  const double nearness = picture_.nearness[edge[0]];
  const double change = picture_.nearness[edge[1]] - nearness;
  const SitePicture::Box box = picture_.box(edge);
  const auto [columns, rows] = cells(box);
  for (std::size_t row = rows[0]; row <= rows[1]; ++row) {
    const std::uint32_t begin = first_[row * side_ + columns[0]];
    const std::uint32_t end = first_[row * side_ + columns[1] + 1];
    if (!spend(end - begin)) {
      return;
    }
    for (std::uint32_t i = begin; i < end; ++i) {
      const std::uint32_t f = in_cells_[i];
      const Triangle& face = surface_.faces[f];
      if (wanted[f] == 0 || !seats_[f].box.intersects(box)) {
        continue;
      }
      double low = 0.0;
      double high = 1.0;
      const Eigen::Vector2d& a = picture_.places[face[0]];
      const Eigen::Vector2d ab = picture_.places[face[1]] - a;
      const Eigen::Vector2d ac = picture_.places[face[2]] - a;
      const double whole = cross(ab, ac);
      // Barycentric coordinates of the edge's beginning, and their change along it.
      const double of_b = cross(from - a, ac) / whole;
      const double of_c = cross(ab, from - a) / whole;
      const double along_b = cross(way, ac) / whole;
      const double along_c = cross(ab, way) / whole;
      for (const auto& [value, slope] : {std::pair(of_b, along_b), std::pair(of_c, along_c),
                                         std::pair(1.0 - of_b - of_c, -along_b - along_c)}) {
        if (slope > 0.0) {
          low = std::max(low, -value / slope);
        } else if (slope < 0.0) {
          high = std::min(high, -value / slope);
        } else if (!(value > 0.0)) {
          high = low;
        }
      }
      if (!(high - low > kLeast)) {
        continue;
      }
      const double middle = 0.5 * (low + high);
      const double of_face = picture_.nearness[face[0]];
      const double behind = of_face +
                            (of_b + middle * along_b) * (picture_.nearness[face[1]] - of_face) +
                            (of_c + middle * along_c) * (picture_.nearness[face[2]] - of_face);
      if (nearness + middle * change > behind) {
        faces.push_back(f);
      }
    }
  }
}

bool FaceClip::add_parts(std::uint32_t face, SeenParts& parts) {
  if (!list_near(face)) {
    return false;
  }
  Shadow shadow(surface_, eye_, face);
  shadows_.shrink_to(0);
  by_size_.clear();
  for (const std::uint32_t other : near_) {
    const double size = shadow.add(other, shadows_);
    if (size > 0.0) {
      by_size_.emplace_back(-size, by_size_.size());
    }
  }
  std::sort(by_size_.begin(), by_size_.end());
  rest_.reset();
  for (const auto& [size, i] : by_size_) {
    if (!spend(kStepsPerPart * rest_.parts().size())) {
      return false;
    }
    rest_.subtract(shadows_[i]);
  }
  const auto& [a, b, c] = surface_.faces[face];
  for (std::size_t i = 0; i < rest_.parts().size(); ++i) {
    const Polygons::Points part = rest_.parts()[i];
    for (const Eigen::Vector2d& w : part) {
      parts.corners.emplace_back(w.x() * surface_.sites[a] + w.y() * surface_.sites[b] +
                                 (1.0 - w.x() - w.y()) * surface_.sites[c]);
    }
    parts.parts.push_back({face, twice_area(part), parts.corners.size()});
  }
  return true;
}

}  // namespace vantage
