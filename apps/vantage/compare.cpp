// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include "vantage/io/write.h"
#include "vantage/pipeline/option_table.h"
#include "vantage/report/comparison.h"

#include "commands.h"
#include "load_posed.h"
#include "look_flags.h"
#include "measure_flags.h"
#include "method_flags.h"
#include "notes.h"
#include "output_file.h"
#include "output_folder.h"
#include "terminal.h"

namespace vantage::cli {
namespace {

struct CompareCommand {
  std::string model{};
  std::string folder{};
  std::string names = "all";
  std::string search = "rings";
  OptionFlags gradient{};
  bool no_images = false;
  MethodFlags method{};
  LookFlags look{};

  void add_flags(CLI::App& app, Session& session) {
    app.add_option("MODEL", model, "file to read, or -")->required();
    app.add_option("-o,--output", folder, "folder for the results; default: NAME.compare");
    offer_measures(
        app.add_option("--method", names, "methods of vantage measures, joined by commas, or all")
            ->capture_default_str(),
        /*joins=*/true, {"all"});
    app.add_option("--search", search,
                   "how the extreme views are found: rings: from the best of the set of views by "
                   "smaller and smaller rings; gradient: Lee's ascent from random starts (--seed), "
                   "of all methods but those that count things")
        ->check(CLI::IsMember({"rings", "gradient"}))
        ->capture_default_str();
    gradient.add(app, find_option("starts"));
    app.add_flag("--no-images", no_images, "no contact sheet and no page");
    method.add_to(app, {.map = true, .saliency = true, .camera = true});
    look.add_to_several(app);
    add_force_flag(app, session.flags);
    add_common_flags(app, session.flags);
  }

  void run(Session& session) {
    ViewOptions options = method.resolve();
    options.margin_percent = look.margin_percent();
    const std::vector<Measure> measures = chosen_measures(session, options);
    session.refuse_idle(idle_in_views(measures));
    for (const Measure& measure : measures) {
      if (!options.focus.empty() && !sums_a_map(measure.name)) {
        throw CLI::ValidationError(
            "--focus", "goes with methods that sum a map only, not with " + measure.name);
      }
    }
    const RunContext run = session.run();
    const Model loaded =
        load_posed(session, model, method.flags(), options, no_images ? nullptr : &look);
    OutputFolder output(folder.empty() ? folder_named(loaded.name, ".compare") : folder,
                        kCompareResults);
    output.check(session.flags);
    const ShapeAnalysis shape = session.computing(
        [&] { return analyse_for(loaded, options, measures, run.part(0.0, 0.2)); });
    session.reading([&] { require_area(shape, model); });
    const FrameChoice choice = choose_frame(loaded, shape, options);
    const Comparison comparison = session.computing(
        [&] { return compare_methods(shape, options, measures, run.part(0.2, 0.9)); });
    const std::string json = comparison_json(loaded, comparison, choice.frame.up, options);
    output.add("compare.json", json);
    output.add("compare.csv", comparison_csv(comparison));
    output.add("agreement.csv", agreement_csv(comparison));
    output.add("sphere.csv", sphere_csv(comparison));
    output.add("timings.csv", comparison_timings_csv(comparison));
    if (!no_images) {
      output.add("sheet.png", png_bytes(comparison_sheet(
                                  shape, comparison, choice.frame.up, options, run.part(0.9, 1.0),
                                  look.of(loaded, up_vector(choice.frame.up)))));
      output.add("index.html", comparison_html(loaded, comparison));
    }
    output.write();
    session.end_progress();
    if (session.flags.json) {
      write_output("-", comparison_json(loaded, comparison, choice.frame.up, options, true));
      return;
    }
    summarise(session, comparison, output.path());
    say_notes(session, loaded.notes);
    say_notes(session, shape);
  }

 private:
  /// The measures to compare; also sets how they are searched. \throw CLI::ValidationError
  std::vector<Measure> chosen_measures(const Session& session, ViewOptions& options) {
    std::vector<Measure> measures = parse_measures(names, "--method");
    if (search != "gradient") {
      if (gradient.insists_on("starts")) {
        throw CLI::ValidationError("--starts", "goes with --search gradient only");
      }
      return measures;
    }
    options.search.strategy = SearchStrategy::Gradient;
    AllOptions given;
    gradient.apply(given);
    options.search.starts = given.view.search.starts;
    options.search.seed = session.flags.seed;
    if (names == "all") {
      std::erase_if(measures, [](const Measure& m) { return m.is_count; });
    }
    for (const Measure& measure : measures) {
      check_gradient(measure);
    }
    return measures;
  }

  /// Whether values differ by rounding alone.
  static bool are_alike(const std::vector<double>& values) {
    constexpr double kRounding = 1e-9;
    const auto [low, high] = std::minmax_element(values.begin(), values.end());
    return low == values.end() ||
           !(*high - *low > kRounding * std::max(std::abs(*low), std::abs(*high)));
  }

  static std::string cell(double value, int digits, bool is_known) {
    constexpr double kNothing = 1e-9;  // of a unit vector, or a degree
    return !is_known || std::isnan(value)
               ? "–"
               : rounded(std::abs(value) < kNothing ? 0.0 : value, digits);
  }

  /// One value a column; how far best and worst views are from the first method's, folded.
  static void summarise(Session& session, const Comparison& comparison, const std::string& path) {
    std::vector<std::vector<std::string>> rows{{"method", "best x", "y", "z", "worst x", "y", "z",
                                                "best °", "worst °", "rank", "views", "s"}};
    bool any_flat = false;
    for (std::size_t m = 0; m < comparison.methods.size(); ++m) {
      const ComparedMethod& method = comparison.methods[m];
      const Agreement& with = comparison.agreement.front()[m];
      std::vector<std::string> row{method.measure.name};
      const bool is_flat = are_alike(method.values);
      const bool has_angles = !is_flat && !are_alike(comparison.methods.front().values);
      any_flat = any_flat || is_flat;
      for (const Vec3& d : {method.views.best.direction, method.views.worst.direction}) {
        for (int axis = 0; axis < 3; ++axis) {
          row.push_back(cell(d[axis], 3, !is_flat));
        }
      }
      row.push_back(cell(with.best_folded_deg, 3, has_angles));
      row.push_back(cell(with.worst_folded_deg, 3, has_angles));
      row.push_back(cell(with.rank_correlation, 2, has_angles));
      row.push_back(std::to_string(method.views.evaluations));
      row.push_back(rounded(method.seconds, 2));
      rows.push_back(std::move(row));
    }
    session.tell(aligned(rows, Alignment::FirstLeft));
    session.tell("best °, worst °, rank: angles and rank correlation with " +
                 comparison.methods.front().measure.name + ", mirror images folded" +
                 (any_flat ? "; –: all views alike" : ""));
    session.tell("all views of the set: " + rounded(comparison.survey_seconds, 3) +
                 " s; results in " + printable(path) + "/");
  }
};

}  // namespace

void add_compare_command(CLI::App& program, Session& session) {
  add_command<CompareCommand>(
      program, session, "compare", "methods side by side: best and worst views, agreement",
      "Examples:\n"
      "  vantage compare horse.ply -o methods\n"
      "  vantage compare horse.ply -o two --method kssm,mesh-saliency\n"
      "  vantage compare horse.ply --method mesh-saliency --search gradient\n"
      "  vantage compare part.stl --method all --no-images --json");
}

}  // namespace vantage::cli
