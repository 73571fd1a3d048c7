// SPDX-License-Identifier: MIT
#pragma once

#include <pybind11/pybind11.h>

#include "vantage/pipeline/option_table.h"

/// \file
/// The keywords of the method: the library's table of options, as Python writes it. Signatures,
/// docstrings and type stubs are made from it.

namespace vantage::python {

namespace py = pybind11;

/// What keywords set.
using Settings = AllOptions;

/// The options of keywords over those of a preset. Keywords that are None are as not given.
/// \throw InvalidInput naming the keyword, py::type_error.
Settings settings_of(const py::dict& keywords);

/// The same over options that an analysis was made with; refuses what would change the analysis.
Settings settings_over(Settings base, const py::dict& keywords);

/// What each keyword is by a preset, a name or None; None: nothing is set.
py::dict default_values(const py::object& preset);

/// Each keyword: name, flag, group, type, help, choices, low, high, default, paper.
py::list option_rows();

}  // namespace vantage::python
