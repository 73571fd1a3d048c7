// SPDX-License-Identifier: MIT
#include "batch/runner.h"

#include <algorithm>
#include <cerrno>
#include <deque>
#include <functional>
#include <list>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <unordered_set>
#include <utility>

#include "vantage/core/error.h"
#include "vantage/core/version.h"

#include "batch/crew.h"
#include "batch/file_stamp.h"
#include "batch/naming.h"
#include "batch/no_room.h"
#include "batch/result_folders.h"
#include "batch/result_heirs.h"

namespace vantage::batch {
namespace {

// Models that wait for an equal one to be finished; beyond this nothing new is taken up.
constexpr std::size_t kMostWaiting = 1024;
// The same for what is unpacked from archives and not done with yet, whatever it waits for.
constexpr std::size_t kMostUnpacked = 64;
constexpr std::uint64_t kMostUnpackedBytes = 1'000'000'000;

std::int64_t now_ms() {
  return std::chrono::duration_cast<std::chrono::milliseconds>(
             std::chrono::system_clock::now().time_since_epoch())
      .count();
}

class Runner {
 public:
  using Report = std::function<void(const RunnerCounts&, const ModelRecord*)>;

  Runner(EntrySource& source, ResultBook& book, const RunnerOptions& options,
         const std::stop_token& stop, const Report& report)
      : source_(source),
        book_(book),
        options_(options),
        stop_(stop),
        report_(report),
        root_(options.folder, options.work_name),
        heirs_(
            book, root_,
            {.own_folder = [this](const ModelRecord& heir) { return own_folder(heir); },
             .is_claimed = [this](const std::string& folder) { return claims_.contains(folder); }}),
        started_ms_(std::max(now_ms(), book.latest_ms())),
        crew_(options, root_, stop) {}

  RunnerCounts run() {
    crew_.clear_work();
    try {
      while (step()) {
      }
    } catch (...) {
      crew_.kill();
      crew_.remove_work();
      throw;
    }
    crew_.kill();
    crew_.remove_work();
    book_.finish();
    return counts_;
  }

 private:
  /// \return false once everything has ended.
  bool step() {
    fill();
    if (stop_.stop_requested()) {
      crew_.kill();
      book_.finish();
      throw Cancelled();
    }
    while (!ready_.empty() && crew_.has_idle()) {
      Job& job = *ready_.front();
      ready_.pop_front();
      crew_.start(job, source_ended_ && ready_.empty());
    }
    if (jobs_.empty()) {
      return !source_ended_;
    }
    for (const CrewEvent& event : crew_.wait()) {
      answer(event);
    }
    decide();
    report_(counts_, nullptr);
    return true;
  }

  /// Takes up entries until every worker has a next one; while there is work, without waiting for a
  /// slow pipe.
  void fill() {
    while (!source_ended_ && ready_.size() < static_cast<std::size_t>(options_.workers) &&
           waiting_ < kMostWaiting && unpacked_ < kMostUnpacked &&
           unpacked_bytes_ < kMostUnpackedBytes && !stop_.stop_requested() &&
           (jobs_.empty() || source_.has_more_now())) {
      std::optional<Entry> entry;
      try {
        entry = source_.next();
      } catch (const Cancelled&) {
        return;  // step() ends the run in order
      }
      if (entry) {
        take_up(std::move(*entry));
      } else {
        source_ended_ = true;
      }
    }
  }

  void take_up(Entry entry) {
    Job job;
    ModelRecord& record = job.record;
    record.key = entry.key;
    record.position = entry.position;
    record.stamp = stamp_of(entry.path);
    record.options = options_.options_hash(entry);
    asked_.insert(record.options);
    record.version = version();
    record.name = entry.model_name();
    job.file = entry.path;
    job.entry = std::move(entry);
    job.before = book_.find(record.key);
    if (!listed_.insert(std::hash<std::string>{}(record.key)).second) {
      counts_.first_repeated = counts_.repeated++ == 0 ? record.key : counts_.first_repeated;
      report_(counts_, nullptr);
      return;
    }
    if (is_settled(job)) {
      ++counts_.skipped;
      counts_.skipped_failed += job.before && job.before->status == "failed" ? 1 : 0;
      counts_.note_doubt(job.before);
      report_(counts_, nullptr);
      return;
    }
    jobs_.push_back(std::move(job));
    Job& kept = jobs_.back();
    if (kept.entry.problem.empty() && !kept.entry.member.empty()) {
      fetch(kept);
    }
    if (stop_.stop_requested()) {  // what was being unpacked is not known to be broken
      remove(kept);
      return;
    }
    if (kept.entry.reason == "disk") {
      throw IoError(options_.folder, kNoRoom, ENOSPC);
    }
    if (!kept.entry.problem.empty()) {
      fail(kept, kept.entry.reason, kept.entry.problem);
    } else {
      make_ready(kept);
    }
  }

  /// The earliest in the input is the next to get a worker: decide() lets nothing run before what comes
  /// ahead of it has been read, so later ones might else have all workers and wait for ever.
  void make_ready(Job& job) {
    job.stage = Stage::Ready;
    ready_.insert(std::upper_bound(ready_.begin(), ready_.end(), &job,
                                   [](const Job* a, const Job* b) {
                                     return a->entry.position < b->entry.position;
                                   }),
                  &job);
  }

  /// Whether an earlier record still says how this model ends.
  bool is_settled(const Job& job) {
    if (!job.before) {
      return false;
    }
    const ModelRecord& before = *job.before;
    if (before.timings.finished_ms > started_ms_) {
      return true;
    }
    return !options_.verify && same_question(before, job.record) &&
           before.stamp == job.record.stamp && are_as_they_were(before.beside, job.entry.path) &&
           still_answers(before);
  }

  /// Whether an earlier record's results are there.
  bool still_answers(const ModelRecord& before) {
    if (before.status == "failed") {
      return !options_.retry_failed && !is_done_elsewhere(before);
    }
    if (before.duplicate_of.empty()) {
      return !before.folder.empty() && root_.is_folder(model_folder(before.folder)) &&
             (!options_.verify || holds_named_files(root_, before));
    }
    const std::optional<ModelRecord> first = book_.find_content(before);
    return first && still_answers(*first);
  }

  /// Whether a model that could not be done, or not read, has an equal one that could, in another shard say.
  bool is_done_elsewhere(const ModelRecord& failed) {
    const std::optional<ModelRecord> first = failed.content.empty() || failed.reason == "name"
                                                 ? std::nullopt
                                                 : book_.find_content(failed);
    return first && first->status == "done" && still_answers(*first);
  }

  /// Brings a model out of its archive, into a file of its own.
  void fetch(Job& job) {
    job.unpacked = work_folder(options_.work_name) + "/in-" + std::to_string(++fetched_);
    root_.make_new_folder(job.unpacked);
    const std::string name =
        folder_name("{stem}.{ext}", {.path = job.entry.member, .key = job.record.key});
    job.file = root_.path_of(job.unpacked + "/" + name);
    source_.fetch(job.entry, job.file);
    job.unpacked_bytes = bytes_on_disk(job.file);
    unpacked_bytes_ += job.unpacked_bytes;
    ++unpacked_;
  }

  void answer(const CrewEvent& event) {
    Job& job = *event.job;
    if (event.kind == CrewEvent::Kind::Result) {
      job.record.status = "done";
      take_over(job);
      heirs_.bring(event.staging, job.record);
      ++counts_.done;
      counts_.note_doubt(job.record);
      settle(job);
      return;
    }
    if (event.kind == CrewEvent::Kind::Content) {
      return;
    }
    if (event.reason == "disk") {
      throw IoError(options_.folder, kNoRoom, ENOSPC);
    }
    release(job);
    if (may_pass_next_time(event.reason) && job.attempts < options_.attempts) {
      part_from_equals(job);
      make_ready(job);
      return;
    }
    fail(job, event.reason, event.error);
  }

  /// Settles, in the order of the input, which models run and which equal an earlier one: so the
  /// first of equal models is always the one that runs, however fast the others' workers are.
  void decide() {
    for (auto at = jobs_.begin(); at != jobs_.end();) {
      Job& job = *at++;  // a job that ends is removed
      if (job.stage == Stage::Ready || job.stage == Stage::Hashing) {
        return;
      }
      if (job.stage == Stage::Hashed) {
        decide(job);
      }
    }
  }

  void decide(Job& job) {
    ModelRecord& record = job.record;
    job.before = book_.find(record.key);  // it may have been given results meanwhile
    if (job.before && job.before->content == record.content && same_question(*job.before, record) &&
        still_answers(*job.before)) {
      crew_.dismiss(job);
      keep(job);
      return;
    }
    if (const auto ahead = running_.find(content_key(record)); ahead != running_.end()) {
      crew_.dismiss(job);
      job.stage = Stage::Waiting;
      ahead->second->equals.push_back(&job);
      ++waiting_;
      return;
    }
    const std::optional<ModelRecord> first = book_.find_content(record);
    if (first && first->key != record.key && may_stand_for(*first)) {
      crew_.dismiss(job);
      settle_as_equal(job, *first);
      return;
    }
    if (claim_folder(job)) {
      running_[content_key(record)] = &job;
      Crew::go(job);
    }
  }

  /// Before another attempt, when the file may be another one, and where what ended the model says nothing of
  /// its content. Those that waited are read again.
  void part_from_equals(Job& job) {
    for (Job* other : std::exchange(job.equals, {})) {
      other->attempts = 0;
      make_ready(*other);
      --waiting_;
    }
  }

  /// The content is what it was; only its file was touched, or it was to be verified.
  void keep(Job& job) {
    ModelRecord unchanged = *job.before;
    unchanged.stamp = job.record.stamp;
    unchanged.beside = job.record.beside;
    unchanged.position = job.record.position;
    unchanged.timings.finished_ms = now_after_start();  // so that a merge takes the new stamp
    ++counts_.skipped;
    counts_.skipped_failed += unchanged.status == "failed" ? 1 : 0;
    counts_.note_doubt(unchanged);
    book_.put(unchanged);
    remove(job);
  }

  /// Whether a finished model's results may count for an equal one.
  bool may_stand_for(const ModelRecord& first) {
    return first.status == "failed"
               ? !options_.retry_failed || first.timings.finished_ms > started_ms_
               : still_answers(first);
  }

  /// Names the job's folder. \return false, with the job failed, if that name is not free.
  bool claim_folder(Job& job) {
    ModelRecord& record = job.record;
    record.folder = folder_name(options_.name_template, {.path = job.entry.shown_path(),
                                                         .name = job.entry.name,
                                                         .key = record.key,
                                                         .content = record.content});
    const auto claim = claims_.find(record.folder);
    const bool is_claimed = claim != claims_.end();
    const std::string owner = is_claimed ? claim->second : book_.owner_of(record.folder);
    job.replaces.clear();
    if (!owner.empty() && owner != record.key) {
      if (is_claimed || !may_take_over(owner, record)) {
        refuse_name(job,
                    "holds those of " + owner +
                        "; use a --name with {key8}, or with {hash8} if they are other models");
        return false;
      }
      job.replaces = owner;
    }
    if (!may_be_replaced(root_, record.folder)) {
      refuse_name(job, "is not a folder of results of vantage; move it away, then --retry failed");
      return false;
    }
    claims_[record.folder] = record.key;
    return true;
  }

  void refuse_name(Job& job, const std::string& because) {
    crew_.dismiss(job);
    fail(
        job, "name",
        "its results would go to '" + std::exchange(job.record.folder, {}) + "', which " + because);
  }

  /// Whether results of the same content, made by an earlier run with what no model of this one asks
  /// for, may be replaced.
  bool may_take_over(const std::string& owner, const ModelRecord& record) {
    const std::optional<ModelRecord> holder = book_.find(owner);
    return holder && holder->content == record.content &&
           (holder->version != record.version || asked_.count(holder->options) == 0);
  }

  /// Where a model's results are to replace those of equal models, these have its results from now on.
  void take_over(const Job& job) {
    const std::optional<ModelRecord> holder =
        job.replaces.empty() ? std::nullopt : book_.find(job.replaces);
    if (holder && holder->folder == job.record.folder) {
      heirs_.make_equal(*holder, job.record);
    }
  }

  /// The folder that a model's results would have, had it been run.
  [[nodiscard]] std::string own_folder(const ModelRecord& record) const {
    const std::string path = path_of_key(record.key);
    return folder_name(
        options_.name_template,
        {.path = path, .name = record.name, .key = record.key, .content = record.content});
  }

  void release(const Job& job) {
    const auto run = running_.find(content_key(job.record));
    if (run != running_.end() && run->second == &job) {
      running_.erase(run);
    }
    const auto claim = claims_.find(job.record.folder);
    if (claim != claims_.end() && claim->second == job.record.key) {
      claims_.erase(claim);
    }
  }

  void fail(Job& job, const std::string& reason, const std::string& error) {
    release(job);
    if (!is_of_content(reason)) {
      part_from_equals(job);
    }
    job.record.status = "failed";
    job.record.reason = reason;
    job.record.error = job.entry.labelled(error);
    job.record.folder.clear();
    job.record.result.clear();
    ++counts_.failed;
    settle(job);
  }

  /// Writes down how the job ended, and with it the models equal to it.
  void settle(Job& job) {
    release(job);
    write(job);
    for (Job* equal : job.equals) {
      --waiting_;
      settle_as_equal(*equal, job.record);
    }
    remove(job);
  }

  void settle_as_equal(Job& job, const ModelRecord& first) {
    job.record.status = first.status;
    job.record.reason = first.reason;
    job.record.error = job.entry.retold(first.error, first.key);
    job.record.duplicate_of = first.key;
    job.record.folder.clear();  // that an earlier attempt, at other content, had claimed
    job.record.result.clear();
    job.record.timings = {};
    ++(first.status == "done" ? counts_.duplicates : counts_.failed);
    if (first.stamp == job.record.stamp && !listed_.contains(std::hash<std::string>{}(first.key))) {
      ++counts_.renamed;  // one file, which the command line has another name for now
    }
    job.attempts = 0;
    write(job);
    remove(job);
  }

  /// Later than any record of an earlier run.
  [[nodiscard]] std::int64_t now_after_start() const { return std::max(now_ms(), started_ms_ + 1); }

  void write(Job& job) {
    job.record.timings.attempts = job.attempts;
    job.record.timings.finished_ms = now_after_start();
    heirs_.remove_unowned(heirs_.replace(job.record));  // results of what the file held before
    report_(counts_, &job.record);
  }

  void remove(const Job& job) {
    if (!job.unpacked.empty()) {
      root_.remove(job.unpacked);
      unpacked_bytes_ -= job.unpacked_bytes;
      --unpacked_;
    }
    jobs_.remove_if([&](const Job& other) { return &other == &job; });
  }

  EntrySource& source_;
  ResultBook& book_;
  const RunnerOptions& options_;
  std::stop_token stop_;
  const Report& report_;
  const ConfinedFolder root_;
  ResultHeirs heirs_;
  std::list<Job> jobs_{};                        // in the order of the input
  std::deque<Job*> ready_{};                     // in that order, too
  std::map<std::string, Job*> running_{};        // by content and options
  std::unordered_set<std::size_t> listed_{};     // hashes of keys: of equal ones the first counts
  std::map<std::string, std::string> claims_{};  // folder → key of the running model
  std::set<std::string> asked_{};                // options of all models so far
  std::size_t waiting_ = 0;
  std::size_t unpacked_ = 0;
  std::uint64_t unpacked_bytes_ = 0;
  std::int64_t fetched_ = 0;
  std::int64_t started_ms_;  // later than every record of earlier runs, whatever their clocks
  bool source_ended_ = false;
  RunnerCounts counts_{};
  Crew crew_;  // last: workers end before what they work on
};

}  // namespace

RunnerCounts run_batch(EntrySource& source, ResultBook& book, const RunnerOptions& options,
                       const std::stop_token& stop,
                       const std::function<void(const RunnerCounts&, const ModelRecord*)>& report) {
  return Runner(source, book, options, stop, report).run();
}

}  // namespace vantage::batch
