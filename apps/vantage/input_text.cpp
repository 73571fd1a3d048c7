// SPDX-License-Identifier: MIT
#include "input_text.h"

#include <cerrno>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>

#include "vantage/core/error.h"

namespace vantage::cli {

std::string read_text(const std::string& path) {
  if (path == "-") {
    return {std::istreambuf_iterator<char>(std::cin), {}};
  }
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) {
    throw IoError(path,
                  std::string("cannot be read: no such file, or not a plain file") +
                      (error ? "" : "; - reads standard input"),
                  error.value());
  }
  std::ifstream stream(path, std::ios::binary);
  std::string text{std::istreambuf_iterator<char>(stream), {}};
  if (!stream.good() && !stream.eof()) {
    throw IoError(path, "cannot be read", errno);
  }
  return text;
}

}  // namespace vantage::cli
