// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <vector>

#include <pybind11/pybind11.h>

#include "vantage/pipeline/option_table.h"

/// \file
/// The keywords of the method: the library's table of options, as Python writes it. Signatures,
/// docstrings and type stubs are made from it.

namespace vantage::python {

namespace py = pybind11;

/// What keywords set.
using Settings = AllOptions;

/// What has no effect in a call with these settings.
using IdleRule = std::function<std::vector<IdleOptions>(const Settings&)>;

/// The options of keywords over those of a preset. Keywords that are None are as not given.
/// \param idle what else is refused, if it is not the preset's. \throw InvalidInput naming the
/// keyword, py::type_error.
Settings settings_of(const py::dict& keywords, const IdleRule& idle = {});

/// The same over options that an analysis was made with; refuses what would change the analysis.
Settings settings_over(Settings base, const py::dict& keywords, const IdleRule& idle);

/// What each keyword is by a preset, a name or None; None: nothing is set.
py::dict default_values(const py::object& preset);

/// Each keyword: name, flag, group, type, help, choices, low, high, default, paper.
py::list option_rows();

}  // namespace vantage::python
