// SPDX-License-Identifier: MIT
#include "pipeline/twins.h"

#include <cmath>
#include <numbers>
#include <utility>

#include "vantage/spatial/mirror_symmetry.h"

#include "pipeline/view_preparation.h"

namespace vantage {
namespace {

// A mirror image with this share of the best score shows as much. [ours]
constexpr double kTwinShare = 0.98;
// Objectives that differ by less are equal to the eye: half of what two tessellations of one shape
// make. [ours]
constexpr double kNearTie = 0.99;
// Views closer than this are one view, not twins.
constexpr double kApartRad = 2.0 * std::numbers::pi / 180.0;
// Components along an axis that differ by less count as equal.
constexpr double kSameComponent = 0.02;

/// Whether a is nearer to the front than b or, at the same distance, more to the side.
bool ahead(const Vec3& a, const Vec3& b, const UprightFrame& frame) {
  const double front = frame.front.dot(a) - frame.front.dot(b);
  if (std::abs(front) > kSameComponent) {
    return front > 0.0;
  }
  return frame.side.dot(a) - frame.side.dot(b) > kSameComponent;
}

/// Whether b is on the right and what a plane between left and right makes of a.
bool is_right_of(const Vec3& b, const Vec3& a, const UprightFrame& frame) {
  return std::abs(frame.front.dot(a) - frame.front.dot(b)) < kSameComponent &&
         std::abs(frame.up.dot(a) - frame.up.dot(b)) < kSameComponent &&
         frame.side.dot(b) - frame.side.dot(a) > kSameComponent;
}

}  // namespace

std::vector<TwinView> twins_of(const Vec3& best, const ShapeAnalysis& shape,
                               const ScoreBatch& score, const Preference& preference) {
  const std::vector<Vec3> images = mirror_images(best, planes_of(shape), kApartRad);
  const std::vector<double> scores = score(images);
  std::vector<TwinView> twins;
  for (std::size_t i = 1; i < images.size(); ++i) {
    if (scores[i] >= kTwinShare * scores.front()) {
      twins.push_back({images[i], scores[i], preference(images[i], scores[i])});
    }
  }
  return twins;
}

void settle_near_ties(TwinView& best, std::vector<TwinView>& twins, const UprightFrame& frame) {
  const double least = kNearTie * best.objective;
  for (TwinView& twin : twins) {
    if (twin.objective >= least && ahead(twin.direction, best.direction, frame)) {
      std::swap(best, twin);
    }
  }
}

void settle_sides(TwinView& best, std::vector<TwinView>& twins, const UprightFrame& frame,
                  const ScorePreference& preference) {
  const double least = kNearTie * best.objective;
  for (TwinView& twin : twins) {
    if (is_right_of(twin.direction, best.direction, frame) &&
        preference(twin.direction, best.score) >= least) {
      std::swap(best, twin);
      return;
    }
  }
}

}  // namespace vantage
