// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <string>

#include "vantage/core/error.h"
#include "vantage/io/model.h"

#include "io/number_parsing.h"
#include "io/text_cursor.h"

namespace vantage {
namespace {

/// The first comma outside of quotes, or npos.
std::size_t next_comma(std::string_view line) {
  bool quoted = false;
  const auto* const found = std::find_if(line.begin(), line.end(), [&](char c) {
    quoted ^= c == '"';
    return c == ',' && !quoted;
  });
  return found == line.end() ? std::string_view::npos
                             : static_cast<std::size_t>(found - line.begin());
}

std::vector<std::string_view> split(std::string_view line) {
  std::vector<std::string_view> fields;
  while (true) {
    const std::size_t comma = next_comma(line);
    std::string_view field = trimmed(line.substr(0, comma));
    if (field.size() >= 2 && field.front() == '"' && field.back() == '"') {
      field = field.substr(1, field.size() - 2);
    }
    fields.push_back(field);
    if (comma == std::string_view::npos) {
      return fields;
    }
    line.remove_prefix(comma + 1);
  }
}

/// \param take is given the points, and where each is.
void parse_rows(std::string_view bytes, std::string_view name,
                std::array<std::string_view, 3> columns,
                const std::function<void(const Vec3&, const Place&)>& take) {
  std::array<std::size_t, 3> places = {0, 1, 2};
  TextCursor cursor(without_bom(bytes));
  const auto fail = [&](const std::string& problem) {
    throw FormatError(name, cursor.place().text(), problem);
  };
  bool is_first = true;
  while (std::optional<std::string_view> line = cursor.next_line()) {
    const std::string_view content = trimmed(*line);
    if (content.empty() || content.front() == '#') {
      continue;
    }
    const std::vector<std::string_view> fields = split(content);
    const bool is_header = is_first && std::none_of(fields.begin(), fields.end(), [](auto field) {
                             return number_from(field).has_value();
                           });
    is_first = false;
    Vec3 point = Vec3::Zero();
    for (std::size_t c = 0; c < 3; ++c) {
      if (is_header) {
        const auto found = std::find(fields.begin(), fields.end(), columns[c]);
        if (found == fields.end()) {
          fail("the header has no column " + std::string(columns[c]) + "; expected " +
               std::string(columns[0]) + "," + std::string(columns[1]) + "," +
               std::string(columns[2]) + ", or three numbers a line, with commas between");
        }
        places[c] = static_cast<std::size_t>(found - fields.begin());
        continue;
      }
      if (places[c] >= fields.size()) {
        fail("expected a value for " + std::string(columns[c]) + ", found only " +
             std::to_string(fields.size()) + " columns");
      }
      const std::optional<double> value = number_from(fields[places[c]]);
      if (!value || !std::isfinite(*value)) {
        fail("column " + std::string(columns[c]) + ": " + number_problem(fields[places[c]]));
      }
      point[static_cast<Eigen::Index>(c)] = *value;
    }
    if (!is_header) {
      take(point, cursor.place());
    }
  }
}

}  // namespace

std::vector<Vec3> parse_points_csv(std::string_view bytes, std::string_view name,
                                   std::array<std::string_view, 3> columns) {
  std::vector<Vec3> points;
  parse_rows(bytes, name, columns,
             [&](const Vec3& point, const Place& /*place*/) { points.push_back(point); });
  return points;
}

std::vector<Vec3> parse_directions_csv(std::string_view bytes, std::string_view name,
                                       std::array<std::string_view, 3> columns) {
  std::vector<Vec3> directions;
  parse_rows(bytes, name, columns, [&](const Vec3& point, const Place& place) {
    const std::optional<Vec3> unit = unit_vector(point);
    if (!unit) {
      throw FormatError(name, place.text(),
                        "a direction must be neither zero nor longer than a number can be");
    }
    directions.push_back(*unit);
  });
  return directions;
}

}  // namespace vantage
