// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace vantage::cli {

/// A folder of results, collected in memory and written at the end: a run that fails before leaves
/// nothing behind, and one that fails while writing removes what it wrote.
class OutputFolder {
 public:
  /// \param path the folder; made if it is missing. A folder that holds files of these names but no
  /// view.json of ours is refused by check(), before any work is done.
  explicit OutputFolder(std::string path) : path_(std::move(path)) {}

  /// \param force also takes a folder of somebody else's files.
  /// \throw IoError if writing there would replace somebody else's files, or it is not a folder.
  void check(bool force) const;

  /// Takes a file to write.
  void add(std::string name, std::string bytes);

  /// Says that this run replaces all files of some names: what a former run left of them and this
  /// one does not write is removed.
  void replace_all(bool (*named)(std::string_view)) { replaced_ = named; }

  /// Writes all files. \throw IoError
  void write();

  /// The same where a further file comes by write_last(): a former one does not stand beside these.
  void write_without(const std::string& name);

  /// Writes one more file. \throw IoError
  void write_last(std::string name, std::string bytes);

  [[nodiscard]] const std::string& path() const { return path_; }

  [[nodiscard]] std::vector<std::string> names() const;

 private:
  [[nodiscard]] bool writes(std::string_view name) const;
  /// Removes temporary files of ours whose writers were killed.
  void remove_parts_of_killed_runs() const;
  void remove_former_views() const;

  std::string path_;
  std::vector<std::pair<std::string, std::string>> files_{};
  bool (*replaced_)(std::string_view) = nullptr;
};

/// The name of a model's folder: its own, cut where the ending would make it too long.
std::string folder_named(const std::string& model, const std::string& ending);

/// Makes a folder and its parents. \throw IoError
void make_folder(const std::string& path);

}  // namespace vantage::cli
