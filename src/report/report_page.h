// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

namespace vantage {

/// The page that viewer/ was bundled to when the library was built; empty if it was built without.
std::string_view report_page();

}  // namespace vantage
