// SPDX-License-Identifier: MIT
#include "batch/runner.h"

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <deque>
#include <filesystem>
#include <list>
#include <map>
#include <memory>
#include <optional>
#include <utility>

#include <nlohmann/json.hpp>
#include <poll.h>
#include <sys/eventfd.h>
#include <sys/stat.h>
#include <unistd.h>

#include "vantage/core/error.h"
#include "vantage/core/version.h"

#include "batch/content_hash.h"
#include "batch/naming.h"
#include "batch/result_folder.h"

namespace vantage::batch {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;
using Json = nlohmann::json;

// Models that wait for an equal one to be finished; beyond this nothing new is taken up.
constexpr std::size_t kMostWaiting = 4096;
// A worker that says nothing is looked at this often, for its time limit.
constexpr int kPollMs = 200;

FileStamp stamp_of(const std::string& path) {
  struct stat status {};

  if (path.empty() || ::stat(path.c_str(), &status) != 0) {
    return {};
  }
  return {status.st_size, status.st_mtim.tv_sec * 1'000'000'000LL + status.st_mtim.tv_nsec,
          status.st_ino};
}

std::int64_t now_ms() {
  return std::chrono::duration_cast<std::chrono::milliseconds>(
             std::chrono::system_clock::now().time_since_epoch())
      .count();
}

/// Wakes a poll when a stop is requested.
class StopEvent {
 public:
  explicit StopEvent(const std::stop_token& stop)
      : descriptor_(::eventfd(0, EFD_CLOEXEC)), callback_(stop, [this] {
          const std::uint64_t one = 1;
          [[maybe_unused]] const auto done = ::write(descriptor_, &one, sizeof one);
        }) {}

  StopEvent(const StopEvent&) = delete;
  StopEvent& operator=(const StopEvent&) = delete;

  ~StopEvent() { ::close(descriptor_); }

  [[nodiscard]] int descriptor() const { return descriptor_; }

 private:
  int descriptor_;
  std::stop_callback<std::function<void()>> callback_;
};

struct Seat;

/// Where a model is between its place in the input and its record.
enum class Stage {
  Ready,    ///< Waits for a worker.
  Hashing,  ///< A worker reads it.
  Hashed,   ///< Its content is known; whether it runs is decided in the order of the input.
  Running,  ///< A worker is at it.
  Waiting,  ///< An equal model is ahead of it.
};

struct Job {
  Entry entry{};
  ModelRecord record{};
  std::optional<ModelRecord> before{};  // what the book said when it was taken up
  Stage stage = Stage::Ready;
  Seat* seat = nullptr;
  int attempts = 0;
  Clock::time_point start{};
  std::vector<Job*> equals{};  // waiting for this one
};

/// A worker and what it is doing.
struct Seat {
  std::unique_ptr<WorkerProcess> process{};
  Job* job = nullptr;
  std::string staging{};
};

class Runner {
 public:
  Runner(EntrySource& source, ResultBook& book, const RunnerOptions& options,
         const std::stop_token& stop,
         const std::function<void(const RunnerCounts&, const ModelRecord*)>& report)
      : source_(source),
        book_(book),
        options_(options),
        stop_(stop),
        report_(report),
        stop_event_(stop),
        seats_(static_cast<std::size_t>(options.workers)) {}

  RunnerCounts run() {
    clear_work();
    while (true) {
      if (stop_.stop_requested()) {
        seats_.clear();  // kills what is in flight
        clear_work();
        book_.finish();
        throw Cancelled();
      }
      fill();
      if (jobs_.empty()) {
        break;
      }
      dispatch();
      wait();
      enforce_time();
      decide();
    }
    seats_.clear();
    clear_work();
    book_.finish();
    return counts_;
  }

 private:
  void clear_work() const {
    std::error_code error;
    fs::remove_all(work_folder(options_.folder, options_.work_name), error);
    fs::create_directories(work_folder(options_.folder, options_.work_name), error);
    if (error) {
      throw IoError(work_folder(options_.folder, options_.work_name), "cannot be created",
                    error.value());
    }
  }

  /// Takes up entries until every seat has a next one.
  void fill() {
    while (!source_ended_ && ready_.size() < seats_.size() && waiting_count_ < kMostWaiting &&
           !stop_.stop_requested()) {
      std::optional<Entry> entry = source_.next();
      if (!entry) {
        source_ended_ = true;
        break;
      }
      take_up(std::move(*entry));
    }
  }

  void take_up(Entry entry) {
    Job job;
    ModelRecord& record = job.record;
    record.key = entry.key;
    record.position = entry.position;
    record.stamp = stamp_of(entry.path);
    record.options = options_.options_hash(entry.up);
    record.version = version();
    record.name = entry.name.empty() ? fs::path(entry.shown_path()).stem().string() : entry.name;
    record.name = key_of_path(record.name);
    job.entry = std::move(entry);
    job.before = book_.find(record.key);
    if (job.before && is_settled(*job.before, record)) {
      ++counts_.skipped;
      counts_.skipped_failed += job.before->status == "failed" ? 1 : 0;
      report_(counts_, nullptr);
      return;
    }
    jobs_.push_back(std::move(job));
    Job& kept = jobs_.back();
    if (!kept.entry.problem.empty()) {
      fail(kept, "input", kept.entry.problem);
    } else {
      ready_.push_back(&kept);
    }
  }

  /// Whether an earlier record still says how this model ends.
  bool is_settled(const ModelRecord& before, const ModelRecord& now) {
    if (options_.verify || !same_question(before, now) || !(before.stamp == now.stamp)) {
      return false;
    }
    return still_answers(before);
  }

  static bool same_question(const ModelRecord& before, const ModelRecord& now) {
    return before.options == now.options && before.version == now.version &&
           before.name == now.name;
  }

  /// Whether an earlier record's results are there.
  bool still_answers(const ModelRecord& before) {
    if (before.status == "failed") {
      return !options_.retry_failed;
    }
    if (before.duplicate_of.empty()) {
      std::error_code error;
      return !before.folder.empty() &&
             fs::is_directory(fs::path(models_folder(options_.folder)) / before.folder, error);
    }
    const std::optional<ModelRecord> first = book_.find(before.duplicate_of);
    return first && first->duplicate_of.empty() && first->content == before.content &&
           first->options == before.options && first->version == before.version &&
           still_answers(*first);
  }

  void dispatch() {
    for (Seat& seat : seats_) {
      if (ready_.empty()) {
        return;
      }
      if (seat.job == nullptr) {
        start(seat, *ready_.front());
        ready_.pop_front();
      }
    }
  }

  void start(Seat& seat, Job& job) {
    if (!seat.process) {
      seat.process = std::make_unique<WorkerProcess>(options_.worker_arguments, options_.limits,
                                                     options_.quiet_workers);
    }
    seat.job = &job;
    seat.staging =
        (fs::path(work_folder(options_.folder, options_.work_name)) / std::to_string(++staged_))
            .string();
    std::error_code error;
    if (!fs::create_directory(seat.staging, error)) {
      throw IoError(seat.staging, "cannot be created", error.value());
    }
    ++job.attempts;
    job.stage = Stage::Hashing;
    job.seat = &seat;
    job.start = Clock::now();
    const auto idle = static_cast<int>(
        std::count_if(seats_.begin(), seats_.end(), [](const Seat& s) { return !s.job; }));
    const bool last_ones = source_ended_ && ready_.size() <= 1 && idle > 0;
    const int busy = options_.workers - idle;
    Json order;
    order["path"] = key_of_path(job.entry.path);
    order["key"] = job.record.key;
    order["name"] = job.record.name;
    order["up"] = job.entry.up;
    order["staging"] = key_of_path(seat.staging);
    order["threads"] =
        last_ones ? std::max(options_.threads, options_.spare_threads / busy) : options_.threads;
    seat.process->send(order.dump());
  }

  void wait() {
    std::vector<pollfd> files{{stop_event_.descriptor(), POLLIN, 0}};
    std::vector<Seat*> seats;
    for (Seat& seat : seats_) {
      if (seat.job != nullptr) {
        files.push_back({seat.process->descriptor(), POLLIN, 0});
        seats.push_back(&seat);
      }
    }
    if (::poll(files.data(), files.size(), kPollMs) <= 0) {
      report_(counts_, nullptr);
      return;
    }
    for (std::size_t i = 0; i < seats.size(); ++i) {
      if (files[i + 1].revents != 0) {
        listen(*seats[i]);
      }
    }
  }

  void listen(Seat& seat) {
    if (!seat.process->receive()) {
      const int status = seat.process->end();
      give_up(seat, "crash", "the worker ended by " + how_it_ended(status));
      return;
    }
    while (seat.job != nullptr) {
      const std::optional<std::string> line = seat.process->line();
      if (!line) {
        return;
      }
      const Json answer = Json::parse(*line, nullptr, false);
      if (!answer.is_object()) {
        seat.process->end();
        give_up(seat, "crash", "the worker said something that makes no sense");
      } else if (answer.contains("content")) {
        seat.job->record.content = answer["content"].get<std::string>();
        seat.job->stage = Stage::Hashed;
      } else {
        conclude(seat, answer);
      }
    }
  }

  /// The worker's last word on its model.
  void conclude(Seat& seat, const Json& answer) {
    Job& job = *seat.job;
    take_time(job);
    job.record.timings.peak_bytes = answer.value("peak_bytes", std::int64_t{0});
    if (answer.contains("result")) {
      job.record.result = answer["result"].get<std::string>();
      move_into_place(seat.staging, place_of(job.record.folder));
      leave(seat);
      job.record.status = "done";
      ++counts_.done;
      settle(job);
      return;
    }
    const auto reason = answer.value("reason", std::string("work"));
    const auto error = answer.value("error", std::string("failed"));
    if (reason == "disk") {
      throw IoError(options_.folder, "cannot hold more results; make room and run it again",
                    ENOSPC);
    }
    if (may_pass_next_time(reason)) {
      give_up(seat, reason, error);  // what the worker holds is in doubt
    } else {
      leave(seat);
      fail(job, reason, error);
    }
  }

  static void take_time(Job& job) {
    job.record.timings.seconds = std::chrono::duration<double>(Clock::now() - job.start).count();
  }

  [[nodiscard]] std::string place_of(const std::string& folder) const {
    return (fs::path(models_folder(options_.folder)) / folder).string();
  }

  /// Replaces the seat's worker; its model is tried again if it has attempts left.
  void give_up(Seat& seat, const std::string& reason, const std::string& error) {
    Job& job = *seat.job;
    take_time(job);
    seat.process.reset();
    leave(seat);
    release(job);
    if (job.attempts < options_.attempts) {
      job.stage = Stage::Ready;
      ready_.push_front(&job);
      return;
    }
    fail(job, reason, error);
  }

  static void leave(Seat& seat) {
    std::error_code error;
    fs::remove_all(seat.staging, error);
    seat.job->seat = nullptr;
    seat.job = nullptr;
  }

  void enforce_time() {
    for (Seat& seat : seats_) {
      if (seat.job == nullptr || seat.job->stage == Stage::Hashed) {
        continue;
      }
      const std::chrono::duration<double> used = Clock::now() - seat.job->start;
      if (used.count() > options_.timeout_s) {
        seat.process->end();
        give_up(seat, "timeout",
                "took longer than the time limit of " + limit_text(options_.timeout_s) + " s");
      }
    }
  }

  static std::string limit_text(double seconds) {
    std::string text = std::to_string(seconds);
    text.erase(text.find_last_not_of('0') + 1);
    return text.ends_with('.') ? text.substr(0, text.size() - 1) : text;
  }

  /// Settles, in the order of the input, which models run and which equal an earlier one: so the
  /// first of equal models is always the one that runs, however fast the others' workers are.
  void decide() {
    for (auto at = jobs_.begin(); at != jobs_.end();) {
      Job& job = *at++;  // settling a job removes it
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
    if (job.before && job.before->content == record.content && same_question(*job.before, record) &&
        still_answers(*job.before)) {
      dismiss(job);
      ModelRecord unchanged = *job.before;  // only touched since, or --verify
      unchanged.stamp = record.stamp;
      unchanged.position = record.position;
      ++counts_.skipped;
      counts_.skipped_failed += unchanged.status == "failed" ? 1 : 0;
      book_.put(unchanged);
      remove(job);
      return;
    }
    if (const auto ahead = running_.find(content_key(record)); ahead != running_.end()) {
      dismiss(job);
      job.stage = Stage::Waiting;
      ahead->second->equals.push_back(&job);
      ++waiting_count_;
      return;
    }
    const std::optional<ModelRecord> first = book_.find_content(record);
    if (first && first->key != record.key && may_stand_for(*first)) {
      dismiss(job);
      settle_as_equal(job, *first);
      return;
    }
    if (claim_folder(job)) {
      job.stage = Stage::Running;
      job.start = Clock::now();
      running_[content_key(record)] = &job;
      job.seat->process->send("go");
    }
  }

  static std::string content_key(const ModelRecord& record) {
    return record.content + ' ' + record.options;
  }

  /// Whether a finished model's results may count for an equal one.
  bool may_stand_for(const ModelRecord& first) {
    return first.status == "failed"
               ? !options_.retry_failed || first.timings.finished_ms >= started_ms_
               : still_answers(first);
  }

  /// Names the job's folder. \return false, with the job failed, if another model has that name.
  bool claim_folder(Job& job) {
    ModelRecord& record = job.record;
    record.folder = folder_name(options_.name_template, {.path = job.entry.shown_path(),
                                                         .name = job.entry.name,
                                                         .key = record.key,
                                                         .content = record.content});
    std::string owner = book_.owner_of(record.folder);
    if (const auto claim = claims_.find(record.folder); claim != claims_.end()) {
      owner = claim->second;
    }
    if (owner.empty() || owner == record.key) {
      claims_[record.folder] = record.key;
      return true;
    }
    std::optional<ModelRecord> holder = book_.find(owner);
    if (holder && holder->content == record.content) {  // an earlier run's, with other options
      holder->folder.clear();
      book_.put(*holder);
      claims_[record.folder] = record.key;
      return true;
    }
    dismiss(job);
    const std::string folder = std::exchange(record.folder, {});
    fail(job, "name",
         "its results would go to '" + folder + "', which holds those of " + owner +
             "; use a --name with {hash8} or {key8}");
    return false;
  }

  /// Tells the job's worker to forget it.
  static void dismiss(Job& job) {
    Seat& seat = *job.seat;
    seat.process->send("skip");
    leave(seat);
  }

  void release(Job& job) {
    running_.erase(content_key(job.record));
    claims_.erase(job.record.folder);
  }

  void fail(Job& job, const std::string& reason, const std::string& error) {
    release(job);
    job.record.status = "failed";
    job.record.reason = reason;
    job.record.error = error;
    job.record.folder.clear();
    job.record.result.clear();
    ++counts_.failed;
    settle(job);
  }

  /// Writes down how the job ended, and the models equal to it.
  void settle(Job& job) {
    release(job);
    write(job);
    for (Job* equal : job.equals) {
      --waiting_count_;
      if (equal->record.key == job.record.key) {  // listed twice
        ++counts_.skipped;
        remove(*equal);
      } else {
        settle_as_equal(*equal, job.record);
      }
    }
    remove(job);
  }

  void settle_as_equal(Job& job, const ModelRecord& first) {
    job.record.status = first.status;
    job.record.reason = first.reason;
    job.record.error = first.error;
    job.record.duplicate_of = first.key;
    ++(first.status == "done" ? counts_.duplicates : counts_.failed);
    write(job);
    remove(job);
  }

  void write(Job& job) {
    job.record.timings.attempts = job.attempts;
    job.record.timings.finished_ms = now_ms();
    book_.put(job.record);
    if (job.before && !job.before->folder.empty() && job.before->folder != job.record.folder &&
        book_.owner_of(job.before->folder).empty()) {
      std::error_code error;  // results of what the file held before
      fs::remove_all(place_of(job.before->folder), error);
    }
    report_(counts_, &job.record);
  }

  void remove(const Job& job) {
    jobs_.remove_if([&](const Job& other) { return &other == &job; });
  }

  EntrySource& source_;
  ResultBook& book_;
  const RunnerOptions& options_;
  std::stop_token stop_;
  const std::function<void(const RunnerCounts&, const ModelRecord*)>& report_;
  StopEvent stop_event_;
  std::list<Job> jobs_{};  // in the order of the input
  std::deque<Job*> ready_{};
  std::map<std::string, Job*> running_{};        // by content and options
  std::map<std::string, std::string> claims_{};  // folder → key of the running model
  std::size_t waiting_count_ = 0;
  std::int64_t staged_ = 0;
  std::int64_t started_ms_ = now_ms();
  bool source_ended_ = false;
  RunnerCounts counts_{};
  std::vector<Seat> seats_;  // last: its workers end before anything they use
};

}  // namespace

std::string work_folder(const std::string& folder, const std::string& work_name) {
  const fs::path all = fs::path(folder) / ".work";
  return work_name.empty() ? all.string() : (all / work_name).string();
}

std::string models_folder(const std::string& folder) {
  return (fs::path(folder) / "models").string();
}

RunnerCounts run_batch(EntrySource& source, ResultBook& book, const RunnerOptions& options,
                       const std::stop_token& stop,
                       const std::function<void(const RunnerCounts&, const ModelRecord*)>& report) {
  return Runner(source, book, options, stop, report).run();
}

}  // namespace vantage::batch
