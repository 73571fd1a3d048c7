// SPDX-License-Identifier: MIT
#include "choice/view_habit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace vantage {
namespace {

// Sides of boxes are told apart down to this share of the sphere's radius. [ours]
constexpr double kThin = 0.02;
// A mirror plane within 8° of an axis is that axis'. [ours]
constexpr double kAlongAxis = 0.99;
// The bandwidth of a shape like few others is widened by this factor until the weights add up to so many
// choices, or to half of the table if it is that small: one odd choice is no habit. [ours]
constexpr double kWiden = 1.1;
constexpr double kLeastChoices = 2.0;
// What every choice weighs at least, however unlike its shape. [ours]
constexpr double kLeastWeight = 1e-4;

double squared_distance(const ShapeProportions& a, const ShapeProportions& b, double mirror) {
  const double height = a.height - b.height;
  const double width = a.width - b.width;
  const int unlike = static_cast<int>(a.mirrors_side != b.mirrors_side) +
                     static_cast<int>(a.mirrors_front != b.mirrors_front) +
                     static_cast<int>(a.mirrors_up != b.mirrors_up);
  return height * height + width * width + mirror * unlike;
}

// acos(x) / √(1 − x) for x in [0, 1], interpolated at Chebyshev's points: within 5·10⁻¹⁴. Eigen makes
// vectors of this and not of std::acos, which took a tenth of the time of small models.
constexpr std::array<double, 15> kArcCosine{
    1.5707963267948508,   -0.21460183658198362,  0.08904862097476693,   -0.05079276663646949,
    0.03368051726468367,  -0.024366816781336672, 0.018623880511052716,  -0.014668862733181742,
    0.011512105039373999, -0.008534775541122475, 0.0055608266626365754, -0.0029273283822277563,
    0.001128864702458543, -0.0002773448611606,   3.215194078620698e-05};

/// In radians; values beyond ±1 count as these.
Eigen::ArrayXd arc_cosine(const Eigen::ArrayXd& cosine) {
  const Eigen::ArrayXd size = cosine.abs().min(1.0);
  Eigen::ArrayXd angle = Eigen::ArrayXd::Constant(size.size(), kArcCosine.back());
  for (std::size_t i = kArcCosine.size() - 1; i-- > 0;) {
    angle = angle * size + kArcCosine[i];
  }
  angle *= (1.0 - size).sqrt();
  return (cosine < 0.0).select(std::numbers::pi - angle, angle);
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

ViewHabit::ViewHabit(const ChoiceTable& table, const ShapeProportions& shape) {
  const auto count = static_cast<Eigen::Index>(table.choices.size());
  for (Eigen::ArrayXd* of_choice : {&side_, &up_, &front_, &weights_}) {
    of_choice->resize(count);
  }
  mirrors_front_.resize(count);
  Eigen::ArrayXd unlike(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const RecordedChoice& choice = table.choices[static_cast<std::size_t>(i)];
    side_[i] = choice.direction.x();
    up_[i] = choice.direction.y();
    front_[i] = choice.direction.z();
    mirrors_front_[i] = choice.shape.mirrors_front;
    unlike[i] = squared_distance(choice.shape, shape, table.mirror_weight);
  }
  const double least = std::min(kLeastChoices, 0.5 * static_cast<double>(count));
  double bandwidth = table.bandwidth;
  const auto kernel = [&]() -> Eigen::ArrayXd {
    return (-unlike / (2.0 * bandwidth * bandwidth)).exp();
  };
  weights_ = kernel();
  while (weights_.sum() < least) {
    bandwidth *= kWiden;
    weights_ = kernel();
  }
  weights_ += kLeastWeight;
  weights_ /= weights_.sum();
}

double ViewHabit::distance(const Vec3& direction) const {
  const Eigen::ArrayXd along = direction.z() * front_;
  const Eigen::ArrayXd cosine = (direction.x() * side_).abs() + direction.y() * up_ +
                                mirrors_front_.select(along.abs(), along);
  return (weights_ * arc_cosine(cosine)).sum();
}

}  // namespace vantage
