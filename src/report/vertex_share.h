// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "vantage/report/view_report.h"

namespace vantage {

/// What each vertex adds to a score that sees it: its significance, or by area that of its third of
/// the faces there over the whole area, the integral of the map wherever a face is seen whole.
std::vector<double> vertex_shares(const ShapeAnalysis& shape, Weight weight);

}  // namespace vantage
