// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <string_view>
#include <vector>

#include "vantage/core/vec3.h"

namespace vantage {

/// Reads points or directions from CSV text: one a line, numbers with a decimal point, separated
/// by commas (blanks around them do not matter). Empty lines and lines that start with # are
/// passed over. If the first line is a header, `columns` are looked up in it and other columns
/// are ignored; without a header the first three columns count.
/// \param name shown in messages. \param columns e.g. {"dx", "dy", "dz"}.
/// \throw FormatError naming the line.
std::vector<Vec3> parse_points_csv(std::string_view bytes, std::string_view name,
                                   std::array<std::string_view, 3> columns);

}  // namespace vantage
