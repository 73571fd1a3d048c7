// SPDX-License-Identifier: MIT
#include "batch/entry_source.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <span>
#include <string_view>
#include <system_error>
#include <utility>

#include <fnmatch.h>

#include "vantage/io/import_stream.h"
#include "vantage/io/model.h"

#include "batch/archive_reader.h"
#include "batch/naming.h"
#include "batch/results_store.h"
#include "result_names.h"

namespace vantage::batch {
namespace {

namespace fs = std::filesystem;

bool matches(const std::string& pattern, const std::string& path) {
  const std::string file = path.substr(path.find_last_of('/') + 1);
  return ::fnmatch(pattern.c_str(), path.c_str(), FNM_CASEFOLD) == 0 ||
         ::fnmatch(pattern.c_str(), file.c_str(), FNM_CASEFOLD) == 0;
}

/// Whether `view` has put results there, which are no models.
bool is_viewed(const std::string& folder) {
  const fs::path marker = fs::path(folder) / "view.json";
  std::error_code error;
  if (!fs::is_regular_file(marker, error)) {  // nobody may ever write to a pipe
    return false;
  }
  std::string beginning(cli::kViewBegins.size(), '\0');
  std::ifstream file(marker, std::ios::binary);
  file.read(beginning.data(), static_cast<std::streamsize>(beginning.size()));
  return file && beginning == cli::kViewBegins;
}

/// Whether a file holds what macOS knows of another one, whose name and ending it has.
bool is_of_macos(const std::string& path) {
  return path.substr(path.find_last_of('/') + 1).starts_with("._") ||
         path.starts_with("__MACOSX/") || path.find("/__MACOSX/") != std::string::npos;
}

constexpr const char* kArchives[] = {"*.zip",     "*.tar",    "*.tar.gz", "*.tgz",
                                     "*.tar.bz2", "*.tar.xz", "*.tar.zst"};

/// Walks a folder, holding only the names of the folders between its top and here.
class FolderWalk {
 public:
  FolderWalk(const std::string& top, const EntryFilter& filter, const fs::path& skipped)
      : top_(top), filter_(filter), skipped_(skipped) {
    open(top);
  }

  std::optional<Entry> next() {
    while (!levels_.empty()) {
      if (!problem_.empty()) {
        Entry entry{.key = key_of_path(problem_path_), .path = problem_path_};
        entry.problem = std::exchange(problem_, {});
        return entry;
      }
      Level& level = levels_.back();
      if (level.names.empty()) {
        levels_.pop_back();
        continue;
      }
      const auto [name, is_folder] = std::move(level.names.back());
      level.names.pop_back();
      const std::string path = level.path + (level.path.ends_with('/') ? "" : "/") + name;
      if (is_folder) {
        open(path);
      } else if (filter_.accepts(path.substr(top_.size() + (top_.ends_with('/') ? 0 : 1)))) {
        return Entry{.key = key_of_path(path), .path = path};
      }
    }
    return std::nullopt;
  }

 private:
  struct Level {
    std::string path{};
    std::vector<std::pair<std::string, bool>> names{};  // last first
  };

  void open(const std::string& path) {
    std::error_code error;
    if (!skipped_.empty() && fs::equivalent(path, skipped_, error)) {
      return;
    }
    if (!levels_.empty() && fs::is_regular_file(fs::path(path) / ResultsStore::kFileName, error)) {
      return;  // of an earlier batch
    }
    Level level{.path = path};
    fs::directory_iterator files(path, error);
    for (; !error && files != fs::directory_iterator{}; files.increment(error)) {
      std::error_code ignored;
      const bool is_folder = files->is_directory(ignored) && !files->is_symlink(ignored);
      // A link that leads nowhere is still listed, and then fails as a model that cannot be read.
      if (is_folder || !files->is_directory(ignored)) {
        level.names.emplace_back(files->path().filename().string(), is_folder);
      }
    }
    if (is_viewed(path)) {
      std::erase_if(level.names, [](const auto& each) {
        return cli::is_view_file(each.first) || cli::is_level_file(each.first);
      });
    }
    if (error) {
      problem_path_ = path;
      problem_ = "this folder cannot be listed: " + error.message();
    }
    std::sort(level.names.begin(), level.names.end(), std::greater<>());
    levels_.push_back(std::move(level));
  }

  std::string top_;
  const EntryFilter& filter_;
  fs::path skipped_;
  std::vector<Level> levels_{};
  std::string problem_path_{};
  std::string problem_{};
};

class PathSource : public EntrySource {
 public:
  PathSource(std::vector<std::string> inputs, EntryFilter filter, std::string skipped,
             ArchiveLimits archive_limits)
      : inputs_(std::move(inputs)),
        filter_(std::move(filter)),
        skipped_(std::move(skipped)),
        archive_limits_(std::move(archive_limits)) {}

  std::optional<Entry> next() override {
    while (true) {
      if (archive_) {
        if (std::optional<Entry> entry = archive_->next(archive_filter_)) {
          return numbered(std::move(*entry));
        }
        archive_.reset();
      }
      if (walk_) {
        if (std::optional<Entry> entry = walk_->next()) {
          if (!entry->problem.empty() || !is_archive(entry->path)) {
            return numbered(std::move(*entry));
          }
          archive_ = std::make_unique<ArchiveReader>(entry->path, archive_limits_);
          archive_filter_ = filter_.inside(entry->path);
          continue;
        }
        walk_.reset();
      }
      if (at_ == inputs_.size()) {
        return std::nullopt;
      }
      if (std::optional<Entry> entry = opened(inputs_[at_++])) {
        return numbered(std::move(*entry));
      }
    }
  }

  void fetch(Entry& entry, const std::string& file) override {
    archive_ ? archive_->fetch(entry, file) : EntrySource::fetch(entry, file);
  }

 private:
  /// Opens a folder or an archive; a plain file is an entry at once.
  std::optional<Entry> opened(const std::string& input) {
    std::string path = fs::path(input).lexically_normal().string();
    std::error_code error;
    if (fs::is_directory(path, error)) {
      walk_ = std::make_unique<FolderWalk>(path, filter_, skipped_);
    } else if (is_archive(path)) {
      archive_ = std::make_unique<ArchiveReader>(path, archive_limits_);
      archive_filter_ = filter_;
    } else {
      Entry entry{.key = key_of_path(path), .path = path};
      if (input.find("://") != std::string::npos && !fs::exists(path, error)) {
        entry.key = key_of_path(input);
        entry.reason = "input";
        entry.problem = "is a web address, and only files are read; download it first";
      }
      return entry;
    }
    return std::nullopt;
  }

  Entry numbered(Entry entry) {
    entry.position = position_++;
    return entry;
  }

  std::vector<std::string> inputs_;
  EntryFilter filter_;
  std::string skipped_;
  std::size_t at_ = 0;
  std::int64_t position_ = 0;
  std::unique_ptr<FolderWalk> walk_{};
  ArchiveLimits archive_limits_;
  std::unique_ptr<ArchiveReader> archive_{};
  EntryFilter archive_filter_{};
};

}  // namespace

std::string Entry::model_name() const {
  return key_of_path(name.empty() ? fs::path(shown_path()).stem().string() : name);
}

std::string Entry::label() const {
  const std::string shown = key_of_path(path);
  const bool says_path =
      path.empty() || !member.empty() || key == shown || shown.ends_with("/" + key);
  return says_path ? key : key + " (" + shown + ")";
}

std::string Entry::labelled(const std::string& sentence) const {
  const std::string shown = label();
  return shown == key || sentence.starts_with(shown) ? sentence : shown + ": " + sentence;
}

std::string Entry::retold(const std::string& sentence, const std::string& its_key) const {
  const std::string rest = sentence.starts_with(its_key) ? sentence.substr(its_key.size()) : "";
  if (!rest.starts_with(": ") && !rest.starts_with(" (")) {
    return labelled(sentence);
  }
  return label() + rest.substr(std::min(rest.find(": "), rest.size()));
}

bool EntryFilter::accepts(const std::string& path_below) const {
  const auto matches_path = [&](const std::string& pattern) {
    return matches(pattern, path_below);
  };
  const auto readable = [&] {
    const auto ends_so = [&](std::string_view ending) {
      return matches_path("*." + std::string(ending));
    };
    const std::span<const std::string_view> own = model_endings();
    return std::any_of(own.begin(), own.end(), ends_so) ||
           (imports &&
            std::any_of(kImportFormats.begin(), kImportFormats.end(),
                        [&](const ImportFormat& format) { return ends_so(format.extension); }));
  };
  if (is_of_macos(path_below)) {
    return false;
  }
  const bool included =
      include.empty() ? readable() : std::any_of(include.begin(), include.end(), matches_path);
  return included && std::none_of(exclude.begin(), exclude.end(), matches_path);
}

EntryFilter EntryFilter::inside(const std::string& archive) const {
  EntryFilter filter = *this;
  std::erase_if(filter.include,
                [&](const std::string& pattern) { return matches(pattern, archive); });
  return filter;
}

bool is_archive(const std::string& path) {
  return std::any_of(std::begin(kArchives), std::end(kArchives),
                     [&](const char* pattern) { return matches(pattern, path); });
}

std::unique_ptr<EntrySource> entries_of_paths(std::vector<std::string> inputs, EntryFilter filter,
                                              std::string skipped, ArchiveLimits archive_limits) {
  return std::make_unique<PathSource>(std::move(inputs), std::move(filter), std::move(skipped),
                                      std::move(archive_limits));
}

}  // namespace vantage::batch
