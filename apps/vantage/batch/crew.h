// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "batch/confined_folder.h"
#include "batch/descriptor.h"
#include "batch/entry_source.h"
#include "batch/model_record.h"
#include "batch/runner.h"
#include "batch/worker_process.h"

/// \file
/// The worker processes of a batch, and the models they are at.

namespace vantage::batch {

struct Seat;

/// Where a model is between its place in the input and its record.
enum class Stage {
  Ready,    ///< Waits for a worker.
  Hashing,  ///< A worker reads it.
  Hashed,   ///< Its content is known; whether it runs is decided in the order of the input.
  Running,  ///< A worker is at it.
  Waiting,  ///< An equal model is ahead of it.
};

/// A model on its way.
struct Job {
  Entry entry{};                                  ///< From the source.
  std::string file{};                             ///< What the worker reads.
  std::string unpacked{};                         ///< Folder of an archive's entry, to remove.
  std::uint64_t unpacked_bytes = 0;               ///< What that takes on the disk.
  ModelRecord record{};                           ///< As far as it is known.
  std::optional<ModelRecord> before{};            ///< What the book said when it was taken up.
  std::string replaces{};                         ///< Key of the model whose folder it takes.
  Stage stage = Stage::Ready;                     ///< Where it is.
  Seat* seat = nullptr;                           ///< Where a worker is at it.
  int attempts = 0;                               ///< Begun so far.
  std::chrono::steady_clock::time_point start{};  ///< Of this stage of this attempt.
  std::vector<Job*> equals{};                     ///< Models that wait for this one.
};

/// A place for a worker, and what it is doing.
struct Seat {
  std::unique_ptr<WorkerProcess> process{};  ///< Started when first needed.
  Job* job = nullptr;                        ///< Null: idle.
  std::string staging{};                     ///< Name of the folder for the job's results.
};

/// What a worker, or its end, has said about its job.
struct CrewEvent {
  enum class Kind { Content, Result, Failure };
  Job* job = nullptr;         ///< After Failure and Result its seat is free.
  Kind kind = Kind::Failure;  ///< Content: job->record.content is known.
  std::string staging{};      ///< Of a Result: name of the folder to put in place.
  std::string reason{};       ///< Of a Failure.
  std::string error{};        ///< Of a Failure.
};

/// A fixed number of workers, each replaced when it crashes, hangs or has run into a limit.
class Crew {
 public:
  Crew(const RunnerOptions& options, const ConfinedFolder& root, const std::stop_token& stop);
  Crew(const Crew&) = delete;
  Crew& operator=(const Crew&) = delete;

  [[nodiscard]] bool has_idle() const;
  /// Gives a job to an idle worker. \param last whether no other job will follow, so that idle
  /// workers' threads are free.
  void start(Job& job, bool last);
  /// Lets a Hashed job run.
  static void go(Job& job);
  /// Takes a Hashed job from its worker.
  void dismiss(Job& job);
  /// Waits a moment for something to happen. \return everything that did.
  std::vector<CrewEvent> wait();
  /// Kills all workers; their jobs are nobody's.
  void kill();
  /// Makes the folder that holds work in progress, empty. \throw IoError
  void clear_work() const;
  /// Removes it.
  void remove_work() const;

 private:
  void listen(Seat& seat, std::vector<CrewEvent>& events);
  /// \throw Json::exception if the line makes no sense; the seat is as it was then.
  void conclude(Seat& seat, const std::string& line, std::vector<CrewEvent>& events);
  void enforce_time(std::vector<CrewEvent>& events);
  CrewEvent lost(Seat& seat, std::string reason, std::string error);
  Job& leave(Seat& seat);

  const RunnerOptions& options_;
  const ConfinedFolder& root_;
  Descriptor stop_event_;  // outlives what writes to it
  std::stop_callback<std::function<void()>> on_stop_;
  std::int64_t staged_ = 0;
  std::vector<Seat> seats_;
};

}  // namespace vantage::batch
