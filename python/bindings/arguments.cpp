// SPDX-License-Identifier: MIT
#include "arguments.h"

#include "vantage/core/error.h"

namespace vantage::python {

void refuse_type(const std::string& what) {
  if (PyErr_ExceptionMatches(PyExc_TypeError) != 0 ||
      PyErr_ExceptionMatches(PyExc_ValueError) != 0) {
    py::raise_from(PyExc_TypeError, what.c_str());
  }
  throw py::error_already_set();
}

std::string word_of(const py::object& value, const std::string& name) {
  if (!py::isinstance<py::str>(value)) {
    throw py::type_error(name + " must be str");
  }
  py::ssize_t size = 0;
  const char* const text = PyUnicode_AsUTF8AndSize(value.ptr(), &size);
  if (text == nullptr) {  // half of a pair of surrogates
    refuse_type(name + " must be text that has a UTF-8 form");
  }
  return {text, static_cast<std::size_t>(size)};
}

bool switch_of(const py::object& value, const std::string& name) {
  py::detail::make_caster<bool> caster;
  if (!caster.load(value, /*convert=*/false)) {
    throw py::type_error(name + " must be bool");
  }
  return static_cast<bool>(caster);
}

bool is_switch(const py::handle& value) {
  return PyBool_Check(value.ptr()) ||
         py::isinstance(value, py::module_::import("numpy").attr("bool_"));
}

double number_of(const py::object& value, const std::string& name) {
  if (is_switch(value)) {
    throw py::type_error(name + " must be a number");
  }
  try {
    return value.cast<double>();
  } catch (const py::cast_error&) {
    throw py::type_error(name + " must be a number");
  }
}

std::int64_t whole_number_of(const py::object& value, const std::string& name, std::int64_t low,
                             std::int64_t high) {
  if (is_switch(value)) {
    throw py::type_error(name + " must be a whole number");
  }
  const auto number = py::reinterpret_steal<py::object>(PyNumber_Index(value.ptr()));
  if (!number) {
    refuse_type(name + " must be a whole number");
  }
  int overflow = 0;
  const long long whole = PyLong_AsLongLongAndOverflow(number.ptr(), &overflow);
  if (overflow != 0 || whole < low || whole > high) {
    throw InvalidInput(name + (overflow == 0 ? " is " + std::to_string(whole) + " but" : "") +
                       " must be between " + std::to_string(low) + " and " + std::to_string(high));
  }
  return whole;
}

}  // namespace vantage::python
