// SPDX-License-Identifier: MIT
#include "errors.h"

#include <exception>

#include <pybind11/pybind11.h>

#include "vantage/core/error.h"

#include "text.h"

namespace vantage::python {
namespace {

namespace py = pybind11;

void raise(const char* name, const Error& error) {
  const py::object type = py::module_::import("vantage.errors").attr(name);
  PyErr_SetObject(type.ptr(), text_of(error.what()).ptr());
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
