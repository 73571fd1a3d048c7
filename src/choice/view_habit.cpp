// SPDX-License-Identifier: MIT
#include "choice/view_habit.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace vantage {
namespace {

// Sides of boxes are told apart down to this share of the sphere's radius. [ours]
constexpr double kThin = 0.02;
// A mirror plane within 8° of an axis is that axis'. [ours]
constexpr double kAlongAxis = 0.99;
// What every choice weighs, however unlike its shape: a shape like no other has their mean. [ours]
constexpr double kLeastWeight = 1e-4;

double squared_distance(const ShapeProportions& a, const ShapeProportions& b, double mirror) {
  const double height = a.height - b.height;
  const double width = a.width - b.width;
  const int unlike = static_cast<int>(a.mirrors_side != b.mirrors_side) +
                     static_cast<int>(a.mirrors_front != b.mirrors_front) +
                     static_cast<int>(a.mirrors_up != b.mirrors_up);
  return height * height + width * width + mirror * unlike;
}

}  // namespace

ShapeProportions proportions_of(const TriMesh& surface, double radius,
                                std::span<const MirrorPlane> planes, const UprightFrame& frame) {
  const std::array<Vec3, 3> axes{frame.side, frame.up, frame.front};
  std::array<double, 3> low{};
  std::array<double, 3> high{};
  bool is_first = true;
  for (const Triangle& corners : surface.triangles) {
    for (const std::uint32_t v : corners) {
      for (std::size_t k = 0; k < 3; ++k) {
        const double x = axes[k].dot(surface.positions[v]) / radius;
        low[k] = is_first ? x : std::min(low[k], x);
        high[k] = is_first ? x : std::max(high[k], x);
      }
      is_first = false;
    }
  }
  const auto side = [&](std::size_t k) { return high[k] - low[k] + kThin; };
  const auto mirrors = [&](const Vec3& axis) {
    return std::any_of(planes.begin(), planes.end(), [&](const MirrorPlane& plane) {
      return std::abs(plane.normal.dot(axis)) > kAlongAxis;
    });
  };
  return {.height = std::log(side(1) / std::sqrt(side(0) * side(2))),
          .width = std::log(side(0) / side(2)),
          .mirrors_side = mirrors(frame.side),
          .mirrors_front = mirrors(frame.front),
          .mirrors_up = mirrors(frame.up)};
}

ViewHabit::ViewHabit(const ChoiceTable& table, const ShapeProportions& shape) : table_(&table) {
  double sum = 0.0;
  for (const RecordedChoice& choice : table.choices) {
    const double d2 = squared_distance(choice.shape, shape, table.mirror_weight);
    weights_.push_back(std::exp(-d2 / (2.0 * table.bandwidth * table.bandwidth)) + kLeastWeight);
    sum += weights_.back();
  }
  for (double& weight : weights_) {
    weight /= sum;
  }
}

double ViewHabit::distance(const Vec3& direction) const {
  double mean = 0.0;
  for (std::size_t i = 0; i < weights_.size(); ++i) {
    const RecordedChoice& choice = table_->choices[i];
    const Vec3& c = choice.direction;
    const double along = direction.z() * c.z();
    const double cosine = std::abs(direction.x() * c.x()) + direction.y() * c.y() +
                          (choice.shape.mirrors_front ? std::abs(along) : along);
    mean += weights_[i] * std::acos(std::clamp(cosine, -1.0, 1.0));
  }
  return mean;
}

}  // namespace vantage
