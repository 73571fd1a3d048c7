// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <pybind11/pybind11.h>

#include "vantage/core/error.h"

/// \file
/// Strings that may hold whatever a file holds: bytes that are no UTF-8 become U+FFFD.

namespace vantage::python {

/// `bytes` as a Python string.
inline pybind11::str text_of(std::string_view bytes) {
  PyObject* decoded =
      PyUnicode_DecodeUTF8(bytes.data(), static_cast<pybind11::ssize_t>(bytes.size()), "replace");
  if (decoded == nullptr) {
    throw pybind11::error_already_set();
  }
  return pybind11::reinterpret_steal<pybind11::str>(decoded);
}

/// A path as the file system wants it, whatever the name's encoding. \throw InvalidInput if it holds a null
/// character, which would end it there.
inline std::string path_text(const pybind11::object& path) {
  auto text = pybind11::module_::import("os").attr("fsencode")(path).cast<std::string>();
  if (text.find('\0') != std::string::npos) {
    throw InvalidInput("a path must not hold a null character");
  }
  return text;
}

/// A message of the library with its options as Python has them: "--max-faces" as max_faces.
std::string without_flags(std::string text);

/// A warning or a note likewise: "--up z shows it" as up="z" shows it.
std::string with_keywords(std::string text);

/// text_of() each of a list of warnings or notes, their options as Python has them.
inline pybind11::tuple messages_of(const std::vector<std::string>& list) {
  pybind11::list texts;
  for (const std::string& message : list) {
    texts.append(text_of(with_keywords(message)));
  }
  return pybind11::tuple(texts);
}

}  // namespace vantage::python
