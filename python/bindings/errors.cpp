// SPDX-License-Identifier: MIT
#include "errors.h"

#include <algorithm>
#include <exception>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <pybind11/pybind11.h>

#include "vantage/core/error.h"

#include "options.h"
#include "text.h"

namespace vantage::python {
namespace {

namespace py = pybind11;

/// A message of the library with its options as Python has them: "--max-faces" as max_faces.
std::string without_flags(std::string text) {
  // Arguments of functions that are no options.
  std::vector<std::string> names{"max-faces", "method",     "view", "show",
                                 "camera",    "directions", "eyes", "sphere"};
  for (const Option& option : option_table()) {
    names.push_back(option.name);
  }
  for (const std::string& name : names) {
    std::string keyword = name;
    std::replace(keyword.begin(), keyword.end(), '-', '_');
    const std::string flag = " --" + name;
    for (std::size_t at = text.find(flag); at != std::string::npos; at = text.find(flag, at + 1)) {
      const std::size_t end = at + flag.size();
      if (end == text.size() ||
          std::string_view(" ,;.:").find(text[end]) != std::string_view::npos) {
        text.replace(at + 1, flag.size() - 1, keyword);
      }
    }
  }
  return text;
}

void raise(const char* name, const Error& error) {
  const py::object type = py::module_::import("vantage.errors").attr(name);
  PyErr_SetObject(type.ptr(), text_of(without_flags(error.what())).ptr());
}

void raise_io(const IoError& error) {
  const py::object type = py::module_::import("vantage.errors").attr("IoError");
  const py::object raised = type(error.error_number(), text_of(error.what()));
  PyErr_SetObject(type.ptr(), raised.ptr());
}

void translate(std::exception_ptr thrown) {
  try {
    if (thrown) {
      std::rethrow_exception(std::move(thrown));
    }
  } catch (const IoError& error) {
    raise_io(error);
  } catch (const FormatError& error) {
    raise("FormatError", error);
  } catch (const InvalidInput& error) {
    raise("InvalidInput", error);
  } catch (const SolverError& error) {
    raise("SolverError", error);
  } catch (const Error& error) {
    raise("Error", error);
  }
}

}  // namespace

void translate_errors() {
  py::register_exception_translator(&translate);
}

}  // namespace vantage::python
