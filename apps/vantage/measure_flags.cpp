// SPDX-License-Identifier: MIT
#include "measure_flags.h"

#include <sstream>

#include "vantage/core/error.h"
#include "vantage/pipeline/measured_shape.h"

#include "option_flags.h"
#include "option_text.h"

namespace vantage::cli {

std::vector<Measure> parse_measures(const std::string& text, const std::string& flag) {
  if (text == "all") {
    return builtin_measures();
  }
  std::vector<Measure> measures;
  std::istringstream names(text);
  for (std::string name; std::getline(names, name, ',');) {
    if (name == "all") {
      throw CLI::ValidationError(flag, "all stands alone: it is every method");
    }
    try {
      const Measure& found = find_measure(name);
      for (const Measure& earlier : measures) {
        if (earlier.name == found.name) {
          throw CLI::ValidationError(flag, "names " + found.name + " twice");
        }
      }
      measures.push_back(found);
    } catch (const InvalidInput& error) {
      throw CLI::ValidationError(flag, error.what());
    }
  }
  if (measures.empty()) {
    throw CLI::ValidationError(flag, "names no method; vantage measures lists them");
  }
  return measures;
}

void check_gradient(const Measure& measure) {
  try {
    require_gradient(measure);
  } catch (const InvalidInput& error) {
    throw refused(error, "--search");
  }
}

void offer_measures(const CLI::Option* option, bool joins, std::vector<std::string> others) {
  for (const Measure& measure : builtin_measures()) {
    others.push_back(measure.name);
  }
  offer_values(option, std::move(others), joins);
}

void MeasureFlags::add_to(CLI::App& app) {
  offer_measures(app.add_option("--method", name_, "measure of a view: see vantage measures")
                     ->capture_default_str()
                     ->group("Method"),
                 /*joins=*/false);
}

void MeasureFlags::apply(ViewOptions& options) const {
  const std::vector<Measure> measures = parse_measures(name_, "--method");
  if (measures.size() != 1) {
    throw CLI::ValidationError("--method", "takes one method here; compare takes several");
  }
  options.method = measures.front().name;
  if (options.search.strategy == SearchStrategy::Gradient) {
    check_gradient(measures.front());
  }
}

}  // namespace vantage::cli
