// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "vantage/pipeline/shape_analysis.h"

#include "session.h"

namespace vantage::cli {

/// Says what a user may want to know of a good result, each in a line to standard error.
void say_notes(Session& session, const std::vector<std::string>& notes);

/// Says why a result should not be trusted, likewise.
void say_warnings(Session& session, const std::vector<std::string>& warnings);

/// What a user may want to know of an analysis. Steps of the contraction that were not taken as defined are no news as
/// long as nothing is in doubt: one line for all, each of them only with `-v`.
void say_notes(Session& session, const ShapeAnalysis& shape);

}  // namespace vantage::cli
