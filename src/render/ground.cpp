// SPDX-License-Identifier: MIT
#include "render/ground.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#include <Eigen/Geometry>

#include "core/parallel.h"

namespace vantage {
namespace {

/// Cells of the grid a side: a cell is then about 2 % of the model. [ours]
constexpr int kCells = 160;
/// Rays from each cell, one of nine sets: the blur below averages over all of them. [ours]
constexpr std::size_t kRays = 48;
constexpr std::size_t kSetsAcross = 3;
/// Rays start this far above the ground, over the reach.
constexpr double kOffset = 1e-4;

/// One pass of the binomial filter 1 2 1 along one axis; what is outside counts as open.
std::vector<double> blurred(const std::vector<double>& values, int step_x, int step_y) {
  std::vector<double> result(values.size());
  const auto at = [&](int x, int y) {
    return x < 0 || y < 0 || x >= kCells || y >= kCells
               ? 0.0
               : values[static_cast<std::size_t>(y) * kCells + static_cast<std::size_t>(x)];
  };
  for (int y = 0; y < kCells; ++y) {
    for (int x = 0; x < kCells; ++x) {
      result[static_cast<std::size_t>(y) * kCells + static_cast<std::size_t>(x)] =
          0.25 * at(x - step_x, y - step_y) + 0.5 * at(x, y) + 0.25 * at(x + step_x, y + step_y);
    }
  }
  return result;
}

}  // namespace

Ground::Ground(const TriMesh& mesh, const RayScene& scene, const Vec3& up, double reach,
               const RunContext& run) {
  constexpr double kFar = std::numeric_limits<double>::infinity();
  floor_ = {up, kFar};
  across_ = up.unitOrthogonal();
  along_ = up.cross(across_);
  std::array<double, 4> box{kFar, -kFar, kFar, -kFar};  // least and largest across, along
  for (const Triangle& triangle : mesh.triangles) {
    for (const std::uint32_t v : triangle) {
      const Vec3& p = mesh.positions[v];
      floor_.height = std::min(floor_.height, p.dot(up));
      box = {std::min(box[0], p.dot(across_)), std::max(box[1], p.dot(across_)),
             std::min(box[2], p.dot(along_)), std::max(box[3], p.dot(along_))};
    }
  }
  const double side = std::max(box[1] - box[0], box[3] - box[2]) + 2.0 * reach;
  cell_ = side / kCells;
  left_ = 0.5 * (box[0] + box[1] - side);
  bottom_ = 0.5 * (box[2] + box[3] - side);
  const Occlusion occlusion(scene, reach, kOffset * reach, std::nullopt);
  const HemisphereDirections directions(kRays, kSetsAcross * kSetsAcross);
  const HemisphereFrame sky{up.cast<float>(), across_.cast<float>(), along_.cast<float>()};
  shadows_.resize(static_cast<std::size_t>(kCells) * kCells);
  parallel_for(run, shadows_.size(), kCells, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const std::size_t column = i % kCells;
      const std::size_t row = i / kCells;
      const Vec3 point = (left_ + (static_cast<double>(column) + 0.5) * cell_) * across_ +
                         (bottom_ + (static_cast<double>(row) + 0.5) * cell_) * along_ +
                         floor_.height * up;
      const std::size_t set = kSetsAcross * (row % kSetsAcross) + column % kSetsAcross;
      const float open =
          occlusion.openness(point.cast<float>(), sky, sky.normal, directions.part(set));
      shadows_[i] = 1.0 - static_cast<double>(open);
    }
  });
  shadows_ = blurred(blurred(shadows_, 1, 0), 0, 1);
}

double Ground::meet(const PictureRay& ray) const {
  const double fall = -ray.direction.dot(floor_.up);
  const double height = ray.origin.dot(floor_.up) - floor_.height;
  return fall > 0.0 && height >= 0.0 ? height / fall : std::numeric_limits<double>::infinity();
}

double Ground::cell(int column, int row) const {
  if (column < 0 || row < 0 || column >= kCells || row >= kCells) {
    return 0.0;
  }
  return shadows_[static_cast<std::size_t>(row) * kCells + static_cast<std::size_t>(column)];
}

double Ground::shadow(const Vec3& point) const {
  const double x = (point.dot(across_) - left_) / cell_ - 0.5;
  const double y = (point.dot(along_) - bottom_) / cell_ - 0.5;
  if (!(x > -1.0 && y > -1.0 && x < kCells && y < kCells)) {
    return 0.0;
  }
  const int column = static_cast<int>(std::floor(x));
  const int row = static_cast<int>(std::floor(y));
  const double u = x - column;
  const double v = y - row;
  return (1.0 - v) * ((1.0 - u) * cell(column, row) + u * cell(column + 1, row)) +
         v * ((1.0 - u) * cell(column, row + 1) + u * cell(column + 1, row + 1));
}

}  // namespace vantage
