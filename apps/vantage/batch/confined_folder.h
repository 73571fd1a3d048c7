// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace vantage::batch {

/// A folder of results, held open. What is written or removed in it goes through here, by names that
/// are relative, have no part "", "." or "..", and are resolved part by part without following a
/// link. So neither a record nor a link that somebody put there leads out of it. The folder itself
/// may be reached through links.
class ConfinedFolder {
 public:
  /// \param work_name of this process among those that write here; its temporary file is
  ///        `.work/NAME.part`, which is nobody else's while it holds the FolderLock of that name.
  /// \throw IoError if the folder cannot be opened.
  explicit ConfinedFolder(std::string path, const std::string& work_name = "local");
  ConfinedFolder(const ConfinedFolder&) = delete;
  ConfinedFolder& operator=(const ConfinedFolder&) = delete;
  ~ConfinedFolder();

  /// Whether a text is such a name.
  static bool is_name(std::string_view name);

  [[nodiscard]] const std::string& path() const { return path_; }

  /// The name below path(), for messages and for other processes.
  [[nodiscard]] std::string path_of(const std::string& name) const;

  /// Whether there is something of that name, a link included.
  [[nodiscard]] bool exists(const std::string& name) const;
  [[nodiscard]] bool is_folder(const std::string& name) const;
  [[nodiscard]] bool is_empty_folder(const std::string& name) const;

  /// Opens a regular file, with flags of open(); never waits, never follows a link.
  /// \return a descriptor, or −1 and errno.
  [[nodiscard]] int open_file(const std::string& name, int flags) const;

  /// The first bytes of a regular file; empty if there is none. \param most at most so many.
  [[nodiscard]] std::string beginning_of(const std::string& name, std::size_t most) const;

  /// All of a regular file; nothing if there is none that can be read, or it has more than 2^31 bytes.
  [[nodiscard]] std::optional<std::string> content_of(const std::string& name) const;

  /// Makes a folder and those above it, where they are missing. \throw IoError
  void make_folders(const std::string& name) const;

  /// Makes a folder that is not there yet. \throw IoError
  void make_new_folder(const std::string& name) const;

  /// Removes a file, a link or a folder with all that is in it. \return whether it is gone.
  bool remove(const std::string& name) const;  // NOLINT(modernize-use-nodiscard): may be ignored

  /// Puts `from` in the place of `to` in one step; what was there is removed, a link as a link.
  /// \throw IoError
  void move(const std::string& from, const std::string& to) const;

  /// Creates the temporary file, empty. \return a descriptor for writing. \throw IoError
  [[nodiscard]] int create_part() const;

  /// Gives the temporary file its name. \throw IoError
  void finish_part(const std::string& name) const;

  /// Writes a file, whole or not at all. \throw IoError
  void write(const std::string& name, std::string_view bytes) const;

 private:
  [[nodiscard]] int open_parent(const std::string& name) const;

  std::string path_;
  std::string part_;
  int folder_ = -1;
};

}  // namespace vantage::batch
