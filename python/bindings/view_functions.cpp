// SPDX-License-Identifier: MIT
#include <algorithm>
#include <utility>

#include <pybind11/stl.h>

#include "vantage/core/error.h"
#include "vantage/pipeline/measured_shape.h"
#include "vantage/spatial/directions.h"

#include "arguments.h"
#include "arrays.h"
#include "released_run.h"
#include "subject.h"

namespace vantage::python {
namespace {

constexpr int kUsualViewSet = 3;   // of views that measures are defined over
constexpr int kFinestViewSet = 6;  // of the same

/// Of directions to look from.
int level_of(const py::object& value, const char* name) {
  static const auto kFinest = static_cast<std::int64_t>(find_option("subdivisions").high);
  return static_cast<int>(whole_number_of(value, name, 0, kFinest));
}

/// Views that were asked for: directions, or positions of eyes.
struct Views {
  std::vector<Vec3> points{};
  bool are_eyes = false;
  int sphere = -1;  ///< The icosahedron's level, if that was given.

  [[nodiscard]] Viewpoint viewpoint(std::size_t i, const ScoringCamera& camera) const {
    return are_eyes ? Viewpoint{Projection::Perspective, points[i]} : camera.viewpoint(points[i]);
  }
};

Views directions_of(const py::object& directions) {
  Views views{.points = points_of(directions, "directions")};
  for (std::size_t i = 0; i < views.points.size(); ++i) {
    const std::optional<Vec3> unit = unit_vector(views.points[i]);
    if (!unit) {
      throw InvalidInput(
          "directions holds the zero vector, or one without a finite length, in row " +
          std::to_string(i));
    }
    views.points[i] = *unit;
  }
  return views;
}

/// Exactly one of the three.
Views views_of(const py::object& directions, const py::object& eyes, const py::object& sphere) {
  const int given = static_cast<int>(!directions.is_none()) + static_cast<int>(!eyes.is_none()) +
                    static_cast<int>(!sphere.is_none());
  if (given != 1) {
    throw InvalidInput("say what to look from by one of directions, eyes and sphere");
  }
  if (!directions.is_none()) {
    return directions_of(directions);
  }
  if (!eyes.is_none()) {
    return {.points = points_of(eyes, "eyes"), .are_eyes = true};
  }
  const auto level = level_of(sphere, "sphere");
  return {.points = direction_set(ViewSphereBase::Icosahedron, level).directions, .sphere = level};
}

bool is_single(const py::object& directions, const py::object& eyes) {
  const py::object& given = directions.is_none() ? eyes : directions;
  return !given.is_none() && is_single_point(given);
}

py::array visible(const py::object& model, const py::object& F, const py::object& eyes,
                  const py::object& directions, const py::object& sphere, const py::dict& options,
                  const py::object& progress, const py::object& threads) {
  const Subject subject(model, F);
  const Settings settings = subject.settings(options, [&](const Settings&) {
    return idle_in_scores({find_measure("kssm")}, !eyes.is_none());
  });
  const Views views = views_of(directions, eyes, sphere);
  std::size_t vertex_count = 0;
  std::vector<std::uint8_t> table = released({progress, threads}, [&](const RunContext& run) {
    const auto analysis = subject.analysed(settings, surface_only, run.part(0.0, 0.2));
    const ShapeAnalysis& shape = analysis->shape;
    const VertexVisibility visibility(shape.surface, shape.sides, views.points.size());
    const ScoringCamera camera = scoring_camera(shape, settings.view);
    vertex_count = shape.surface_vertex.size();
    std::vector<std::uint8_t> rows;
    rows.reserve(views.points.size() * vertex_count);
    for (std::size_t i = 0; i < views.points.size(); ++i) {
      run.advance("looking",
                  0.2 + 0.8 * static_cast<double>(i) / static_cast<double>(views.points.size()));
      const auto seen = visibility.visible_vertices(views.viewpoint(i, camera), run);
      for (const std::uint32_t v : shape.surface_vertex) {
        rows.push_back(seen[v]);
      }
    }
    return rows;
  });
  if (is_single(directions, eyes)) {
    return owned_flags(std::move(table), {extent(vertex_count)});
  }
  return owned_flags(std::move(table), {extent(views.points.size()), extent(vertex_count)});
}

/// The method's own score, as the search takes it.
std::vector<double> kssm_scores(const Analysis& analysis, const ViewOptions& options,
                                const Views& views, const RunContext& run) {
  const ShapeAnalysis& shape = analysis.shape;
  const VertexVisibility visibility(shape.surface, shape.sides, views.points.size());
  const MapScorer by_map(shape, visibility, options);
  const ViewScorer& scorer = by_map.scorer();
  if (!views.are_eyes) {
    return scorer.score_all(views.points, run);
  }
  std::vector<double> scores;
  scores.reserve(views.points.size());
  for (std::size_t i = 0; i < views.points.size(); ++i) {
    run.advance("scoring", static_cast<double>(i) / static_cast<double>(views.points.size()));
    scores.push_back(scorer.score_from(views.viewpoint(i, scorer.camera()), run));
  }
  return scores;
}

/// Values of any measures, looking once for all of them.
MeasureValues measured_scores(const Analysis& analysis, const ViewOptions& options,
                              const std::vector<Measure>& measures, const Views& views,
                              int view_set, const RunContext& run) {
  ViewMeasurer measurer(measure_subject(analysis.shape, options), measures, view_set,
                        run.part(0.0, 0.8));
  const RunContext rest = run.part(0.8, 1.0);
  if (views.sphere == view_set) {
    return measurer.set_values(rest);
  }
  if (!views.are_eyes) {
    return measurer.values(std::span<const Vec3>(views.points), rest);
  }
  std::vector<Viewpoint> eyes;
  eyes.reserve(views.points.size());
  for (std::size_t i = 0; i < views.points.size(); ++i) {
    eyes.push_back(views.viewpoint(i, {}));
  }
  return measurer.values(std::span<const Viewpoint>(eyes), rest);
}

/// \param method one name, or several.
std::vector<Measure> measures_of(const py::object& method) {
  if (py::isinstance<py::str>(method)) {
    return {find_measure(word_of(method, "method"))};
  }
  const auto names = py::reinterpret_steal<py::object>(PySequence_List(method.ptr()));
  if (!names) {
    refuse_type("method must be str or a list of them");
  }
  std::vector<Measure> measures;
  for (const py::handle name : names) {
    measures.push_back(find_measure(word_of(py::reinterpret_borrow<py::object>(name), "method")));
  }
  if (measures.empty()) {
    throw InvalidInput("method names no measure; measures() lists them");
  }
  return measures;
}

py::array score(const py::object& model, const py::object& F, const py::object& directions,
                const py::object& eyes, const py::object& sphere, const py::object& method,
                const py::object& view_set, const py::dict& options, const py::object& progress,
                const py::object& threads) {
  const Subject subject(model, F);
  const std::vector<Measure> measures = measures_of(method);
  const Settings settings = subject.settings(
      options, [&](const Settings&) { return idle_in_scores(measures, !eyes.is_none()); });
  const Views views = views_of(directions, eyes, sphere);
  const auto set = static_cast<int>(whole_number_of(view_set, "view_set", 0, kFinestViewSet));
  const bool is_of_set =
      std::any_of(measures.begin(), measures.end(), [](const Measure& m) { return m.is_of_set(); });
  if (set != kUsualViewSet && !is_of_set) {
    throw InvalidInput(
        "view_set goes with measures that are built on a set of views only, such as vmi");
  }
  const bool by_kssm = measures.size() == 1 && measures.front().name == "kssm";
  std::vector<double> table = released({progress, threads}, [&](const RunContext& run) {
    const auto analyse = [&](const Model& loaded, const ViewOptions& o, const RunContext& part) {
      return by_kssm ? with_map(loaded, o, part) : analyse_for(loaded, o, measures, part);
    };
    const auto analysis = subject.analysed(settings, analyse, run.part(0.0, 0.5));
    const RunContext rest = run.part(0.5, 1.0);
    if (by_kssm) {
      return kssm_scores(*analysis, settings.view, views, rest);
    }
    std::vector<double> rows;
    for (const std::vector<double>& row :
         measured_scores(*analysis, settings.view, measures, views, set, rest)) {
      rows.insert(rows.end(), row.begin(), row.end());
    }
    return rows;
  });
  const Shape shape{extent(measures.size()), extent(views.points.size())};
  return owned_array<double>(std::move(table), shape);
}

py::tuple directions(const py::object& level, const py::object& of_base) {
  const std::string base = word_of(of_base, "base");
  if (base != "icosahedron" && base != "cube") {
    throw InvalidInput("base is '" + base + "' but must be icosahedron or cube");
  }
  DirectionSet set =
      direction_set(base == "cube" ? ViewSphereBase::Cube : ViewSphereBase::Icosahedron,
                    level_of(level, "level"));
  return py::make_tuple(owned_array(std::move(set.directions)),
                        owned_array(std::move(set.triangles)));
}

py::list measures() {
  py::list list;
  for (const Measure& measure : builtin_measures()) {
    py::dict row;
    row["name"] = measure.name;
    row["alias"] = measure.alias.empty() ? py::object(py::none()) : py::str(measure.alias);
    row["meaning"] = measure.meaning;
    row["source"] = measure.source;
    row["better"] = measure.better == Better::More ? "more" : "less";
    row["cost"] = std::string(measure.cost());
    list.append(row);
  }
  return list;
}

}  // namespace

void define_view_functions(py::module_& module) {
  module.def("visible_vertices", &visible, py::arg("model"), py::arg("F"), py::arg("eyes"),
             py::arg("directions"), py::arg("sphere"), py::arg("options"), py::arg("progress"),
             py::arg("threads"));
  module.def("score", &score, py::arg("model"), py::arg("F"), py::arg("directions"),
             py::arg("eyes"), py::arg("sphere"), py::arg("method"), py::arg("view_set"),
             py::arg("options"), py::arg("progress"), py::arg("threads"));
  module.def("directions", &directions, py::arg("level"), py::arg("base"));
  module.def("measures", &measures);
}

}  // namespace vantage::python
