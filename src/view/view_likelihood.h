// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "vantage/view/measure.h"

/// \file
/// From how large a part of the view sphere a model looks alike, after Weinshall, Werman, "On View
/// Likelihood and Stability", IEEE PAMI 19(2), 1997. They take images of points and count all views
/// within ε of one; docs/measures.md says what stands for both here.

namespace vantage {

/// Two views are alike if the Jensen–Shannon divergence of p(Z|v) and p(Z|w), with equal weights, is
/// at most this, bits: if half of what one sees is what the other sees. [ours]
inline constexpr double kAlike = 0.5;

/// Share of the view sphere, in [0, 1], that the region around a view covers in which all views are
/// alike to it. Between views of the set the square root of the divergence, which is a metric, is
/// taken to be linear. \pre the table has the faces and the neighbours of a view that sees something,
/// the model the views of the set.
double view_likelihood(const MeasuredModel& model, const SightTable& sight);

/// The same of a view among those of the next coarser set, in a quarter of the time.
double estimated_view_likelihood(const MeasuredModel& model, const SightTable& sight);

/// The corners of the set's triangle that a direction falls in; of a direction that is one of the
/// set's, the views beside it. \param next for each view of the set the views beside it.
std::vector<std::uint32_t> views_around(const DirectionSet& set, const IndexLists& next,
                                        const Vec3& towards);

/// Share of a triangle where the linear function with these values at its corners is at most `limit`.
double share_below(double a, double b, double c, double limit);

}  // namespace vantage
