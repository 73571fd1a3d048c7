// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "batch/results_store.h"

/// \file
/// Selecting and printing rows of the view `results` of a batch's store.

namespace vantage::cli {

/// A condition like "best_fraction<0.4", checked against the columns that there are.
struct Condition {
  std::string column{};
  std::string comparison{};  ///< SQL with a ? for the value.
  std::string value{};
  std::optional<double> number{};  ///< Of a column of numbers, what it is compared with.
};

/// A column to sort by, or none.
struct Order {
  std::string column{};
  bool is_down = false;  ///< The largest first.
};

/// What a row is sorted by, to join rows of several stores: numbers come before texts.
class RankedRow {
 public:
  RankedRow(const batch::Statement& row, int column);

  [[nodiscard]] bool comes_before(const RankedRow& other, bool is_down) const;

 private:
  int kind_ = 2;  ///< 0: a number, 1: text, 2: no value.
  double number_ = 0.0;
  std::string text_{};
};

/// \throw CLI::ValidationError
Condition parse_condition(const std::string& text);

/// The columns of "name,status", all of which exist. \throw CLI::ValidationError
std::vector<std::string> parse_columns(const std::string& text);

/// "column", "-column" or "". \throw CLI::ValidationError
Order parse_order(const std::string& text);

/// Rows that fulfil all conditions, sorted; without a column by key.
batch::Statement select_rows(batch::ResultsStore& store, const std::vector<std::string>& columns,
                             const std::vector<Condition>& conditions, const Order& sort);

/// A cell's text as exports write it; numbers in the shortest form that reads back the same.
std::string cell_text(const batch::Statement& row, int column);

/// The same for CSV: a spreadsheet would compute a text that begins with = + - @, a tab or a carriage
/// return, so an apostrophe is put before it; not before lengths and angles of a camera.
/// \param name of the column.
std::string csv_text(const batch::Statement& row, int column, const std::string& name);

/// A cell as JSON. \param name of its column.
nlohmann::ordered_json cell_json(const batch::Statement& row, int column, const std::string& name);

/// Cells joined by commas, quoted where CSV needs it, with a line end.
std::string csv_line(const std::vector<std::string>& cells);

/// Words joined by commas.
std::string joined(const std::vector<std::string>& words);

}  // namespace vantage::cli
