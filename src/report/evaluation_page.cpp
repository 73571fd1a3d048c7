// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "vantage/io/write.h"
#include "vantage/report/evaluation.h"

namespace vantage {
namespace {

std::string fixed(double value, int decimals) {
  if (!std::isfinite(value)) {
    return "–";
  }
  std::array<char, 40> text{};
  std::snprintf(text.data(), text.size(), "%.*f", decimals, value);
  return text.data();
}

std::string interval_text(const Interval& interval, double scale, int decimals) {
  return fixed(scale * interval.mean, decimals) + " [" + fixed(scale * interval.low, decimals) +
         ", " + fixed(scale * interval.high, decimals) + "]";
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

std::string view_table(const std::vector<ViewAgreement>& rows) {
  struct Line {
    double error = 0.0;
    std::string text{};
  };

  std::vector<Line> lines;
  for (const std::string& name : names_of(rows, &ViewAgreement::method)) {
    const auto values = [&](double ViewAgreement::*value) {
      return column(rows, &ViewAgreement::method, name, value);
    };
    const Interval folded = bootstrap_mean(values(&ViewAgreement::mean_folded_deg));
    const Interval plain = bootstrap_mean(values(&ViewAgreement::mean_deg));
    lines.push_back(
        {folded.mean,
         "| " + name + " | " + interval_text(folded, 1.0 / 180.0, 3) + " | " +
             fixed(plain.mean / 180.0, 3) + " | " + fixed(folded.mean, 1) + " | " +
             fixed(median_of(values(&ViewAgreement::mean_folded_deg)), 1) + " | " +
             fixed(100.0 * bootstrap_mean(values(&ViewAgreement::within_45)).mean, 0) + " % | " +
             fixed(bootstrap_mean(values(&ViewAgreement::all_folded_deg)).mean / 180.0, 3) + " | " +
             fixed(bootstrap_mean(values(&ViewAgreement::percentile)).mean, 2) + " |\n"});
  }
  std::stable_sort(lines.begin(), lines.end(),
                   [](const Line& a, const Line& b) { return a.error < b.error; });
  std::string text =
      "| view | error, folded [95 %] | error | mean angle, folded | median | within 45° | error "
      "with "
      "kept starts, folded | people's views in its own scores |\n"
      "| --- | --- | --- | --- | --- | --- | --- | --- |\n";
  for (const Line& line : lines) {
    text += line.text;
  }
  return text;
}

std::string gaze_table(const std::vector<GazeAgreement>& rows) {
  std::string text =
      "| map | CC [95 %] | Spearman | area under ROC | chance-adjusted | normalised | z |\n"
      "| --- | --- | --- | --- | --- | --- | --- |\n";
  for (const std::string& name : names_of(rows, &GazeAgreement::map)) {
    const auto mean = [&](double GazeAgreement::*value) {
      return bootstrap_mean(column(rows, &GazeAgreement::map, name, value));
    };
    text += "| " + name + " | " + interval_text(mean(&GazeAgreement::correlation), 1.0, 3) + " | " +
            fixed(mean(&GazeAgreement::rank).mean, 3) + " | " +
            fixed(mean(&GazeAgreement::area).mean, 3) + " | " +
            fixed(mean(&GazeAgreement::chance_adjusted).mean, 4) + " | " +
            fixed(mean(&GazeAgreement::normalised).mean, 3) + " | " +
            fixed(mean(&GazeAgreement::z_score).mean, 3) + " |\n";
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
            view_table(views) + "\n";
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
    csv += '"' + row.method + "\"," + row.model;
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
    csv += '"' + row.map + "\"," + row.model;
    for (const double value :
         {row.correlation, row.rank, row.area, row.chance_adjusted, row.normalised, row.z_score}) {
      csv += ',' + number_text(value);
    }
    csv += '\n';
  }
  return csv;
}

}  // namespace vantage
