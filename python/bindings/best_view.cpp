// SPDX-License-Identifier: MIT
#include <numbers>
#include <utility>

#include "vantage/pipeline/measured_shape.h"
#include "vantage/report/view_report.h"
#include "vantage/view/measure.h"

#include "arguments.h"
#include "arrays.h"
#include "camera.h"
#include "released_run.h"
#include "subject.h"
#include "text.h"

namespace vantage::python {
namespace {

/// What the search found, and the text of view.json.
struct Outcome {
  std::shared_ptr<const Analysis> analysis{};
  ViewReport report{};
  std::string json{};
};

py::dict view_dict(const ReportedView& view) {
  py::dict result;
  result["direction"] = array_of(view.direction);
  result["eye"] = array_of(view.eye);
  result["up"] = array_of(view.up);
  result["score"] = view.score;
  result["score_fraction"] = view.score_fraction;
  result["objective"] = view.objective;
  result["visible_area_fraction"] = view.visible_area_fraction;
  result["camera"] = camera_dict(view.picture);
  result["size"] = py::make_tuple(view.size.width, view.size.height);
  return result;
}

py::list twins_of(const ViewReport& report) {
  py::list twins;
  for (const TwinView& twin : report.twins) {
    twins.append(py::make_tuple(array_of(twin.direction), twin.score, twin.objective));
  }
  return twins;
}

/// The views of a set, each with what it adds.
py::list views_of(const ReportedViewSet& set) {
  py::list views;
  for (std::size_t i = 0; i < set.views.size(); ++i) {
    py::dict view = view_dict(set.views[i]);
    view["gain"] = set.choice.views[i].gain;
    view["coverage"] = set.choice.views[i].coverage;
    views.append(view);
  }
  return views;
}

void add_set(py::dict& result, const std::optional<ReportedViewSet>& set) {
  result["views"] = set ? views_of(*set) : py::list();
  result["tour"] = py::none();
  result["tour_length_deg"] = py::none();
  if (set) {
    std::vector<std::int64_t> order(set->tour.order.begin(), set->tour.order.end());
    result["tour"] = owned_array(std::move(order));
    result["tour_length_deg"] = set->tour.length_rad * 180.0 / std::numbers::pi;
  }
}

py::dict report_dict(const Outcome& outcome) {
  const ViewReport& report = outcome.report;
  py::dict result;
  result["best"] = view_dict(report.best);
  result["worst"] = view_dict(report.worst);
  result["total"] = report.total;
  result["up"] = std::string(up_name(report.up));
  result["up_source"] = report.orientation.up.source;
  result["up_confidence"] = report.orientation.up.confidence;
  result["front"] = std::string(up_name(report.front));
  result["front_source"] = report.orientation.front.source;
  result["front_confidence"] = report.orientation.front.confidence;
  result["centre"] = array_of(report.camera.sphere.centre);
  result["distance"] = report.camera.distance();
  result["evaluations"] = report.best_search.evaluations + report.worst_search.evaluations;
  result["estimates"] = report.best_search.estimates + report.worst_search.estimates;
  result["twins"] = twins_of(report);
  result["dense_gap"] = py::none();
  if (const auto& gap = report.dense_gap) {
    result["dense_gap"] = py::make_tuple(gap->best_ratio, gap->worst_above, gap->evaluations);
  }
  add_set(result, report.set);
  result["warnings"] =
      messages_of(warnings_of(*outcome.analysis->model, outcome.analysis->shape, report));
  result["doubts"] = messages_of(report.reliability_warnings);
  result["json"] = text_of(outcome.json);
  return result;
}

py::dict best_view(const py::object& model, const py::object& F, const py::object& method,
                   const py::dict& options, const py::object& progress, const py::object& threads) {
  const Subject subject(model, F);
  const Measure measure = find_measure(word_of(method, "method"));
  Settings settings =
      subject.settings(options, [&](const Settings&) { return idle_in_views({measure}); });
  settings.view.method = measure.name;
  settings.view.pictures = false;  // view.json names none
  return report_dict(released({progress, threads}, [&](const RunContext& run) {
    Outcome outcome;
    outcome.analysis = subject.analysed(settings, with_map, run.part(0.0, 0.5));
    const Model& loaded = *outcome.analysis->model;
    const ShapeAnalysis& shape = outcome.analysis->shape;
    outcome.report = find_views(shape, choose_frame(loaded, shape, settings.view), settings.view,
                                run.part(0.5, 1.0));
    outcome.json = view_json(loaded, shape, outcome.report, settings.view);
    return outcome;
  }));
}

}  // namespace

void define_best_view(py::module_& module) {
  module.def("best_view", &best_view, py::arg("model"), py::arg("F"), py::arg("method"),
             py::arg("options"), py::arg("progress"), py::arg("threads"));
}

}  // namespace vantage::python
