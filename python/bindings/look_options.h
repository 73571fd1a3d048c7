// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "options.h"

namespace vantage::python {

/// Adds the keywords of how pictures look, those of the program's `render`.
void add_look_options(std::vector<Option>& table);

}  // namespace vantage::python
