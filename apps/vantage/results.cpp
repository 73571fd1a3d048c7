// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "vantage/core/error.h"

#include "batch/folder_lock.h"
#include "batch/folder_owner.h"
#include "batch/json_text.h"
#include "batch/overview.h"
#include "batch/results_store.h"
#include "batch/shard_log.h"
#include "batch/shard_merge.h"
#include "commands.h"
#include "method_flags.h"
#include "output_file.h"
#include "results_diff.h"
#include "results_table.h"
#include "results_verify.h"
#include "row_file.h"
#include "standard_output.h"
#include "terminal.h"
#include "value_checks.h"

namespace vantage::cli {
namespace {

using batch::Json;

std::unique_ptr<batch::ResultsStore> open_store(Session& session, const std::string& folder) {
  return session.reading(
      [&] { return std::make_unique<batch::ResultsStore>(folder, batch::Database::Mode::Read); });
}

struct ExportCommand {
  std::vector<std::string> folders{};
  std::string output = "-";
  std::string format{};
  bool timings = false;

  void add_flags(CLI::App& app, Session& session) {
    app.add_option("DIR", folders, "folder of a batch; of several, all rows")->required();
    app.add_option("-o,--output", output, "file to write")->capture_default_str();
    app.add_option("--format", format, "of the table; default: jsonl for a FILE.jsonl, else csv")
        ->check(CLI::IsMember({"csv", "jsonl"}));
    app.add_flag("--timings", timings,
                 "also seconds, memory and attempts, which differ every time");
    add_force_flag(app, session.flags);
    add_common_flags(app, session.flags, Answer::OfItsOwn);
  }

  void run(Session& session) const {
    const std::string kind = !format.empty() ? format : format_by_name();
    std::vector<std::string> columns = batch::result_columns();
    if (timings) {
      columns.insert(columns.end(), batch::timing_columns().begin(), batch::timing_columns().end());
    }
    check_output(output, OutputKind::Table, session.flags);
    for (const std::string& folder : folders) {
      open_store(session, folder);  // says what is missing before anything is written
    }
    RowFile file(output);
    if (kind == "csv") {
      file.add(csv_line(columns));
    }
    std::vector<std::string> selected = columns;
    selected.emplace_back("result");
    const RunContext context = session.run();
    for (const std::string& folder : folders) {
      const auto store = open_store(session, folder);
      batch::Statement rows = select_rows(*store, selected, {}, {});
      while (rows.step()) {
        context.check();
        file.add(kind == "csv" ? csv_row(rows, columns) : json_row(rows, columns));
      }
    }
    file.finish();
  }

 private:
  /// \throw CLI::ValidationError if the file's ending is that of another format.
  [[nodiscard]] std::string format_by_name() const {
    const std::string ending = suffix_of(output);
    if (!ending.empty() && ending != ".csv" && ending != ".jsonl") {
      throw CLI::ValidationError("--output",
                                 "'" + output +
                                     "' is to be .csv or .jsonl, the formats that there "
                                     "are, or say --format csv or --format jsonl");
    }
    return ending == ".jsonl" ? "jsonl" : "csv";
  }

  static std::string csv_row(const batch::Statement& row, const std::vector<std::string>& columns) {
    std::vector<std::string> cells;
    for (std::size_t i = 0; i < columns.size(); ++i) {
      cells.push_back(csv_text(row, static_cast<int>(i), columns[i]));
    }
    return csv_line(cells);
  }

  static std::string json_row(const batch::Statement& row,
                              const std::vector<std::string>& columns) {
    Json json;
    const int result_column = static_cast<int>(columns.size());
    for (int i = 0; i < result_column; ++i) {
      const std::string& name = columns[static_cast<std::size_t>(i)];
      if (!name.starts_with("best_") && !name.starts_with("worst_")) {
        json[name] = cell_json(row, i, name);
      }
    }
    const Json result = batch::parsed_json(row.text(result_column));
    for (const char* part : {"up", "camera", "best", "worst"}) {
      json[part] = result.is_object() && result.contains(part) ? result[part] : Json(nullptr);
    }
    return batch::json_text(json) + "\n";
  }
};

struct QueryCommand {
  std::vector<std::string> folders{};
  std::vector<std::string> where{};
  std::string status{};
  std::string sort{};
  std::string columns = "name,status,best_fraction,worst_fraction,vertices,error";
  std::size_t limit = 0;

  void add_flags(CLI::App& app, Session& session) {
    app.add_option("DIR", folders, "folder of a batch")->required();
    app.add_option("--where", where,
                   "condition like best_fraction<0.4 or name~chair; may be given again")
        ->allow_extra_args(false);
    app.add_option("--status", status, "only these")
        ->check(CLI::IsMember({"done", "failed", "duplicate"}));
    app.add_option("--sort", sort, "column to sort by; -COLUMN for the largest first");
    app.add_option("--columns", columns, "what to show")->capture_default_str();
    app.add_option("--limit", limit, "at most so many rows; 0: all")
        ->check(whole_from_zero())
        ->capture_default_str();
    add_common_flags(app, session.flags);
  }

  void run(Session& session) const {
    const std::vector<std::string> wanted = parse_columns(columns);
    std::vector<Condition> conditions;
    for (const std::string& text : where) {
      conditions.push_back(parse_condition(text));
    }
    if (!status.empty()) {
      conditions.push_back(parse_condition(status == "failed" ? "status=failed" : "status=done"));
      if (status != "failed") {
        conditions.push_back(
            parse_condition(status == "done" ? "duplicate_of=" : "duplicate_of!="));
      }
    }
    std::vector<std::vector<std::string>> table{wanted};
    Json list = Json::array();
    for (FoundRow& row : found(session, wanted, conditions)) {
      list.push_back(std::move(row.json));
      table.push_back(std::move(row.cells));
    }
    if (session.flags.json) {
      std::printf("%s\n", batch::json_text(list, 2).c_str());
    } else {
      std::printf("%s\n", aligned(table, Alignment::Left).c_str());
    }
    finish_standard_output();
  }

 private:
  struct FoundRow {
    RankedRow rank;
    Json json{};
    std::vector<std::string> cells{};
  };

  /// Rows of all folders in one order, at most as many as are wanted.
  [[nodiscard]] std::vector<FoundRow> found(Session& session,
                                            const std::vector<std::string>& wanted,
                                            const std::vector<Condition>& conditions) const {
    const Order order = parse_order(sort);
    std::vector<std::string> selected = wanted;
    selected.push_back(order.column.empty() ? wanted.front() : order.column);
    const int rank = static_cast<int>(wanted.size());
    const RunContext context = session.run();
    std::vector<FoundRow> all;
    for (const std::string& folder : folders) {
      const auto store = open_store(session, folder);
      batch::Statement rows = select_rows(*store, selected, conditions, order);
      for (std::size_t i = 0; (limit == 0 || i < limit) && rows.step(); ++i) {
        context.check();
        all.push_back({RankedRow(rows, rank), object_of(rows, wanted), cells_of(rows, rank)});
      }
    }
    if (!order.column.empty()) {
      std::stable_sort(all.begin(), all.end(), [&](const FoundRow& a, const FoundRow& b) {
        return a.rank.comes_before(b.rank, order.is_down);
      });
    }
    if (limit > 0 && all.size() > limit) {
      all.erase(all.begin() + static_cast<std::ptrdiff_t>(limit), all.end());
    }
    return all;
  }

  static Json object_of(const batch::Statement& row, const std::vector<std::string>& names) {
    Json json;
    for (std::size_t i = 0; i < names.size(); ++i) {
      json[names[i]] = cell_json(row, static_cast<int>(i), names[i]);
    }
    return json;
  }

  static std::vector<std::string> cells_of(const batch::Statement& row, int count) {
    std::vector<std::string> cells;
    cells.reserve(static_cast<std::size_t>(count));
    for (int i = 0; i < count; ++i) {
      cells.push_back(printable(row.is_real(i) ? rounded(row.number(i)) : row.text(i)));
    }
    return cells;
  }
};

struct DiffCommand {
  std::string before{};
  std::string after{};
  double tolerance = 0.0;

  void add_flags(CLI::App& app, Session& session) {
    app.add_option("A", before, "folder of a batch")->required();
    app.add_option("B", after, "folder of another one")->required();
    app.add_option(
           "--tolerance", tolerance,
           "scores, and numbers of cameras, may differ by this share of the larger before it "
           "counts")
        ->check(within(0.0, 1.0))
        ->capture_default_str();
    add_common_flags(app, session.flags);
  }

  void run(Session& session) const {
    const auto a = open_store(session, before);
    const auto b = open_store(session, after);
    Json differences = Json::array();
    const DiffCounts counts =
        diff_results(*a, *b, tolerance, session.run(), [&](const Difference& difference) {
          if (session.flags.json) {
            differences.push_back(to_json(difference));
          } else {
            session.tell(difference_line(difference));
          }
        });
    if (session.flags.json) {
      const Json json = {{"equal", counts.equal},
                         {"changed", counts.changed},
                         {"only_in_a", counts.removed},
                         {"only_in_b", counts.added},
                         {"differences", std::move(differences)}};
      std::printf("%s\n", batch::json_text(json, 2).c_str());
    }
    session.tell(plural(counts.equal, "model") + " alike, " + grouped(counts.changed) +
                 " changed, " + grouped(counts.removed) + " only in A, " + grouped(counts.added) +
                 " only in B");
    if (counts.equal + counts.changed == 0 && share_content(*a, *b, session.run())) {
      session.say(
          "note: no key is in both, though contents are: keys are paths as they were given; "
          "run both batches from one folder, or by manifests that have keys");
    }
    finish_standard_output();
  }
};

struct MergeCommand {
  std::vector<std::string> folders{};
  bool no_overview = false;

  void add_flags(CLI::App& app, Session& session) {
    app.add_option(
           "DIR", folders,
           "folder of a batch that receives its shards' results, and those of further folders")
        ->required();
    app.add_flag("--no-overview", no_overview,
                 "no index.html and no contact sheets; those of an earlier run go");
    add_common_flags(app, session.flags);
  }

  void run(Session& session) const {
    require_something(session);
    batch::prepare_folder(folders.front());
    const batch::ConfinedFolder root(folders.front(), batch::kMergeCorner);
    if (!no_overview) {
      batch::check_overview(root);
    }
    const RunContext context = session.run();
    const batch::FolderLock lock(root, batch::kMergeCorner, context);
    batch::ResultsStore store(folders.front(), batch::Database::Mode::Create);
    const batch::MergeCounts merged =
        session.reading([&] { return batch::merge_shards(folders, store, root, context); });
    batch::renew_overview(root, store, !no_overview, context);
    summarise(session, merged, store.counts());
  }

 private:
  /// A folder alone is made by nobody: it has shards, or a store. \throw IoError
  void require_something(Session& session) const {
    const std::filesystem::path first = folders.front();
    if (folders.size() > 1 || std::filesystem::exists(first / batch::kShardFolder)) {
      return;
    }
    if (std::filesystem::exists(first)) {
      batch::prepare_folder(first.string());  // says whose it is
    }
    if (!std::filesystem::exists(first / batch::ResultsStore::kFileName)) {
      open_store(session, first.string());  // says that there is none
    }
  }

  static void summarise(Session& session, const batch::MergeCounts& merged,
                        const batch::StatusCounts& counts) {
    const auto count = [](std::int64_t number) {
      return grouped(static_cast<std::size_t>(number));
    };
    session.tell(plural(merged.seen, "record") + " read, " + grouped(merged.taken) + " new; " +
                 count(counts.done) + " done, " + count(counts.failed) + " failed, " +
                 count(counts.duplicates) + " with the content of another");
    if (merged.torn > 0) {
      session.say("note: " + plural(merged.torn, "line") +
                  " of shards and stores were no sound records and were left out");
    }
    if (merged.clashes > 0) {
      session.say("warning: " + plural(merged.clashes, "record") +
                  " left out, since their results have the folder's name of another model's; run "
                  "those batches with a --name that has {key8}");
    }
    if (merged.missing > 0) {
      session.say("warning: " + plural(merged.missing, "record") +
                  " came without results; run their batches again, then merge");
    }
    if (session.flags.json) {
      const Json json = {{"read", merged.seen},       {"new", merged.taken},
                         {"torn", merged.torn},       {"clashes", merged.clashes},
                         {"missing", merged.missing}, {"done", counts.done},
                         {"failed", counts.failed},   {"duplicates", counts.duplicates}};
      std::printf("%s\n", batch::json_text(json).c_str());
    }
    finish_standard_output();
  }
};

struct VerifyCommand {
  std::string folder{};

  void add_flags(CLI::App& app, Session& session) {
    app.add_option("DIR", folder, "folder of a batch")->required();
    add_common_flags(app, session.flags);
  }

  void run(Session& session) const {
    const auto store = open_store(session, folder);
    Json problems = Json::array();
    const VerifyCounts counts =
        verify_results(folder, *store, session.run(), [&](const std::string& problem) {
          if (session.flags.json) {
            problems.push_back(problem);
          } else {
            session.tell(problem);
          }
        });
    if (session.flags.json) {
      std::printf(
          "%s\n",
          batch::json_text(
              {{"records", counts.records}, {"folders", counts.folders}, {"problems", problems}}, 2)
              .c_str());
    }
    session.tell(plural(counts.records, "record") + ", " + plural(counts.folders, "folder") +
                 " of results: " +
                 (counts.problems == 0 ? "all sound" : plural(counts.problems, "problem")));
    finish_standard_output();
    session.exit_code = counts.problems == 0 ? kDone : kFailed;
  }
};

}  // namespace

void add_results_command(CLI::App& program, Session& session) {
  CLI::App* results = program.add_subcommand("results", "what a batch has stored");
  results->require_subcommand(1);
  results->footer(
      "Examples:\n  vantage results query DIR --where 'doubts>0' --columns key,doubt\n"
      "  vantage results diff DIR1 DIR2");
  add_command<QueryCommand>(
      *results, session, "query", "rows that fulfil conditions, as a table",
      "Examples:\n"
      "  vantage results query DIR --status failed --columns key,reason,error\n"
      "  vantage results query DIR --where 'best_fraction<0.4' --sort best_fraction --limit 20");
  add_command<ExportCommand>(*results, session, "export", "all results as one table",
                             "Examples:\n  vantage results export DIR --format jsonl -o all.jsonl");
  add_command<DiffCommand>(*results, session, "diff", "what differs between two batches",
                           "Examples:\n  vantage results diff DIR1 DIR2 --tolerance 0.01");
  add_command<MergeCommand>(*results, session, "merge", "shards' results into the folder's store",
                            "Examples:\n  vantage results merge DIR\n"
                            "  vantage results merge ALL PART1 PART2");
  add_command<VerifyCommand>(*results, session, "verify",
                             "whether all that was stored is there, whole, and of its record",
                             "Exit code 1: something is not.\n\n"
                             "Examples:\n  vantage results verify DIR");
}

}  // namespace vantage::cli
