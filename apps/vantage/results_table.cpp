// SPDX-License-Identifier: MIT
#include "results_table.h"

#include <algorithm>
#include <array>
#include <charconv>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "vantage/io/write.h"

namespace vantage::cli {
namespace {

using Json = nlohmann::ordered_json;

bool is_column(const std::string& name) {
  const auto in = [&](const std::vector<std::string>& columns) {
    return std::find(columns.begin(), columns.end(), name) != columns.end();
  };
  return in(batch::result_columns()) || in(batch::timing_columns());
}

/// Columns of text come first in the list of columns, up to and with `format`.
bool holds_text(const std::string& name) {
  const auto& columns = batch::result_columns();
  const auto last_text = std::find(columns.begin(), columns.end(), "format");
  return std::find(columns.begin(), last_text + 1, name) != last_text + 1;
}

void require_column(const std::string& name, const std::string& flag) {
  if (!is_column(name)) {
    throw CLI::ValidationError(flag, "'" + name + "' is none of " +
                                         joined(batch::result_columns()) + ", " +
                                         joined(batch::timing_columns()));
  }
}

}  // namespace

Condition parse_condition(const std::string& text) {
  // Longer signs first: "<=" is not "<" and a value that begins with "=".
  constexpr std::array<std::pair<const char*, const char*>, 7> kSigns{{{"!=", " <> ?"},
                                                                       {"<=", " <= ?"},
                                                                       {">=", " >= ?"},
                                                                       {"=", " = ?"},
                                                                       {"<", " < ?"},
                                                                       {">", " > ?"},
                                                                       {"~", ""}}};
  const std::size_t at = text.find_first_of("!<>=~");
  for (const auto& [sign, sql] : kSigns) {
    if (at == std::string::npos || text.compare(at, std::string_view(sign).size(), sign) != 0) {
      continue;
    }
    Condition condition{.column = text.substr(0, at),
                        .value = text.substr(at + std::string_view(sign).size())};
    require_column(condition.column, "--where");
    condition.comparison = *sql == '\0' ? "instr(lower(" + condition.column + "), lower(?)) > 0"
                                        : condition.column + sql;
    double number = 0.0;
    const char* const end = condition.value.data() + condition.value.size();
    const auto parsed = std::from_chars(condition.value.data(), end, number);
    condition.is_number =
        !holds_text(condition.column) && parsed.ec == std::errc{} && parsed.ptr == end;
    return condition;
  }
  throw CLI::ValidationError("--where",
                             "expected a column, one of = != < <= > >= ~ (contains) and "
                             "a value, like best_fraction<0.4, found '" +
                                 text + "'");
}

std::vector<std::string> parse_columns(const std::string& text) {
  std::vector<std::string> columns(1);
  for (const char c : text) {
    if (c == ',') {
      columns.emplace_back();
    } else {
      columns.back() += c;
    }
  }
  for (const std::string& column : columns) {
    require_column(column, "--columns");
  }
  return columns;
}

batch::Statement select_rows(batch::ResultsStore& store, const std::vector<std::string>& columns,
                             const std::vector<Condition>& conditions, const std::string& sort) {
  std::string where;
  for (const Condition& condition : conditions) {
    where += (where.empty() ? "" : " AND ") + condition.comparison;
  }
  std::string order;
  if (!sort.empty()) {
    const bool down = sort.front() == '-';
    const std::string column = sort.substr(down ? 1 : 0);
    require_column(column, "--sort");
    order = column + (down ? " DESC NULLS LAST" : " NULLS LAST");
  }
  batch::Statement rows = store.select(joined(columns), where, order);
  int index = 0;
  for (const Condition& condition : conditions) {
    if (condition.is_number) {
      double number = 0.0;
      std::from_chars(condition.value.data(), condition.value.data() + condition.value.size(),
                      number);
      rows.bind(++index, number);
    } else {
      rows.bind(++index, condition.value);
    }
  }
  return rows;
}

std::string cell_text(const batch::Statement& row, int column) {
  return row.is_real(column) ? number_text(row.number(column)) : row.text(column);
}

std::string csv_text(const batch::Statement& row, int column) {
  const std::string text = cell_text(row, column);
  const bool is_number = row.is_real(column) || row.is_integer(column);
  const bool computes =
      !text.empty() && std::string_view("=+-@\t\r").find(text.front()) != std::string_view::npos;
  return computes && !is_number ? "'" + text : text;
}

Json cell_json(const batch::Statement& row, int column, const std::string& name) {
  if (row.is_null(column)) {
    return nullptr;
  }
  if (name == "closed") {
    return row.integer(column) != 0;
  }
  return row.is_real(column)      ? Json(row.number(column))
         : row.is_integer(column) ? Json(row.integer(column))
                                  : Json(row.text(column));
}

std::string csv_line(const std::vector<std::string>& cells) {
  std::string line;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    line += i == 0 ? "" : ",";
    if (cells[i].find_first_of(",\"\r\n") == std::string::npos) {
      line += cells[i];
      continue;
    }
    line += '"';
    for (const char c : cells[i]) {
      line += c == '"' ? std::string("\"\"") : std::string(1, c);
    }
    line += '"';
  }
  return line + "\n";
}

std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) {
    text += (text.empty() ? "" : ", ") + word;
  }
  return text;
}

}  // namespace vantage::cli
