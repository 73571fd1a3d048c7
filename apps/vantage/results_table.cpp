// SPDX-License-Identifier: MIT
#include "results_table.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <tuple>
#include <utility>

#include <CLI/CLI.hpp>

#include "vantage/io/write.h"

#include "batch/json_text.h"

namespace vantage::cli {
namespace {

using batch::Json;

// Longer signs first: "<=" is not "<" and a value that begins with "=".
constexpr std::array<std::pair<const char*, const char*>, 7> kSigns{{{"!=", " <> ?"},
                                                                     {"<=", " <= ?"},
                                                                     {">=", " >= ?"},
                                                                     {"=", " = ?"},
                                                                     {"<", " < ?"},
                                                                     {">", " > ?"},
                                                                     {"~", ""}}};
constexpr const char* kSignLetters = "!<>=~";

/// The texts of an answer's doubts, of queries only: exports have view.json.
constexpr const char* kDoubt = "doubt";
constexpr const char* kDoubtSql =
    "(SELECT group_concat(value, '; ') FROM json_each(result, '$.doubts'))";

std::string sql_of(const std::string& column) {
  const bool is_of_result = column == "up" || column == "front";  // that differences are told of
  return column == kDoubt ? kDoubtSql
         : is_of_result   ? "json_extract(result, '$." + column + "')"
                          : column;
}

bool is_column(const std::string& name) {
  const auto in = [&](const std::vector<std::string>& columns) {
    return std::find(columns.begin(), columns.end(), name) != columns.end();
  };
  return in(batch::result_columns()) || in(batch::timing_columns()) || name == kDoubt;
}

/// Columns of text come first in the list of columns, up to and with `format`; cameras for web pages
/// follow.
bool holds_text(const std::string& name) {
  const auto& columns = batch::result_columns();
  const auto last_text = std::find(columns.begin(), columns.end(), "format");
  return std::find(columns.begin(), last_text + 1, name) != last_text + 1 ||
         name.starts_with("best_camera_") || name == "best_field_of_view" || name == kDoubt;
}

std::optional<double> number_of(const std::string& text) {
  double number = 0.0;
  const char* const end = text.data() + text.size();
  const auto parsed = std::from_chars(text.data(), end, number);
  return parsed.ec == std::errc{} && parsed.ptr == end && std::isfinite(number)
             ? std::optional(number)
             : std::nullopt;
}

/// Refuses signs that are none of these, as ">>" is; what is to be contained may begin with any.
void require_sign(const std::string& text, std::size_t at) {
  const std::string signs = text.substr(at, text.find_first_not_of(kSignLetters, at) - at);
  const bool is_known =
      signs.front() == '~' || std::any_of(kSigns.begin(), kSigns.end(),
                                          [&](const auto& sign) { return signs == sign.first; });
  if (!is_known) {
    throw CLI::ValidationError("--where",
                               "'" + signs + "' in '" + text +
                                   "' is none of = != < <= > >= ~ (contains); a value "
                                   "that begins with such a sign needs a blank before it");
  }
}

/// What equal models are asked for by, as the status of all of these is done.
void refuse_duplicates(const Condition& condition) {
  if (condition.column == "status" && condition.value.starts_with("duplicate")) {
    throw CLI::ValidationError("--where",
                               "status is done or failed; models with the content of another are "
                               "found by --status duplicate, or --where 'duplicate_of!='");
  }
}

/// What a column of numbers is compared with. \throw CLI::ValidationError
double number_for(const Condition& condition) {
  const std::string& value = condition.value;
  if (condition.column == "closed" && (value == "true" || value == "false")) {
    return value == "true" ? 1.0 : 0.0;
  }
  const std::optional<double> number = number_of(value);
  if (!number) {
    throw CLI::ValidationError("--where", "'" + value + "' is no number, which " +
                                              condition.column +
                                              " is compared with; write one like 0.4" +
                                              (condition.column == "closed" ? " or true" : ""));
  }
  return *number;
}

void require_column(const std::string& name, const std::string& flag) {
  if (!is_column(name)) {
    throw CLI::ValidationError(flag, "'" + name + "' is none of " +
                                         joined(batch::result_columns()) + ", " +
                                         joined(batch::timing_columns()) + ", " + kDoubt);
  }
}

std::string trimmed_blanks(const std::string& text) {
  const std::size_t begin = text.find_first_not_of(' ');
  return begin == std::string::npos ? ""
                                    : text.substr(begin, text.find_last_not_of(' ') + 1 - begin);
}

}  // namespace

Condition parse_condition(const std::string& text) {
  const std::size_t at = text.find_first_of(kSignLetters);
  if (at != std::string::npos) {
    require_sign(text, at);
  }
  for (const auto& [sign, sql] : kSigns) {
    if (at == std::string::npos || text.compare(at, std::string_view(sign).size(), sign) != 0) {
      continue;
    }
    Condition condition{.column = trimmed_blanks(text.substr(0, at)),
                        .value = trimmed_blanks(text.substr(at + std::string_view(sign).size()))};
    require_column(condition.column, "--where");
    refuse_duplicates(condition);
    const std::string column = sql_of(condition.column);
    condition.comparison =
        *sql == '\0' ? "instr(lower(" + column + "), lower(?)) > 0" : column + sql;
    if (*sql != '\0' && !holds_text(condition.column)) {
      condition.number = number_for(condition);
    }
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

Order parse_order(const std::string& text) {
  Order order;
  order.is_down = text.starts_with('-');
  order.column = text.substr(order.is_down ? 1 : 0);
  if (!text.empty()) {
    require_column(order.column, "--sort");
  }
  return order;
}

RankedRow::RankedRow(const batch::Statement& row, int column) {
  if (row.is_real(column) || row.is_integer(column)) {
    kind_ = 0;
    number_ = row.number(column);
  } else if (!row.is_null(column)) {
    kind_ = 1;
    text_ = row.text(column);
  }
}

bool RankedRow::comes_before(const RankedRow& other, bool is_down) const {
  if (kind_ == 2 || other.kind_ == 2) {  // no value is last in both directions
    return kind_ < other.kind_;
  }
  const auto [first, second] = is_down ? std::pair(&other, this) : std::pair(this, &other);
  return std::tie(first->kind_, first->number_, first->text_) <
         std::tie(second->kind_, second->number_, second->text_);
}

batch::Statement select_rows(batch::ResultsStore& store, const std::vector<std::string>& columns,
                             const std::vector<Condition>& conditions, const Order& sort) {
  std::string where;
  for (const Condition& condition : conditions) {
    where += (where.empty() ? "" : " AND ") + condition.comparison;
  }
  const std::string order =
      sort.column.empty()
          ? ""
          : sql_of(sort.column) + (sort.is_down ? " DESC NULLS LAST" : " NULLS LAST");
  std::vector<std::string> selected;
  std::transform(columns.begin(), columns.end(), std::back_inserter(selected), sql_of);
  batch::Statement rows = store.select(joined(selected), where, order);
  int index = 0;
  for (const Condition& condition : conditions) {
    if (condition.number) {
      rows.bind(++index, *condition.number);
    } else {
      rows.bind(++index, condition.value);
    }
  }
  return rows;
}

std::string cell_text(const batch::Statement& row, int column) {
  return row.is_real(column) ? number_text(row.number(column)) : row.text(column);
}

std::string csv_text(const batch::Statement& row, int column, const std::string& name) {
  const std::string text = cell_text(row, column);
  const bool is_number = row.is_real(column) || row.is_integer(column) ||
                         (name.starts_with("best_camera_") &&
                          text.find_first_not_of("-.0123456789 degm") == std::string::npos);
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
