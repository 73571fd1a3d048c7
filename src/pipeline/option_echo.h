// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json.hpp>

#include "vantage/pipeline/option_table.h"

namespace vantage {

/// Every option of a view under its name, as view.json has them.
nlohmann::ordered_json option_echo(const ViewOptions& options);

}  // namespace vantage
