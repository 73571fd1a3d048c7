// SPDX-License-Identifier: MIT
#pragma once

#include "vantage/pipeline/option_table.h"

#include "core/json_text.h"

namespace vantage {

/// Every option of a view under its name, as view.json has them.
OrderedJson option_echo(const ViewOptions& options);

}  // namespace vantage
