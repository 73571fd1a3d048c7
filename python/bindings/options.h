// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <pybind11/pybind11.h>

#include "vantage/render/render.h"
#include "vantage/report/view_report.h"

/// \file
/// The keywords of the method: one table that sets them, checks them and describes them, so that
/// signatures, docstrings and type stubs cannot say anything else.

namespace vantage::python {

namespace py = pybind11;

/// What keywords set.
struct Settings {
  ViewOptions view{};
  RenderOptions look{};
  bool asset_colours = false;  ///< Pictures in the file's own colours.
  std::optional<int> views{};
  std::optional<double> coverage{};
};

/// One keyword.
struct Option {
  std::string name{};                  ///< As on the command line, with _ for -.
  std::string group{};                 ///< Which functions take it.
  std::string type{};                  ///< As Python writes it.
  std::string help{};                  ///< One line: meaning, unit, source.
  std::vector<std::string> choices{};  ///< Of a word.
  std::optional<double> low{};         ///< Of a number.
  std::optional<double> high{};        ///< Of a number.
  std::function<void(Settings&, const py::object&)> set{};
  std::function<py::object(const Settings&)> value{};  ///< None: nothing is set.
};

/// Groups that shape what analyse() makes, so that they cannot be given again afterwards.
inline constexpr std::string_view kMethodGroup = "method";
inline constexpr std::string_view kMapGroup = "map";

/// All keywords, in the order in which they are applied.
const std::vector<Option>& option_table();

/// The options of keywords over those of a preset. Keywords that are None are as not given.
/// \throw InvalidInput naming the keyword, py::type_error.
Settings settings_of(const py::dict& keywords);

/// The same over options that an analysis was made with; refuses what would change the analysis.
Settings settings_over(Settings base, const py::dict& keywords);

/// Parts of the table that have a file of their own.
void add_method_options(std::vector<Option>& table);
void add_view_options(std::vector<Option>& table);

/// Refuses sets of views that make no sense, and asks for the one that is wanted.
void finish_view_set(Settings& settings);

}  // namespace vantage::python
