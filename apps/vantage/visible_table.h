// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string>

#include "vantage/view/view_set.h"

namespace vantage::cli {

/// Which view sees which vertex, as a NumPy file (.npy, version 1.0) of one record a vertex:
/// `significance` as <f8, and `seen` as bytes whose bit i % 8 of byte i / 8, lowest first, says
/// whether view i sees it. \param significance |V| values.
std::string visible_table(const VisibleSets& sets, std::span<const double> significance);

}  // namespace vantage::cli
