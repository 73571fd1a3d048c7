// SPDX-License-Identifier: MIT
#include <cmath>

#include "vantage/core/version.h"
#include "vantage/io/write.h"
#include "vantage/report/comparison.h"

#include "core/json_text.h"
#include "report/fixed_text.h"

namespace vantage {
namespace {

using Json = OrderedJson;

Json number(double value) {
  return std::isfinite(value) ? Json(value) : Json(nullptr);
}

Json view_of(const MeasuredView& view) {
  const Vec3& d = view.direction;
  return {{"direction", Json::array({d.x(), d.y(), d.z()})}, {"score", number(view.value)}};
}

void add_numbers(std::string& row, std::initializer_list<double> values) {
  for (const double value : values) {
    row += ',' + number_text(value);
  }
}

std::string escaped(const std::string& text) {
  std::string safe;
  for (const char c : text) {
    safe += c == '<' ? "&lt;" : c == '&' ? "&amp;" : std::string(1, c);
  }
  return safe;
}

/// What each method found.
std::string method_table(const Comparison& comparison) {
  std::string html =
      "<h2>Methods</h2>\n<table><tr><th>method</th><th>better</th><th>best from</th><th>score</th>"
      "<th>worst from</th><th>score</th><th>views evaluated</th></tr>\n";
  const auto view_cells = [](const MeasuredView& view) {
    const Vec3& d = view.direction;
    return "<td>" + fixed_text(d.x(), 3) + ", " + fixed_text(d.y(), 3) + ", " +
           fixed_text(d.z(), 3) + "</td><td>" + fixed_text(view.value, 4) + "</td>";
  };
  for (const ComparedMethod& method : comparison.methods) {
    html += "<tr><th>" + method.measure.name + "</th><td>" +
            (method.measure.better == Better::More ? "max" : "min") + "</td>" +
            view_cells(method.views.best) + view_cells(method.views.worst) + "<td>" +
            std::to_string(method.views.evaluations) + "</td></tr>\n";
  }
  return html + "</table>\n<p>What it took is in <a href=\"timings.csv\">timings.csv</a>.</p>\n";
}

/// One table of a number for each pair of methods.
std::string pair_table(const Comparison& comparison, const char* title, double Agreement::*member,
                       int decimals) {
  std::string html = "<h2>" + std::string(title) + "</h2>\n<table><tr><th></th>";
  for (const ComparedMethod& method : comparison.methods) {
    html += "<th class=\"side\"><span>" + method.measure.name + "</span></th>";
  }
  html += "</tr>\n";
  for (std::size_t a = 0; a < comparison.methods.size(); ++a) {
    html += "<tr><th>" + comparison.methods[a].measure.name + "</th>";
    for (const Agreement& agreement : comparison.agreement[a]) {
      html += "<td>" + fixed_text(agreement.*member, decimals) + "</td>";
    }
    html += "</tr>\n";
  }
  return html + "</table>\n";
}

}  // namespace

std::string comparison_json(const Model& model, const Comparison& comparison, UpAxis up,
                            const ViewOptions& options, bool with_seconds) {
  Json json;
  json["vantage"] = version();
  json["schema"] = 1;
  json["options_hash"] = options_hash(options);
  json["model"] = model.name;
  json["up"] = up_name(up);
  json["views"] = comparison.set.directions.size();
  json["search"] = options.search.strategy == SearchStrategy::Gradient ? "gradient" : "rings";
  if (with_seconds) {
    json["seconds"] = comparison.survey_seconds;
  }
  json["mirror_planes"] = Json::array();
  for (const MirrorPlane& plane : comparison.planes) {
    json["mirror_planes"].push_back({plane.normal.x(), plane.normal.y(), plane.normal.z()});
  }
  json["methods"] = Json::array();
  for (const ComparedMethod& method : comparison.methods) {
    json["methods"].push_back({{"method", method.measure.name},
                               {"better", method.measure.better == Better::More ? "max" : "min"},
                               {"best", view_of(method.views.best)},
                               {"worst", view_of(method.views.worst)},
                               {"evaluations", method.views.evaluations}});
    if (with_seconds) {
      json["methods"].back()["seconds"] = method.seconds;
    }
  }
  json["agreement"] = Json::array();
  for (std::size_t a = 0; a < comparison.methods.size(); ++a) {
    for (std::size_t b = a + 1; b < comparison.methods.size(); ++b) {
      const Agreement& pair = comparison.agreement[a][b];
      json["agreement"].push_back({{"a", comparison.methods[a].measure.name},
                                   {"b", comparison.methods[b].measure.name},
                                   {"best_deg", pair.best_deg},
                                   {"best_folded_deg", pair.best_folded_deg},
                                   {"worst_deg", pair.worst_deg},
                                   {"worst_folded_deg", pair.worst_folded_deg},
                                   {"rank_correlation", number(pair.rank_correlation)}});
    }
  }
  return json_text(json, 2) + "\n";
}

std::string comparison_csv(const Comparison& comparison) {
  std::string csv =
      "method,better,dx,dy,dz,score,worst_dx,worst_dy,worst_dz,worst_score,evaluations\n";
  for (const ComparedMethod& method : comparison.methods) {
    csv += method.measure.name + (method.measure.better == Better::More ? ",max" : ",min");
    for (const MeasuredView* view : {&method.views.best, &method.views.worst}) {
      const Vec3& d = view->direction;
      add_numbers(csv, {d.x(), d.y(), d.z(), view->value});
    }
    csv += ',' + std::to_string(method.views.evaluations) + '\n';
  }
  return csv;
}

std::string agreement_csv(const Comparison& comparison) {
  std::string csv = "a,b,best_deg,best_folded_deg,worst_deg,worst_folded_deg,rank_correlation\n";
  for (std::size_t a = 0; a < comparison.methods.size(); ++a) {
    for (std::size_t b = a + 1; b < comparison.methods.size(); ++b) {
      const Agreement& pair = comparison.agreement[a][b];
      csv += comparison.methods[a].measure.name + ',' + comparison.methods[b].measure.name;
      add_numbers(csv, {pair.best_deg, pair.best_folded_deg, pair.worst_deg, pair.worst_folded_deg,
                        pair.rank_correlation});
      csv += '\n';
    }
  }
  return csv;
}

std::string sphere_csv(const Comparison& comparison) {
  std::string csv = "dx,dy,dz";
  for (const ComparedMethod& method : comparison.methods) {
    csv += ',' + method.measure.name;
  }
  csv += '\n';
  for (std::size_t v = 0; v < comparison.set.directions.size(); ++v) {
    const Vec3& d = comparison.set.directions[v];
    std::string row;
    add_numbers(row, {d.x(), d.y(), d.z()});
    for (const ComparedMethod& method : comparison.methods) {
      add_numbers(row, {method.values[v]});
    }
    csv += row.substr(1) + '\n';
  }
  return csv;
}

std::string comparison_html(const Model& model, const Comparison& comparison) {
  std::string html =
      "<!doctype html>\n<meta charset=\"utf-8\">\n<title>" + escaped(model.name) +
      " by all methods</title>\n<style>body{font:14px sans-serif;margin:2em}img{max-width:100%}"
      "table{border-collapse:collapse}td,th{border:1px solid #ccc;padding:2px 6px;text-align:right}"
      ".side{vertical-align:bottom}.side span{writing-mode:vertical-rl}</style>\n<h1>" +
      escaped(model.name) +
      "</h1>\n<p>Best view, worst view, and around the model all views of the set: the farther out "
      "and the warmer, the better.</p>\n<img src=\"sheet.png\" alt=\"contact sheet\">\n";
  html += method_table(comparison);
  html += pair_table(comparison, "Angle between best views, degrees", &Agreement::best_deg, 0);
  html += pair_table(comparison, "Angle between best views, degrees, mirror-folded",
                     &Agreement::best_folded_deg, 0);
  html += pair_table(comparison, "Angle between worst views, degrees", &Agreement::worst_deg, 0);
  html += pair_table(comparison, "Angle between worst views, degrees, mirror-folded",
                     &Agreement::worst_folded_deg, 0);
  html +=
      pair_table(comparison, "Rank correlation over the sphere", &Agreement::rank_correlation, 2);
  return html;
}

std::string comparison_timings_csv(const Comparison& comparison) {
  std::string csv = "what,seconds\nall views of the set by all methods";
  add_numbers(csv, {comparison.survey_seconds});
  for (const ComparedMethod& method : comparison.methods) {
    csv += "\nsearch by " + method.measure.name;
    add_numbers(csv, {method.seconds});
  }
  return csv + "\n";
}

}  // namespace vantage
