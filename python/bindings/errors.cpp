// SPDX-License-Identifier: MIT
#include "errors.h"

#include <algorithm>
#include <cerrno>
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

void raise(const char* name, const Error& error) {
  const py::object type = py::module_::import("vantage.errors").attr(name);
  PyErr_SetObject(type.ptr(), text_of(without_flags(error.what())).ptr());
}

void raise_io(const IoError& error) {
  const bool is_missing = error.error_number() == ENOENT;
  const py::object type =
      py::module_::import("vantage.errors").attr(is_missing ? "MissingFileError" : "IoError");
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

std::string without_flags(std::string text) {
  // Arguments of functions that are no options.
  std::vector<std::string> names{"max-faces", "method",     "view", "show",
                                 "camera",    "directions", "eyes", "sphere"};
  for (const Option& option : option_table()) {
    names.push_back(option.name);
  }
  const auto is_one_of = [](char c, std::string_view those) {
    return those.find(c) != std::string_view::npos;
  };
  for (const std::string& name : names) {
    std::string keyword = name;
    std::replace(keyword.begin(), keyword.end(), '-', '_');
    const std::string flag = "--" + name;
    for (std::size_t at = text.find(flag); at != std::string::npos; at = text.find(flag, at + 1)) {
      const std::size_t end = at + flag.size();
      if ((at == 0 || is_one_of(text[at - 1], " (\"'")) &&
          (end == text.size() || is_one_of(text[end], " ,;.:)\"'"))) {
        text.replace(at, flag.size(), keyword);
      }
    }
  }
  return text;
}

std::string with_keywords(std::string text) {
  for (const Option& option : option_table()) {
    std::string keyword = option.name;
    std::replace(keyword.begin(), keyword.end(), '-', '_');
    for (const std::string& word : option.words) {
      const std::string flag = std::string("--").append(option.name).append(" ").append(word);
      for (std::size_t at = text.find(flag); at != std::string::npos;
           at = text.find(flag, at + 1)) {
        const std::size_t end = at + flag.size();
        if (end == text.size() || text[end] == ' ' || text[end] == ',' || text[end] == ';') {
          text.replace(at, flag.size(),
                       std::string(keyword).append("=\"").append(word).append("\""));
        }
      }
    }
  }
  return without_flags(std::move(text));
}

void translate_errors() {
  py::register_exception_translator(&translate);
}

}  // namespace vantage::python
