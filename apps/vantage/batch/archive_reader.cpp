// SPDX-License-Identifier: MIT
#include "batch/archive_reader.h"

#include <utility>

#include <nlohmann/json.hpp>

#include "batch/naming.h"

namespace vantage::batch {
namespace {

using Json = nlohmann::json;

// The largest dictionary of an .xz file is 1.5 GiB.
constexpr std::uint64_t kUnpackerMemory = 2'000'000'000;

}  // namespace

ArchiveReader::ArchiveReader(std::string path, ArchiveLimits limits)
    : path_(std::move(path)),
      limits_(std::move(limits)),
      process_({"batch-unpack", "--", key_of_path(path_), std::to_string(limits_.entry_bytes)},
               {.memory_bytes = kUnpackerMemory, .file_bytes = limits_.entry_bytes}, true) {}

std::optional<std::string> ArchiveReader::answer() {
  return process_.await_line(limits_.timeout_s, limits_.stop);
}

Entry ArchiveReader::broken(const std::string& problem) {
  ended_ = true;
  Entry entry{.key = key_of_path(path_), .path = path_};
  entry.problem = problem;
  return entry;
}

std::optional<Entry> ArchiveReader::next(const EntryFilter& filter) {
  while (!ended_) {
    if (std::exchange(offered_, false)) {
      process_.send("skip");
    }
    const std::optional<std::string> line = answer();
    if (!line && limits_.stop.stop_requested()) {
      ended_ = true;
      return std::nullopt;
    }
    const Json json = Json::parse(line.value_or(""), nullptr, false);
    if (!json.is_object()) {
      return broken(
          "the rest of this archive cannot be read: the process that unpacks it ended by " +
          how_it_ended(process_.end()));
    }
    if (json.contains("problem")) {
      return broken("the rest of this archive cannot be read: " +
                    json["problem"].get<std::string>());
    }
    if (!json.contains("member")) {
      ended_ = true;
      return std::nullopt;
    }
    offered_ = true;
    const auto member = json["member"].get<std::string>();
    Entry entry{.path = path_, .member = path_of_key(member)};
    if (!filter.accepts(entry.member)) {
      continue;
    }
    // No normal path holds "//", so no file beside the archive can have this key.
    entry.key = key_of_path(path_) + "//" + member;
    if (const auto repeat = json.value("repeat", 0); repeat > 0) {
      entry.key += "//" + std::to_string(repeat + 1);
    }
    return entry;
  }
  return std::nullopt;
}

std::string ArchiveReader::fetch(const std::string& file) {
  offered_ = false;
  process_.send("take " + key_of_path(file));
  const Json json = Json::parse(answer().value_or(""), nullptr, false);
  if (!json.is_object()) {
    ended_ = true;
    return "cannot be unpacked: the process that does it ended by " + how_it_ended(process_.end());
  }
  return json.value("failed", std::string());
}

}  // namespace vantage::batch
