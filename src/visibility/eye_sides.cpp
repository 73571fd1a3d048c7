// SPDX-License-Identifier: MIT
// Which sides of faces are turned to the eye.
#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include "core/parallel.h"
#include "visibility/eye_grid.h"

namespace vantage {
namespace {

// A face whose normal is this close to a right angle with the line of sight is seen edge on: the
// rounding of positions in a UnitFrame and of the dot product, in radians.
constexpr double kEdgeOn = 0x1p-46;
// Blocks per chunk: some tenths of a millisecond.
constexpr std::size_t kBlockGrain = 128;

/// Which side of the face is turned to the eye, in double: 1 front, 2 back, 0 edge on.
std::uint8_t exact_side(const Surface& surface, std::size_t f, const Viewpoint& eye) {
  const Vec3 sight = eye.projection == Projection::Perspective
                         ? Vec3(eye.position - surface.sites[surface.faces[f][0]])
                         : eye.position;
  const double height = surface.area_vectors[f].dot(sight);
  if (!(std::abs(height) > kEdgeOn * surface.twice_areas[f] * sight.norm())) {
    return 0;
  }
  return height > 0.0 ? 1 : 2;
}

}  // namespace

void EyeGrid::begin(const Surface& surface, const Viewpoint& eye,
                    std::span<const std::uint8_t> backs, const RunContext& run) {
  eye_ = eye;
  aim_ = Aim::None;
  backs_ = backs;
  face_sides(surface, run);
}

void EyeGrid::face_sides(const Surface& surface, const RunContext& run) {
  const Viewpoint& eye = eye_;
  const FacePlanes& planes = surface.planes;
  const std::size_t count = surface.faces.size();
  turned_.resize(count);
  const bool perspective = eye.projection == Projection::Perspective;
  const auto length = static_cast<float>(eye.position.norm());
  const Eigen::Vector3f at = eye.position.cast<float>();
  const float offset = perspective ? 1.0F : 0.0F;
  // Bounds the rounding of the float height below: a dozen roundings of numbers of this size.
  const float error_bound = 0x1p-19F * (length + 2.0F);
  block_sides(surface.blocks, error_bound);
  const auto faces_of = [&](std::size_t begin, std::size_t end) {
    for (std::size_t f = begin; f < end; ++f) {
      const float height = planes.x[f] * at.x() + planes.y[f] * at.y() + planes.z[f] * at.z() -
                           offset * planes.offset[f];
      const int side = height > 0.0F ? 1 : 2;
      turned_[f] = static_cast<std::uint8_t>(std::abs(height) > error_bound ? side : 3);
    }
    for (std::size_t f = begin; f < end; ++f) {
      if (turned_[f] == 3) {
        turned_[f] = exact_side(surface, f, eye);
      }
    }
  };
  constexpr std::size_t kFaces = FaceBlocks::kFaces;
  parallel_for(run, block_side_.size(), kBlockGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t block = begin; block < end; ++block) {
      const std::size_t first = block * kFaces;
      const std::size_t last = std::min(count, first + kFaces);
      if (block_side_[block] == 0) {
        faces_of(first, last);
      } else {
        std::fill(turned_.data() + first, turned_.data() + last, block_side_[block]);
      }
    }
  });
}

/// Which side all of a block's faces turn to the eye; 0 if that is not clear.
void EyeGrid::block_sides(const FaceBlocks& blocks, float error_bound) {
  const Eigen::Vector3f at = eye_.position.cast<float>();
  const bool perspective = eye_.projection == Projection::Perspective;
  block_side_.assign(blocks.radius.size(), 0);
  // Squares of far eyes overflow; each face is looked at then.
  constexpr float kFarthest = 1e6F;
  if (blocks.cosine.empty() || !(at.norm() < kFarthest)) {
    return;
  }
  for (std::size_t i = 0; i < block_side_.size(); ++i) {
    const Eigen::Vector3f centre(blocks.centres.x[i], blocks.centres.y[i], blocks.centres.z[i]);
    const Eigen::Vector3f axis(blocks.axes.x[i], blocks.axes.y[i], blocks.axes.z[i]);
    const Eigen::Vector3f sight = perspective ? Eigen::Vector3f(at - centre) : at;
    // How high the eye is over the planes of normals within the cone, through points in the ball.
    const float along = axis.dot(sight);
    const float aside = std::sqrt(std::max(0.0F, sight.squaredNorm() - along * along));
    const float cosine = blocks.cosine[i];
    const float sine = std::sqrt(std::max(0.0F, 1.0F - cosine * cosine));
    // Far more than rounding, that of a narrow cone's cosine above all.
    const float bound = 0x1p10F * error_bound + (perspective ? blocks.radius[i] : 0.0F);
    const float least = along * cosine - aside * sine;
    const float most = along * cosine + aside * sine;
    const bool is_cone = cosine > 0.0F;
    block_side_[i] = is_cone && least > bound ? 1 : is_cone && most < -bound ? 2 : 0;
  }
}

}  // namespace vantage
