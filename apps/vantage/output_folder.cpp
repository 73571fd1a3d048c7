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

#include <nlohmann/json.hpp>

#include "vantage/core/error.h"
#include "vantage/io/write.h"

namespace vantage::cli {
namespace {

namespace fs = std::filesystem;

/// What tells a folder of ours from somebody else's.
constexpr std::array<std::string_view, 2> kMarkers{"view.json", "compare.json"};

bool holds(const fs::path& folder, std::string_view marker) {
  std::error_code error;
  if (!fs::is_regular_file(folder / marker, error)) {  // nobody may ever write to a pipe
    return false;
  }
  std::ifstream stream(folder / marker, std::ios::binary);
  if (!stream) {
    return false;
  }
  const std::string text{std::istreambuf_iterator<char>(stream), {}};
  const auto json = nlohmann::json::parse(text, nullptr, false);
  return json.is_object() && json.contains("vantage") && json.contains("options_hash");
}

bool is_ours(const fs::path& folder) {
  return std::any_of(kMarkers.begin(), kMarkers.end(),
                     [&](std::string_view marker) { return holds(folder, marker); });
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

void OutputFolder::check(bool force) const {
  std::error_code error;
  const fs::file_status status = fs::status(path_, error);
  if (!fs::exists(status)) {
    return;
  }
  if (!fs::is_directory(status)) {
    throw IoError(path_, "is a file where the results' folder should be; choose another with -o");
  }
  if (!force && !holds_leftovers_only(path_) && !is_ours(path_)) {
    throw IoError(path_,
                  "holds files that are not results of vantage; choose another folder with -o, or "
                  "say --force to write among them");
  }
}

void OutputFolder::add(std::string name, std::string bytes) {
  files_.emplace_back(std::move(name), std::move(bytes));
}

void OutputFolder::write() {
  std::error_code error;
  const bool fresh = !fs::exists(path_, error);
  make_folder(path_);
  remove_parts_of_killed_runs();
  std::vector<fs::path> written;
  try {
    for (const auto& [name, bytes] : files_) {
      const fs::path file = fs::path(path_) / name;
      write_file(file.string(), bytes);
      written.push_back(file);
    }
  } catch (const Error&) {
    for (const fs::path& file : written) {
      fs::remove(file, error);
    }
    if (fresh) {
      fs::remove(path_, error);
    }
    throw;
  }
  remove_former_views();
}

void OutputFolder::write_without(const std::string& name) {
  std::error_code error;
  fs::remove(fs::path(path_) / name, error);
  write();
}

void OutputFolder::write_last(std::string name, std::string bytes) {
  write_file((fs::path(path_) / name).string(), bytes);
  add(std::move(name), std::move(bytes));
}

bool OutputFolder::writes(std::string_view name) const {
  return std::any_of(files_.begin(), files_.end(),
                     [&](const auto& file) { return file.first == name; });
}

void OutputFolder::remove_parts_of_killed_runs() const {
  std::error_code error;
  std::vector<fs::path> leftovers;
  for (const fs::directory_entry& entry : fs::directory_iterator(path_, error)) {
    const std::optional<PartFile> part = part_file(entry.path());
    if (part && writes(part->name) && ::kill(part->writer, 0) != 0 && errno == ESRCH) {
      leftovers.push_back(entry.path());
    }
  }
  for (const fs::path& file : leftovers) {
    fs::remove(file, error);
  }
}

void OutputFolder::remove_former_views() const {
  if (replaced_ == nullptr) {
    return;
  }
  std::error_code error;
  std::vector<fs::path> leftovers;
  for (const fs::directory_entry& entry : fs::directory_iterator(path_, error)) {
    const std::string name = entry.path().filename().string();
    if (!writes(name) && replaced_(name) && entry.is_regular_file(error)) {
      leftovers.push_back(entry.path());
    }
  }
  for (const fs::path& leftover : leftovers) {
    fs::remove(leftover, error);  // one that stays is no reason to fail
  }
}

std::vector<std::string> OutputFolder::names() const {
  std::vector<std::string> names;
  for (const auto& [name, bytes] : files_) {
    names.push_back(name);
  }
  return names;
}

}  // namespace vantage::cli
