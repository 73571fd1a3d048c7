// SPDX-License-Identifier: MIT
#include "vantage/report/evaluation.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "vantage/core/error.h"
#include "vantage/mesh/measures.h"

#include "core/random.h"
#include "mesh/curvature.h"
#include "report/agreement.h"

namespace vantage {
namespace {

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

/// The best view of `vantage view` as it is without flags, but for the map's and the camera's.
Vec3 default_view(const Model& model, const ShapeAnalysis& shape, ViewOptions options,
                  const RunContext& run) {
  options.method = "kssm";
  options.objective = Objective::People;
  options.prior = no_prior();
  options.view_set.reset();
  const FrameChoice choice = choose_frame(model, shape, options);
  return find_views(shape, choice, options, run).best.direction;
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
  const double mean = all > 0.0 ? sum / all : kUnknown;
  double squares = 0.0;
  for (std::size_t v = 0; v < values.size(); ++v) {
    squares += weights[v] * (values[v] - mean) * (values[v] - mean);
  }
  return {mean, all > 0.0 ? std::sqrt(squares / all) : kUnknown};
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
  return aa > 0.0 && bb > 0.0 ? ab / std::sqrt(aa * bb) : kUnknown;
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
          surface.mean != 0.0 ? adjusted / surface.mean : kUnknown,
          surface.deviation > 0.0 ? adjusted / surface.deviation : kUnknown};
}

}  // namespace

std::vector<ViewAgreement> evaluate_views(const RecordedModel& record, const Model& model,
                                          const ViewOptions& options,
                                          const std::vector<Measure>& measures,
                                          const RunContext& run) {
  const ShapeAnalysis shape = analyse_for(model, options, measures, run.part(0.0, 0.3));
  require_area(shape, record.name);
  const UpAxis up = options.up.value_or(default_up(model));
  const UprightFrame frame = upright_frame(up_vector(up));
  ViewMeasurer measurer(measure_subject(shape, options), measures, kMeasureSetLevel,
                        run.part(0.3, 0.5));
  const MeasureValues values = measurer.set_values(run.part(0.5, 0.7));
  std::vector<Vec3> moved;
  for (const ChosenByPerson& view : record.views) {
    if (view.moved) {
      moved.push_back(view.direction);
    }
  }
  const RunContext quiet = run.quiet();
  const MeasureValues of_people = measurer.values(moved, quiet);
  std::vector<ViewAgreement> rows = reference_rows(record, measurer.set(), frame);
  for (std::size_t m = 0; m < measures.size(); ++m) {
    if (measures[m].name == "kssm") {
      rows.push_back(agreement(std::string(kDefaultView), record,
                               default_view(model, shape, options, run.part(0.7, 0.8))));
    }
    const MeasuredView best = best_view(measurer, m, quiet);
    rows.push_back(agreement(measures[m].name, record, best.direction));
    rows.back().percentile = human_percentile(measures[m], values[m], of_people[m]);
    rows.push_back(agreement(measures[m].name + std::string(kUnderPrior), record,
                             best_under_prior(measures[m], measurer.set(), values[m], frame)));
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
  const Vec3 up = up_vector(options.up.value_or(default_up(model)));
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
    return {kUnknown, kUnknown, kUnknown};
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
