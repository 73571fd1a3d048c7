// SPDX-License-Identifier: MIT
#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>
#include <thread>
#include <utility>

#include "vantage/core/error.h"
#include "vantage/core/version.h"
#include "vantage/pipeline/sidecar.h"
#include "vantage/pipeline/view_options.h"

#include "batch/confined_folder.h"
#include "batch/content_hash.h"
#include "batch/entry_source.h"
#include "batch/file_stamp.h"
#include "batch/folder_lock.h"
#include "batch/folder_owner.h"
#include "batch/forget.h"
#include "batch/json_text.h"
#include "batch/naming.h"
#include "batch/overview.h"
#include "batch/result_folders.h"
#include "batch/results_store.h"
#include "batch/runner.h"
#include "batch/shard_log.h"
#include "batch/shard_plan.h"
#include "batch/shell_word.h"
#include "batch_end.h"
#include "batch_progress.h"
#include "batch_slurm.h"
#include "commands.h"
#include "import_program.h"
#include "load_posed.h"
#include "look_flags.h"
#include "method_flags.h"
#include "option_text.h"
#include "output_file.h"
#include "standard_output.h"
#include "terminal.h"
#include "value_checks.h"
#include "view_outputs.h"
#include "view_set_flags.h"

namespace vantage::cli {
namespace {

// Share of the machine's memory that all workers together may take; the rest is for caches.
constexpr double kMemoryShare = 0.8;
constexpr double kLeastMemoryGb = 0.5;
// On Slurm the share of a machine is what is asked for: for each worker, and for its parent.
constexpr double kSlurmMemoryGb = 4.0;
constexpr double kParentMemoryGb = 0.25;

double machine_memory_gb() {
  return static_cast<double>(usable_memory_bytes()) / 1e9;
}

int cores() {
  return std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

struct BatchCommand {
  std::vector<std::string> inputs{};
  std::string folder{};
  std::string manifest{};
  batch::EntryFilter filter{};
  std::string write = "best,worst";
  std::string shard{};
  std::string retry{};
  std::string engine = "local";
  bool no_overview = false;
  bool forget = false;
  bool strict = false;
  int jobs = 0;
  double memory_gb = 0.0;
  double output_limit_mb = 1024.0;
  batch::RunnerOptions runner{};
  MethodFlags method{};
  ViewSetFlags several{};
  LookFlags look{};
  SlurmFlags slurm{};
  std::vector<CLI::Option*> method_options{};
  std::vector<CLI::Option*> shard_options{};  ///< That a shard takes over as they are.
  CLI::Option* threads = nullptr;

  void add_flags(CLI::App& app, Session& session) {
    app.add_option("INPUT", inputs,
                   "model files, folders and archives (.zip .tar .tar.gz …) of them");
    app.add_option("-o,--output", folder, "folder for all results")->required();
    app.add_option("--manifest", manifest,
                   "file that lists the models (- for standard input): JSON lines, CSV, or paths");
    app.add_option("--include", filter.include,
                   "only files of folders that match this pattern; may be given again");
    app.add_option("--exclude", filter.exclude, "no files that match this pattern");
    const std::string known = OutputKinds::all().text();
    offer_values(
        app.add_option("--write", write,
                       "what to write for each model, besides view.json: json (no more), " + known)
            ->capture_default_str(),
        CLI::detail::split("json," + known, ','), /*joins=*/true);
    app.add_option("--name", runner.name_template,
                   "folder of a model's results: {stem} {name} {ext} {parent} {hash2} {hash8} "
                   "{hash16} {hash} {key8}")
        ->capture_default_str();
    app.add_flag(
        "--forget", forget,
        "remove what earlier runs stored of models that are not among the inputs any more");
    app.add_flag("--no-overview", no_overview,
                 "no index.html and no contact sheets; those of an earlier run go");
    add_running_flags(app);
    for (const char* name : {"--write", "--name", "--jobs", "--timeout", "--memory",
                             "--output-limit", "--attempts", "--retry", "--verify"}) {
      shard_options.push_back(app.get_option(name));
    }
    slurm.add_to(app);
    const std::vector<CLI::Option*> before = app.get_options();
    method.add_to(app,
                  {.map = true, .camera = true, .search = true, .picture = true, .fits = true});
    several.add_set_to(app);
    look.add_to_several(app);
    for (CLI::Option* option : app.get_options()) {
      if (std::find(before.begin(), before.end(), option) == before.end()) {
        method_options.push_back(option);
      }
    }
    add_common_flags(app, session.flags);
    method_options.push_back(app.get_option("--max-faces"));
    threads = app.get_option("--threads");
    threads->default_str("1")->description("threads of each worker; 0: all cores");
    shard_options.push_back(threads);
  }

  void add_running_flags(CLI::App& app) {
    const std::string group = "Running";
    app.add_option("--jobs", jobs, "worker processes; 0: one a core")
        ->check(within(0, 1024))
        ->capture_default_str()
        ->group(group);
    app.add_option("--timeout", runner.timeout_s, "seconds for one attempt at a model")
        ->check(within(0.001, 1e7))
        ->capture_default_str()
        ->group(group);
    app.add_option("--memory", memory_gb,
                   "memory for each worker: GB, or with a unit; default: its share of 80 %")
        ->transform(size_in(1e9))
        ->check(within(0.3, 1e6))  // less does not hold a view of a small model
        ->group(group);
    app.add_option("--output-limit", output_limit_mb,
                   "largest file that may be written: MB, or with a unit")
        ->transform(size_in(1e6))
        ->check(within(0.001, 1e6))
        ->capture_default_str()
        ->group(group);
    app.add_option("--attempts", runner.attempts,
                   "tries at a model that crashes or breaks a limit; bad input is not tried again")
        ->check(within(1, 100))
        ->capture_default_str()
        ->group(group);
    app.add_option("--retry", retry, "failed: also do again what failed before")
        ->check(CLI::IsMember({"failed"}))
        ->group(group);
    app.add_flag(
           "--strict", strict,
           "exit code 1 if an answer should not be trusted (column doubts of results); all are "
           "stored")
        ->group(group);
    app.add_flag(
           "--verify", runner.verify,
           "read every input again instead of trusting size, time and inode, and do again what "
           "lacks files of its results")
        ->group(group);
    app.add_option("--shard", shard,
                   "INDEX/COUNT, from 0: only this share of the models, into DIR/shards/")
        ->group(group);
    app.add_option("--engine", engine,
                   "local: worker processes here; slurm: a job array, its results merged")
        ->check(CLI::IsMember({"local", "slurm"}))
        ->capture_default_str()
        ->group(group);
  }

  void run(Session& session) {
    const bool on_slurm = engine == "slurm";
    if (on_slurm && !shard.empty()) {
      throw CLI::ValidationError("--shard", "--engine slurm makes the shards itself");
    }
    if (!on_slurm) {
      slurm.refuse_any();
    }
    if (forget && (on_slurm || !shard.empty())) {
      throw CLI::ValidationError("--forget", "goes with neither --shard nor --engine slurm");
    }
    const std::optional<batch::Shard> part = checked_shard();
    prepare(session, part);
    std::unique_ptr<batch::EntrySource> source = open_source(session, /*warn=*/true);
    batch::prepare_folder(folder);
    const batch::ConfinedFolder root(folder);
    if (!no_overview && !part) {
      batch::check_overview(root);
    }
    const batch::FolderLock lock(root, runner.work_name);
    session.if_stopped = "; the same command goes on from there";
    if (on_slurm) {
      run_shards(session, *source, root);
      return;
    }
    auto listed = std::make_unique<batch::ListedEntries>(std::move(source));
    const batch::ListedEntries& list = *listed;
    source = std::move(listed);
    std::unique_ptr<batch::ResultBook> book;
    if (part) {
      source = std::make_unique<batch::ShardEntries>(std::move(source), *part);
      book = std::make_unique<batch::ShardLog>(folder, *part);
    } else {
      book = std::make_unique<batch::ResultsStore>(folder, batch::Database::Mode::Create);
    }
    const RunContext run = session.run();
    BatchProgress progress(run, count_entries(session, part));
    const auto report = [&](const batch::RunnerCounts& counts, const batch::ModelRecord* record) {
      if (record != nullptr && record->status == "failed") {
        const bool named = record->error.starts_with(record->key);
        session.say(named ? record->error : record->key + ": " + record->error);
      }
      progress.show(counts);
      if (const auto line = isatty(STDERR_FILENO) == 0 ? progress.due(counts) : std::nullopt) {
        session.say(*line);
      }
    };
    auto* const store = dynamic_cast<batch::ResultsStore*>(book.get());
    batch::RunnerCounts counts;
    try {
      counts = batch::run_batch(*source, *book, runner, run.stop, report);
    } catch (const Cancelled&) {
      show_what_has_ended(session, root, store, !no_overview);
      throw;
    }
    if (store != nullptr) {
      if (forget) {
        forget_unlisted(session, root, *store, list);
      }
      batch::update_overview(root, *store, !no_overview, run);
    }
    summarise(session, counts, part.has_value());
    if (!part) {
      warn_of_nothing(session, counts);
    }
    finish_standard_output();
    settle_exit_code(session, counts.failed + counts.skipped_failed, counts.doubted);
  }

 private:
  void warn_of_nothing(Session& session, const batch::RunnerCounts& counts) const {
    if (counts.done + counts.failed + counts.skipped + counts.duplicates == 0) {
      session.say("warning: there was nothing to do: no models were found in '" +
                  printable(manifest.empty() ? inputs.front() : manifest) +
                  (inputs.size() > 1 ? "' and the other inputs" : "'"));
    }
  }

  /// The shard asked for, if any, and a template that suits it. \throw CLI::ValidationError
  [[nodiscard]] std::optional<batch::Shard> checked_shard() const {
    try {
      const std::optional<batch::Shard> part =
          shard.empty() ? std::nullopt : std::optional(batch::parse_shard(shard));
      batch::check_template(runner.name_template, part.has_value() || engine == "slurm");
      return part;
    } catch (const InvalidInput& error) {
      throw CLI::ValidationError(error.what());
    }
  }

  void prepare(Session& session, const std::optional<batch::Shard>& part) {
    if (inputs.empty() == manifest.empty()) {
      throw CLI::ValidationError("INPUT", "give either inputs or --manifest");
    }
    OutputKinds kinds = OutputKinds::parse(write);
    const int count = jobs > 0 ? jobs : cores();
    runner.folder = folder;
    runner.workers = count;
    runner.threads = threads->count() == 0 ? 1 : session.flags.threads;
    runner.threads = runner.threads == 0 ? cores() : runner.threads;
    runner.spare_threads = std::max(cores(), runner.threads);
    const double gb = memory_gb > 0.0
                          ? memory_gb
                          : std::max(kLeastMemoryGb, kMemoryShare * machine_memory_gb() / count);
    runner.limits.memory_bytes = static_cast<std::uint64_t>(gb * 1e9);
    runner.limits.file_bytes = static_cast<std::uint64_t>(output_limit_mb * 1e6);
    runner.retry_failed = retry == "failed";
    runner.quiet_workers = !session.flags.verbose;
    if (part) {
      runner.work_name =
          "shard-" + std::to_string(part->index) + "-of-" + std::to_string(part->count);
    }
    const ViewOptions options = view_options_of(method, several, look, kinds, session.flags.seed);
    runner.options_hash = [this, options, kinds](const batch::Entry& entry) {
      ViewOptions own = options;
      LookFlags own_look = look;
      std::string trouble;
      own.up = entry.up.empty() ? options.up : up_axis(entry.up);
      own.front = entry.front.empty() ? options.front : up_axis(entry.front);
      if (entry.member.empty() && entry.problem.empty()) {
        try {
          const Sidecar sidecar = sidecar_of(entry.path);
          apply_below(method.flags(), sidecar, own);
          own_look.suggest(sidecar.style);
        } catch (const Error& error) {  // the worker says what is wrong, until that is mended
          trouble = error.what();
        }
      }
      // Of equal bytes the file's ending says how they are read.
      return batch::text_hash(options_hash(own) + ' ' + kinds.text() + ' ' +
                              (kinds.has_pictures() ? own_look.text() : "") + ' ' +
                              suffix_of(entry.shown_path()) + ' ' + trouble)
          .substr(0, 16);
    };
    runner.worker_arguments = {"batch-worker",
                               "--write=" + (kinds.text().empty() ? "json" : kinds.text()),
                               "--seed=" + std::to_string(session.flags.seed)};
    append_flags(runner.worker_arguments, method_options);
  }

  /// Options as they were given.
  static void append_flags(std::vector<std::string>& command,
                           const std::vector<CLI::Option*>& options) {
    for (const CLI::Option* option : options) {
      for (const std::string& value : option->results()) {
        std::string flag = "--" + option->get_lnames().front();
        if (option->get_type_size() != 0) {
          flag.append("=").append(value);
        }
        command.push_back(std::move(flag));
      }
    }
  }

  void run_shards(Session& session, batch::EntrySource& source, const batch::ConfinedFolder& root) {
    batch::SlurmRequest& request = slurm.request;
    request.folder = std::filesystem::absolute(folder).lexically_normal().string();
    request.cpus = std::int64_t{std::max(1, jobs)} * runner.threads;
    const double task_gb = std::max(1, jobs) * (memory_gb > 0.0 ? memory_gb : kSlurmMemoryGb);
    request.memory_mb = static_cast<std::int64_t>((task_gb + kParentMemoryGb) * 1e3);
    request.command = {std::filesystem::read_symlink("/proc/self/exe").string(),
                       "batch",
                       "--manifest=" + request.folder + "/slurm/plan.jsonl",
                       "--output=" + request.folder,
                       "--quiet",
                       "--config=none",
                       "--seed=" + std::to_string(session.flags.seed)};
    append_flags(request.command, shard_options);
    append_flags(request.command, method_options);
    if (jobs == 0) {
      request.command.emplace_back("--jobs=1");
    }
    if (memory_gb <= 0.0) {
      request.command.push_back("--memory=" + rounded(kSlurmMemoryGb));
    }
    batch::ResultsStore store(folder, batch::Database::Mode::Create);
    const SlurmBatch plan{
        .attempts = runner.attempts,
        .verify = runner.verify,
        .is_current = [&](const batch::Entry& entry, const batch::ModelRecord& record) {
          const auto first = record.duplicate_of.empty() ? record : store.find_content(record);
          const bool has_results = record.status != "done" ||
                                   (first && root.is_folder(batch::model_folder(first->folder)));
          return has_results && record.version == version() &&
                 record.stamp == batch::stamp_of(entry.path) &&
                 batch::are_as_they_were(record.beside, entry.path) &&
                 (record.options == runner.options_hash(entry) || record.options.empty()) &&
                 !(runner.retry_failed && record.status == "failed");
        }};
    try {
      if (!run_on_slurm(session, source, store, root, slurm, plan)) {
        finish_standard_output();
        return;
      }
    } catch (const Cancelled&) {
      show_what_has_ended(session, root, &store, !no_overview);
      throw;
    }
    batch::renew_overview(root, store, !no_overview, session.run());
    const batch::StatusCounts counts = store.counts();
    const std::int64_t doubted = store.count_doubted();
    summarise(session, {.done = counts.done,
                        .failed = counts.failed,
                        .duplicates = counts.duplicates,
                        .doubted = doubted});
    finish_standard_output();
    settle_exit_code(session, counts.failed, doubted);
  }

  /// For the shell.
  [[nodiscard]] std::string word_of_folder() const { return printable(batch::shell_word(folder)); }

  void settle_exit_code(Session& session, std::int64_t failed, std::int64_t doubted) const {
    if (failed > 0) {
      session.exit_code = kSomeFailed;
    } else if (strict && doubted > 0) {
      throw Error(grouped(static_cast<std::size_t>(doubted)) +
                  " of the answers should not be trusted (--strict); vantage results query " +
                  word_of_folder() + " --where 'doubts>0' lists them");
    }
  }

  /// \param warn whether what is odd about a manifest is told.
  std::unique_ptr<batch::EntrySource> open_source(Session& session, bool warn) const {
    const auto tell = [&session, warn](const std::string& warning) {
      if (warn) {
        session.say("warning: " + warning);
      }
    };
    return session.reading([&] {
      batch::EntryFilter counted = filter;
      counted.imports = !import_program().empty();
      return manifest.empty() ? batch::entries_of_paths(inputs, counted, folder,
                                                        {.entry_bytes = runner.limits.memory_bytes,
                                                         .timeout_s = runner.timeout_s,
                                                         .attempts = runner.attempts,
                                                         .stop = session.run().stop})
                              : batch::entries_of_manifest(manifest, session.run().stop, tell);
    });
  }

  /// How many models there are, if progress is told and it can be known beforehand: a pipe can be read but once.
  std::int64_t count_entries(Session& session, const std::optional<batch::Shard>& part) const {
    std::error_code error;
    const bool is_known = manifest.empty()
                              ? std::none_of(inputs.begin(), inputs.end(), batch::is_archive)
                              : std::filesystem::is_regular_file(manifest, error);
    if (session.flags.quiet || session.flags.json || !is_known) {
      return -1;
    }
    std::unique_ptr<batch::EntrySource> source = open_source(session, /*warn=*/false);
    if (part) {
      source = std::make_unique<batch::ShardEntries>(std::move(source), *part);
    }
    std::int64_t count = 0;
    for (const RunContext run = session.run(); source->next(); ++count) {
      run.check();
    }
    return count;
  }

  void summarise(Session& session, const batch::RunnerCounts& counts, bool is_shard = false) const {
    const batch::Json json = {{"done", counts.done},
                              {"failed", counts.failed + counts.skipped_failed},
                              {"skipped", counts.skipped},
                              {"duplicates", counts.duplicates},
                              {"repeated", counts.repeated},
                              {"doubted", counts.doubted},
                              {"folder", batch::key_of_path(folder)}};
    session.end_progress();
    if (session.flags.json) {
      std::printf("%s\n", batch::json_text(json).c_str());
      return;
    }
    session.tell(
        counts_text(counts) + "; results in " + printable(folder) +
        (is_shard ? "/shards/; once all shards are done: vantage results merge " + word_of_folder()
                  : "/"));
    if (!counts.first_doubted.empty()) {
      session.tell(doubted_text(counts) +
                   (is_shard ? ""
                             : "; vantage results query " + word_of_folder() +
                                   " --where 'doubts>0' --columns key,doubt says why"));
    }
    if (counts.renamed > 0) {
      session.say("note: " + plural(static_cast<std::size_t>(counts.renamed), "model") +
                  " stored under another name before; --forget removes names that are no inputs");
    }
  }
};

}  // namespace

void add_batch_command(CLI::App& program, Session& session) {
  add_command<BatchCommand>(
      program, session, "batch", "best and worst views of a whole collection",
      "Stopped or killed, the same command goes on where it was. Exit code 4: some models failed.\n"
      "A log on standard error gets a line of progress each half minute, later each tenth of the "
      "time.\n"
      "\n"
      "Examples:\n"
      "  vantage batch models/ -o results\n"
      "  vantage batch a.ply b/ -o results --write best,map,camera --jobs 8 --timeout 60\n"
      "  find . -name '*.stl' | vantage batch --manifest - -o results --name "
      "'{parent}/{stem}-{hash8}'\n"
      "  vantage batch models/ -o results --shard 3/64; vantage results merge results");
}

}  // namespace vantage::cli
