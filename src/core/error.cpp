// SPDX-License-Identifier: MIT
#include "vantage/core/error.h"

#include <system_error>

namespace vantage {
namespace {

std::string joined(std::string_view file, std::string_view place, std::string_view problem) {
  std::string text(file);
  if (!place.empty()) {
    text += ", ";
    text += place;
  }
  text += ": ";
  text += problem;
  return text;
}

std::string with_reason(std::string_view file, std::string_view problem, int error_number) {
  std::string text = joined(file, {}, problem);
  if (error_number != 0) {
    text += " (" + std::generic_category().message(error_number) + ")";
  }
  return text;
}

}  // namespace

FormatError::FormatError(std::string_view file, std::string_view place, std::string_view problem)
    : Error(joined(file, place, problem)) {}

IoError::IoError(std::string_view file, std::string_view problem, int error_number)
    : Error(with_reason(file, problem, error_number)), error_number_(error_number) {}

}  // namespace vantage
