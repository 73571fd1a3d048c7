// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "vantage/core/image.h"
#include "vantage/pipeline/measured_shape.h"
#include "vantage/report/view_report.h"
#include "vantage/spatial/mirror_symmetry.h"

/// \file
/// Measures side by side on one model: their extreme views, and how far they agree.

namespace vantage {

/// One measure on the model.
struct ComparedMethod {
  Measure measure{};
  MeasuredViews views{};
  std::vector<double> values{};  ///< Of the set of views.
  double seconds = 0.0;  ///< Of its own search beyond the set; not in files meant to repeat.
};

/// How far two measures agree. Angles in degrees; folded: the smallest over mirror images.
struct Agreement {
  double best_deg = 0.0;
  double best_folded_deg = 0.0;
  double worst_deg = 0.0;
  double worst_folded_deg = 0.0;
  double rank_correlation = 0.0;  ///< Spearman's over the set of how good views are; NaN if flat.
};

/// Result of compare_methods().
struct Comparison {
  DirectionSet set{};                               ///< The views all values are of.
  std::vector<MirrorPlane> planes{};                ///< Of the model.
  std::vector<ComparedMethod> methods{};            ///< As asked for.
  std::vector<std::vector<Agreement>> agreement{};  ///< Of each with each; symmetric.
  double survey_seconds = 0.0;  ///< Looking at the set, for all of them at once.
};

/// Angle between two directions, degrees.
double angle_deg(const Vec3& a, const Vec3& b);

/// The smallest angle from `a` to `b` or one of its mirror images, degrees.
double folded_angle_deg(const Vec3& a, const Vec3& b, std::span<const MirrorPlane> planes);

/// Spearman's rank correlation, ties at their mean rank; NaN if one of both is flat.
/// \pre equal sizes, no NaN.
double rank_correlation(std::span<const double> a, std::span<const double> b);

/// Compares measures on a model. \pre shape is analyse_for() them. \throw InvalidInput, Cancelled
Comparison compare_methods(const ShapeAnalysis& shape, const ViewOptions& options,
                           std::vector<Measure> measures, const RunContext& run = {});

/// For each method its best view, its worst, and the wireframe of all views around the model, near
/// and cool where bad, far and warm where good, seen from a corner in front. \throw Cancelled
/// \param look of the views; white where it has no background.
Image comparison_sheet(const ShapeAnalysis& shape, const Comparison& comparison, UpAxis up,
                       const ViewOptions& options, const RunContext& run = {},
                       const PictureLook& look = {});

/// compare.json: without the seconds the same bytes for the same input.
std::string comparison_json(const Model& model, const Comparison& comparison, UpAxis up,
                            const ViewOptions& options, bool with_seconds = false);
/// compare.csv: method,better,dx,dy,dz,score,worst_dx,worst_dy,worst_dz,worst_score,evaluations.
std::string comparison_csv(const Comparison& comparison);
/// agreement.csv: one row a pair of methods.
std::string agreement_csv(const Comparison& comparison);
/// sphere.csv: dx,dy,dz and the value by each method, one row a view of the set.
std::string sphere_csv(const Comparison& comparison);
/// A page with sheet.png and all tables but timings.csv, which it refers to.
std::string comparison_html(const Model& model, const Comparison& comparison);
/// timings.csv: what,seconds. Other bytes each time.
std::string comparison_timings_csv(const Comparison& comparison);

}  // namespace vantage
