// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "vantage/pipeline/view_options.h"
#include "vantage/view/measure.h"

namespace vantage::cli {

/// Parses "kssm,vmi" or "all". \throw CLI::ValidationError naming what there is.
std::vector<Measure> parse_measures(const std::string& text, const std::string& flag);

/// Refuses a search along the gradient of what has none. \throw CLI::ValidationError
void check_gradient(const Measure& measure);

/// Lets shells complete the names of measures. \param others further values.
void offer_measures(const CLI::Option* option, bool joins, std::vector<std::string> others = {});

/// --method NAME of one measure.
class MeasureFlags {
 public:
  void add_to(CLI::App& app);
  /// \throw CLI::ValidationError for a name that does not exist.
  void apply(ViewOptions& options) const;

 private:
  std::string name_ = "kssm";
};

}  // namespace vantage::cli
