// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <string_view>
#include <utility>

#include "vantage/io/write.h"
#include "vantage/report/evaluation.h"

#include "report/agreement.h"
#include "report/constant_camera.h"
#include "report/csv_field.h"
#include "report/fixed_text.h"

namespace vantage {
namespace {

std::string interval_text(const Interval& interval, double scale, int decimals, const char* unit) {
  if (!std::isfinite(interval.mean)) {
    return "–";
  }
  return fixed_text(scale * interval.mean, decimals) + unit + " [" +
         fixed_text(scale * interval.low, decimals) + ", " +
         fixed_text(scale * interval.high, decimals) + "]";
}

/// Names in order of first appearance.
template <class Row>
std::vector<std::string> names_of(const std::vector<Row>& rows, std::string Row::*name) {
  std::vector<std::string> names;
  for (const Row& row : rows) {
    if (std::find(names.begin(), names.end(), row.*name) == names.end()) {
      names.push_back(row.*name);
    }
  }
  return names;
}

template <class Row>
std::vector<double> column(const std::vector<Row>& rows, std::string Row::*name,
                           const std::string& wanted, double Row::*value) {
  std::vector<double> values;
  for (const Row& row : rows) {
    if (row.*name == wanted) {
      values.push_back(row.*value);
    }
  }
  return values;
}

double median_of(std::vector<double> values) {
  std::erase_if(values, [](double value) { return !std::isfinite(value); });
  if (values.empty()) {
    return std::nan("");
  }
  std::sort(values.begin(), values.end());
  const std::size_t half = values.size() / 2;
  return values.size() % 2 == 1 ? values[half] : 0.5 * (values[half - 1] + values[half]);
}

/// What a view's row says in either table.
class ViewRow {
 public:
  ViewRow(const std::vector<ViewAgreement>& rows, std::string name)
      : rows_(&rows), name_(std::move(name)) {}

  [[nodiscard]] std::vector<double> values(double ViewAgreement::*value) const {
    return column(*rows_, &ViewAgreement::method, name_, value);
  }

  /// Mean and interval of a column.
  [[nodiscard]] std::string mean(double ViewAgreement::*value, double scale, int decimals,
                                 const char* unit = "") const {
    return interval_text(bootstrap_mean(values(value)), scale, decimals, unit);
  }

  [[nodiscard]] std::string median(double ViewAgreement::*value) const {
    return fixed_text(median_of(values(value)), 1);
  }

  /// What rows are sorted by; those without a number come last.
  [[nodiscard]] double error() const {
    const double mean = bootstrap_mean(values(&ViewAgreement::mean_folded_deg)).mean;
    return std::isfinite(mean) ? mean : std::numeric_limits<double>::infinity();
  }

  [[nodiscard]] const std::string& name() const { return name_; }

 private:
  const std::vector<ViewAgreement>* rows_;
  std::string name_;
};

constexpr double kOfHalfTurn = 1.0 / 180.0;

bool is_under_prior(std::string_view name) {
  return name.size() >= kUnderPrior.size() &&
         name.substr(name.size() - kUnderPrior.size()) == kUnderPrior;
}

/// The rows of some methods, least error first. \param tells what a line says of a method.
template <class Wanted, class Tells>
std::string sorted_lines(const std::vector<ViewAgreement>& rows, Wanted wanted, Tells tells) {
  std::vector<ViewRow> lines;
  for (const std::string& name : names_of(rows, &ViewAgreement::method)) {
    if (wanted(name)) {
      lines.emplace_back(rows, name);
    }
  }
  std::stable_sort(lines.begin(), lines.end(),
                   [](const ViewRow& a, const ViewRow& b) { return a.error() < b.error(); });
  std::string text;
  for (const ViewRow& line : lines) {
    text += tells(line);
  }
  return text;
}

/// A method's values less those of another one on the same models.
std::vector<double> less_than(const std::vector<ViewAgreement>& rows, const std::string& method,
                              std::string_view other, double ViewAgreement::*value) {
  std::map<std::string_view, double> of_other;
  for (const ViewAgreement& row : rows) {
    if (row.method == other) {
      of_other[row.model] = row.*value;
    }
  }
  std::vector<double> differences;
  for (const ViewAgreement& row : rows) {
    const auto found = of_other.find(row.model);
    if (row.method == method && found != of_other.end()) {
      differences.push_back(row.*value - found->second);
    }
  }
  return differences;
}

std::string view_table(const std::vector<ViewAgreement>& rows) {
  const auto tells = [&](const ViewRow& row) {
    const std::vector<double> less =
        less_than(rows, row.name(), kConstantCamera, &ViewAgreement::mean_folded_deg);
    return "| " + row.name() + " | " + row.mean(&ViewAgreement::mean_folded_deg, kOfHalfTurn, 3) +
           " | " + interval_text(bootstrap_mean(less), kOfHalfTurn, 3, "") + " | " +
           row.mean(&ViewAgreement::mean_deg, kOfHalfTurn, 3) + " | " +
           row.median(&ViewAgreement::mean_folded_deg) + " | " +
           row.median(&ViewAgreement::mean_deg) + " | " +
           row.mean(&ViewAgreement::within_45, 100.0, 0, " %") + " | " +
           row.mean(&ViewAgreement::all_folded_deg, kOfHalfTurn, 3) + " | " +
           row.mean(&ViewAgreement::percentile, 1.0, 2) + " |\n";
  };
  return "| view | error, folded [95 %] | less the best constant camera's, folded [95 %, paired] | "
         "error [95 %] | median, folded | median | within 45° [95 %] | error with kept starts, "
         "folded [95 %] | people's views in its own scores "
         "[95 %] |\n"
         "| --- | --- | --- | --- | --- | --- | --- | --- | --- |\n" +
         sorted_lines(
             rows, [](const std::string& name) { return !is_under_prior(name); }, tells);
}

/// Empty if there is no method under the prior.
std::string prior_table(const std::vector<ViewAgreement>& rows) {
  const auto tells = [&](const ViewRow& row) {
    const std::vector<double> less =
        less_than(rows, row.name(), kPriorAlone, &ViewAgreement::mean_folded_deg);
    const auto nearer = std::count_if(less.begin(), less.end(), [](double d) { return d < 0.0; });
    const auto farther = std::count_if(less.begin(), less.end(), [](double d) { return d > 0.0; });
    return "| " + row.name() + " | " + row.mean(&ViewAgreement::mean_folded_deg, kOfHalfTurn, 3) +
           " | " + interval_text(bootstrap_mean(less), kOfHalfTurn, 3, "") + " | " +
           std::to_string(nearer) + " / " + std::to_string(farther) + " | " +
           interval_text(
               bootstrap_mean(less_than(rows, row.name(), kPriorAlone, &ViewAgreement::within_45)),
               100.0, 0, " %") +
           " | " + row.mean(&ViewAgreement::mean_deg, kOfHalfTurn, 3) + " |\n";
  };
  const auto is_wanted = [](const std::string& name) {
    return is_under_prior(name) || name == kDefaultView || name == kConstantCamera;
  };
  const std::string lines = sorted_lines(rows, is_wanted, tells);
  return std::none_of(rows.begin(), rows.end(),
                      [](const ViewAgreement& row) { return is_under_prior(row.method); })
             ? ""
             : "### Under the prior\n"
               "| view | error, folded [95 %] | less the prior's alone, folded [95 %, paired] | "
               "models nearer / farther | within 45°, less the prior's alone [95 %, paired] | "
               "error [95 %] |\n"
               "| --- | --- | --- | --- | --- | --- |\n" +
                   lines + "\n";
}

std::string gaze_table(const std::vector<GazeAgreement>& rows) {
  std::string text =
      "| map | CC [95 %] | Spearman [95 %] | area under ROC [95 %] | chance-adjusted [95 %] | "
      "normalised [95 %] | z [95 %] |\n"
      "| --- | --- | --- | --- | --- | --- | --- |\n";
  for (const std::string& name : names_of(rows, &GazeAgreement::map)) {
    const auto mean = [&](double GazeAgreement::*value, int decimals) {
      return " | " + interval_text(bootstrap_mean(column(rows, &GazeAgreement::map, name, value)),
                                   1.0, decimals, "");
    };
    text += "| " + name + mean(&GazeAgreement::correlation, 3) + mean(&GazeAgreement::rank, 3) +
            mean(&GazeAgreement::area, 3) + mean(&GazeAgreement::chance_adjusted, 4) +
            mean(&GazeAgreement::normalised, 3) + mean(&GazeAgreement::z_score, 3) + " |\n";
  }
  return text;
}

}  // namespace

std::string evidence_tables(const std::vector<ViewAgreement>& views,
                            const std::vector<GazeAgreement>& gaze) {
  std::string text;
  if (!views.empty()) {
    text += "## Views that people chose\n" +
            std::to_string(names_of(views, &ViewAgreement::model).size()) + " models.\n\n" +
            view_table(views) + "\n" + prior_table(views);
  }
  if (!gaze.empty()) {
    text += "## Where people looked\n" +
            std::to_string(names_of(gaze, &GazeAgreement::model).size()) + " models.\n\n" +
            gaze_table(gaze) + "\n";
  }
  return text;
}

std::string view_agreement_csv(const std::vector<ViewAgreement>& rows) {
  std::string csv = "method,model,mean_deg,mean_folded_deg,all_folded_deg,within_45,percentile\n";
  for (const ViewAgreement& row : rows) {
    csv += csv_field(row.method) + "," + csv_field(row.model);
    for (const double value :
         {row.mean_deg, row.mean_folded_deg, row.all_folded_deg, row.within_45, row.percentile}) {
      csv += ',' + number_text(value);
    }
    csv += '\n';
  }
  return csv;
}

std::string gaze_agreement_csv(const std::vector<GazeAgreement>& rows) {
  std::string csv = "map,model,correlation,rank,roc_area,chance_adjusted,normalised,z_score\n";
  for (const GazeAgreement& row : rows) {
    csv += csv_field(row.map) + "," + csv_field(row.model);
    for (const double value :
         {row.correlation, row.rank, row.area, row.chance_adjusted, row.normalised, row.z_score}) {
      csv += ',' + number_text(value);
    }
    csv += '\n';
  }
  return csv;
}

}  // namespace vantage
