// SPDX-License-Identifier: MIT
#include "contraction/soundness.h"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>

#include "contraction/step_limits.h"
#include "mesh/place_order.h"

namespace vantage {
namespace {

using Sample = Soundness::Sample;

/// A vertex may get this far from the first enclosing sphere's centre, in radii. The box does not
/// see one vertex that flies off while the others shrink, and what it sees depends on the axes.
constexpr double kFarthest = 1.2;
/// Rounding of a_t.
constexpr double kRise = 1e-9;
/// A surface is a curve if it has less area than this, over its squared extent [ours: a disc has
/// 1.57, a ball 3.14].
constexpr double kThin = 0.3;
/// A step must leave a curve this share of its length [ours: trials in docs/lab].
constexpr double kKept = 0.7;
constexpr std::size_t kSamples = 32;

/// Vertices each of which is as far as can be from those before it, beginning far from `centre`. Of those as
/// far, the order of places decides, not of numbers: other samples may tell otherwise whether a step is kept.
std::vector<Sample> farthest_points(const std::vector<Vec3>& points, const Vec3& centre) {
  const PlaceOrder order(points);
  std::vector<double> distance(points.size());
  std::vector<std::uint32_t> place(points.size());
  for (std::size_t v = 0; v < points.size(); ++v) {
    distance[v] = (points[v] - centre).norm();
    place[v] = order.place(points[v], points[v]);
  }
  std::vector<Sample> chosen;
  while (chosen.size() < std::min(kSamples, points.size())) {
    std::size_t far = 0;
    std::pair<std::uint32_t, std::uint32_t> farthest{order.steps(distance[0]), place[0]};
    for (std::size_t v = 1; v < points.size(); ++v) {
      const std::pair candidate{order.steps(distance[v]), place[v]};
      if (candidate > farthest) {
        far = v;
        farthest = candidate;
      }
    }
    const bool first = chosen.empty();
    chosen.push_back({far, first ? std::numeric_limits<double>::infinity() : distance[far]});
    for (std::size_t v = 0; v < points.size(); ++v) {
      const double d = (points[v] - points[far]).norm();
      distance[v] = first ? d : std::min(distance[v], d);
    }
  }
  return chosen;
}

/// Length of the minimum spanning tree of the samples (Prim 1957): that of a curve through them.
double tree_length(const std::vector<Vec3>& points, std::span<const Sample> samples) {
  std::vector<double> distance(samples.size(), std::numeric_limits<double>::infinity());
  std::vector<bool> is_in(samples.size(), false);
  double length = 0.0;
  std::size_t last = 0;
  for (std::size_t step = 1; step < samples.size(); ++step) {
    is_in[last] = true;
    std::size_t next = last;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < samples.size(); ++i) {
      if (!is_in[i]) {
        distance[i] = std::min(distance[i],
                               (points[samples[i].vertex] - points[samples[last].vertex]).norm());
        if (distance[i] < least) {
          least = distance[i];
          next = i;
        }
      }
    }
    length += least;
    last = next;
  }
  return length;
}

}  // namespace

Soundness::Soundness(const TriMesh& start)
    : sphere_(enclosing_sphere(start.positions)),
      largest_(largest_box(start.positions, sphere_.diameter)),
      samples_(farthest_points(start.positions, sphere_.centre)) {}

StepFlaw Soundness::flaw(const TriMesh& before, const std::vector<Vec3>& after,
                         double shrinkage_before, double shrinkage_after, StepBound bound) const {
  if (outgrown(after, bound)) {
    return StepFlaw::Grew;
  }
  if (!(shrinkage_after <= shrinkage_before + kRise)) {
    return StepFlaw::Rose;
  }
  return collapsed(before, after) ? StepFlaw::Collapsed : StepFlaw::None;
}

bool Soundness::outgrown(const std::vector<Vec3>& now, StepBound bound) const {
  const double farthest = kFarthest * 0.5 * sphere_.diameter;
  return (bounding_box(now).size().array() > largest_.array()).any() ||
         (bound == StepBound::BoxAndSphere &&
          std::any_of(now.begin(), now.end(), [&](const Vec3& p) {
            return (p - sphere_.centre).squaredNorm() > farthest * farthest;
          }));
}

bool Soundness::collapsed(const TriMesh& before, const std::vector<Vec3>& after) const {
  const double extent = enclosing_sphere(before.positions).diameter;
  const double area = surface_area(before);
  if (area >= kThin * extent * extent) {
    return false;
  }
  // A tree through nearer ones would measure how wide the surface is: a tube along the extent has
  // the area of three of its diameters times that.
  const auto far_apart = std::find_if(samples_.begin(), samples_.end(),
                                      [&](const Sample& l) { return l.spacing * extent < area; });
  const std::span<const Sample> samples(samples_.begin(), far_apart);
  return enclosing_sphere(after).diameter < kKept * extent ||
         tree_length(after, samples) < kKept * tree_length(before.positions, samples);
}

}  // namespace vantage
