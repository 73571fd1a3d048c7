// SPDX-License-Identifier: MIT
#include "results_diff.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <unordered_set>

#include "vantage/core/error.h"

#include "batch/json_text.h"
#include "results_table.h"
#include "terminal.h"

namespace vantage::cli {
namespace {

const std::vector<std::string>& compared_columns() {
  static const std::vector<std::string> kColumns = [] {
    std::vector<std::string> columns;
    const std::set<std::string> others{"name",   "duplicate_of", "options", "version",
                                       "folder", "format",       "doubts"};
    for (const std::string& column : batch::result_columns()) {
      if (!others.contains(column)) {
        columns.push_back(column);
      }
    }
    columns.insert(columns.end(), {"up", "front", "doubt"});
    return columns;
  }();
  return kColumns;
}

bool is_near(double x, double y, double tolerance) {
  return std::abs(x - y) <= tolerance * std::max(std::abs(x), std::abs(y));
}

/// Takes the number off the front of a text, if one is there.
std::optional<double> take_number(std::string_view& text) {
  double number = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc{} || !std::isfinite(number)) {  // of "information"
    return std::nullopt;
  }
  text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  return number;
}

/// Whether texts as `12deg 75deg 3.1m` are alike but for their numbers.
bool is_alike(std::string_view a, std::string_view b, double tolerance) {
  while (!a.empty() && !b.empty()) {
    const std::optional<double> x = take_number(a);
    const std::optional<double> y = take_number(b);
    if (x && y ? !is_near(*x, *y, tolerance) : x || y || a.front() != b.front()) {
      return false;
    }
    a.remove_prefix(x ? 0 : 1);
    b.remove_prefix(y ? 0 : 1);
  }
  return a.empty() && b.empty();
}

bool is_alike(const batch::Statement& a, const batch::Statement& b, int column, double tolerance) {
  const std::string& name = compared_columns()[static_cast<std::size_t>(column)];
  if (a.is_real(column) && b.is_real(column)) {
    const double x = a.number(column);
    const double y = b.number(column);
    const bool is_of_unit_vector = name.starts_with("best_d") || name.starts_with("worst_d");
    return is_of_unit_vector ? std::abs(x - y) <= tolerance : is_near(x, y, tolerance);
  }
  const std::string x = cell_text(a, column);
  const std::string y = cell_text(b, column);
  return name.starts_with("best_") || name == "doubt" ? is_alike(x, y, tolerance) : x == y;
}

Difference compared(const batch::Statement& a, const batch::Statement& b, double tolerance) {
  Difference difference{.key = a.text(0), .kind = "changed"};
  const auto& columns = compared_columns();
  for (std::size_t i = 1; i < columns.size(); ++i) {
    const int column = static_cast<int>(i);
    if (!is_alike(a, b, column, tolerance)) {
      difference.changes.push_back({columns[i], cell_text(a, column), cell_text(b, column)});
    }
  }
  return difference;
}

}  // namespace

DiffCounts diff_results(batch::ResultsStore& a, batch::ResultsStore& b, double tolerance,
                        const RunContext& run, const std::function<void(const Difference&)>& take) {
  batch::Statement left = select_rows(a, compared_columns(), {}, {});
  batch::Statement right = select_rows(b, compared_columns(), {}, {});
  DiffCounts counts;
  bool in_a = left.step();
  bool in_b = right.step();
  while (in_a || in_b) {
    run.check();
    const int order = !in_a ? 1 : !in_b ? -1 : left.text(0).compare(right.text(0));
    if (order < 0) {
      ++counts.removed;
      take({.key = left.text(0), .kind = "removed"});
    } else if (order > 0) {
      ++counts.added;
      take({.key = right.text(0), .kind = "added"});
    } else {
      const Difference difference = compared(left, right, tolerance);
      ++(difference.changes.empty() ? counts.equal : counts.changed);
      if (!difference.changes.empty()) {
        take(difference);
      }
    }
    in_a = order <= 0 ? left.step() : in_a;
    in_b = order >= 0 ? right.step() : in_b;
  }
  return counts;
}

bool share_content(batch::ResultsStore& a, batch::ResultsStore& b, const RunContext& run) {
  std::unordered_set<std::string> contents;
  batch::Statement left = a.select("content", "content <> ''", "");
  while (left.step()) {
    run.check();
    contents.insert(left.text(0));
  }
  batch::Statement right = b.select("content", "content <> ''", "");
  while (right.step()) {
    run.check();
    if (contents.contains(right.text(0))) {
      return true;
    }
  }
  return false;
}

std::string difference_line(const Difference& difference) {
  std::string line = difference.kind + "  " + difference.key;
  for (const Difference::Change& change : difference.changes) {
    line += "  " + change.column + ": " + (change.a.empty() ? "–" : change.a) + " → " +
            (change.b.empty() ? "–" : change.b);
  }
  return printable(line);
}

batch::Json to_json(const Difference& difference) {
  batch::Json json = {{"key", difference.key}, {"kind", difference.kind}};
  for (const Difference::Change& change : difference.changes) {
    json["changes"][change.column] = {change.a, change.b};
  }
  return json;
}

}  // namespace vantage::cli
