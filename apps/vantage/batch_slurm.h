// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "batch/confined_folder.h"
#include "batch/entry_source.h"
#include "batch/model_record.h"
#include "batch/results_store.h"
#include "batch/slurm.h"
#include "session.h"

namespace vantage::cli {

/// Flags of `--engine slurm`.
struct SlurmFlags {
  batch::SlurmRequest request{};
  bool balance = false;
  bool detach = false;

  void add_to(CLI::App& app);

  /// Refuses them where there is no such engine. \throw CLI::ValidationError
  void refuse_any() const;

 private:
  std::vector<const CLI::Option*> options_{};
};

/// What a collection on Slurm needs to know of the batch.
struct SlurmBatch {
  int attempts = 2;     ///< At shards that end before their models have.
  bool verify = false;  ///< Every shard runs once, whatever is known of its models.
  /// Whether a model's record is up to date: same options and version.
  std::function<bool(const batch::Entry&, const batch::ModelRecord&)> is_current{};
};

/// Plans the shards, submits them as a job array, waits, merges, and submits again the shards that
/// ended before their models had; models that no attempt could end are recorded as failed.
/// Interrupted, it cancels the job and merges what there is; run again, it joins a job that still
/// runs. \return whether all has ended, which a detached job that was just submitted has not.
/// \throw Cancelled, IoError
bool run_on_slurm(Session& session, batch::EntrySource& entries, batch::ResultsStore& store,
                  const batch::ConfinedFolder& folder, const SlurmFlags& flags,
                  const SlurmBatch& batch);

}  // namespace vantage::cli
