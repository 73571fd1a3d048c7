// SPDX-License-Identifier: MIT
#pragma once

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
  bool is_number = false;
};

/// \throw CLI::ValidationError
Condition parse_condition(const std::string& text);

/// The columns of "name,status", all of which exist. \throw CLI::ValidationError
std::vector<std::string> parse_columns(const std::string& text);

/// Rows that fulfil all conditions, in the order of `sort` ("column" or "-column", "": by key).
batch::Statement select_rows(batch::ResultsStore& store, const std::vector<std::string>& columns,
                             const std::vector<Condition>& conditions, const std::string& sort);

/// A cell's text as exports write it; numbers in the shortest form that reads back the same.
std::string cell_text(const batch::Statement& row, int column);

/// The same for CSV: a spreadsheet would compute a text that begins with = + - @, a tab or a carriage
/// return, so an apostrophe is put before it.
std::string csv_text(const batch::Statement& row, int column);

/// A cell as JSON. \param name of its column.
nlohmann::ordered_json cell_json(const batch::Statement& row, int column, const std::string& name);

/// Cells joined by commas, quoted where CSV needs it, with a line end.
std::string csv_line(const std::vector<std::string>& cells);

/// Words joined by commas.
std::string joined(const std::vector<std::string>& words);

}  // namespace vantage::cli
