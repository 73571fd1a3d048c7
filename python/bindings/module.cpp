// SPDX-License-Identifier: MIT
#include <string>

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include "vantage/core/version.h"

#include "errors.h"
#include "options.h"
#include "subject.h"

namespace vantage::python {
namespace {

py::dict defaults(const std::string& preset) {
  py::dict keywords;
  keywords["preset"] = preset;
  const Settings settings = settings_of(keywords);
  py::dict values;
  for (const Option& option : option_table()) {
    values[py::str(option.name)] = option.value(settings);
  }
  return values;
}

py::list options() {
  const py::dict ours = defaults("default");
  const py::dict papers = defaults("paper");
  py::list rows;
  for (const Option& option : option_table()) {
    py::dict row;
    row["name"] = option.name;
    row["group"] = option.group;
    row["type"] = option.type;
    row["help"] = option.help;
    row["low"] = option.low;
    row["high"] = option.high;
    row["default"] = ours[py::str(option.name)];
    row["paper"] = papers[py::str(option.name)];
    rows.append(row);
  }
  return rows;
}

}  // namespace
}  // namespace vantage::python

PYBIND11_MODULE(_core, module) {
  using namespace vantage::python;
  module.doc() = "The compiled part of vantage; use the package instead.";
  module.attr("__version__") = std::string(vantage::version());
  translate_errors();
  define_models(module);
  define_shape_functions(module);
  define_view_functions(module);
  define_best_view(module);
  define_pictures(module);
  module.def("defaults", &defaults, py::arg("preset"));
  module.def("options", &options);
  module.def("library_versions", [] { return vantage::library_versions(); });
}
