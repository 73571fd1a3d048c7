// SPDX-License-Identifier: MIT
#include "batch/archive_reader.h"

#include <utility>

#include <unistd.h>

#include "batch/json_text.h"
#include "batch/naming.h"

namespace vantage::batch {
namespace {

// The largest dictionary of an .xz file is 1.5 GiB.
constexpr std::uint64_t kUnpackerMemory = 2'000'000'000;

/// What the process that unpacks says: of an entry, of what became of one, or that there are no more.
struct Answer {
  explicit Answer(const Json& json)
      : number(json.contains("number") ? std::optional(json.at("number").get<std::uint64_t>())
                                       : std::nullopt),
        member(json.value("member", "")),
        problem(json.value("problem", "")),
        repeat(json.value("repeat", 0)),
        failed(json.value("failed", "")),
        reason(json.value("reason", "input")) {}

  std::optional<std::uint64_t> number;  // of the entry, if it is about one
  std::string member;                   // its name in the archive
  std::string problem;                  // why it, or all that follows, cannot be read
  int repeat;                           // how many before it have its name
  std::string failed;                   // why it could not be unpacked
  std::string reason;                   // of that, in a word
};

/// \return nothing if there is no line, or it makes no sense: the process is lost.
std::optional<Answer> parsed(const std::optional<std::string>& line) {
  try {
    return line ? std::optional<Answer>(parsed_json(*line)) : std::nullopt;
  } catch (const Json::exception&) {
    return std::nullopt;
  }
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
    const std::optional<Answer> said = parsed(answer());
    if (limits_.stop.stop_requested()) {
      ended_ = true;
      return std::nullopt;
    }
    if (!said) {
      const End end = end_of_process();
      if (++deaths_ >= limits_.attempts) {
        return broken("what comes here " + end.words, end.reason);
      }
      start();
      continue;
    }
    deaths_ = 0;
    if (!said->number && !said->problem.empty()) {
      return broken(said->problem, "input");
    }
    if (!said->number) {
      ended_ = true;
      return std::nullopt;
    }
    at_ = *said->number;
    passed_ = at_;
    offered_ = true;
    Entry entry{.path = path_, .member = path_of_key(said->member)};
    entry.problem = said->problem;
    if (!said->member.empty() && !filter.accepts(entry.member)) {
      continue;
    }
    // No normal path holds "//", so no file beside the archive can have this key.
    // No key_of_path() holds a single backslash before an e or an r, so no entry can be called so.
    entry.key = key_of_path(path_) + "//" +
                (said->member.empty() ? "\\entry " + std::to_string(at_) : said->member);
    if (said->repeat > 0) {
      entry.key += "\\repeat " + std::to_string(said->repeat + 1);
    }
    return entry;
  }
  return std::nullopt;
}

/// After a new start before the entry that next() gave last: whether it is there again.
bool ArchiveReader::is_offered_again() {
  const std::optional<Answer> said = parsed(answer());
  return said && said->number == at_;
}

void ArchiveReader::fetch(Entry& entry, const std::string& file) {
  offered_ = false;
  for (int attempt = 1;; ++attempt) {
    process_->send("take " + json_text(Json(key_of_path(file))));
    if (const std::optional<Answer> said = parsed(answer())) {
      entry.problem = said->failed;
      entry.reason = said->reason;
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
