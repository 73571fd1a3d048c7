// SPDX-License-Identifier: MIT
#include "batch/slurm.h"

#include <algorithm>
#include <chrono>
#include <sstream>
#include <thread>

#include "vantage/core/error.h"

#include "batch/program_call.h"
#include "batch/shell_word.h"

namespace vantage::batch {
namespace {

/// A task is told to stop so long before its time limit: a model in flight is given up at once, and
/// the shard's file is written within a second. [ours]
constexpr int kWarningSeconds = 30;
/// The controller may be restarted under a running batch; after this many silent tries it is gone.
constexpr int kTries = 30;
constexpr std::chrono::milliseconds kBetweenTries(2000);
constexpr std::chrono::milliseconds kStopLook(100);  // between two looks whether the run is to stop

/// A path in one of sbatch's patterns, where a percent sign begins a field.
std::string in_pattern(const std::string& path) {
  std::string text;
  for (const char c : path) {
    text += c == '%' ? std::string("%%") : std::string(1, c);
  }
  return text;
}

std::string first_line(const std::string& text) {
  return text.substr(0, text.find('\n'));
}

}  // namespace

std::string index_ranges(const std::vector<std::uint32_t>& indices) {
  std::string text;
  for (std::size_t i = 0; i < indices.size();) {
    std::size_t last = i;
    while (last + 1 < indices.size() && indices[last + 1] == indices[last] + 1) {
      ++last;
    }
    text += (text.empty() ? "" : ",") + std::to_string(indices[i]);
    if (last > i) {
      text += "-" + std::to_string(indices[last]);
    }
    i = last + 1;
  }
  return text;
}

std::string slurm_script(const SlurmRequest& request) {
  std::string command;
  for (const std::string& word : request.command) {
    command += shell_word(word) + " ";
  }
  command += "--shard \"$SLURM_ARRAY_TASK_ID\"/" + std::to_string(request.shards);
  // Slurm signals the script alone; it hands SIGTERM on and reports what the shard made of it.
  const std::string records = shell_word(request.folder + "/shards/") +
                              "\"$(printf 'shard-%05d-of-%05d.jsonl' \"$SLURM_ARRAY_TASK_ID\" " +
                              std::to_string(request.shards) + ")\"*";
  return "#!/bin/bash\n"
         "# Written by vantage batch --engine slurm: one shard of a collection a task.\n"
         "ended() { cat " +
         records +
         " 2>/dev/null | wc -l; }\n"
         "before=$(ended)\n" +
         command +
         " &\n"
         "shard=$!\n"
         "trap 'kill -TERM $shard 2>/dev/null' TERM\n"
         "wait $shard\n"
         "code=$?\n"
         "while kill -0 $shard 2>/dev/null; do wait $shard; code=$?; done\n"
         "# 4: every model has ended, some as failed. That is a result, not a failed task.\n"
         "if [ $code -eq 4 ]; then code=0; fi\n"
         "# Stopped before a single model had ended: starting again would go on for ever.\n"
         "if [ $code -eq 75 ] && [ \"$(ended)\" -eq \"$before\" ]; then code=1; fi\n"
         "exit $code\n";
}

std::string submit_slurm(const SlurmRequest& request, const std::vector<std::uint32_t>& indices) {
  const std::string script = request.folder + "/slurm/shard.sh";
  std::string array = index_ranges(indices);
  if (request.at_once > 0) {
    array += "%" + std::to_string(request.at_once);
  }
  std::vector<std::string> command = {
      "sbatch",
      "--parsable",
      "--job-name=vantage",
      "--array=" + array,
      "--ntasks=1",
      "--cpus-per-task=" + std::to_string(request.cpus),
      "--requeue",
      "--open-mode=append",
      "--output=" + in_pattern(request.folder) + "/slurm/shard-%a.log",
      "--signal=B:TERM@" + std::to_string(kWarningSeconds)};
  if (request.memory_mb > 0) {
    command.push_back("--mem=" + std::to_string(request.memory_mb));
  }
  if (request.minutes > 0) {
    command.push_back("--time=" + std::to_string(request.minutes));
  }
  if (!request.partition.empty()) {
    command.push_back("--partition=" + request.partition);
  }
  command.insert(command.end(), request.extra.begin(), request.extra.end());
  command.push_back(script);
  const ProgramResult result = call_program(command);
  // "1234" or "1234;cluster"
  std::string id = result.output.substr(0, result.output.find_first_of(";\n"));
  if (result.exit_code != 0 || !is_job(id)) {
    throw IoError("sbatch", "did not take the job: " + first_line(result.messages));
  }
  return id;
}

bool is_job(const std::string& text) {
  return !text.empty() &&
         std::all_of(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; });
}

SlurmProgress slurm_progress(const std::string& job, const RunContext& run) {
  for (int attempt = 0;; ++attempt) {
    const ProgramResult result = call_program(
        {"squeue", "--noheader", "--array", "--jobs=" + job, "--name=vantage", "--format=%T %r"});
    if (result.exit_code == 0) {
      SlurmProgress progress;
      std::istringstream lines(result.output);
      for (std::string line; std::getline(lines, line);) {
        const bool waits = line.starts_with("PENDING") || line.starts_with("REQUEUE");
        const bool held = line.find("held") != std::string::npos ||
                          line.find("Held") != std::string::npos ||
                          line.starts_with("SPECIAL_EXIT");
        (held ? progress.held : waits ? progress.waiting : progress.running) += 1;
      }
      return progress;
    }
    if (result.messages.find("Invalid job id") != std::string::npos) {
      return {};
    }
    if (attempt == kTries) {
      throw IoError("squeue", "cannot tell about job " + job + ": " + first_line(result.messages));
    }
    for (auto slept = kStopLook; slept <= kBetweenTries; slept += kStopLook) {
      std::this_thread::sleep_for(kStopLook);
      run.check();
    }
  }
}

void cancel_slurm(const std::string& job) {
  call_program({"scancel", "--name=vantage", job});
}

}  // namespace vantage::batch
