// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <system_error>

#include "io/readers.h"

namespace vantage {

/// The names in folders. Each folder is listed once, when a name is first looked for in it.
class FolderNames {
 public:
  /// The name in the folder that is `name` but for capitals, the first of several; empty if there is none.
  std::string spelled_otherwise(const std::filesystem::path& folder, std::string_view name);

 private:
  using Names = std::map<std::string, std::string>;  // by the name in small letters

  static Names listed(const std::filesystem::path& folder);

  std::map<std::filesystem::path, Names> names_{};
};

/// Where a file beside a model is, all links resolved; empty if it lies outside the model's folder.
/// \param error set if there is no such file.
std::filesystem::path place_beside(const std::string& model_path, const std::string& relative,
                                   FolderNames& names, std::error_code& error);

/// Looks for each file beside a model once. \param model_path must outlive it, and so must `names`.
SideFileCheck side_file_check(const std::string& model_path, FolderNames& names);

/// A file beside a model, named by a relative path, that the model can do without. Does not throw.
SideFile side_file(const std::string& model_path, const std::string& relative, FolderNames& names);

}  // namespace vantage
