// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

#include "vantage/report/view_report.h"

namespace vantage {

std::string_view strategy_name(SearchStrategy strategy);  ///< "rapid", …
std::string_view base_name(ViewSphereBase base);          ///< "cube", "icosahedron"
std::string_view preset_name(Preset preset);              ///< "default", "paper"
std::string_view weight_name(Weight weight);              ///< "vertex", "area"
std::string_view projection_name(Projection projection);  ///< "perspective", "orthographic"

}  // namespace vantage
