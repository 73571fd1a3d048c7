// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "batch/entry_source.h"
#include "batch/worker_process.h"

namespace vantage::batch {

/// Reads an archive from its beginning to its end, in another process. What a hostile archive does
/// to that one costs only the entry at hand: the process is started again behind it.
class ArchiveReader {
 public:
  /// \throw IoError if no process can be started.
  ArchiveReader(std::string path, ArchiveLimits limits);

  /// The next file that the filter accepts, or whose name cannot be read. What cannot be unpacked
  /// (a link, an entry without a name) is an entry with a problem, and so is what ends the archive
  /// early. Names inside archives only ever become keys, never paths.
  std::optional<Entry> next(const EntryFilter& filter);

  /// Unpacks the file that next() gave last; says in `problem` and `reason` why that cannot be.
  void fetch(Entry& entry, const std::string& file);

 private:
  struct End {
    std::string reason{};  ///< As in ModelRecord.
    std::string words{};
  };

  void start();
  std::optional<std::string> answer();
  bool is_offered_again();
  End end_of_process();
  Entry broken(const std::string& problem, const std::string& reason);

  std::string path_;
  ArchiveLimits limits_;
  std::unique_ptr<WorkerProcess> process_{};
  std::uint64_t passed_ = 0;  // entries that the process need not offer any more
  std::uint64_t at_ = 0;      // number of the entry that next() gave last
  int deaths_ = 0;            // of the process, in a row, between two entries
  bool ended_ = false;
  bool offered_ = false;  // an entry that was neither fetched nor passed over yet
};

/// Which part of an archive is unpacked, and how much of it.
struct UnpackLimits {
  std::uint64_t entry_bytes = 0;  ///< Most bytes of one entry; 0: any number.
  std::uint64_t passed = 0;       ///< So many entries at the front are not offered.
};

/// What the other process does: answers on descriptor `answers` to lines on standard input, which
/// are "skip" or "take" and a path as a JSON string. However small an archive is, an entry of it may
/// take 256 MB, and a thousand bytes for each one of the archive; beyond that it is refused.
void unpack_archive(const std::string& path, const UnpackLimits& limits, int answers);

}  // namespace vantage::batch
