// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "vantage/core/error.h"
#include "vantage/io/write.h"

#include "batch/overview.h"
#include "batch/results_store.h"
#include "batch/shard_log.h"
#include "commands.h"
#include "method_flags.h"
#include "terminal.h"

namespace vantage::cli {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) {
    text += (text.empty() ? "" : ", ") + word;
  }
  return text;
}

std::string csv_cell(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) {
    return text;
  }
  std::string quoted = "\"";
  for (const char c : text) {
    quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  }
  return quoted + '"';
}

struct ExportCommand {
  std::string folder{};
  std::string output = "-";
  std::string format = "csv";
  bool timings = false;

  void add_flags(CLI::App& app, Session& session) {
    app.add_option("DIR", folder, "folder of a batch")->required();
    app.add_option("-o,--output", output, "file to write")->capture_default_str();
    app.add_option("--format", format, "of the table")
        ->check(CLI::IsMember({"csv", "jsonl"}))
        ->capture_default_str();
    app.add_flag("--timings", timings,
                 "also seconds, memory and attempts, which differ every time");
    add_common_flags(app, session.flags);
  }

  void run(Session& session) const {
    auto store = session.reading(
        [&] { return std::make_unique<batch::ResultsStore>(folder, batch::Database::Mode::Read); });
    std::vector<std::string> columns = batch::result_columns();
    if (timings) {
      columns.insert(columns.end(), batch::timing_columns().begin(), batch::timing_columns().end());
    }
    std::string text = format == "csv" ? csv_header(columns) : "";
    batch::Statement rows = store->select(joined(columns) + ", result", "", "");
    while (rows.step()) {
      text += format == "csv" ? csv_row(rows, columns.size()) : json_row(rows, columns);
    }
    write_file(output, text);
  }

 private:
  static std::string csv_header(const std::vector<std::string>& columns) {
    std::string line;
    for (const std::string& column : columns) {
      line += (line.empty() ? "" : ",") + column;
    }
    return line + "\n";
  }

  static std::string csv_row(const batch::Statement& row, std::size_t count) {
    std::string line;
    for (int i = 0; i < static_cast<int>(count); ++i) {
      const bool real = row.is_real(i);
      line += (i == 0 ? "" : ",") + csv_cell(real ? number_text(row.number(i)) : row.text(i));
    }
    return line + "\n";
  }

  static std::string json_row(const batch::Statement& row,
                              const std::vector<std::string>& columns) {
    Json json;
    const int result_column = static_cast<int>(columns.size());
    for (int i = 0; i < result_column; ++i) {
      const std::string& name = columns[static_cast<std::size_t>(i)];
      const bool in_result = name.starts_with("best_") || name.starts_with("worst_");
      if (in_result) {
        continue;
      }
      json[name] = row.is_null(i)      ? Json(nullptr)
                   : name == "closed"  ? Json(row.integer(i) != 0)
                   : row.is_real(i)    ? Json(row.number(i))
                   : row.is_integer(i) ? Json(row.integer(i))
                                       : Json(row.text(i));
    }
    const Json result = Json::parse(row.text(result_column), nullptr, false);
    for (const char* part : {"up", "camera", "best", "worst"}) {
      json[part] = result.is_object() && result.contains(part) ? result[part] : Json(nullptr);
    }
    return json.dump() + "\n";
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
    app.add_flag("--no-overview", no_overview, "no index.html and no contact sheets");
    add_common_flags(app, session.flags);
  }

  void run(Session& session) const {
    batch::ResultsStore store(folders.front(), batch::Database::Mode::Create);
    std::size_t seen = 0;
    std::size_t taken = 0;
    std::size_t torn = 0;
    store.begin();
    const auto take = [&](const batch::ModelRecord& record) {
      ++seen;
      taken += store.merge(record) ? 1 : 0;
    };
    for (const std::string& folder : folders) {
      for (const std::string& file : session.reading([&] { return shard_files(folder); })) {
        torn += batch::read_shard_file(file, take);
      }
      if (folder != folders.front() &&
          fs::exists(fs::path(folder) / batch::ResultsStore::kFileName)) {
        batch::ResultsStore(folder, batch::Database::Mode::Read).for_each_record(take);
      }
    }
    store.commit();
    if (!no_overview) {
      batch::write_overview(folders.front(), store, session.run());
    }
    const batch::StatusCounts counts = store.counts();
    session.tell(plural(seen, "record") + " read, " + grouped(taken) + " new; " +
                 grouped(static_cast<std::size_t>(counts.done)) + " done, " +
                 grouped(static_cast<std::size_t>(counts.failed)) + " failed, " +
                 grouped(static_cast<std::size_t>(counts.duplicates)) +
                 " with the content of another");
    if (torn > 0) {
      session.say("note: " + plural(torn, "line") + " of the shards' files were no records");
    }
    if (session.flags.json) {
      std::printf("%s\n", Json{{"read", seen},
                               {"new", taken},
                               {"done", counts.done},
                               {"failed", counts.failed},
                               {"duplicates", counts.duplicates}}
                              .dump()
                              .c_str());
    }
  }

 private:
  static std::vector<std::string> shard_files(const std::string& folder) {
    std::vector<std::string> files;
    std::error_code error;
    for (const auto& file : fs::directory_iterator(batch::shard_folder(folder), error)) {
      const std::string name = file.path().filename().string();
      // A log holds what a shard that runs, or was killed, has not yet put into its file.
      if (name.starts_with("shard-") &&
          (name.ends_with(".jsonl") || name.ends_with(".jsonl.log"))) {
        files.push_back(file.path().string());
      }
    }
    std::sort(files.begin(), files.end());
    return files;
  }
};

}  // namespace

void add_results_command(CLI::App& program, Session& session) {
  CLI::App* results = program.add_subcommand("results", "what a batch has stored");
  results->require_subcommand(1);
  add_command<ExportCommand>(*results, session, "export", "all results as one table",
                             "Examples:\n  vantage results export DIR --format jsonl -o all.jsonl");
  add_command<MergeCommand>(*results, session, "merge", "shards' results into the folder's store",
                            "Examples:\n  vantage results merge DIR\n"
                            "  vantage results merge ALL PART1 PART2");
}

}  // namespace vantage::cli
