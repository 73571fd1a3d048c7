// SPDX-License-Identifier: MIT
#include "batch_slurm.h"

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <memory>
#include <thread>
#include <vector>

#include "vantage/core/error.h"
#include "vantage/core/version.h"

#include "batch/file_stamp.h"
#include "batch/result_heirs.h"
#include "batch/shard_log.h"
#include "batch/shard_merge.h"
#include "batch/shard_plan.h"
#include "batch/shell_word.h"
#include "settings.h"
#include "terminal.h"
#include "value_checks.h"

namespace vantage::cli {
namespace {

namespace fs = std::filesystem;
using batch::Entry;

/// A shard should last minutes: Slurm takes a second or two to start a task. At about three seconds
/// a model this is three minutes. [ours]
constexpr std::int64_t kModelsPerShard = 64;
/// Slurm's own default for the largest index of an array is 1000.
constexpr std::uint32_t kMostShards = 1000;
/// Between two looks at the queue: often at first, then so that thousands of batches do not disturb
/// the controller.
constexpr std::chrono::milliseconds kFirstLook(500);
constexpr std::chrono::milliseconds kLaterLook(5000);

// In the batch's folder.
constexpr const char* kFolder = "slurm";
constexpr const char* kPlan = "slurm/plan.jsonl";
constexpr const char* kJob = "slurm/job";
constexpr const char* kScript = "slurm/shard.sh";

/// One collection on its way through Slurm.
class SlurmRun {
 public:
  SlurmRun(Session& session, batch::ResultsStore& store, const batch::ConfinedFolder& folder,
           const SlurmFlags& flags, const SlurmBatch& batch)
      : session_(session), store_(store), folder_(folder), flags_(flags), batch_(batch) {}

  void plan(batch::EntrySource& entries) {
    folder_.make_folders(kFolder);
    models_ = session_.reading([&] { return batch::write_plan(entries, folder_, kPlan); });
    if (flags_.request.shards == 0) {
      const std::int64_t wanted = (models_ + kModelsPerShard - 1) / kModelsPerShard;
      flags_.request.shards =
          static_cast<std::uint32_t>(std::clamp<std::int64_t>(wanted, 1, kMostShards));
    }
    if (flags_.balance) {
      batch::balance_plan(folder_, kPlan, flags_.request.shards);
    }
  }

  /// \return whether all has ended.
  bool run() {
    join_earlier_job();
    for (int attempt = 0; attempt < batch_.attempts; ++attempt) {
      const std::vector<std::uint32_t> shards = shards_with(
          [&](const Entry& entry) { return (batch_.verify && attempt == 0) || !has_ended(entry); });
      if (shards.empty()) {
        return true;
      }
      remove_links();
      folder_.write(kScript, batch::slurm_script(flags_.request));
      const std::string job = batch::submit_slurm(flags_.request, shards);
      folder_.write(kJob, job + "\n");
      session_.say("job " + job + ": " + plural(static_cast<std::size_t>(models_), "model") +
                   " in " + plural(shards.size(), "shard"));
      if (flags_.detach) {
        session_.say("when it has ended: vantage results merge " +
                     batch::shell_word(flags_.request.folder));
        return false;
      }
      await(job);
    }
    give_up();
    return true;
  }

 private:
  /// A job that an earlier parent submitted, and did not live to see the end of.
  void join_earlier_job() {
    constexpr std::size_t kLongestId = 32;
    const std::string text = folder_.beginning_of(kJob, kLongestId);
    const std::string job = text.substr(0, text.find('\n'));
    if (batch::is_job(job) && has_tasks(batch::slurm_progress(job, session_.run()))) {
      session_.say("job " + job + " of an earlier run is still there; waiting for it first");
      await(job);
    } else {
      batch::merge_shards({flags_.request.folder}, store_, folder_);
    }
  }

  /// Slurm appends to logs through links: what is none of its logs is not left in their place.
  void remove_links() const {
    std::error_code error;
    const fs::directory_iterator files(folder_.path_of(kFolder), error);
    for (const fs::directory_entry& file : files) {
      if (file.is_symlink(error)) {
        folder_.remove(std::string(kFolder) + "/" + file.path().filename().string());
      }
    }
  }

  static bool has_tasks(const batch::SlurmProgress& progress) {
    return progress.waiting + progress.running > 0;
  }

  void await(const std::string& job) {
    const RunContext run = session_.run();
    auto pause = kFirstLook;
    try {
      for (batch::SlurmProgress progress = batch::slurm_progress(job, run); has_tasks(progress);
           progress = batch::slurm_progress(job, run)) {
        run.advance("job " + job + ": " + std::to_string(progress.running) + " running, " +
                        std::to_string(progress.waiting) + " waiting",
                    0.0);
        for (auto slept = kFirstLook; slept <= pause; slept += kFirstLook) {
          std::this_thread::sleep_for(kFirstLook);
          run.check();
        }
        pause = std::min(2 * pause, kLaterLook);
      }
    } catch (const Cancelled&) {
      batch::cancel_slurm(job);
      batch::merge_shards({flags_.request.folder}, store_, folder_);
      throw;
    }
    batch::cancel_slurm(job);  // tasks that are held would stay for ever
    folder_.remove(kJob);
    batch::merge_shards({flags_.request.folder}, store_, folder_);
  }

  bool has_ended(const Entry& entry) {
    const std::optional<batch::ModelRecord> record = store_.find(entry.key);
    return record && batch_.is_current(entry, *record);
  }

  template <class Take>
  void for_each_planned(Take&& take) {
    const auto entries = batch::entries_of_manifest(folder_.path_of(kPlan));
    while (const std::optional<Entry> entry = entries->next()) {
      take(*entry);
    }
  }

  /// Those that have an entry for which `is_to_run` holds.
  template <class IsToRun>
  std::vector<std::uint32_t> shards_with(IsToRun&& is_to_run) {
    std::vector<bool> needed(flags_.request.shards, false);
    for_each_planned([&](const Entry& entry) {
      if (is_to_run(entry)) {
        needed[batch::shard_of(entry, flags_.request.shards)] = true;
      }
    });
    std::vector<std::uint32_t> shards;
    for (std::uint32_t i = 0; i < needed.size(); ++i) {
      if (needed[i]) {
        shards.push_back(i);
      }
    }
    return shards;
  }

  /// Nothing is to be left without a record: what no attempt could end has failed.
  void give_up() {
    std::vector<Entry> lost;
    for_each_planned([&](const Entry& entry) {
      if (!has_ended(entry)) {
        lost.push_back(entry);
      }
    });
    batch::ResultHeirs heirs(store_, folder_);
    for (const Entry& entry : lost) {
      batch::ModelRecord record;
      record.key = entry.key;
      record.position = entry.position;
      record.stamp = batch::stamp_of(entry.path);
      record.version = version();
      record.name = entry.model_name();
      record.status = "failed";
      record.reason = "crash";
      record.error = "its shard ended before it " + std::to_string(batch_.attempts) +
                     " times; see the logs in slurm/, then --retry failed";
      record.timings.attempts = batch_.attempts;
      heirs.remove_unowned(heirs.replace(record));
    }
  }

  Session& session_;
  batch::ResultsStore& store_;
  const batch::ConfinedFolder& folder_;
  SlurmFlags flags_;
  const SlurmBatch& batch_;
  std::int64_t models_ = 0;
};

}  // namespace

void SlurmFlags::add_to(CLI::App& app) {
  const std::string group = "Slurm";
  request.shards = 0;
  app.add_option("--shards", request.shards,
                 "tasks of the job array; default: one for every 64 models")
      ->check(within(1, 99999))
      ->group(group);
  app.add_flag("--balance", balance,
               "deal models to shards by the size of their files instead of by a hash of their key")
      ->group(group);
  app.add_option("--at-once", request.at_once, "at most this many tasks together")
      ->check(within(1, 99999))
      ->group(group);
  app.add_option("--minutes", request.minutes, "time limit of a task; it goes on where it was")
      ->check(within(1, 1000000))
      ->group(group);
  app.add_option("--partition", request.partition, "partition to run in")->group(group);
  app.add_option("--sbatch", request.extra, "a further option for sbatch; may be given again")
      ->group(group);
  app.add_flag("--detach", detach, "submit and do not wait; merge with vantage results merge DIR")
      ->group(group);
  for (const CLI::Option* option : app.get_options()) {
    if (option->get_group() == group) {
      options_.push_back(option);
    }
  }
}

void SlurmFlags::refuse_any() const {
  for (const CLI::Option* option : options_) {
    if (is_typed(*option)) {
      throw CLI::ValidationError(option->get_name(), "goes with --engine slurm only");
    }
  }
}

bool run_on_slurm(Session& session, batch::EntrySource& entries, batch::ResultsStore& store,
                  const batch::ConfinedFolder& folder, const SlurmFlags& flags,
                  const SlurmBatch& batch) {
  SlurmRun run(session, store, folder, flags, batch);
  run.plan(entries);
  return run.run();
}

}  // namespace vantage::cli
