// SPDX-License-Identifier: MIT
#include <array>
#include <cmath>
#include <optional>
#include <string>

#include "io/model_builder.h"
#include "io/number_parsing.h"
#include "io/readers.h"
#include "io/text_cursor.h"

namespace vantage {
namespace {

/// Takes the next column off a line; columns are parted by blanks, commas or semicolons.
std::string_view take_column(std::string_view& line) {
  const auto parts = [](char c) { return is_blank(c) || c == ',' || c == ';'; };
  while (!line.empty() && parts(line.front())) {
    line.remove_prefix(1);
  }
  std::size_t end = 0;
  while (end < line.size() && !parts(line[end])) {
    ++end;
  }
  const std::string_view column = line.substr(0, end);
  line.remove_prefix(end);
  return column;
}

bool is_comment(std::string_view line) {
  return line.empty() || line.front() == '#' || line.substr(0, 2) == "//";
}

/// Whether a line stands above the points: a count, or names of columns.
bool is_heading(std::string_view line) {
  const std::string_view first = take_column(line);
  return !number_from(first) || take_column(line).empty();
}

}  // namespace

Model parse_point_list(std::string_view bytes, std::string_view name, ModelFormat format,
                       const RunContext& run) {
  ModelBuilder builder(format, name, run, 0);
  TextCursor cursor(without_bom(bytes));
  bool flat = false;
  for (auto text = cursor.next_line(); text; text = cursor.next_line()) {
    std::string_view line = trimmed(*text);
    if (is_comment(line) || (builder.point_count() == 0 && is_heading(line))) {
      continue;
    }
    std::array<std::string_view, 3> column;
    Vec3 point = Vec3::Zero();
    int found = 0;
    for (std::string_view token = take_column(line); !token.empty() && found < 3;
         token = take_column(line)) {
      const std::optional<double> value = number_from(token);
      if (!value || !std::isfinite(*value)) {
        builder.fail(cursor.place(), number_problem(token));
      }
      column[static_cast<std::size_t>(found)] = token;
      point[found++] = *value;
    }
    if (found < 3 && (found < 2 || (builder.point_count() > 0 && !flat))) {
      builder.fail(cursor.place(), "expected 3 coordinates, found " + std::to_string(found));
    }
    flat = flat || found == 2;
    for (int c = 0; c < found && !builder.double_precision(); ++c) {
      if (needs_double(column[static_cast<std::size_t>(c)], point[c])) {
        builder.coordinates_need_double();
      }
    }
    builder.add_point(point, cursor.place());
    builder.advance(cursor.offset(), bytes.size());
  }
  if (flat) {
    builder.note("points of two coordinates were read with z = 0");
  }
  return builder.finish();
}

}  // namespace vantage
