// SPDX-License-Identifier: MIT
#include "output_folder.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>
#include <system_error>
#include <utility>

#include <CLI/CLI.hpp>
#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include "vantage/core/error.h"
#include "vantage/io/write.h"

#include "batch/json_text.h"
#include "output_file.h"

namespace vantage::cli {
namespace {

namespace fs = std::filesystem;

/// What tells a folder of ours from somebody else's.
constexpr std::array kMarkers{kViewResults.marker, kCompareResults.marker};
constexpr std::string_view kUnfinishedText = "Vantage was exchanging its results here.\n";
/// The table of figures begins with it.
constexpr std::string_view kTableHead = "model,vertices,faces,";

/// The whole of a regular file, or as much as `most`; nothing if there is none.
std::string text_of(const fs::path& file, std::size_t most = std::string::npos) {
  std::error_code error;
  if (!fs::is_regular_file(file, error)) {  // nobody may ever write to a pipe
    return {};
  }
  std::ifstream stream(file, std::ios::binary);
  std::string text;
  for (std::istreambuf_iterator<char> at(stream), end; at != end && text.size() < most; ++at) {
    text += *at;
  }
  return text;
}

/// The file that is there while one run's files are exchanged for another's.
std::string unfinished_name(std::string_view marker) {
  return "." + std::string(marker) + ".unfinished";
}

bool is_unfinished(const fs::path& folder, std::string_view marker) {
  return text_of(folder / unfinished_name(marker), kUnfinishedText.size()) == kUnfinishedText;
}

bool holds(const fs::path& folder, std::string_view marker) {
  if (marker == kFigureResults.marker) {
    return text_of(folder / marker, kTableHead.size()) == kTableHead;
  }
  if (marker == kLevelResults.marker) {
    constexpr std::size_t kHead = 128;
    return text_of(folder / marker, kHead).find(" written by vantage\n") != std::string::npos;
  }
  const auto json = batch::parsed_json(text_of(folder / marker));
  return json.is_object() && json.contains("vantage") && json.contains("options_hash");
}

bool is_ours(const fs::path& folder) {
  return std::any_of(kMarkers.begin(), kMarkers.end(), [&](std::string_view marker) {
    return holds(folder, marker) || is_unfinished(folder, marker);
  });
}

/// A file under its temporary name, ".NAME.part.PROCESS".
struct PartFile {
  std::string name{};
  pid_t writer = 0;
};

std::optional<PartFile> part_file(const fs::path& file) {
  constexpr std::string_view kPart = ".part.";
  const std::string name = file.filename().string();
  const std::size_t at = name.rfind(kPart);
  pid_t process = 0;
  const char* const end = name.data() + name.size();
  if (!name.starts_with('.') || at == std::string::npos || at == 0 ||
      std::from_chars(name.data() + at + kPart.size(), end, process).ptr != end || process <= 0) {
    return std::nullopt;
  }
  return PartFile{name.substr(1, at - 1), process};
}

/// Whether there is nothing in the folder but what a killed run left.
bool holds_leftovers_only(const fs::path& folder) {
  std::error_code error;
  const fs::directory_iterator files(folder, error);
  return !error && std::all_of(begin(files), end(files), [](const fs::directory_entry& entry) {
    return part_file(entry.path()).has_value();
  });
}

/// Keeps two runs from exchanging files in one folder at once; ends with the process at the latest.
class FolderTurn {
 public:
  explicit FolderTurn(const std::string& folder)
      : descriptor_(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)) {
    while (descriptor_ >= 0 && ::flock(descriptor_, LOCK_EX) != 0 && errno == EINTR) {
    }  // a file system that knows no locks is no reason to fail
  }

  FolderTurn(const FolderTurn&) = delete;
  FolderTurn& operator=(const FolderTurn&) = delete;

  ~FolderTurn() {
    if (descriptor_ >= 0) {
      ::close(descriptor_);
    }
  }

 private:
  int descriptor_;
};

void remove_or_throw(const fs::path& file) {
  std::error_code error;
  fs::remove(file, error);
  if (error) {
    throw IoError(file.string(), "cannot be replaced", error.value());
  }
}

}  // namespace

void make_folder(const std::string& path) {
  std::error_code error;
  fs::create_directories(path, error);
  if (error || !fs::is_directory(path)) {
    throw IoError(path, "cannot make this folder; choose another with -o", error.value());
  }
}

std::string folder_named(const std::string& model, const std::string& ending) {
  constexpr std::size_t kLongestName = 255;
  std::size_t length = std::min(model.size(), kLongestName - ending.size());
  while (length < model.size() && length > 0 &&
         (static_cast<unsigned char>(model[length]) & 0xC0U) == 0x80U) {
    --length;  // not within a letter
  }
  return model.substr(0, length) + ending;
}

void write_levels(const std::string& folder, std::vector<std::string> levels) {
  OutputFolder output(folder, kLevelResults);
  for (std::size_t j = 0; j < levels.size(); ++j) {
    const std::string number = (j < 10 ? "0" : "") + std::to_string(j);
    output.add("level-" + number + ".ply", std::move(levels[j]));
  }
  output.write();
}

OutputFolder::OutputFolder(std::string path, const ResultKind& kind)
    : path_(std::move(path)), kind_(kind) {
  while (path_.size() > 1 && path_.back() == '/') {
    path_.pop_back();
  }
}

void OutputFolder::check(const CommonFlags& flags) const {
  if (path_ == "-") {
    throw CLI::ValidationError("--output",
                               "names a folder: standard output is none; for one named - say ./-");
  }
  std::error_code error;
  const fs::file_status status = fs::status(path_, error);
  if (!fs::exists(status)) {
    return;
  }
  if (!fs::is_directory(status)) {
    throw IoError(path_, "is a file where the results' folder should be; choose another with -o");
  }
  refuse_inputs(flags.inputs);
  if (!flags.force && !holds_leftovers_only(path_) && !is_ours(path_)) {
    throw IoError(path_,
                  "holds files that are not results of vantage; choose another folder with -o, or "
                  "say --force to write among them");
  }
}

bool OutputFolder::is_in(const std::string& path) const {
  std::error_code error;
  const fs::path folder = fs::path(path).parent_path();
  return path != "-" && fs::weakly_canonical(folder.empty() ? "." : folder, error) ==
                            fs::weakly_canonical(path_, error);
}

void OutputFolder::refuse_inputs(const std::vector<std::string>& inputs) const {
  for (const std::string& input : inputs) {
    std::error_code error;
    const fs::path file = fs::weakly_canonical(input, error);
    if (kind_.named(file.filename().string()) && is_in(file.string())) {
      throw CLI::ValidationError(input, "is read, and the results in " + path_ +
                                            " would replace it; choose another folder");
    }
  }
}

void OutputFolder::refuse_own_name(const std::string& path, const std::string& option) const {
  const std::string name = fs::path(path).filename().string();
  if (kind_.named(name) && is_in(path)) {
    throw CLI::ValidationError(option, "'" + name + "' is the name of one of the results in " +
                                           path_ + "; choose another");
  }
}

void OutputFolder::add(std::string name, std::string bytes) {
  files_.emplace_back(std::move(name), std::move(bytes));
}

void OutputFolder::add_named(const std::string& path, std::string bytes) {
  if (is_in(path)) {
    if (writes(fs::path(path).filename().string())) {
      throw IoError(path, "is the name of two files of this run; choose another");
    }
    add(fs::path(path).filename().string(), std::move(bytes));
  } else {
    beside_.emplace_back(path, std::move(bytes));
  }
}

void OutputFolder::write() {
  std::error_code error;
  const bool fresh = !fs::exists(path_, error);
  make_folder(path_);
  try {
    exchange();
  } catch (const Error&) {
    if (fresh) {
      fs::remove(path_, error);
    }
    throw;
  }
  for (const auto& [path, bytes] : beside_) {
    const fs::path folder = fs::path(path).parent_path();
    if (!folder.empty()) {
      make_folder(folder.string());
    }
    write_output(path, bytes);
  }
}

void OutputFolder::exchange() {
  const FolderTurn turn(path_);
  remove_parts_of_killed_runs();
  const fs::path folder(path_);
  std::vector<StagedFile> staged;
  staged.reserve(files_.size());
  for (const auto& [name, bytes] : files_) {
    const fs::path file = folder / name;
    std::error_code error;
    if (fs::is_directory(fs::symlink_status(file, error))) {
      throw IoError(file.string(), "is a folder, not a file");
    }
    make_folder(file.parent_path().string());
    staged.emplace_back(file.string(), bytes);
  }
  std::stable_partition(staged.begin(), staged.end(), [&](const StagedFile& file) {
    return fs::path(file.path()) != folder / kind_.marker;
  });

  const std::vector<std::string> former = former_files();
  const fs::path unfinished = folder / unfinished_name(kind_.marker);
  if (!is_private_) {
    write_file(unfinished.string(), kUnfinishedText);
  }
  std::vector<fs::path> placed;
  std::size_t removed = 0;
  std::error_code error;
  try {
    for (const std::string& name : former) {
      remove_or_throw(folder / name);
      ++removed;
    }
    for (StagedFile& file : staged) {
      file.place();
      placed.emplace_back(file.path());
    }
  } catch (const Error&) {
    for (const fs::path& file : placed) {
      fs::remove(file, error);
    }
    // Without their marker the former results are no answer any more. What cannot be removed must
    // still be known as ours by the next run.
    bool is_clear = true;
    for (std::size_t i = 0; removed > 0 && i < former.size(); ++i) {
      fs::remove(folder / former[i], error);
      is_clear = is_clear && !fs::exists(fs::symlink_status(folder / former[i], error));
    }
    if (is_clear) {
      fs::remove(unfinished, error);
    }
    throw;
  }
  for (const std::string& sub : below_) {
    fs::remove(folder / sub, error);  // unless something else is in it
  }
  fs::remove(unfinished, error);
}

void OutputFolder::write_last(std::string name, std::string bytes) {
  const FolderTurn turn(path_);
  for (const auto& [own, content] : files_) {
    if (own == kind_.marker && text_of(fs::path(path_) / own) != content) {
      throw IoError(path_, "was written by another run meanwhile, so " + name +
                               " does not belong there; run again");
    }
  }
  write_file((fs::path(path_) / name).string(), bytes);
  add(std::move(name), std::move(bytes));
}

bool OutputFolder::writes(std::string_view name) const {
  return std::any_of(files_.begin(), files_.end(),
                     [&](const auto& file) { return file.first == name; });
}

std::vector<std::string> OutputFolder::former_files() const {
  std::vector<std::string> names;
  std::error_code error;
  const bool ours = holds(path_, kind_.marker) || is_unfinished(path_, kind_.marker);
  const auto look_into = [&](const std::string& sub) {
    const fs::path folder = fs::path(path_) / sub;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder, error)) {
      const std::string own = entry.path().filename().string();
      const std::string name = (fs::path(sub) / own).string();
      const bool is_file = fs::is_regular_file(entry.symlink_status(error));
      if (writes(name) || (ours && is_file && kind_.named(own))) {
        names.push_back(name);
      }
    }
  };
  look_into("");
  for (const std::string& sub : below_) {
    look_into(sub);
  }
  std::sort(names.begin(), names.end());
  std::stable_partition(names.begin(), names.end(),
                        [&](const std::string& name) { return name == kind_.marker; });
  return names;
}

void OutputFolder::remove_parts_of_killed_runs() const {
  std::error_code error;
  std::vector<fs::path> leftovers;
  for (const fs::directory_entry& entry : fs::directory_iterator(path_, error)) {
    const std::optional<PartFile> part = part_file(entry.path());
    const bool ours = part && (writes(part->name) || kind_.named(part->name));
    if (ours && ::kill(part->writer, 0) != 0 && errno == ESRCH) {
      leftovers.push_back(entry.path());
    }
  }
  for (const fs::path& file : leftovers) {
    fs::remove(file, error);
  }
}

std::vector<std::string> OutputFolder::names() const {
  std::vector<std::string> names;
  for (const auto& [name, bytes] : files_) {
    names.push_back(name);
  }
  return names;
}

std::map<std::string, std::size_t> OutputFolder::sizes() const {
  std::map<std::string, std::size_t> sizes;
  for (const auto& [name, bytes] : files_) {
    sizes[name] = bytes.size();
  }
  return sizes;
}

}  // namespace vantage::cli
