// SPDX-License-Identifier: MIT
#pragma once

#include <utility>

#include "vantage/pipeline/view_options.h"

namespace vantage::test {

/// The options, without refining coarse parts before they are contracted, which takes longer than all else.
inline ViewOptions unrefined(ViewOptions options = {}) {
  options.contraction.method = ContractionMethod::Exact;
  return options;
}

}  // namespace vantage::test
