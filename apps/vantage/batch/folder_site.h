// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>
#include <string_view>

#include "batch/served_file.h"

/// \file
/// A folder of results as a web site: which path shows what. Knows nothing of HTTP.

namespace vantage::batch {

/// What stands at a path.
struct SitePage {
  std::string type{};                        ///< Media type.
  std::string body{};                        ///< Of a page made here, if there is no `file`.
  std::shared_ptr<const ServedFile> file{};  ///< A file of the folder.
  bool is_report = false;                    ///< Whether its name is that of a report of ours.
};

/// The folder of a batch (a page of its store, made anew each time, so that a batch that still runs
/// can be watched), or any folder with results of `view` in it, four levels deep.
class FolderSite {
 public:
  /// \param stop once it is requested, the page that is being made ends where it is.
  /// \throw IoError if it is no folder, or there are no results in it.
  explicit FolderSite(const std::string& folder, std::stop_token stop = {});

  /// What stands at the decoded path of a request ("/", "/models/x/best.png"); nothing for what does
  /// not exist, is hidden, lies outside the folder or behind a link, or is of a kind that results
  /// never are. \throw IoError if the store cannot be read.
  [[nodiscard]] std::optional<SitePage> find(std::string_view path) const;

 private:
  [[nodiscard]] std::optional<SitePage> index(std::size_t page) const;
  [[nodiscard]] std::string results_index() const;

  std::stop_token stop_;
  std::filesystem::path root_{};
  bool is_batch_ = false;
};

}  // namespace vantage::batch
