// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <stdexcept>
#include <string>
#include <string_view>

/// \file
/// Every exception of the library. what() is one sentence that a user of the program can act on.
/// Names of files are in it as they are: printable() makes it safe to show.

namespace vantage {

/// The text as one line that does nothing but show letters, for whatever comes from outside: "?" for
/// each control character, for bytes that are no UTF-8, and for what turns the direction of writing.
std::string printable(std::string_view text);

/// Root of all exceptions thrown by this library.
class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The bytes are not what their format demands, or the format is not one we read.
class FormatError : public Error {
 public:
  /// \param file    name shown to the user.
  /// \param place   "line 17", "byte 84", or empty if the file as a whole is wrong.
  /// \param problem what was expected, what was found, what to do.
  FormatError(std::string_view file, std::string_view place, std::string_view problem);
};

/// A file cannot be opened, read, written or renamed; names the file and the system's reason.
class IoError : public Error {
 public:
  /// \param file name of the file. \param problem what failed. \param error_number errno, or 0.
  IoError(std::string_view file, std::string_view problem, int error_number = 0);

  /// errno at the time, 0 if unknown.
  [[nodiscard]] int error_number() const { return error_number_; }

 private:
  int error_number_ = 0;
};

/// A documented precondition does not hold, or an option is outside its range.
class InvalidInput : public Error {
 public:
  using Error::Error;
};

/// A factorisation or a solve failed for good; says the stage and the size.
class SolverError : public Error {
 public:
  using Error::Error;
};

/// The caller asked to stop through RunContext::stop.
class Cancelled : public Error {
 public:
  Cancelled() : Error("stopped on request") {}
};

}  // namespace vantage
