// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "vantage/core/run_context.h"

/// \file
/// Job arrays of Slurm, through its own programs: sbatch, squeue, scancel.

namespace vantage::batch {

/// What a job array is asked to be.
struct SlurmRequest {
  std::string folder{};                ///< Absolute; script and logs are in folder/slurm/.
  std::vector<std::string> command{};  ///< The shard's command line; "--shard i/n" is added.
  std::uint32_t shards = 1;            ///< [n], tasks of the array.
  std::uint32_t at_once = 0;           ///< Tasks that may run together; 0: as many as fit.
  std::int64_t cpus = 1;               ///< Of each task.
  std::int64_t memory_mb = 0;          ///< Of each task; 0: the cluster's default.
  int minutes = 0;                     ///< Time limit of a task; 0: the partition's.
  std::string partition{};             ///< Empty: the default one.
  std::vector<std::string> extra{};    ///< Further options of sbatch, as they are.
};

/// How far a job array is.
struct SlurmProgress {
  std::size_t waiting = 0;  ///< Tasks not started, or to be started again.
  std::size_t running = 0;  ///< Tasks that run.
  std::size_t held = 0;     ///< Tasks that Slurm will not start again by itself.
};

/// "0-3,7" of 0, 1, 2, 3, 7. \pre ascending.
std::string index_ranges(const std::vector<std::uint32_t>& indices);

/// The batch script of a request. A shard asked to stop by SIGTERM (time limit, preemption) ends
/// with 75, for RequeueExit=75, unless no model of it had ended since it began; shards whose models have
/// all ended succeed, even if some failed.
std::string slurm_script(const SlurmRequest& request);

/// Submits tasks `indices` of the request, whose script is in folder/slurm/shard.sh.
/// \return the job's id. \throw IoError with sbatch's words.
std::string submit_slurm(const SlurmRequest& request, const std::vector<std::uint32_t>& indices);

/// Tasks of a job that have not ended; none if the job is unknown (it has ended, and was forgotten).
/// \throw IoError if the controller does not answer for long, Cancelled
SlurmProgress slurm_progress(const std::string& job, const RunContext& run);

/// Whether a text can be the id of a job.
bool is_job(const std::string& text);

/// Ends all tasks of a job that have not ended; of jobs named vantage, as batches are.
void cancel_slurm(const std::string& job);

}  // namespace vantage::batch
