// SPDX-License-Identifier: MIT
#include "spatial/face_clip.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include "core/cross.h"
#include "spatial/picture_cells.h"
#include "spatial/segment.h"

namespace vantage {
namespace {

constexpr std::size_t kStepsPerPart = 8;  // of cutting a polygon, over those of passing a face
constexpr double kTouch = 1e-9;           // share of an edge: less is no cut

/// Whether all of a polygon lies on the other side of an edge of the other, or on it.
bool is_beside(Polygons::Points polygon, Polygons::Points other) {
  for (std::size_t k = 0; k < other.size(); ++k) {
    const Eigen::Vector2d& from = other[k];
    const Eigen::Vector2d way = other[k + 1 < other.size() ? k + 1 : 0] - from;
    if (std::all_of(polygon.begin(), polygon.end(), [&](const Eigen::Vector2d& place) {
          return cross(way, place - from) <= 0.0;
        })) {
      return true;
    }
  }
  return false;
}

/// Whether two corners of a polygon in a face are not one but for rounding.
bool is_apart(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  constexpr double kRounding = 1e-11;
  return (a - b).cwiseAbs().maxCoeff() > kRounding;
}

Vec3 homogeneous(const Eigen::Vector2d& place) {
  return {place.x(), place.y(), 1.0 - place.x() - place.y()};
}

}  // namespace

double twice_area(Polygons::Points polygon) {
  double sum = 0.0;
  for (std::size_t k = 2; k < polygon.size(); ++k) {
    sum += cross(polygon[k - 1] - polygon[0], polygon[k] - polygon[0]);
  }
  return sum;
}

void FaceClip::begin(std::span<const Vec3> points, std::span<const Triangle> faces,
                     const Viewpoint& eye) {
  points_ = points;
  faces_ = faces;
  eye_ = eye;
}

void FaceClip::take(std::uint32_t face, const Vec3& normal) {
  on_ = faces_[face];
  const std::array<Vec3, 3> places{points_[on_[0]], points_[on_[1]], points_[on_[2]]};
  first_ = places[0];
  Eigen::Matrix<double, 4, 3> rows;
  // The plane through the eye and a side; its value at the corner opposite is 1.
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3& a = places[(k + 1) % 3];
    const Vec3& b = places[(k + 2) % 3];
    const Vec3 across = (b - a).cross(sight_line(a, eye_));
    rows.row(static_cast<Eigen::Index>(k)) = across / across.dot(places[k] - a);
  }
  rows.row(3) = normal.dot(sight_line(first_, eye_)) < 0.0 ? Vec3(-normal) : normal;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    of_axes_[axis] = rows.col(static_cast<Eigen::Index>(axis));
  }
  no_area_ = kNoArea;
  parts_.shrink_to(0);
  parts_.add(kWholeFace);
  shadows_.shrink_to(0);
  by_size_.clear();
}

bool FaceClip::is_corner(std::uint32_t point) const {
  return std::find(on_.begin(), on_.end(), point) != on_.end();
}

/// Heights are over more than a touch.
FaceClip::Corner FaceClip::corner(std::uint32_t point) const {
  for (std::size_t k = 0; k < 3; ++k) {
    if (on_[k] == point) {  // exactly
      return Corner::Unit(static_cast<Eigen::Index>(k));
    }
  }
  const Vec3 place = points_[point] - first_;
  return Corner(1.0, 0.0, 0.0, -Segment::kContact) + place.x() * of_axes_[0] +
         place.y() * of_axes_[1] + place.z() * of_axes_[2];
}

bool FaceClip::add_shadow(std::uint32_t other) {
  const auto& [a, b, c] = faces_[other];
  ConvexPolygon<Corner> polygon;
  polygon.push_back(corner(a));
  polygon.push_back(corner(b));
  polygon.push_back(corner(c));
  const Corner low = polygon[0].cwiseMin(polygon[1]).cwiseMin(polygon[2]);
  const Corner high = polygon[0].cwiseMax(polygon[1]).cwiseMax(polygon[2]);
  if (!(high.minCoeff() > 0.0)) {
    return false;  // behind or beside
  }
  no_area_ = std::max({no_area_, kNoArea * high.maxCoeff(), -kNoArea * low.minCoeff()});
  for (const Eigen::Index k : {3, 0, 1, 2}) {
    if (low[k] < 0.0) {
      ConvexPolygon<Corner> cut;
      cut_polygon(
          polygon, [k](const Corner& corner) { return corner[k]; }, cut, [](const Corner&) {});
      polygon = cut;
      if (polygon.size() < 3) {
        return false;
      }
    }
  }
  // Without sides that are all rounding: they have no direction to cut along.
  std::array<Eigen::Vector2d, ConvexPolygon<Corner>::kMost> shadow;
  std::size_t count = 0;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    shadow[count] = polygon[k].head<2>() / polygon[k].head<3>().sum();
    count += count == 0 || is_apart(shadow[count], shadow[count - 1]) ? 1 : 0;
  }
  count -= count > 1 && !is_apart(shadow[count - 1], shadow[0]) ? 1 : 0;
  const std::span points = std::span(shadow).first(count);
  const double area = twice_area(points);
  if (area < 0.0) {
    std::reverse(points.begin(), points.end());
  }
  if (!(std::abs(area) > no_area_)) {
    return false;
  }
  by_size_.emplace_back(-std::abs(area), shadows_.size());
  shadows_.add(points);
  return !(std::abs(area) < 1.0 - no_area_);
}

bool FaceClip::is_behind(const std::array<std::uint32_t, 2>& edge) const {
  constexpr double kInFace = 1e-9;  // below the face's plane, in units of the frame
  const Corner from = corner(edge[0]);
  const Corner to = corner(edge[1]);
  // From a corner of the face down: only there it is as near to the plane as to lie in it.
  if (is_corner(edge[0]) ? to[3] < -kInFace : is_corner(edge[1]) && from[3] < -kInFace) {
    return false;
  }
  const Corner way = to - from;
  double low = 0.0;
  double high = 1.0;
  for (Eigen::Index k = 0; k < 4; ++k) {
    const double value = k < 3 ? from[k] : from[k] + kInFace;
    if (way[k] > 0.0) {
      low = std::max(low, -value / way[k]);
    } else if (way[k] < 0.0) {
      high = std::min(high, -value / way[k]);
    } else if (k < 3 ? !(value > 0.0) : value < 0.0) {
      return false;
    }
  }
  return high - low > kTouch;
}

void FaceClip::cut_along(const std::array<std::uint32_t, 2>& edge) {
  const Vec3 first = corner(edge[0]).head<3>();
  const Vec3 last = corner(edge[1]).head<3>();
  const Vec3 line = first.cross(last);
  if (!(line.squaredNorm() > 0.0)) {
    return;
  }
  // A place on the line is first times its product with the one plus last times that with the other.
  const Vec3 of_first = last.cross(line) / line.squaredNorm();
  const Vec3 of_last = line.cross(first) / line.squaredNorm();
  next_.shrink_to(0);
  for (std::size_t i = 0; i < parts_.size(); ++i) {
    double most_first = 0.0;
    double most_last = 0.0;
    outside_.clear();
    cut_polygon(
        parts_[i], [&](const Eigen::Vector2d& place) { return line.dot(homogeneous(place)); },
        inside_,
        [&](const Eigen::Vector2d& place) {
          outside_.push_back(place);
          if (!inside_.empty() && inside_.back() == place) {  // on both sides: on the line
            most_first = std::max(most_first, of_first.dot(homogeneous(place)));
            most_last = std::max(most_last, of_last.dot(homogeneous(place)));
          }
        });
    const bool is_between = most_first > kTouch && most_last > kTouch;
    if (is_between && twice_area(inside_) > kNoArea && twice_area(outside_) > kNoArea) {
      next_.add(inside_);
      next_.add(outside_);
    } else {
      next_.add(parts_[i]);
    }
  }
  std::swap(parts_, next_);
}

Vec3 FaceClip::middle(Polygons::Points part) const {
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  for (const Eigen::Vector2d& place : part) {
    sum += place;
  }
  const Vec3 shares = homogeneous(sum / static_cast<double>(part.size()));
  return shares.x() * points_[on_[0]] + shares.y() * points_[on_[1]] + shares.z() * points_[on_[2]];
}

/// The largest first, as they leave least to be cut.
bool FaceClip::subtract(std::size_t& steps, std::size_t most) {
  std::sort(by_size_.begin(), by_size_.end());
  for (const auto& [size, i] : by_size_) {
    steps += kStepsPerPart * parts_.size();
    if (steps > most) {
      return false;
    }
    subtract(shadows_[i]);
  }
  return true;
}

void FaceClip::subtract(Polygons::Points polygon) {
  next_.shrink_to(0);
  for (std::size_t i = 0; i < parts_.size(); ++i) {
    const std::size_t before = next_.size();
    if (is_beside(parts_[i], polygon)) {
      next_.add(parts_[i]);
      continue;
    }
    inside_.assign(parts_[i].begin(), parts_[i].end());
    for (std::size_t k = 0; k < polygon.size() && inside_.size() > 2; ++k) {
      const Eigen::Vector2d& from = polygon[k];
      const Eigen::Vector2d way = polygon[(k + 1) % polygon.size()] - from;
      outside_.clear();
      cut_polygon(
          inside_, [&](const Eigen::Vector2d& place) { return cross(way, place - from); }, kept_,
          [&](const Eigen::Vector2d& place) { outside_.push_back(place); });
      std::swap(inside_, kept_);
      if (twice_area(outside_) > no_area_) {
        next_.add(outside_);
      }
    }
    if (!(twice_area(inside_) > no_area_)) {
      next_.shrink_to(before);
      next_.add(parts_[i]);  // whole: the polygon passes it by
    }
  }
  std::swap(parts_, next_);
}

}  // namespace vantage
