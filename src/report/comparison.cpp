// SPDX-License-Identifier: MIT
#include "vantage/report/comparison.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

#include "core/spearman.h"
#include "view/sphere_angles.h"

namespace vantage {
namespace {

using Clock = std::chrono::steady_clock;

// Mirror images nearer to each other than this are one. [ours]
constexpr double kApartRad = 1e-6;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

Agreement agreement_of(const ComparedMethod& a, const ComparedMethod& b,
                       std::span<const MirrorPlane> planes) {
  Agreement agreement;
  agreement.best_deg = angle_deg(a.views.best.direction, b.views.best.direction);
  agreement.best_folded_deg =
      folded_angle_deg(a.views.best.direction, b.views.best.direction, planes);
  agreement.worst_deg = angle_deg(a.views.worst.direction, b.views.worst.direction);
  agreement.worst_folded_deg =
      folded_angle_deg(a.views.worst.direction, b.views.worst.direction, planes);
  agreement.rank_correlation = rank_correlation(a.values, b.values);
  if (a.measure.better != b.measure.better) {
    agreement.rank_correlation = -agreement.rank_correlation;
  }
  return agreement;
}

}  // namespace

double angle_deg(const Vec3& a, const Vec3& b) {
  return angle_between(a, b) / kRadPerDeg;
}

double folded_angle_deg(const Vec3& a, const Vec3& b, std::span<const MirrorPlane> planes) {
  double least = angle_deg(a, b);
  for (const Vec3& image : mirror_images(b, planes, kApartRad)) {
    least = std::min(least, angle_deg(a, image));
  }
  return least;
}

double rank_correlation(std::span<const double> a, std::span<const double> b) {
  return spearman(a, b);
}

Comparison compare_methods(const ShapeAnalysis& shape, const ViewOptions& options,
                           std::vector<Measure> measures, const RunContext& run) {
  const auto start = Clock::now();
  ViewMeasurer measurer(measure_subject(shape, options), std::move(measures), kMeasureSetLevel,
                        run.part(0.0, 0.3));
  const MeasureValues& values = measurer.set_values(run.part(0.3, 0.6));
  Comparison comparison;
  comparison.set = measurer.set();
  comparison.planes = mirror_planes(shape.surface);
  comparison.survey_seconds = seconds_since(start);
  const RunContext searching = run.part(0.6, 1.0);
  for (std::size_t m = 0; m < measurer.measures().size(); ++m) {
    const auto share_before = [&](std::size_t done) {
      return static_cast<double>(done) / static_cast<double>(measurer.measures().size());
    };
    searching.advance("views", share_before(m));
    const auto begun = Clock::now();
    comparison.methods.push_back(
        {measurer.measures()[m],
         extreme_views(measurer, m, options.search,
                       searching.part(share_before(m), share_before(m + 1))),
         values[m]});
    comparison.methods.back().seconds = seconds_since(begun);
  }
  searching.advance("views", 1.0);
  for (const ComparedMethod& a : comparison.methods) {
    auto& row = comparison.agreement.emplace_back();
    for (const ComparedMethod& b : comparison.methods) {
      row.push_back(agreement_of(a, b, comparison.planes));
    }
  }
  return comparison;
}

}  // namespace vantage
