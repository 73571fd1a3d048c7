// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include <Eigen/Core>

#include "vantage/core/camera.h"
#include "vantage/mesh/tri_mesh.h"
#include "vantage/spatial/mirror_symmetry.h"

#include "choice/choice_table.h"

namespace vantage {

/// Proportions of a surface in a frame. \param radius of its enclosing sphere, > 0.
ShapeProportions proportions_of(const TriMesh& surface, double radius,
                                std::span<const MirrorPlane> planes, const UprightFrame& frame);

/// From where people show things of such proportions: a kernel regression (Nadaraya 1964, Watson
/// 1964) over recorded choices.
class ViewHabit {
 public:
  ViewHabit(const ChoiceTable& table, const ShapeProportions& shape);

  /// Mean angle in radians from a direction to the views recorded, weighted by how like their
  /// shapes are to this one. Left and right count as one, and so do front and back of what mirrors
  /// them. \param direction unit, along side, up and front.
  [[nodiscard]] double distance(const Vec3& direction) const;

 private:
  // Of each choice:
  Eigen::ArrayXd side_;
  Eigen::ArrayXd up_;
  Eigen::ArrayXd front_;
  Eigen::Array<bool, Eigen::Dynamic, 1> mirrors_front_;
  Eigen::ArrayXd weights_;  // they add up to 1
};

}  // namespace vantage
