// SPDX-License-Identifier: MIT
#include "spatial/picture_cells.h"

#include <cmath>
#include <limits>

#include <Eigen/Geometry>

#include "spatial/convex_polygon.h"

namespace vantage {
namespace {

// The nearest depth over the farthest from which on a picture is one plane: before a nearer eye most
// of a plane would be empty, and almost all of the surface in a few cells around its middle. [ours]
constexpr double kLeastRatio = 1.0 / 64.0;

}  // namespace

void PictureCells::begin(std::span<const Vec3> samples, const Viewpoint& eye, std::size_t cells) {
  samples_ = samples;
  eye_ = eye;
  project();
  const double sides = is_flat_ ? 1.0 : static_cast<double>(kSides);
  const double side = std::ceil(std::sqrt(static_cast<double>(cells) / sides));
  side_ = static_cast<std::uint32_t>(std::clamp(side, 1.0, static_cast<double>(kMostSide)));
  columns_ = is_flat_ ? side_ : kSides * side_;
  if (!is_flat_ || exact_.empty()) {
    return;
  }
  Eigen::Array3d low = exact_[0].array();
  Eigen::Array3d high = low;
  for (const Vec3& place : exact_) {
    low = low.min(place.array());
    high = high.max(place.array());
  }
  low_ = low.matrix().head<2>();
  for (const Eigen::Index k : {0, 1}) {
    per_unit_[k] = high[k] > low[k] ? side_ / (high[k] - low[k]) : 0.0;
  }
  places_.resize(exact_.size());
  for (std::size_t sample = 0; sample < exact_.size(); ++sample) {
    places_[sample] = in_cells(exact_[sample]);
  }
}

/// Finds out whether the picture is one plane, and then where the samples are on it.
void PictureCells::project() {
  distance_ = eye_.position.norm();
  is_ahead_ = distance_ > 0.0;
  is_flat_ = is_ahead_;
  if (!is_ahead_) {
    return;
  }
  towards_ = eye_.position / distance_;
  right_ = towards_.unitOrthogonal();
  up_ = towards_.cross(right_);
  if (eye_.projection == Projection::Perspective && !samples_.empty()) {
    double nearest = std::numeric_limits<double>::infinity();
    double farthest = -nearest;
    for (const Vec3& place : samples_) {
      const double depth = distance_ - place.dot(towards_);
      nearest = std::min(nearest, depth);
      farthest = std::max(farthest, depth);
    }
    is_ahead_ = nearest > 0.0;
    is_flat_ = is_ahead_ && nearest >= kLeastRatio * farthest;
    if (!is_flat_) {
      return;
    }
  }
  exact_.resize(samples_.size());
  for (std::size_t sample = 0; sample < exact_.size(); ++sample) {
    exact_[sample] = on_plane(samples_[sample]);
  }
}

bool PictureCells::coarsen() {
  if (side_ == 1) {
    return false;
  }
  const std::uint32_t side = side_ / 2;
  const float scale = static_cast<float>(side) / static_cast<float>(side_);
  for (Place& place : places_) {
    place.x *= scale;
    place.y *= scale;
  }
  side_ = side;
  per_unit_ *= scale;
  columns_ = is_flat_ ? side_ : kSides * side_;
  return true;
}

PictureCells::Outline::Outline(const PictureCells& picture, const Triangle& face)
    : picture_(picture) {
  if (!picture.is_flat_) {
    return;
  }
  std::array<Place, 3> corners;
  for (std::size_t k = 0; k < 3; ++k) {
    corners[k] = picture.places_[face[k]];
  }
  const auto& [a, b, c] = corners;
  const float twice = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
  const float sign = twice < 0.0F ? -1.0F : 1.0F;
  for (std::size_t k = 0; k < 3; ++k) {
    const Place& from = corners[k];
    const Place& to = corners[(k + 1) % 3];
    const float x = sign * (from.y - to.y);
    const float y = sign * (to.x - from.x);
    lines_[k] = {x, y, x * from.x + y * from.y, kSlack * (std::abs(x) + std::abs(y))};
  }
}

/// Where an edge or a face is on a side of the cube. \return false if it is not there.
bool PictureCells::on_side(const Vec3* from_eye, std::size_t count, std::uint32_t side,
                           CellRange& cells) const {
  const auto axis = static_cast<Eigen::Index>(side / 2);
  const double sign = side % 2 == 0 ? 1.0 : -1.0;
  ConvexPolygon<Vec3> polygon;
  ConvexPolygon<Vec3> cut;
  for (std::size_t k = 0; k < count; ++k) {
    const Vec3& place = from_eye[k];
    polygon.push_back({place[(axis + 1) % 3], place[(axis + 2) % 3], sign * place[axis]});
  }
  for (const Eigen::Index k : {0, 1}) {
    for (const double way : {1.0, -1.0}) {
      const auto within = [=](const Vec3& place) { return place.z() + way * place[k]; };
      cut_polygon(polygon, within, cut, [](const Vec3&) {});
      std::swap(polygon, cut);
      if (polygon.size() == 0) {
        return false;
      }
    }
  }
  Eigen::Array2d low(1.0, 1.0);
  Eigen::Array2d high(-1.0, -1.0);
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Vec3& place = polygon[k];
    if (place.z() > 0.0) {
      low = low.min(place.head<2>().array() / place.z());
      high = high.max(place.head<2>().array() / place.z());
    } else {  // the eye itself
      low = -1.0;
      high = 1.0;
    }
  }
  const auto at = [&](double place, double slack) {
    const double in_cells = 0.5 * (place + 1.0) * side_ + slack;
    return static_cast<std::uint16_t>(std::clamp(in_cells, 0.0, side_ - 1.0));
  };
  const double slack = kSlack;
  const auto column = [&](std::uint16_t of_side) {
    return static_cast<std::uint16_t>(side * side_ + of_side);
  };
  cells = {column(at(low[0], -slack)), column(at(high[0], slack)), at(low[1], -slack),
           at(high[1], slack)};
  return true;
}

}  // namespace vantage
