// SPDX-License-Identifier: MIT
#include "batch/archive_reader.h"

#include <utility>

#include <nlohmann/json.hpp>
#include <unistd.h>

#include "batch/naming.h"

namespace vantage::batch {
namespace {

using Json = nlohmann::json;

// The largest dictionary of an .xz file is 1.5 GiB.
constexpr std::uint64_t kUnpackerMemory = 2'000'000'000;

Json parsed(const std::optional<std::string>& line) {
  return Json::parse(line.value_or(""), nullptr, false);
}

}  // namespace

ArchiveReader::ArchiveReader(std::string path, ArchiveLimits limits)
    : path_(std::move(path)), limits_(std::move(limits)) {
  start();
}

void ArchiveReader::start() {
  process_.reset();
  process_ = std::make_unique<WorkerProcess>(
      std::vector<std::string>{"batch-unpack", "--", key_of_path(path_),
                               std::to_string(limits_.entry_bytes), std::to_string(passed_)},
      WorkerLimits{.memory_bytes = kUnpackerMemory, .file_bytes = limits_.entry_bytes}, true);
}

std::optional<std::string> ArchiveReader::answer() {
  return process_->await_line(limits_.timeout_s, limits_.stop);
}

ArchiveReader::End ArchiveReader::end_of_process() {
  if (!process_->has_closed()) {
    process_->end();
    return {"timeout",
            "took longer than the time limit of " + seconds_text(limits_.timeout_s) + " s"};
  }
  return {"crash", "ended the process that unpacks by " + how_it_ended(process_->end())};
}

Entry ArchiveReader::broken(const std::string& problem, const std::string& reason) {
  ended_ = true;
  Entry entry{.key = key_of_path(path_), .path = path_};
  entry.problem = "the rest of this archive cannot be read: " + problem;
  entry.reason = reason;
  return entry;
}

std::optional<Entry> ArchiveReader::next(const EntryFilter& filter) {
  while (!ended_) {
    if (std::exchange(offered_, false)) {
      process_->send("skip");
    }
    const Json json = parsed(answer());
    if (limits_.stop.stop_requested()) {
      ended_ = true;
      return std::nullopt;
    }
    if (!json.is_object()) {
      const End end = end_of_process();
      if (++deaths_ >= limits_.attempts) {
        return broken("what comes here " + end.words, end.reason);
      }
      start();
      continue;
    }
    deaths_ = 0;
    if (json.contains("problem") && !json.contains("number")) {
      return broken(json["problem"].get<std::string>(), "input");
    }
    if (!json.contains("number")) {
      ended_ = true;
      return std::nullopt;
    }
    at_ = json["number"].get<std::uint64_t>();
    passed_ = at_;
    offered_ = true;
    const auto member = json.value("member", std::string());
    Entry entry{.path = path_, .member = path_of_key(member)};
    entry.problem = json.value("problem", std::string());
    if (!member.empty() && !filter.accepts(entry.member)) {
      continue;
    }
    // No normal path holds "//", so no file beside the archive can have this key.
    // No key_of_path() holds a single backslash before an e or an r, so no entry can be called so.
    entry.key =
        key_of_path(path_) + "//" + (member.empty() ? "\\entry " + std::to_string(at_) : member);
    if (const auto repeat = json.value("repeat", 0); repeat > 0) {
      entry.key += "\\repeat " + std::to_string(repeat + 1);
    }
    return entry;
  }
  return std::nullopt;
}

/// After a new start before the entry that next() gave last: whether it is there again.
bool ArchiveReader::is_offered_again() {
  const Json json = parsed(answer());
  return json.is_object() && json.value("number", std::uint64_t{0}) == at_;
}

void ArchiveReader::fetch(Entry& entry, const std::string& file) {
  offered_ = false;
  for (int attempt = 1;; ++attempt) {
    process_->send("take " + Json(key_of_path(file)).dump());
    const Json json = parsed(answer());
    if (json.is_object()) {
      entry.problem = json.value("failed", std::string());
      entry.reason = json.value("reason", std::string("input"));
      return;
    }
    if (limits_.stop.stop_requested()) {
      ended_ = true;
      return;
    }
    const End end = end_of_process();
    ::unlink(file.c_str());
    const bool again = attempt < limits_.attempts;
    passed_ = again ? at_ - 1 : at_;
    start();
    passed_ = at_;  // from now on
    if (!again || !is_offered_again()) {
      entry.problem = "cannot be unpacked: it " + end.words;
      entry.reason = end.reason;
      if (again) {
        start();
      }
      return;
    }
  }
}

}  // namespace vantage::batch
