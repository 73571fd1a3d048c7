// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "result_names.h"
#include "session.h"

namespace vantage::cli {

/// What a folder of results holds.
struct ResultKind {
  std::string_view marker;          ///< The file that says that they are whole; comes last.
  bool (*named)(std::string_view);  ///< Whether files of this name belong to them.
};

inline constexpr ResultKind kViewResults{"view.json", is_view_file};
inline constexpr ResultKind kCompareResults{"compare.json", is_compare_file};
inline constexpr ResultKind kFigureResults{"table-1-times.csv", is_figure_file};
inline constexpr ResultKind kLevelResults{"level-00.ply", is_level_file};

/// A folder of results, collected in memory and exchanged at the end for those of a former run. All
/// files are on the disk before the first former one goes, and all former ones have gone before the
/// first new one gets its name: so at any moment, and after a kill at any moment, what is there is of
/// one run. The marker goes first and comes last; a folder without it is known to be unfinished.
class OutputFolder {
 public:
  /// \param path the folder, with or without slashes at its end; made if it is missing. A folder that
  /// holds files but no marker of ours is refused by check().
  OutputFolder(std::string path, const ResultKind& kind);

  /// Says that nobody else knows the folder before it is whole, nor keeps it if it never is: then no file has to tell
  /// that it is unfinished, which saves a wait for the disk.
  void keep_private() { is_private_ = true; }

  /// \throw IoError if writing there would replace somebody else's files and --force is not given, or
  /// it is not a folder. \throw CLI::ValidationError if it would replace an input.
  void check(const CommonFlags& flags) const;

  /// \throw CLI::ValidationError if one of the files has the place of a result.
  void refuse_inputs(const std::vector<std::string>& inputs) const;

  /// \throw CLI::ValidationError if a path that the user gave is that of one of the results.
  void refuse_own_name(const std::string& path, const std::string& option) const;

  /// Takes a file to write, by its name in the folder; "sub/name" for one in a folder below.
  void add(std::string name, std::string bytes);

  /// Takes a file under a path that the user gave: one in this folder belongs to the results, another
  /// is written after them, in a folder that is made if it is missing. \throw IoError if a file of that
  /// name is there already.
  void add_named(const std::string& path, std::string bytes);

  /// Says that former results may also be in a folder below. \param sub its name.
  void replace_below(std::string sub) { below_.push_back(std::move(sub)); }

  /// Exchanges the files. If that fails, former results stay, or if they have gone already the folder
  /// holds nothing of ours. \throw IoError
  void write();

  /// Writes one more file of the same run, after write(). \throw IoError
  void write_last(std::string name, std::string bytes);

  [[nodiscard]] const std::string& path() const { return path_; }

  [[nodiscard]] std::vector<std::string> names() const;

  /// Bytes of each file, by its name.
  [[nodiscard]] std::map<std::string, std::size_t> sizes() const;

 private:
  using File = std::pair<std::string, std::string>;  // name and bytes

  [[nodiscard]] bool is_in(const std::string& path) const;
  void exchange();
  [[nodiscard]] bool writes(std::string_view name) const;
  /// Files of a former run that are there, relative to the folder; the marker first.
  [[nodiscard]] std::vector<std::string> former_files() const;
  /// Removes temporary files of ours whose writers were killed.
  void remove_parts_of_killed_runs() const;

  std::string path_;
  ResultKind kind_;
  std::vector<File> files_{};
  std::vector<File> beside_{};  // by their paths
  std::vector<std::string> below_{};
  bool is_private_ = false;
};

/// Writes level-00.ply, level-01.ply, … in place of those of a former run. \throw IoError
void write_levels(const std::string& folder, std::vector<std::string> levels);

/// The name of a model's folder: its own, cut where the ending would make it too long.
std::string folder_named(const std::string& model, const std::string& ending);

/// Makes a folder and its parents. \throw IoError
void make_folder(const std::string& path);

}  // namespace vantage::cli
