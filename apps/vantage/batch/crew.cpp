// SPDX-License-Identifier: MIT
#include "batch/crew.h"

#include <algorithm>
#include <filesystem>
#include <utility>

#include <poll.h>
#include <sys/eventfd.h>
#include <unistd.h>

#include "batch/json_text.h"
#include "batch/naming.h"
#include "batch/result_folders.h"

namespace vantage::batch {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

// Workers that say nothing are looked at this often, for their time limit.
constexpr int kPollMs = 200;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

}  // namespace

Crew::Crew(const RunnerOptions& options, const ConfinedFolder& root, const std::stop_token& stop)
    : options_(options),
      root_(root),
      stop_event_(::eventfd(0, EFD_CLOEXEC)),
      on_stop_(stop,
               [event = stop_event_.number()] {
                 const std::uint64_t one = 1;
                 [[maybe_unused]] const auto done = ::write(event, &one, sizeof one);
               }),
      seats_(static_cast<std::size_t>(options.workers)) {}

bool Crew::has_idle() const {
  return std::any_of(seats_.begin(), seats_.end(), [](const Seat& seat) { return !seat.job; });
}

void Crew::start(Job& job, bool last) {
  // A worker that runs already before one that must be started.
  const auto idle = [](bool running) {
    return [running](const Seat& s) { return !s.job && (s.process != nullptr) == running; };
  };
  auto seat = std::find_if(seats_.begin(), seats_.end(), idle(true));
  seat = seat == seats_.end() ? std::find_if(seats_.begin(), seats_.end(), idle(false)) : seat;
  if (!seat->process) {
    seat->process = std::make_unique<WorkerProcess>(options_.worker_arguments, options_.limits,
                                                    options_.quiet_workers);
  }
  seat->job = &job;
  seat->staging = work_folder(options_.work_name) + "/out-" + std::to_string(++staged_);
  root_.make_new_folder(seat->staging);
  ++job.attempts;
  job.stage = Stage::Hashing;
  job.seat = &*seat;
  job.start = Clock::now();
  const auto busy = static_cast<int>(
      std::count_if(seats_.begin(), seats_.end(), [](const Seat& s) { return s.job != nullptr; }));
  const int shared = last ? options_.spare_threads / busy : 0;
  const Json order = {{"path", key_of_path(job.file)},
                      {"key", job.record.key},
                      {"label", job.entry.label()},
                      {"in_archive", !job.entry.member.empty()},
                      {"file", key_of_path(fs::path(job.entry.shown_path()).filename().string())},
                      {"name", job.record.name},
                      {"up", job.entry.up},
                      {"front", job.entry.front},
                      {"staging", key_of_path(root_.path_of(seat->staging))},
                      {"threads", std::max(options_.threads, shared)},
                      {"seconds", options_.timeout_s}};
  seat->process->send(json_text(order));
}

void Crew::go(Job& job) {
  job.stage = Stage::Running;
  job.start = Clock::now();
  job.seat->process->send("go");
}

void Crew::dismiss(Job& job) {
  job.seat->process->send("skip");
  leave(*job.seat);
}

Job& Crew::leave(Seat& seat) {
  root_.remove(seat.staging);
  Job& job = *std::exchange(seat.job, nullptr);
  job.seat = nullptr;
  return job;
}

std::vector<CrewEvent> Crew::wait() {
  std::vector<pollfd> files{{stop_event_.number(), POLLIN, 0}};
  std::vector<Seat*> busy;
  for (Seat& seat : seats_) {
    if (seat.job != nullptr) {
      files.push_back({seat.process->descriptor(), POLLIN, 0});
      busy.push_back(&seat);
    }
  }
  std::vector<CrewEvent> events;
  if (::poll(files.data(), files.size(), kPollMs) > 0) {
    for (std::size_t i = 0; i < busy.size(); ++i) {
      if (files[i + 1].revents != 0) {
        listen(*busy[i], events);
      }
    }
  }
  enforce_time(events);
  return events;
}

void Crew::listen(Seat& seat, std::vector<CrewEvent>& events) {
  if (!seat.process->receive()) {
    const std::string end = how_it_ended(seat.process->end());
    events.push_back(lost(seat, "crash", "the worker ended by " + end));
    return;
  }
  while (seat.job != nullptr) {
    const std::optional<std::string> line = seat.process->line();
    if (!line) {
      return;
    }
    try {
      conclude(seat, *line, events);
    } catch (const Json::exception&) {
      events.push_back(lost(seat, "crash", "the worker said something that makes no sense"));
    }
  }
}

void Crew::conclude(Seat& seat, const std::string& line, std::vector<CrewEvent>& events) {
  const Json answer = parsed_json(line);
  Job& job = *seat.job;
  if (answer.contains("content")) {
    job.record.content = answer.at("content").get<std::string>();
    // Of a model in an archive nothing beside it is read, and what is beside the archive is not asked for.
    job.record.beside =
        job.entry.member.empty() ? beside_of(answer.at("beside")) : std::vector<StampBeside>();
    job.stage = Stage::Hashed;
    events.push_back({.job = &job, .kind = CrewEvent::Kind::Content});
    return;
  }
  job.record.timings.seconds = seconds_since(job.start);
  job.record.timings.peak_bytes = answer.value("peak_bytes", std::int64_t{0});
  if (answer.contains("result")) {
    job.record.result = answer.at("result").get<std::string>();
    seat.job = nullptr;
    job.seat = nullptr;
    events.push_back(
        {.job = &job, .kind = CrewEvent::Kind::Result, .staging = std::move(seat.staging)});
    return;
  }
  CrewEvent failure{.job = &job,
                    .reason = answer.value("reason", std::string("work")),
                    .error = answer.value("error", std::string("failed"))};
  if (may_pass_next_time(failure.reason)) {
    seat.process.reset();  // what it holds is in doubt
  }
  leave(seat);
  events.push_back(std::move(failure));
}

CrewEvent Crew::lost(Seat& seat, std::string reason, std::string error) {
  seat.process.reset();
  Job& job = leave(seat);
  job.record.timings.seconds = seconds_since(job.start);
  return {.job = &job, .reason = std::move(reason), .error = std::move(error)};
}

void Crew::enforce_time(std::vector<CrewEvent>& events) {
  for (Seat& seat : seats_) {
    // A model that is read and waits for its turn uses up nobody's time.
    if (seat.job != nullptr && seat.job->stage != Stage::Hashed &&
        seconds_since(seat.job->start) > options_.timeout_s) {
      events.push_back(
          lost(seat, "timeout",
               "took longer than the time limit of " + seconds_text(options_.timeout_s) + " s"));
    }
  }
}

void Crew::kill() {
  for (Seat& seat : seats_) {
    seat.process.reset();
    seat.job = nullptr;
  }
}

void Crew::remove_work() const {
  root_.remove(work_folder(options_.work_name));
}

void Crew::clear_work() const {
  remove_work();
  root_.make_folders(work_folder(options_.work_name));
}

}  // namespace vantage::batch
