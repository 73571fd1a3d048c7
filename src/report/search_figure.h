// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "vantage/view/search.h"

#include "report/line_drawing.h"

namespace vantage {

/// Figure 4: the paper's rapid search on the view sphere, from its trace. A panel a level, of
/// the first five: the triangulation, the directions scored so far in the colours of their
/// scores, and the way from the first choice on; last, enlarged, where the rings ended.
/// \param trace of a rapid search from `base`, not empty. \param total what scores are shares of.
/// \param size width of a panel, px.
LineDrawing search_figure(const std::vector<SearchStep>& trace, ViewSphereBase base, Goal goal,
                          double total, int size);

}  // namespace vantage
