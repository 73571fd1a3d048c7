// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>

#include <pybind11/pybind11.h>

/// \file
/// Plain arguments of functions. One of a wrong type is a TypeError of one sentence that begins with
/// its name.

namespace vantage::python {

namespace py = pybind11;

/// Throws what Python has just raised for an argument: an error of its type or value as the cause of
/// a TypeError that says `what`, anything else, as Ctrl-C, as it is.
[[noreturn]] void refuse_type(const std::string& what);

/// \throw py::type_error
std::string word_of(const py::object& value, const std::string& name);
/// True or False, NumPy's too; numbers are none. \throw py::type_error
bool switch_of(const py::object& value, const std::string& name);
/// Whether it is True or False, of Python or NumPy: where a number is asked for, these are none.
bool is_switch(const py::handle& value);
/// \throw py::type_error
double number_of(const py::object& value, const std::string& name);
/// \throw py::type_error, InvalidInput if it is less than `low` or more than `high`
std::int64_t whole_number_of(const py::object& value, const std::string& name, std::int64_t low,
                             std::int64_t high);

}  // namespace vantage::python
