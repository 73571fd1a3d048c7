// SPDX-License-Identifier: MIT
#include "results_diff.h"

#include <algorithm>
#include <charconv>
#include <cmath>
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
  static const std::vector<std::string> kColumns{"key",
                                                 "status",
                                                 "reason",
                                                 "error",
                                                 "content",
                                                 "vertices",
                                                 "faces",
                                                 "best_score",
                                                 "best_fraction",
                                                 "worst_score",
                                                 "worst_fraction",
                                                 "best_camera_orbit",
                                                 "best_camera_target",
                                                 "best_field_of_view"};
  return kColumns;
}

bool is_near(double x, double y, double tolerance) {
  return std::abs(x - y) <= tolerance * std::max(std::abs(x), std::abs(y));
}

/// Takes the number off the front of a text, or else a letter. \return the number, or the letter's code.
double take_number(std::string_view& text) {
  double number = static_cast<unsigned char>(text.front());
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  text.remove_prefix(error == std::errc{} ? static_cast<std::size_t>(end - text.data()) : 1);
  return number;
}

/// Whether cameras as `12deg 75deg 3.1m` are alike but for their numbers.
bool is_alike(std::string_view a, std::string_view b, double tolerance) {
  while (!a.empty() && !b.empty()) {
    if (!is_near(take_number(a), take_number(b), tolerance)) {
      return false;
    }
  }
  return a.empty() && b.empty();
}

bool is_alike(const batch::Statement& a, const batch::Statement& b, int column, double tolerance) {
  if (a.is_real(column) && b.is_real(column)) {
    return is_near(a.number(column), b.number(column), tolerance);
  }
  const std::string x = cell_text(a, column);
  const std::string y = cell_text(b, column);
  return compared_columns()[static_cast<std::size_t>(column)].starts_with("best_")
             ? is_alike(x, y, tolerance)
             : x == y;
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
                        const std::function<void(const Difference&)>& take) {
  batch::Statement left = select_rows(a, compared_columns(), {}, {});
  batch::Statement right = select_rows(b, compared_columns(), {}, {});
  DiffCounts counts;
  bool in_a = left.step();
  bool in_b = right.step();
  while (in_a || in_b) {
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

bool share_content(batch::ResultsStore& a, batch::ResultsStore& b) {
  std::unordered_set<std::string> contents;
  batch::Statement left = a.select("content", "content <> ''", "");
  while (left.step()) {
    contents.insert(left.text(0));
  }
  batch::Statement right = b.select("content", "content <> ''", "");
  while (right.step()) {
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
