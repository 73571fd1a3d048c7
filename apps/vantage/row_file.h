// SPDX-License-Identifier: MIT
#pragma once

#include <cstdio>
#include <string>

namespace vantage::cli {

/// A file that is written row by row and gets its name only when it is whole; "-": standard output.
class RowFile {
 public:
  /// \throw IoError
  explicit RowFile(std::string path);
  RowFile(const RowFile&) = delete;
  RowFile& operator=(const RowFile&) = delete;
  /// Removes what was not finished.
  ~RowFile();

  /// \throw IoError
  void add(const std::string& row);

  /// \throw IoError
  void finish();

 private:
  std::string path_;
  std::string part_{};  ///< Of a name that nothing had; empty: written in place.
  std::FILE* file_ = nullptr;
};

}  // namespace vantage::cli
