// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "vantage/pipeline/find_views.h"
#include "vantage/view/measure.h"

/// \file
/// Measures of a view, applied to an analysed model.

namespace vantage {

/// Analyses the model as far as the measures need it: significance and skeleton cost most.
/// \throw InvalidInput, Cancelled
ShapeAnalysis analyse_for(const Model& model, const ViewOptions& options,
                          std::span<const Measure> measures, const RunContext& run = {});

/// \throw InvalidInput that names the model if its surface has no area: views of it are all blind.
void require_area(const ShapeAnalysis& shape, const std::string& name);

/// The shape as measures take it; refers to it. Without a map or skeleton these stay empty.
MeasureSubject measure_subject(const ShapeAnalysis& shape, const ViewOptions& options);

/// A map of one number a vertex of the surface: kssm, mesh-saliency or pmi-saliency.
/// \pre the map is there, if it is kssm. \throw InvalidInput for another name. \throw Cancelled
std::vector<double> vertex_map(const ShapeAnalysis& shape, const ViewOptions& options,
                               std::string_view name, const RunContext& run = {});

/// Whether the method sums a map over the vertices seen, so that it has a total and an estimate.
bool sums_a_map(std::string_view method);

/// One extreme view of a measure.
struct MeasuredView {
  Vec3 direction = Vec3::UnitZ();  ///< Unit, from the centre to the eye.
  double value = 0.0;              ///< As the measure gave it.
};

/// Best and worst view by one measure.
struct MeasuredViews {
  MeasuredView best{};
  MeasuredView worst{};
  std::size_t evaluations = 0;  ///< Views scored for them, those of the set among them.
};

/// Best and worst view by one measure. \param m index into measurer.measures().
/// \throw InvalidInput if there is no such measure, or a value is no number, and as require_gradient() for
/// a search along the gradient. \throw Cancelled
MeasuredViews extreme_views(ViewMeasurer& measurer, std::size_t m,
                            const SearchOptions& options = {}, const RunContext& run = {});

/// The best of these alone, for half the work.
MeasuredView best_view(ViewMeasurer& measurer, std::size_t m, const RunContext& run = {});

/// \throw InvalidInput for a measure that counts things: it has no gradient.
void require_gradient(const Measure& measure);

/// find_views() for options.method among the measures that sum no map: `score` is the measure's
/// value, `total` and `score_fraction` are NaN. The objective takes as score the value or, where less
/// is better, what is left of it to the largest of the set. \throw InvalidInput, Cancelled
ViewReport find_views_by_measure(const ShapeAnalysis& shape, const FrameChoice& choice,
                                 const ViewOptions& options, const RunContext& run = {});

}  // namespace vantage
