// SPDX-License-Identifier: MIT
#include "measure_flags.h"

#include <sstream>

#include "vantage/core/error.h"

namespace vantage::cli {

std::vector<Measure> parse_measures(const std::string& text, const std::string& flag) {
  if (text == "all") {
    return builtin_measures();
  }
  std::vector<Measure> measures;
  std::istringstream names(text);
  for (std::string name; std::getline(names, name, ',');) {
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

void SaliencyFlags::add_to(CLI::App& app) {
  const std::string group = "Mesh saliency";
  for_each_field(kMeshSaliencyFields, [&](const auto& field) {
    app.add_option("--" + std::string(field.name), options_.*(field.member),
                   std::string(field.help))
        ->check(CLI::Range(field.low, field.high))
        ->capture_default_str()
        ->group(group);
  });
  app.add_flag("--signed", options_.signed_curvature,
               "keep the sign of the mean curvature (its absolute value counts otherwise)")
      ->group(group);
  app.add_option_function<std::string>(
         "--kernel-weight",
         [this](const std::string& kind) { options_.area_kernel = kind == "area"; },
         "what the Gaussian means count: vertices, or the area that they stand for")
      ->check(CLI::IsMember({"vertex", "area"}))
      ->default_str("vertex")
      ->group(group);
}

void MeasureFlags::add_to(CLI::App& app) {
  app.add_option("--method", name_, "measure of a view: see vantage measures")
      ->capture_default_str()
      ->group("Method");
  saliency_.add_to(app);
}

void MeasureFlags::apply(ViewOptions& options) const {
  const std::vector<Measure> measures = parse_measures(name_, "--method");
  if (measures.size() != 1) {
    throw CLI::ValidationError("--method", "takes one method here; compare takes several");
  }
  options.method = measures.front().name;
  saliency_.apply(options);
}

}  // namespace vantage::cli
