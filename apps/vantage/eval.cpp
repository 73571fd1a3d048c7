// SPDX-License-Identifier: MIT
#include <filesystem>
#include <memory>

#include "vantage/core/error.h"
#include "vantage/core/version.h"
#include "vantage/io/write.h"
#include "vantage/report/evaluation.h"

#include "commands.h"
#include "input_text.h"
#include "measure_flags.h"
#include "method_flags.h"
#include "output_file.h"
#include "terminal.h"

namespace vantage::cli {
namespace {

constexpr std::string_view kBegin = "<!-- vantage eval begins -->\n";
constexpr std::string_view kEnd = "<!-- vantage eval ends -->";

struct EvalCommand {
  std::string folder{};
  std::string names = "all";
  std::string output{};
  std::string page{};
  std::string views_file{};
  std::string gaze_file{};
  MethodFlags method{};

  void add_flags(CLI::App& app, Session& session) {
    app.add_option("DATASET", folder,
                   "folder with views.csv and models/, or gaze/ and meshes/, or folders of these; "
                   "or a JSON manifest: docs/evidence.md")
        ->required();
    app.add_option(
        "-o,--output", output,
        "folder for tables.md, views.csv, gaze.csv, and the rows of each model as soon as "
        "they are there: a run that was stopped goes on where it was");
    offer_measures(
        app.add_option("--method", names, "methods of vantage measures, joined by commas, or all")
            ->capture_default_str(),
        /*joins=*/true, {"all"});
    app.add_option("--page", page, "also put the tables into this page, between its marks");
    app.add_option("--views-csv", views_file, "also write one row a method and model of views");
    app.add_option("--gaze-csv", gaze_file, "also write one row a map and model of gaze");
    method.add_to(app, {.map = true, .camera = true});
    add_force_flag(app, session.flags);
    add_common_flags(app, session.flags, Answer::OfItsOwn);
  }

  void run(Session& session) {
    const ViewOptions options = method.resolve();
    const std::vector<Measure> measures = parse_measures(names, "--method");
    check_outputs(session.flags);
    const auto records = session.read([&] { return read_records(folder); });
    const std::string before = page.empty() ? "" : session.read([&] { return read_text(page); });
    check_marks(before);
    const auto journal = output.empty() ? std::make_unique<EvaluationJournal>()
                                        : std::make_unique<EvaluationJournal>(journal_file());
    std::size_t known = 0;
    std::vector<ViewAgreement> views;
    std::vector<GazeAgreement> gaze;
    for (const EvaluatedModel& rows :
         evaluate_records(records, options, measures, *journal, known, session.run())) {
      views.insert(views.end(), rows.views.begin(), rows.views.end());
      gaze.insert(gaze.end(), rows.gaze.begin(), rows.gaze.end());
    }
    session.end_progress();
    if (known > 0) {
      session.say("note: " + std::to_string(known) + " of " + std::to_string(records.size()) +
                  " models were evaluated by an earlier run");
    }
    const std::string tables = made_by(options, measures) + evidence_tables(views, gaze);
    write_output("-", tables);
    if (!output.empty()) {
      write_file(output + "/tables.md", tables);
      write_file(output + "/views.csv", view_agreement_csv(views));
      write_file(output + "/gaze.csv", gaze_agreement_csv(gaze));
    }
    if (!page.empty()) {
      const std::size_t begin = before.find(kBegin) + kBegin.size();
      write_output(page, before.substr(0, begin) + tables + before.substr(before.find(kEnd)));
    }
    if (!views_file.empty()) {
      write_output(views_file, view_agreement_csv(views));
    }
    if (!gaze_file.empty()) {
      write_output(gaze_file, gaze_agreement_csv(gaze));
    }
  }

 private:
  /// What the tables were made by: all that changes them but the data.
  static std::string made_by(const ViewOptions& options, const std::vector<Measure>& measures) {
    return "Made by vantage " + std::string(version()) + " with " + library_versions() +
           ", options_hash " + options_hash(options) + ", " + plural(measures.size(), "method") +
           " of 642 views.\n\n";
  }

  /// People's choices are in files of such names too.
  void check_outputs(CommonFlags flags) const {
    std::vector<NamedOutput> outputs{
        {"--page", page}, {"--views-csv", views_file}, {"--gaze-csv", gaze_file}};
    for (const char* const name : {"/tables.md", "/views.csv", "/gaze.csv", "/rows.jsonl"}) {
      outputs.push_back({"-o", output.empty() ? "" : output + name});
    }
    require_distinct(outputs);
    if (const std::string choices = folder + "/views.csv";
        flags.force && std::filesystem::exists(choices)) {
      flags.inputs.push_back(choices);
    }
    for (const std::string* file : {&views_file, &gaze_file}) {
      check_output(*file, OutputKind::Table, flags);
    }
    if (!output.empty()) {
      for (const char* const name : {"/tables.md", "/views.csv", "/gaze.csv"}) {
        check_result(output + name, OutputKind::Table, flags);
      }
    }
  }

  /// In the folder for results, which is made.
  [[nodiscard]] std::string journal_file() const {
    std::error_code error;
    std::filesystem::create_directories(output, error);
    if (error) {
      throw IoError(output, "cannot be made: " + error.message(), error.value());
    }
    return output + "/rows.jsonl";
  }

  void check_marks(const std::string& text) const {
    if (!page.empty() &&
        (text.find(kBegin) == std::string::npos || text.find(kEnd) == std::string::npos ||
         text.find(kEnd) < text.find(kBegin))) {
      throw CLI::ValidationError("--page", page + " has no lines '" +
                                               std::string(kBegin.substr(0, kBegin.size() - 1)) +
                                               "' and '" + std::string(kEnd) + "' in this order");
    }
  }
};

}  // namespace

void add_eval_command(CLI::App& program, Session& session) {
  add_command<EvalCommand>(program, session, "eval",
                           "score methods against recorded choices and gaze of people",
                           "Examples:\n"
                           "  vantage eval people\n"
                           "  vantage eval people.json -o results\n"
                           "  vantage eval people/views --method kssm,vmi --views-csv rows.csv");
}

}  // namespace vantage::cli
