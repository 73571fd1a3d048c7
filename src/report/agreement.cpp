// SPDX-License-Identifier: MIT
#include "report/agreement.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace vantage {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
constexpr double kNearDeg = 45.0;

/// The mean of several agreements of one method and model. \pre there are some.
ViewAgreement mean_agreement(const std::vector<ViewAgreement>& rows) {
  ViewAgreement mean{rows.front().method, rows.front().model, 0, 0, 0, 0, kNone};
  const auto share = 1.0 / static_cast<double>(rows.size());
  for (const ViewAgreement& row : rows) {
    mean.mean_deg += share * row.mean_deg;
    mean.mean_folded_deg += share * row.mean_folded_deg;
    mean.all_folded_deg += share * row.all_folded_deg;
    mean.within_45 += share * row.within_45;
  }
  return mean;
}

/// The least error that any of several views has, plain and folded, each by itself.
/// \pre somebody moved.
ViewAgreement least_error(const std::vector<ViewAgreement>& rows) {
  ViewAgreement best = rows.front();
  double plain = best.mean_deg;
  for (const ViewAgreement& row : rows) {
    plain = std::min(plain, row.mean_deg);
    best = row.mean_folded_deg < best.mean_folded_deg ? row : best;
  }
  best.mean_deg = plain;
  best.method = "best possible single view";
  return best;
}

}  // namespace

double mean_of(std::span<const double> values) {
  double sum = 0.0;
  for (const double value : values) {
    sum += value;
  }
  return values.empty() ? kNone : sum / static_cast<double>(values.size());
}

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

std::optional<ViewAgreement> another_person(const RecordedModel& record) {
  std::vector<ViewAgreement> rows;
  for (std::size_t i = 0; i < record.views.size(); ++i) {
    if (record.views[i].moved) {
      RecordedModel others = record;
      others.views.erase(others.views.begin() + static_cast<std::ptrdiff_t>(i));
      rows.push_back(agreement("another person", others, record.views[i].direction));
    }
  }
  return rows.empty() ? std::nullopt : std::optional(mean_agreement(rows));
}

std::vector<ViewAgreement> reference_rows(const RecordedModel& record, const DirectionSet& set,
                                          const UprightFrame& frame) {
  const ViewPrior prior = upright_prior();
  std::vector<ViewAgreement> every;
  std::size_t likeliest = 0;
  double highest = -1.0;
  for (std::size_t i = 0; i < set.directions.size(); ++i) {
    every.push_back(agreement("random", record, set.directions[i]));
    const double factor = prior.factor(frame, set.directions[i]);
    likeliest = factor > highest ? i : likeliest;
    highest = std::max(highest, factor);
  }
  std::vector<ViewAgreement> rows;
  if (const std::optional<ViewAgreement> person = another_person(record)) {
    rows.push_back(least_error(every));
    rows.push_back(*person);
  }
  const auto camera = [&](const char* name, double side, double up, double front) {
    const Vec3 d = (side * frame.side + up * frame.up + front * frame.front).normalized();
    rows.push_back(agreement(name, record, d));
  };
  camera("three-quarter (1, 0.6, 1)", 1.0, 0.6, 1.0);
  camera("isometric (1, 1, 1)", 1.0, 1.0, 1.0);
  camera("f3d's default (1, 0.5, 1)", 1.0, 0.5, 1.0);
  camera("straight front", 0.0, 0.0, 1.0);
  rows.push_back(agreement(std::string(kPriorAlone), record, set.directions[likeliest]));
  rows.push_back(mean_agreement(every));
  return rows;
}

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

Vec3 best_under_prior(const Measure& measure, const DirectionSet& set,
                      std::span<const double> values, const UprightFrame& frame) {
  const ViewPrior prior = upright_prior();
  double largest = 0.0;
  for (const double value : values) {
    largest = std::isfinite(value) ? std::max(largest, value) : largest;
  }
  std::size_t best = 0;
  double highest = -1.0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double score =
        measure.better == Better::More ? values[i] : std::max(0.0, largest - values[i]);
    const double objective = score * prior.factor(frame, set.directions[i]);
    if (objective > highest) {
      highest = objective;
      best = i;
    }
  }
  return set.directions[best];
}

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

}  // namespace vantage
