// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>

#include "batch/entry_source.h"
#include "batch/worker_process.h"

namespace vantage::batch {

/// Reads an archive from its beginning to its end, in another process: what a hostile archive does
/// to that one ends only the archive.
class ArchiveReader {
 public:
  /// \throw IoError if no process can be started.
  ArchiveReader(std::string path, ArchiveLimits limits);

  /// The next file that the filter accepts. What ends the archive early is a last entry with a
  /// problem. Names inside archives only ever become keys, never paths.
  std::optional<Entry> next(const EntryFilter& filter);

  /// Unpacks the file that next() gave last. \return empty, or why that cannot be.
  std::string fetch(const std::string& file);

 private:
  std::optional<std::string> answer();
  Entry broken(const std::string& problem);

  std::string path_;
  ArchiveLimits limits_;
  WorkerProcess process_;
  bool ended_ = false;
  bool offered_ = false;  // an entry that was neither fetched nor passed over yet
};

/// What the other process does: answers on descriptor `answers` to lines on standard input.
/// \param entry_bytes most bytes of one entry unpacked; 0: any number.
void unpack_archive(const std::string& path, std::uint64_t entry_bytes, int answers);

}  // namespace vantage::batch
