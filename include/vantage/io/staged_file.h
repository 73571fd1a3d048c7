// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

/// \file
/// A file that is whole on the disk before anybody sees it.

namespace vantage {

/// Bytes on the disk that have no name yet, so that several files can take their places in one short
/// moment. A process that is killed before leaves nothing behind where the file system knows files
/// without a name (O_TMPFILE), else one named ".NAME.part.PROCESS".
class StagedFile {
 public:
  /// Writes the bytes in the folder of `path`. \throw IoError
  StagedFile(std::string path, std::string_view bytes);
  /// Drops what was not placed.
  ~StagedFile();
  StagedFile(StagedFile&& other) noexcept;
  StagedFile& operator=(StagedFile&& other) noexcept;

  /// Gives it its name, in place of the file, link or pipe that has it. Call once. \throw IoError
  void place();

  [[nodiscard]] const std::string& path() const { return path_; }  ///< Where place() puts it.

 private:
  /// \return whether the file system knows files without a name. \throw IoError
  bool write_nameless(std::string_view bytes);
  /// \throw IoError
  void write_temporary(std::string_view bytes);
  void drop() noexcept;

  std::string path_;
  std::string temporary_{};  ///< Its name until it is placed; empty: it has none.
  int descriptor_ = -1;      ///< Of a file without a name.
};

}  // namespace vantage
