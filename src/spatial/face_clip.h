// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "vantage/core/camera.h"
#include "vantage/core/vec3.h"
#include "vantage/mesh/tri_mesh.h"

#include "spatial/convex_polygon.h"

/// \file
/// A face in parts, as polygons: cut along edges that pass before it, or less the shadows that the
/// faces before it cast on it from the eye (Weiler and Atherton, "Hidden surface removal using polygon
/// area sorting", 1977, for one face at a time).

namespace vantage {

/// Convex polygons, counterclockwise, in the first two barycentric coordinates of a face. Keeps its
/// memory when it is emptied.
class Polygons {
 public:
  using Points = std::span<const Eigen::Vector2d>;

  [[nodiscard]] std::size_t size() const { return ends_.size(); }

  [[nodiscard]] Points operator[](std::size_t i) const {
    const std::size_t begin = i == 0 ? 0 : ends_[i - 1];
    return std::span(points_).subspan(begin, ends_[i] - begin);
  }

  void add(Points polygon) {
    points_.insert(points_.end(), polygon.begin(), polygon.end());
    ends_.push_back(points_.size());
  }

  /// Leaves the first `count`.
  void shrink_to(std::size_t count) {
    ends_.resize(count);
    points_.resize(count == 0 ? 0 : ends_.back());
  }

 private:
  std::vector<Eigen::Vector2d> points_{};
  std::vector<std::size_t> ends_{};
};

/// All of a face.
inline const std::array<Eigen::Vector2d, 3> kWholeFace{
    Eigen::Vector2d(1.0, 0.0), Eigen::Vector2d(0.0, 1.0), Eigen::Vector2d(0.0, 0.0)};

/// Positive if its corners go counterclockwise; of a part of a face its share of the face's area.
double twice_area(Polygons::Points polygon);

/// Clips one face after the other, all as one eye sees them. Made for reuse.
class FaceClip {
 public:
  /// Shares of a face up to this are rounding, times how many times as large as the face what lies before
  /// it is.
  static constexpr double kNoArea = 1e-13;

  /// \param points in a UnitFrame, and the eye in it. \param faces of positive area. Both must outlive
  ///               the use of this.
  void begin(std::span<const Vec3> points, std::span<const Triangle> faces, const Viewpoint& eye);

  /// Takes a face, whole. \param normal its unit normal. \pre it is not seen edge on.
  void take(std::uint32_t face, const Vec3& normal);

  /// Whether an edge lies before the inside of the face, or in it.
  [[nodiscard]] bool is_behind(const std::array<std::uint32_t, 2>& edge) const;

  /// Cuts the parts that an edge passes before in two, along it.
  void cut_along(const std::array<std::uint32_t, 2>& edge);

  /// Adds the shadow of another face. \return whether it alone hides all of the face.
  bool add_shadow(std::uint32_t other);

  /// Takes all shadows away. \param steps are counted up. \return false if they pass `most`.
  bool subtract(std::size_t& steps, std::size_t most);

  /// What the face was cut into, or what is left of it after subtract().
  [[nodiscard]] const Polygons& parts() const { return parts_; }

  /// The middle of a part, in the frame.
  [[nodiscard]] Vec3 middle(Polygons::Points part) const;

 private:
  /// A place in homogeneous barycentric coordinates of the face, as it is seen from the eye; the fourth
  /// is the height over the face's plane on the eye's side.
  using Corner = Eigen::Vector4d;

  [[nodiscard]] bool is_corner(std::uint32_t point) const;  // of the face
  [[nodiscard]] Corner corner(std::uint32_t point) const;
  void subtract(Polygons::Points polygon);

  std::span<const Vec3> points_{};
  std::span<const Triangle> faces_{};
  Viewpoint eye_{};
  Triangle on_{};                    // the face's corners
  Vec3 first_ = Vec3::Zero();        // corner
  std::array<Corner, 3> of_axes_{};  // what x, y and z from there add to a place's coordinates
  double no_area_ = kNoArea;
  Polygons shadows_{}, parts_{}, next_{};
  std::vector<std::pair<double, std::size_t>> by_size_{};       // less the area of each shadow
  std::vector<Eigen::Vector2d> inside_{}, outside_{}, kept_{};  // of the part at hand
};

}  // namespace vantage
