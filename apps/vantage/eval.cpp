// SPDX-License-Identifier: MIT
#include "vantage/io/write.h"
#include "vantage/report/evaluation.h"

#include "commands.h"
#include "input_text.h"
#include "measure_flags.h"
#include "method_flags.h"
#include "terminal.h"

namespace vantage::cli {
namespace {

constexpr std::string_view kBegin = "<!-- vantage eval begins -->\n";
constexpr std::string_view kEnd = "<!-- vantage eval ends -->";

struct EvalCommand {
  std::string folder{};
  std::string names = "all";
  std::string page{};
  std::string views_file{};
  std::string gaze_file{};
  MethodFlags method{};

  void add_flags(CLI::App& app, Session& session) {
    app.add_option("DATASET", folder,
                   "folder with views.csv and models/, or gaze/ and meshes/, or folders of these")
        ->required();
    app.add_option("--method", names, "methods of vantage measures, joined by commas, or all")
        ->capture_default_str();
    app.add_option("--page", page, "also put the tables into this page, between its marks");
    app.add_option("--views-csv", views_file, "also write one row a method and model of views");
    app.add_option("--gaze-csv", gaze_file, "also write one row a map and model of gaze");
    method.add_to(app, {.map = true, .camera = true});
    add_common_flags(app, session.flags);
  }

  void run(Session& session) const {
    const ViewOptions options = method.resolve();
    const std::vector<Measure> measures = parse_measures(names, "--method");
    const auto records = session.reading([&] { return read_records(folder); });
    const std::string before = page.empty() ? "" : session.reading([&] { return read_text(page); });
    check_marks(before);
    const RunContext run = session.run();
    std::vector<ViewAgreement> views;
    std::vector<GazeAgreement> gaze;
    for (std::size_t i = 0; i < records.size(); ++i) {
      const auto share = 1.0 / static_cast<double>(records.size());
      const RunContext part =
          run.part(share * static_cast<double>(i), share * static_cast<double>(i + 1));
      const Model model = session.load(records[i].path);
      if (!records[i].views.empty()) {
        const auto rows = evaluate_views(records[i], model, options, measures, part);
        views.insert(views.end(), rows.begin(), rows.end());
      } else {
        const auto rows = evaluate_gaze(records[i], model, options, part);
        gaze.insert(gaze.end(), rows.begin(), rows.end());
      }
    }
    session.end_progress();
    const std::string tables = evidence_tables(views, gaze);
    write_file("-", tables);
    if (!page.empty()) {
      const std::size_t begin = before.find(kBegin) + kBegin.size();
      write_file(page, before.substr(0, begin) + tables + before.substr(before.find(kEnd)));
    }
    if (!views_file.empty()) {
      write_file(views_file, view_agreement_csv(views));
    }
    if (!gaze_file.empty()) {
      write_file(gaze_file, gaze_agreement_csv(gaze));
    }
  }

 private:
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
                           "  vantage eval people/views --method kssm,vmi --views-csv rows.csv");
}

}  // namespace vantage::cli
