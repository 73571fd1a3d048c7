// SPDX-License-Identifier: MIT
#include <string>

#include <pybind11/pybind11.h>

#include "vantage/core/version.h"

#include "errors.h"
#include "options.h"
#include "released_run.h"
#include "subject.h"

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
  py::module_::import("atexit").attr("register")(py::cpp_function(&stop_all_work));
  module.def("defaults", &default_values, py::arg("preset"));
  module.def("options", &option_rows);
  module.def("library_versions", [] { return vantage::library_versions(); });
}
