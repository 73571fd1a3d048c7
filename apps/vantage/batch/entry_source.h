// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

/// \file
/// Where the models of a batch come from, one after the other, never all in memory.

namespace vantage::batch {

/// One model to do.
struct Entry {
  std::string key{};             ///< Identity; UTF-8.
  std::string path{};            ///< File to read; for an archive's entry the archive.
  std::string member{};          ///< Entry inside the archive `path`; empty for plain files.
  std::string name{};            ///< From the manifest; empty: the file's stem.
  std::string up{};              ///< From the manifest; empty: as the command line says.
  std::string front{};           ///< The same.
  std::int64_t position = 0;     ///< Place among all entries, before any is left out.
  std::string problem{};         ///< Not empty: cannot be done; one sentence.
  std::string reason = "input";  ///< Of a problem, as in ModelRecord; "disk": there is no room.
  std::optional<std::uint32_t> shard{};  ///< From a balanced plan; else the key's hash decides.

  /// What naming templates call the path: the member's if there is one.
  [[nodiscard]] const std::string& shown_path() const { return member.empty() ? path : member; }

  /// What its record calls it: the manifest's name, or the stem; UTF-8.
  [[nodiscard]] std::string model_name() const;

  /// What messages call it: its key, and its path where the key says nothing of that.
  [[nodiscard]] std::string label() const;

  /// A sentence about it, with its label where this says more than its key.
  [[nodiscard]] std::string labelled(const std::string& sentence) const;

  /// What was said of an equal model, said of this one.
  [[nodiscard]] std::string retold(const std::string& sentence, const std::string& its_key) const;
};

/// Gives entries in an order that depends on names and nothing else.
class EntrySource {
 public:
  EntrySource() = default;
  EntrySource(const EntrySource&) = delete;
  EntrySource& operator=(const EntrySource&) = delete;
  virtual ~EntrySource() = default;

  /// The next entry; empty at the end. Keys and positions are filled in.
  /// \throw IoError
  virtual std::optional<Entry> next() = 0;

  /// Whether next() need not wait for whoever writes the list: it may be a pipe.
  [[nodiscard]] virtual bool has_more_now() const { return true; }

  /// Copies the entry that next() gave last out of its archive into a new file; where that cannot
  /// be, `problem` and `reason` say why.
  virtual void fetch(Entry& entry, const std::string& file) {
    static_cast<void>(file);
    entry.problem = "is in an archive, which this list of models cannot reach into";
  }
};

/// Which files of folders and archives count.
struct EntryFilter {
  std::vector<std::string> include{};  ///< Shell patterns; empty: every format that can be read.
  std::vector<std::string> exclude{};  ///< Shell patterns, stronger than `include`.
  bool imports = false;                ///< Whether formats of vantage-import can be read.

  /// Whether a file counts. Patterns are compared with the path below the folder and with the bare
  /// name; letter case does not matter.
  [[nodiscard]] bool accepts(const std::string& path_below) const;

  /// Which entries count of an archive in a folder, which was named by some of the patterns: they go by
  /// the others, or by their formats if there are none.
  [[nodiscard]] EntryFilter inside(const std::string& archive) const;
};

/// How far an archive is trusted.
struct ArchiveLimits {
  std::uint64_t entry_bytes = 0;  ///< Of one entry unpacked; 0: any number.
  double timeout_s = 300.0;       ///< From one entry to the next, and for unpacking one.
  int attempts = 2;               ///< At what ends the process that unpacks; at least 1.
  std::stop_token stop{};         ///< Ends waiting.
};

/// Whether a path is unpacked rather than read: .zip, .tar, .tar.gz and the like.
bool is_archive(const std::string& path);

/// Files, archives and folders in the order given; folders are walked in the order of their names' bytes,
/// and links to folders are not followed. \param skipped folder that is never entered (the output).
std::unique_ptr<EntrySource> entries_of_paths(std::vector<std::string> inputs, EntryFilter filter,
                                              std::string skipped, ArchiveLimits archive_limits);

/// Entries of a manifest ("-": standard input): JSON lines with "path" and, if wanted, "key",
/// "name", "up", "front"; or CSV with such columns in its header; or a path a line (or ended by a zero
/// byte). What it is shows in its first line. Paths are relative to the manifest's folder.
/// \param stop ends waiting for a pipe: next() throws Cancelled. \param warn is told once of columns or
/// members that are none of these.
/// \throw IoError if it cannot be opened or read; FormatError if its first line shows that it lists no models.
std::unique_ptr<EntrySource> entries_of_manifest(
    const std::string& path, std::stop_token stop = {},
    std::function<void(const std::string& warning)> warn = {});

}  // namespace vantage::batch
