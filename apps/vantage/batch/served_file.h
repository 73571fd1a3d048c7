// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>

namespace vantage::batch {

/// A regular file of a folder, open: what its name leads to later does not matter.
class ServedFile {
 public:
  /// \param path below `root`, without "..". \return nothing if it does not exist, is no regular
  /// file, or a link is on the way.
  static std::shared_ptr<const ServedFile> open(const std::filesystem::path& root,
                                                const std::filesystem::path& path);
  ServedFile(const ServedFile&) = delete;
  ServedFile& operator=(const ServedFile&) = delete;
  ~ServedFile();

  [[nodiscard]] std::size_t size() const { return size_; }

  /// \return how many bytes were read from `offset` on; 0 at the end or if it fails.
  std::size_t read(std::size_t offset, char* bytes, std::size_t size) const;

 private:
  ServedFile(int file, std::size_t size) : file_(file), size_(size) {}

  int file_;
  std::size_t size_;
};

}  // namespace vantage::batch
