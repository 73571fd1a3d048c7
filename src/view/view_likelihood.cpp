// SPDX-License-Identifier: MIT
#include "view/view_likelihood.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <span>
#include <vector>

#include <Eigen/Geometry>

#include "core/shannon.h"
#include "view/shared_logs.h"

namespace vantage {
namespace {

/// A view nearer than this to one of the set is that one.
constexpr double kSame = 1e-9;

/// A bound of a distance must be below the limit by this: divergences of stored areas are off by 1e-8,
/// the root of one next to 0 by 1e-4, and a bound adds up a few.
constexpr double kDistanceError = 1e-3;

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
    const SightTable& other = model_->set_sights[view];
    if (!(other.projected_area > 0.0)) {
      return 1.0;  // it sees nothing, and so shares nothing
    }
    const double scale = seen_.area / other.projected_area;
    const double logs = scale * other.area_logs + seen_.area * log_2(scale);
    return divergence_of(seen_, laid_out_, {model_->set_views[view], seen_.area, logs, scale});
  }

  const MeasuredModel* model_;
  SummedAreas seen_;
  LaidOutAreas laid_out_;
  std::vector<double> known_;
};

/// Views that one is compared with: those of a set.
struct Compared {
  const DirectionSet& set;
  const IndexLists& next;                 // views beside each
  std::span<const double> divergences{};  // of these, weighted by areas; empty if not known
};

/// A bound of the distance of two views from their divergence weighted by areas. As a function of the
/// weight w of one of them divergences are concave, and 0 at 0 and 1: at ½ it is at most
/// ½ / min(w, 1 − w) times that at w.
double distance_at_most(double divergence, double area, double other) {
  const double lesser = std::min(area, other);
  return lesser > 0.0 ? std::sqrt(divergence * 0.5 * (area + other) / lesser) : 1.0;
}

/// The view of the set that looks from there, if there is one.
std::optional<std::uint32_t> same_view(const Compared& to, const Vec3& towards) {
  for (std::uint32_t view = 0; view < to.set.directions.size(); ++view) {
    if ((to.set.directions[view] - towards).norm() < kSame) {
      return view;
    }
  }
  return {};
}

/// Marks the views of the set that are alike and joined to one of `seeds` by such. What is near enough
/// to one that is near needs no distance of its own: distances are a metric.
std::vector<std::uint8_t> alike_views(const Compared& to, std::span<const SightTable> sights,
                                      std::vector<std::uint32_t> seeds, SetDistances& distance,
                                      double limit) {
  const std::size_t count = to.set.directions.size();
  std::vector<std::uint8_t> is_alike(count, 0);
  std::vector<double> at_most(count, std::numeric_limits<double>::infinity());
  for (std::size_t i = 0; i < seeds.size(); ++i) {  // grows
    const std::uint32_t view = seeds[i];
    if (is_alike[view] != 0) {
      continue;
    }
    if (!(at_most[view] <= limit - kDistanceError)) {
      at_most[view] = distance[view];
    }
    if (at_most[view] <= limit) {
      is_alike[view] = 1;
      for (std::uint32_t k = to.next.offsets[view]; k < to.next.offsets[view + 1]; ++k) {
        const std::uint32_t other = to.next.values[k];
        seeds.push_back(other);
        if (!to.divergences.empty()) {
          const double step = distance_at_most(to.divergences[k], sights[view].projected_area,
                                               sights[other].projected_area);
          at_most[other] = std::min(at_most[other], at_most[view] + step);
        }
      }
    }
  }
  return is_alike;
}

double likelihood_among(const Compared& to, const MeasuredModel& model, const SightTable& sight) {
  const double limit = std::sqrt(kAlike);
  SetDistances distance(model, sight);
  const std::optional<std::uint32_t> own = same_view(to, sight.towards);
  if (own) {
    distance.begin_at(*own);
  }
  const std::vector<std::uint32_t> around =
      own ? std::vector{*own} : views_around(to.set, to.next, sight.towards);
  const std::vector<std::uint8_t> is_alike =
      alike_views(to, model.set_sights, around, distance, limit);
  const std::vector<Vec3>& directions = to.set.directions;
  const auto is_around = [&](const Triangle& t) {  // the view, which is none of the set
    return !own && std::is_permutation(t.begin(), t.end(), around.begin(), around.end());
  };
  double region = 0.0;
  for (const Triangle& t : to.set.triangles) {
    if (is_around(t)) {
      for (std::size_t c = 0; c < 3; ++c) {
        const std::uint32_t a = t[c];
        const std::uint32_t b = t[(c + 1) % 3];
        region += share_below(0.0, distance[a], distance[b], limit) *
                  solid_angle(sight.towards, directions[a], directions[b]);
      }
    } else if (is_alike[t[0]] != 0 && is_alike[t[1]] != 0 && is_alike[t[2]] != 0) {
      region += solid_angle(directions[t[0]], directions[t[1]], directions[t[2]]);
    } else if (is_alike[t[0]] != 0 || is_alike[t[1]] != 0 || is_alike[t[2]] != 0) {
      region += share_below(distance[t[0]], distance[t[1]], distance[t[2]], limit) *
                solid_angle(directions[t[0]], directions[t[1]], directions[t[2]]);
    }
  }
  return std::min(1.0, region / (4.0 * std::numbers::pi));
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
  return likelihood_among({model.set, model.next_views, model.divergences}, model, sight);
}

double estimated_view_likelihood(const MeasuredModel& model, const SightTable& sight) {
  return likelihood_among({model.coarse_set, model.next_coarse_views}, model, sight);
}

std::vector<std::uint32_t> views_around(const DirectionSet& set, const IndexLists& next,
                                        const Vec3& towards) {
  if (const std::optional<std::uint32_t> own = same_view({set, next}, towards)) {
    const auto row = next[*own];
    return {row.begin(), row.end()};
  }
  const Triangle* best = nullptr;
  double inside = -std::numeric_limits<double>::infinity();
  for (const Triangle& t : set.triangles) {
    const Vec3 &a = set.directions[t[0]], &b = set.directions[t[1]], &c = set.directions[t[2]];
    const double least =
        std::min({towards.dot(a.cross(b)), towards.dot(b.cross(c)), towards.dot(c.cross(a))});
    if (least > inside) {
      inside = least;
      best = &t;
    }
  }
  return best == nullptr ? std::vector<std::uint32_t>{}
                         : std::vector<std::uint32_t>(best->begin(), best->end());
}

}  // namespace vantage
