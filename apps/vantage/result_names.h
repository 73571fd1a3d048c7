// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

/// \file
/// Names of the files that commands write into a folder of results: what a former run left under
/// them goes when a new run takes its place.

namespace vantage::cli {

/// How every view.json of ours begins.
inline constexpr std::string_view kViewBegins = "{\n  \"vantage\": ";

/// Whether `view` and `batch` write files of this name.
bool is_view_file(std::string_view name);
/// Whether `compare` does.
bool is_compare_file(std::string_view name);
/// Whether `figures` does, for one model.
bool is_figure_file(std::string_view name);
/// Whether --levels does.
bool is_level_file(std::string_view name);

}  // namespace vantage::cli
