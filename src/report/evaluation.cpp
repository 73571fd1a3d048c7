// SPDX-License-Identifier: MIT
#include "vantage/report/evaluation.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "vantage/core/error.h"
#include "vantage/core/random.h"
#include "vantage/mesh/curvature.h"
#include "vantage/mesh/measures.h"

namespace vantage {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
constexpr double kNearDeg = 45.0;

double mean_of(std::span<const double> values) {
  double sum = 0.0;
  for (const double value : values) {
    sum += value;
  }
  return values.empty() ? kNone : sum / static_cast<double>(values.size());
}

/// How near one direction is to people's.
ViewAgreement agreement(const std::string& method, const RecordedModel& record,
                        const Vec3& direction) {
  std::vector<double> plain;
  std::vector<double> folded;
  std::vector<double> all;
  double near = 0.0;
  for (const ChosenByPerson& view : record.views) {
    all.push_back(folded_angle_deg(direction, view.direction, record.planes));
    if (view.moved) {
      plain.push_back(angle_deg(direction, view.direction));
      folded.push_back(all.back());
      near += folded.back() < kNearDeg ? 1.0 : 0.0;
    }
  }
  return {method,         record.name,
          mean_of(plain), mean_of(folded),
          mean_of(all),   plain.empty() ? kNone : near / static_cast<double>(plain.size()),
          kNone};
}

/// The mean of several agreements of one method and model.
ViewAgreement mean_agreement(const std::string& method, const std::vector<ViewAgreement>& rows) {
  ViewAgreement mean{method, rows.empty() ? "" : rows.front().model, 0, 0, 0, 0, kNone};
  const auto share = 1.0 / static_cast<double>(rows.size());
  for (const ViewAgreement& row : rows) {
    mean.mean_deg += share * row.mean_deg;
    mean.mean_folded_deg += share * row.mean_folded_deg;
    mean.all_folded_deg += share * row.all_folded_deg;
    mean.within_45 += share * row.within_45;
  }
  return mean;
}

/// Each person who moved against all the others.
ViewAgreement another_person(const RecordedModel& record) {
  std::vector<ViewAgreement> rows;
  for (std::size_t i = 0; i < record.views.size(); ++i) {
    if (record.views[i].moved) {
      RecordedModel others = record;
      others.views.erase(others.views.begin() + static_cast<std::ptrdiff_t>(i));
      rows.push_back(agreement("another person", others, record.views[i].direction));
    }
  }
  return mean_agreement("another person", rows);
}

/// The reference rows.
void add_references(const RecordedModel& record, const DirectionSet& set, const UprightFrame& frame,
                    std::vector<ViewAgreement>& rows) {
  const ViewPrior prior = upright_prior();
  std::vector<ViewAgreement> every;
  ViewAgreement best;
  best.mean_deg = best.mean_folded_deg = std::numeric_limits<double>::infinity();
  std::size_t likeliest = 0;
  for (std::size_t i = 0; i < set.directions.size(); ++i) {
    every.push_back(agreement("random", record, set.directions[i]));
    best.mean_deg = std::min(best.mean_deg, every.back().mean_deg);
    if (every.back().mean_folded_deg < best.mean_folded_deg) {
      const double plain = best.mean_deg;
      best = every.back();
      best.mean_deg = plain;
    }
    likeliest =
        prior.factor(frame, set.directions[i]) > prior.factor(frame, set.directions[likeliest])
            ? i
            : likeliest;
  }
  best.method = "best possible single view";
  rows.push_back(best);
  rows.push_back(another_person(record));
  const auto camera = [&](const char* name, double side, double up, double front) {
    const Vec3 d = (side * frame.side + up * frame.up + front * frame.front).normalized();
    rows.push_back(agreement(name, record, d));
  };
  camera("three-quarter (1, 0.6, 1)", 1.0, 0.6, 1.0);
  camera("isometric (1, 1, 1)", 1.0, 1.0, 1.0);
  camera("f3d's default (1, 0.5, 1)", 1.0, 0.5, 1.0);
  camera("straight front", 0.0, 0.0, 1.0);
  rows.push_back(agreement("prior alone", record, set.directions[likeliest]));
  rows.push_back(mean_agreement("random", every));
}

/// Mean share of the set's views that are no better than each view people chose.
double human_percentile(const Measure& measure, std::span<const double> of_set,
                        std::span<const double> of_people) {
  double sum = 0.0;
  for (const double value : of_people) {
    double below = 0.0;
    for (const double other : of_set) {
      below += measure.is_better(value, other) ? 1.0 : value == other ? 0.5 : 0.0;
    }
    sum += below / static_cast<double>(of_set.size());
  }
  return of_people.empty() ? kNone : sum / static_cast<double>(of_people.size());
}

/// The best view of the set under the upright prior.
Vec3 best_under_prior(const DirectionSet& set, std::span<const double> values,
                      const UprightFrame& frame) {
  const ViewPrior prior = upright_prior();
  std::size_t best = 0;
  double highest = -1.0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double objective = values[i] * prior.factor(frame, set.directions[i]);
    if (objective > highest) {
      highest = objective;
      best = i;
    }
  }
  return set.directions[best];
}

/// Mean and standard deviation over the surface.
struct Spread {
  double mean = 0.0, deviation = 0.0;
};

Spread spread_of(std::span<const double> values, std::span<const double> weights) {
  double all = 0.0;
  double sum = 0.0;
  for (std::size_t v = 0; v < values.size(); ++v) {
    all += weights[v];
    sum += weights[v] * values[v];
  }
  const double mean = all > 0.0 ? sum / all : kNone;
  double squares = 0.0;
  for (std::size_t v = 0; v < values.size(); ++v) {
    squares += weights[v] * (values[v] - mean) * (values[v] - mean);
  }
  return {mean, all > 0.0 ? std::sqrt(squares / all) : kNone};
}

double pearson(std::span<const double> a, std::span<const double> b) {
  const double mean_a = mean_of(a);
  const double mean_b = mean_of(b);
  double ab = 0.0;
  double aa = 0.0;
  double bb = 0.0;
  for (std::size_t v = 0; v < a.size(); ++v) {
    ab += (a[v] - mean_a) * (b[v] - mean_b);
    aa += (a[v] - mean_a) * (a[v] - mean_a);
    bb += (b[v] - mean_b) * (b[v] - mean_b);
  }
  return aa > 0.0 && bb > 0.0 ? ab / std::sqrt(aa * bb) : kNone;
}

/// Chance that a vertex of the twentieth of most gaze has a larger value than another one.
double roc_area(std::span<const double> map, std::span<const double> gaze) {
  constexpr double kTop = 0.05;
  std::vector<std::size_t> order(map.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return gaze[a] > gaze[b] || (gaze[a] == gaze[b] && a < b);
  });
  const auto count = static_cast<std::size_t>(std::ceil(kTop * static_cast<double>(map.size())));
  std::vector<double> rest;
  for (std::size_t k = count; k < order.size(); ++k) {
    rest.push_back(map[order[k]]);
  }
  std::sort(rest.begin(), rest.end());
  double sum = 0.0;
  for (std::size_t k = 0; k < count; ++k) {
    const auto [low, high] = std::equal_range(rest.begin(), rest.end(), map[order[k]]);
    sum += 0.5 * static_cast<double>((low - rest.begin()) + (high - rest.begin()));
  }
  return rest.empty() ? kNone
                      : sum / (static_cast<double>(count) * static_cast<double>(rest.size()));
}

GazeAgreement gaze_agreement(const std::string& map, const RecordedModel& record,
                             std::span<const double> values, std::span<const double> areas) {
  std::vector<double> looked;
  looked.reserve(areas.size());
  for (std::size_t v = 0; v < areas.size(); ++v) {
    looked.push_back(areas[v] * std::max(0.0, record.gaze[v]));
  }
  const Spread surface = spread_of(values, areas);
  const double adjusted = spread_of(values, looked).mean - surface.mean;
  return {map,
          record.name,
          pearson(values, record.gaze),
          rank_correlation(values, record.gaze),
          roc_area(values, record.gaze),
          adjusted,
          surface.mean != 0.0 ? adjusted / surface.mean : kNone,
          surface.deviation > 0.0 ? adjusted / surface.deviation : kNone};
}

}  // namespace

std::vector<ViewAgreement> evaluate_views(const RecordedModel& record, const Model& model,
                                          const ViewOptions& options,
                                          const std::vector<Measure>& measures,
                                          const RunContext& run) {
  const ShapeAnalysis shape = analyse_for(model, options, measures, run.part(0.0, 0.3));
  require_area(shape, record.name);
  const UpAxis up = options.up.value_or(default_up(model.format));
  const UprightFrame frame = upright_frame(up_vector(up));
  constexpr int kLevel = 3;
  ViewMeasurer measurer(measure_subject(shape, options), measures, kLevel, run.part(0.3, 0.8));
  const MeasureValues values = measurer.set_values(run.part(0.3, 0.8));
  std::vector<Vec3> moved;
  for (const ChosenByPerson& view : record.views) {
    if (view.moved) {
      moved.push_back(view.direction);
    }
  }
  RunContext quiet = run;
  quiet.report = nullptr;
  const MeasureValues of_people = measurer.values(moved, quiet);
  std::vector<ViewAgreement> rows;
  add_references(record, measurer.set(), frame, rows);
  for (std::size_t m = 0; m < measures.size(); ++m) {
    if (measures[m].name == "kssm") {
      rows.push_back(agreement("kssm × prior (the default of view)", record,
                               best_under_prior(measurer.set(), values[m], frame)));
    }
    const MeasuredView best = best_view(measurer, m, run.part(0.8, 1.0));
    rows.push_back(agreement(measures[m].name, record, best.direction));
    rows.back().percentile = human_percentile(measures[m], values[m], of_people[m]);
  }
  return rows;
}

std::vector<GazeAgreement> evaluate_gaze(const RecordedModel& record, const Model& model,
                                         const ViewOptions& options, const RunContext& run) {
  if (record.gaze.size() != model.mesh.positions.size()) {
    throw InvalidInput(record.name + ": has " + std::to_string(model.mesh.positions.size()) +
                       " vertices but " + std::to_string(record.gaze.size()) +
                       " values of gaze; each vertex needs one");
  }
  const ShapeAnalysis shape = analyse_shape(model, options, run.part(0.0, 0.5));
  const std::vector<double> areas = vertex_areas(model.mesh);
  std::vector<GazeAgreement> rows;
  const auto add = [&](const char* name, const std::vector<double>& of_surface) {
    rows.push_back(gaze_agreement(name, record, on_input_vertices(shape, of_surface), areas));
  };
  const Vec3 up = up_vector(options.up.value_or(default_up(model.format)));
  std::vector<double> height;
  for (const Vec3& p : shape.surface.positions) {
    height.push_back((p - shape.sphere.centre).dot(up) / shape.sphere.diameter + 0.5);
  }
  add("height", height);
  std::vector<double> bend = mean_curvatures(shape.surface);
  for (double& value : bend) {
    value = std::abs(value);
  }
  add("mean curvature, absolute", bend);
  for (const char* name : {"kssm", "mesh-saliency", "pmi-saliency"}) {
    add(name, vertex_map(shape, options, name, run.part(0.5, 1.0)));
  }
  return rows;
}

Interval bootstrap_mean(std::span<const double> values, std::uint64_t seed) {
  constexpr std::size_t kSamples = 2000;
  constexpr double kTail = 0.025;
  std::vector<double> finite;
  for (const double value : values) {
    if (std::isfinite(value)) {
      finite.push_back(value);
    }
  }
  if (finite.empty()) {
    return {kNone, kNone, kNone};
  }
  Pcg32 random(seed);
  std::vector<double> means;
  for (std::size_t s = 0; s < kSamples; ++s) {
    double sum = 0.0;
    for (std::size_t i = 0; i < finite.size(); ++i) {
      sum += finite[random.below(static_cast<std::uint32_t>(finite.size()))];
    }
    means.push_back(sum / static_cast<double>(finite.size()));
  }
  std::sort(means.begin(), means.end());
  const auto tail = static_cast<std::size_t>(kTail * kSamples);
  return {mean_of(finite), means[tail], means[kSamples - 1 - tail]};
}

}  // namespace vantage
