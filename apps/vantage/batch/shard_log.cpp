// SPDX-License-Identifier: MIT
#include "batch/shard_log.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <charconv>

#include <fcntl.h>
#include <sys/stat.h>

#include "vantage/core/error.h"

#include "batch/content_hash.h"
#include "batch/descriptor.h"
#include "batch/json_text.h"

namespace vantage::batch {
namespace {

// Records between two checkpoints, at least: rewriting a shard of minutes costs less than a model. A larger
// one is rewritten when its log has as many records as its file.
constexpr std::size_t kCheckpoint = 256;

// A record is a few kB; the rest of a longer line is no record and fills no memory.
constexpr std::size_t kLongestRecord = 16U << 20U;

struct CloseFile {
  void operator()(std::FILE* file) const { std::fclose(file); }
};

using File = std::unique_ptr<std::FILE, CloseFile>;

/// The next line without its end, cut where it is too long. \return false at the end.
bool read_line(std::FILE* file, std::string& line) {
  line.clear();
  int c = 0;
  while ((c = ::getc_unlocked(file)) != EOF && c != '\n') {
    if (line.size() <= kLongestRecord) {
      line += static_cast<char>(c);
    }
  }
  return c != EOF || !line.empty();
}

std::string file_name(const Shard& shard) {
  std::array<char, 64> name{};
  std::snprintf(name.data(), name.size(), "shard-%05u-of-%05u.jsonl", shard.index, shard.count);
  return name.data();
}

std::string versioned_content_key(const ModelRecord& record) {
  return record.content + ' ' + record.options + ' ' + record.version;
}

bool stands_for_its_content(const ModelRecord& record) {
  return !record.content.empty() && record.duplicate_of.empty() && is_of_content(record.reason);
}

/// Those that are done come first.
std::tuple<bool, std::int64_t, std::string> place_among_equals(const ModelRecord& record) {
  return {record.status != "done", record.position, record.key};
}

}  // namespace

std::uint32_t Shard::of_key(const std::string& key, std::uint32_t count) {
  return static_cast<std::uint32_t>(stable_number(key) % count);
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

bool is_shard_file(std::string_view name) {
  constexpr std::string_view kLike = "shard-00000-of-00000.jsonl";
  const std::string_view stem = name.substr(0, kLike.size());
  const bool fits = stem.size() == kLike.size() &&
                    std::equal(stem.begin(), stem.end(), kLike.begin(), [](char c, char like) {
                      return like == '0' ? c >= '0' && c <= '9' : c == like;
                    });
  return fits && (name.size() == kLike.size() || name.substr(kLike.size()) == ".log");
}

std::size_t read_shard_file(const std::string& path,
                            const std::function<void(const ModelRecord&)>& take) {
  Descriptor opened(::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC));

  struct stat status {};

  if (opened.number() < 0 && errno == ENOENT) {
    return 0;  // a log that its shard has just put into its file
  }
  if (opened.number() < 0 || ::fstat(opened.number(), &status) != 0) {
    throw IoError(path, "cannot be read", errno);
  }
  if (!S_ISREG(status.st_mode)) {
    throw IoError(path, "is not a regular file; move it away");
  }
  const File file(::fdopen(opened.release(), "rb"));
  std::size_t torn = 0;
  for (std::string line; read_line(file.get(), line);) {
    if (const std::optional<ModelRecord> record = record_from_line(line)) {
      take(*record);
    } else {
      ++torn;
    }
  }
  return torn;
}

ShardLog::ShardLog(const std::string& folder, const Shard& shard)
    : folder_(folder,
              "shard-" + std::to_string(shard.index) + "-of-" + std::to_string(shard.count)),
      name_(std::string(kShardFolder) + "/" + file_name(shard)),
      log_name_(name_ + ".log") {
  folder_.make_folders(kShardFolder);
  read(name_);
  read(log_name_);
  if (folder_.exists(log_name_) || !folder_.exists(name_)) {
    // A killed run's records come first into the file; an empty one shows whose folder this is.
    finish();
  }
}

ShardLog::~ShardLog() {
  if (log_ != nullptr) {
    std::fclose(log_);
  }
}

void ShardLog::read(const std::string& name) {
  if (folder_.exists(name)) {
    read_shard_file(folder_.path_of(name), [this](const ModelRecord& record) { remember(record); });
  }
}

void ShardLog::remember(const ModelRecord& record) {
  if (const auto old = records_.find(record.key); old != records_.end()) {
    for (KeysOfContent* const keys : {&runs_of_content_, &duplicates_of_content_}) {
      (*keys)[versioned_content_key(old->second)].erase(place_among_equals(old->second));
    }
    if (owner_of(old->second.folder) == record.key) {
      owner_of_folder_.erase(old->second.folder);
    }
  }
  records_[record.key] = record;
  if (stands_for_its_content(record)) {
    runs_of_content_[versioned_content_key(record)].insert(place_among_equals(record));
  }
  if (record.status == "done" && !record.duplicate_of.empty()) {
    duplicates_of_content_[versioned_content_key(record)].insert(place_among_equals(record));
  }
  if (!record.folder.empty()) {
    owner_of_folder_[record.folder] = record.key;
  }
}

std::optional<ModelRecord> ShardLog::find(const std::string& key) {
  const auto found = records_.find(key);
  return found == records_.end() ? std::nullopt : std::optional(found->second);
}

std::optional<ModelRecord> ShardLog::first_of(const KeysOfContent& keys,
                                              const ModelRecord& like) const {
  const auto found = keys.find(versioned_content_key(like));
  if (found == keys.end() || found->second.empty()) {
    return std::nullopt;
  }
  return records_.at(std::get<std::string>(*found->second.begin()));
}

std::optional<ModelRecord> ShardLog::find_content(const ModelRecord& like) {
  return first_of(runs_of_content_, like);
}

std::optional<ModelRecord> ShardLog::find_duplicate(const ModelRecord& like) {
  return first_of(duplicates_of_content_, like);
}

std::vector<ModelRecord> ShardLog::find_equals(const ModelRecord& like) {
  const std::string wanted = versioned_content_key(like);
  std::vector<ModelRecord> equals;
  for (const auto& [key, record] : records_) {
    if (!record.content.empty() && versioned_content_key(record) == wanted) {
      equals.push_back(record);
    }
  }
  return equals;
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
  const int file = folder_.open_file(log_name_, O_WRONLY | O_APPEND | O_CREAT);
  log_ = file < 0 ? nullptr : ::fdopen(file, "ab");
  if (log_ == nullptr) {
    throw IoError(folder_.path_of(log_name_), "cannot be created", errno);
  }
}

void ShardLog::put(const ModelRecord& record) {
  if (log_ == nullptr) {
    open_log();
  }
  const std::string line = json_text(to_json(record)) + "\n";
  if (std::fwrite(line.data(), 1, line.size(), log_) != line.size() || std::fflush(log_) != 0) {
    throw IoError(folder_.path_of(log_name_), "cannot be written", errno);
  }
  remember(record);
  if (++unsaved_ >= std::max(kCheckpoint, saved_)) {
    finish();
  }
}

void ShardLog::finish() {
  std::string text;
  for (const auto& [key, record] : records_) {
    text += json_text(to_json(record)) + "\n";
  }
  folder_.write(name_, text);
  // Only now, with the records safe under their final name, may the log go.
  if (log_ != nullptr) {
    std::fclose(log_);
    log_ = nullptr;
  }
  folder_.remove(log_name_);
  unsaved_ = 0;
  saved_ = records_.size();
}

}  // namespace vantage::batch
