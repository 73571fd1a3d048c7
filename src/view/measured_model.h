// SPDX-License-Identifier: MIT
#pragma once

#include "vantage/core/run_context.h"
#include "vantage/view/measure.h"

namespace vantage {

/// What measures with these needs know of a model before any view of it is looked at.
/// \param level of the set of views, 0–6.
/// \throw InvalidInput if the surface has no area, or the subject lacks what is needed. \throw Cancelled
MeasuredModel measured_model(const MeasureSubject& subject, int level, const MeasureNeeds& needs,
                             const RunContext& run);

}  // namespace vantage
