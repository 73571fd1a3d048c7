// SPDX-License-Identifier: MIT
#include "batch/shard_plan.h"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <queue>
#include <utility>
#include <vector>

#include "vantage/core/error.h"

#include "batch/json_text.h"
#include "batch/naming.h"

namespace vantage::batch {
namespace {

namespace fs = std::filesystem;

/// Bytes that a model costs before its first vertex: starting, and pictures, which take as long as
/// the analysis of some ten thousand vertices.
constexpr std::uint64_t kCostOfAnyModel = 500'000;

/// A file that appears under its name when it is complete.
class WholeFile {
 public:
  WholeFile(const ConfinedFolder& folder, std::string name)
      : folder_(folder), name_(std::move(name)), file_(::fdopen(folder.create_part(), "wb")) {}

  void line(const Json& json) {
    const std::string text = json_text(json) + '\n';
    if (std::fwrite(text.data(), 1, text.size(), file_.get()) != text.size()) {
      throw IoError(folder_.path_of(name_), "cannot be written", errno);
    }
  }

  void finish() {
    if (std::fflush(file_.get()) != 0) {
      throw IoError(folder_.path_of(name_), "cannot be written", errno);
    }
    folder_.finish_part(name_);
  }

 private:
  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };

  const ConfinedFolder& folder_;
  std::string name_;
  std::unique_ptr<std::FILE, Close> file_{};
};

void write_entry(WholeFile& file, const Entry& entry, std::optional<std::uint32_t> shard) {
  // What names no file has none, and fails by its problem.
  const std::string path = entry.path.empty() ? "" : fs::absolute(entry.path).string();
  Json json = {{"planned", true}, {"path", key_of_path(path)}, {"key", entry.key}};
  const std::pair<const char*, const std::string&> rest[] = {
      {"name", entry.name}, {"up", entry.up}, {"front", entry.front}, {"problem", entry.problem}};
  for (const auto& [name, value] : rest) {
    if (!value.empty()) {
      json[name] = value;
    }
  }
  if (!entry.member.empty()) {
    json["member"] = key_of_path(entry.member);
  }
  if (shard) {
    json["shard"] = *shard;
  }
  file.line(json);
}

std::uint64_t cost_of(const Entry& entry) {
  std::error_code error;
  const std::uintmax_t size = fs::file_size(entry.path, error);
  return kCostOfAnyModel + (error ? 0 : size);
}

}  // namespace

std::uint32_t shard_of(const Entry& entry, std::uint32_t shards) {
  return entry.shard ? *entry.shard % shards : Shard::of_key(entry.key, shards);
}

std::optional<Entry> ShardEntries::next() {
  std::optional<Entry> entry = all_->next();
  while (entry && shard_of(*entry, shard_.count) != shard_.index) {
    entry = all_->next();
  }
  return entry;
}

std::int64_t write_plan(EntrySource& entries, const ConfinedFolder& folder,
                        const std::string& name) {
  WholeFile file(folder, name);
  std::int64_t count = 0;
  while (const std::optional<Entry> entry = entries.next()) {
    if (!entry->member.empty() && entry->problem.empty()) {
      throw IoError(entry->path,
                    "is an archive, and models in archives are not shared out to other machines; "
                    "unpack it first, or leave --engine out");
    }
    write_entry(file, *entry, std::nullopt);
    ++count;
  }
  file.finish();
  return count;
}

void balance_plan(const ConfinedFolder& folder, const std::string& name, std::uint32_t shards) {
  const std::string path = folder.path_of(name);
  std::vector<std::pair<std::uint64_t, std::size_t>> by_cost;
  const std::unique_ptr<EntrySource> sizes = entries_of_manifest(path);
  while (const std::optional<Entry> entry = sizes->next()) {
    by_cost.emplace_back(cost_of(*entry), by_cost.size());
  }
  // Descending cost; of equals the earlier first.
  std::sort(by_cost.begin(), by_cost.end(), [](const auto& a, const auto& b) {
    return a.first != b.first ? a.first > b.first : a.second < b.second;
  });
  using Load = std::pair<std::uint64_t, std::uint32_t>;
  std::priority_queue<Load, std::vector<Load>, std::greater<>> least;
  for (std::uint32_t shard = 0; shard < shards; ++shard) {
    least.emplace(0, shard);
  }
  std::vector<std::uint32_t> shard_of(by_cost.size());
  for (const auto& [cost, index] : by_cost) {
    const auto [load, shard] = least.top();
    least.pop();
    shard_of[index] = shard;
    least.emplace(load + cost, shard);
  }
  WholeFile file(folder, name);
  const std::unique_ptr<EntrySource> entries = entries_of_manifest(path);
  std::size_t index = 0;
  while (const std::optional<Entry> entry = entries->next()) {
    write_entry(file, *entry, shard_of[index++]);
  }
  file.finish();
}

}  // namespace vantage::batch
