// SPDX-License-Identifier: MIT
#include "batch/shard_log.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <filesystem>
#include <fstream>

#include <nlohmann/json.hpp>

#include "vantage/core/error.h"
#include "vantage/io/write.h"

#include "batch/content_hash.h"

namespace vantage::batch {
namespace {

namespace fs = std::filesystem;

// Records between two checkpoints: rewriting a shard of minutes costs less than a model.
constexpr std::size_t kCheckpoint = 256;

std::string file_name(const Shard& shard) {
  std::array<char, 64> name{};
  std::snprintf(name.data(), name.size(), "shard-%05u-of-%05u.jsonl", shard.index, shard.count);
  return name.data();
}

std::string content_key(const ModelRecord& record) {
  return record.content + ' ' + record.options + ' ' + record.version;
}

bool stands_for_its_content(const ModelRecord& record) {
  return !record.content.empty() && record.duplicate_of.empty() && record.reason != "name";
}

}  // namespace

bool Shard::holds(const std::string& key) const {
  return stable_number(key) % count == index;
}

Shard parse_shard(const std::string& text) {
  Shard shard;
  const char* const end = text.data() + text.size();
  const auto [slash, error] = std::from_chars(text.data(), end, shard.index);
  if (error == std::errc{} && slash != end && *slash == '/') {
    const auto [last, count_error] = std::from_chars(slash + 1, end, shard.count);
    if (count_error == std::errc{} && last == end && shard.index < shard.count &&
        shard.count <= 99'999) {
      return shard;
    }
  }
  throw InvalidInput("--shard: expected INDEX/COUNT like 3/64, counted from 0, found '" + text +
                     "'");
}

std::string shard_folder(const std::string& folder) {
  return (fs::path(folder) / "shards").string();
}

std::size_t read_shard_file(const std::string& path,
                            const std::function<void(const ModelRecord&)>& take) {
  std::ifstream file(path, std::ios::binary);
  if (!file) {
    throw IoError(path, "cannot be read", errno);
  }
  std::size_t torn = 0;
  for (std::string line; std::getline(file, line);) {
    if (const std::optional<ModelRecord> record = record_from_line(line)) {
      take(*record);
    } else {
      ++torn;
    }
  }
  return torn;
}

ShardLog::ShardLog(const std::string& folder, const Shard& shard) {
  std::error_code error;
  fs::create_directories(shard_folder(folder), error);
  path_ = (fs::path(shard_folder(folder)) / file_name(shard)).string();
  log_path_ = path_ + ".log";
  read(path_);
  read(log_path_);
  if (fs::exists(log_path_, error)) {
    finish();  // a killed run left it: its records come first into the file
  }
}

ShardLog::~ShardLog() {
  if (log_ != nullptr) {
    std::fclose(log_);
  }
}

void ShardLog::read(const std::string& path) {
  std::error_code error;
  if (fs::exists(path, error)) {
    read_shard_file(path, [this](const ModelRecord& record) { remember(record); });
  }
}

void ShardLog::remember(const ModelRecord& record) {
  if (const auto old = records_.find(record.key); old != records_.end()) {
    runs_of_content_[content_key(old->second)].erase({old->second.position, record.key});
    owner_of_folder_.erase(old->second.folder);
  }
  records_[record.key] = record;
  if (stands_for_its_content(record)) {
    runs_of_content_[content_key(record)].insert({record.position, record.key});
  }
  if (!record.folder.empty()) {
    owner_of_folder_[record.folder] = record.key;
  }
}

std::optional<ModelRecord> ShardLog::find(const std::string& key) {
  const auto found = records_.find(key);
  return found == records_.end() ? std::nullopt : std::optional(found->second);
}

std::optional<ModelRecord> ShardLog::find_content(const ModelRecord& like) {
  const auto found = runs_of_content_.find(content_key(like));
  if (found == runs_of_content_.end() || found->second.empty()) {
    return std::nullopt;
  }
  return records_.at(found->second.begin()->second);
}

std::string ShardLog::owner_of(const std::string& folder) {
  const auto found = owner_of_folder_.find(folder);
  return found == owner_of_folder_.end() ? std::string() : found->second;
}

std::int64_t ShardLog::latest_ms() {
  std::int64_t latest = 0;
  for (const auto& [key, record] : records_) {
    latest = std::max(latest, record.timings.finished_ms);
  }
  return latest;
}

void ShardLog::open_log() {
  log_ = std::fopen(log_path_.c_str(), "abe");
  if (log_ == nullptr) {
    throw IoError(log_path_, "cannot be created", errno);
  }
}

void ShardLog::put(const ModelRecord& record) {
  if (log_ == nullptr) {
    open_log();
  }
  const std::string line = to_json(record).dump() + "\n";
  if (std::fwrite(line.data(), 1, line.size(), log_) != line.size() || std::fflush(log_) != 0) {
    throw IoError(log_path_, "cannot be written", errno);
  }
  remember(record);
  if (++unsaved_ >= kCheckpoint) {
    finish();
  }
}

void ShardLog::finish() {
  std::string text;
  for (const auto& [key, record] : records_) {
    text += to_json(record).dump() + "\n";
  }
  write_file(path_, text);
  // Only now, with the records safe under their final name, may the log go.
  if (log_ != nullptr) {
    std::fclose(log_);
    log_ = nullptr;
  }
  std::error_code error;
  fs::remove(log_path_, error);
  unsaved_ = 0;
}

}  // namespace vantage::batch
