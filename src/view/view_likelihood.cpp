// SPDX-License-Identifier: MIT
#include "view/view_likelihood.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

#include <Eigen/Geometry>

#include "core/shannon.h"
#include "view/shared_logs.h"

namespace vantage {
namespace {

/// A view nearer than this to one of the set is that one.
constexpr double kSame = 1e-9;

/// Of the triangle with these unit corners, steradians; van Oosterom, Strackee 1983.
double solid_angle(const Vec3& a, const Vec3& b, const Vec3& c) {
  const double volume = std::abs(a.dot(b.cross(c)));
  return 2.0 * std::atan2(volume, 1.0 + a.dot(b) + b.dot(c) + c.dot(a));
}

/// Distances of a view from those of the set: roots of divergences, found when asked for. Both views
/// weigh the same: weighted by areas, one that sees little is alike to all that see much.
class SetDistances {
 public:
  SetDistances(const MeasuredModel& model, const SightTable& sight)
      : model_(&model),
        seen_{sight.faces, sight.projected_area, sight.area_logs},
        laid_out_(model.face_areas.size()),
        known_(model.set_views.size(), kUnknown) {
    laid_out_.put(sight.faces);
  }

  double operator[](std::uint32_t view) {
    double& distance = known_[view];
    if (distance == kUnknown) {
      distance = std::sqrt(divergence(view));
    }
    return distance;
  }

  /// Makes a view of the set the one that distances are from.
  void begin_at(std::uint32_t view) { known_[view] = 0.0; }

 private:
  static constexpr double kUnknown = -1.0;

  double divergence(std::uint32_t view) {
    const auto& [area, logs] = model_->set_sums[view];
    if (!(area > 0.0)) {
      return 1.0;  // it sees nothing, and so shares nothing
    }
    const double scale = seen_.area / area;
    scaled_.clear();
    for (const FaceArea& a : model_->set_views[view]) {
      scaled_.push_back({a.face, static_cast<float>(scale * a.area)});
    }
    return divergence_of(seen_, laid_out_,
                         {scaled_, seen_.area, scale * logs + seen_.area * log_2(scale)});
  }

  const MeasuredModel* model_;
  SummedAreas seen_;
  LaidOutAreas laid_out_;
  std::vector<double> known_;
  std::vector<FaceArea> scaled_{};
};

/// The view of the set that looks from there, if there is one.
std::optional<std::uint32_t> same_view(const MeasuredModel& model, const SightTable& sight) {
  if (sight.set_index != SightTable::kOffSet) {
    return sight.set_index;
  }
  for (const std::uint32_t near : sight.neighbours) {
    for (const std::uint32_t view : model.next_views[near]) {
      if ((model.set.directions[view] - sight.towards).norm() < kSame) {
        return view;
      }
    }
  }
  return {};
}

/// Marks the views of the set that are alike and joined to one of `seeds` by such.
std::vector<std::uint8_t> alike_views(const MeasuredModel& model, std::vector<std::uint32_t> seeds,
                                      SetDistances& distance, double limit) {
  std::vector<std::uint8_t> is_alike(model.set_views.size(), 0);
  while (!seeds.empty()) {
    const std::uint32_t view = seeds.back();
    seeds.pop_back();
    if (is_alike[view] == 0 && distance[view] <= limit) {
      is_alike[view] = 1;
      const auto next = model.next_views[view];
      seeds.insert(seeds.end(), next.begin(), next.end());
    }
  }
  return is_alike;
}

}  // namespace

double share_below(double a, double b, double c, double limit) {
  std::array<double, 3> f{a, b, c};
  std::sort(f.begin(), f.end());
  if (limit >= f[2]) {
    return 1.0;
  }
  if (limit <= f[0]) {
    return 0.0;
  }
  if (limit <= f[1]) {
    return (limit - f[0]) / (f[1] - f[0]) * ((limit - f[0]) / (f[2] - f[0]));
  }
  return 1.0 - (f[2] - limit) / (f[2] - f[0]) * ((f[2] - limit) / (f[2] - f[1]));
}

double view_likelihood(const MeasuredModel& model, const SightTable& sight) {
  const double limit = std::sqrt(kAlike);
  SetDistances distance(model, sight);
  const std::optional<std::uint32_t> own = same_view(model, sight);
  if (own) {
    distance.begin_at(*own);
  }
  const std::vector<std::uint8_t> is_alike =
      alike_views(model, own ? std::vector{*own} : sight.neighbours, distance, limit);
  const std::vector<Vec3>& directions = model.set.directions;
  const auto is_around = [&](const Triangle& t) {  // the view, which is none of the set
    return !own && std::is_permutation(t.begin(), t.end(), sight.neighbours.begin(),
                                       sight.neighbours.end());
  };
  double region = 0.0;
  for (const Triangle& t : model.set.triangles) {
    if (is_around(t)) {
      for (std::size_t c = 0; c < 3; ++c) {
        const std::uint32_t a = t[c];
        const std::uint32_t b = t[(c + 1) % 3];
        region += share_below(0.0, distance[a], distance[b], limit) *
                  solid_angle(sight.towards, directions[a], directions[b]);
      }
    } else if (is_alike[t[0]] != 0 || is_alike[t[1]] != 0 || is_alike[t[2]] != 0) {
      region += share_below(distance[t[0]], distance[t[1]], distance[t[2]], limit) *
                solid_angle(directions[t[0]], directions[t[1]], directions[t[2]]);
    }
  }
  return std::min(1.0, region / (4.0 * std::numbers::pi));
}

}  // namespace vantage
