// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <utility>

#include <pybind11/stl.h>

#include "vantage/core/error.h"
#include "vantage/mesh/curve_graph.h"
#include "vantage/pipeline/measured_shape.h"
#include "vantage/skeleton/skeleton.h"

#include "arguments.h"
#include "arrays.h"
#include "released_run.h"
#include "subject.h"
#include "text.h"

namespace vantage::python {
namespace {

/// All levels after another, on the input's vertices.
template <class Value>
std::vector<Value> stacked_levels(const ShapeAnalysis& shape,
                                  const std::vector<std::vector<Value>>& levels) {
  std::vector<Value> all;
  all.reserve(levels.size() * shape.surface_vertex.size());
  for (const std::vector<Value>& level : levels) {
    for (const std::uint32_t v : shape.surface_vertex) {
      all.push_back(level[v]);
    }
  }
  return all;
}

/// What skeleton() gives, before Python sees it.
struct SkeletonParts {
  CurveGraph graph{};
  std::vector<double> radius{};
  std::vector<std::int64_t> vertex_node{};
  std::vector<std::vector<std::uint32_t>> branches{};
  std::vector<Vec3> levels{};
  std::size_t level_count = 0;
  std::vector<double> shrinkage{};
  std::vector<std::string> warnings{};
  std::optional<SkeletonQuality> quality{};
};

SkeletonParts skeleton_parts(const Analysis& analysis, bool levels, bool measure,
                             const RunContext& run) {
  const ShapeAnalysis& shape = analysis.shape;
  SkeletonParts parts{.graph = shape.skeleton.graph,
                      .radius = shape.skeleton.radius,
                      .vertex_node = nodes_of_input_vertices(shape),
                      .branches = graph_branches(shape.skeleton.graph),
                      .level_count = shape.history.levels.size(),
                      .shrinkage = shape.history.shrinkage,
                      .warnings = shape.warnings};
  if (levels) {
    parts.levels = stacked_levels(shape, shape.history.levels);
  }
  if (measure) {
    parts.quality =
        measure_skeleton(shape.surface, shape.history.component_of_vertex, shape.skeleton,
                         sample_spacing(shape.surface, analysis.settings.view.skeleton), run);
  }
  return parts;
}

py::dict quality_dict(const SkeletonQuality& quality, double diameter) {
  const double whole = quality.length > 0.0 ? quality.length : 1.0;
  py::dict result;
  result["ends"] = quality.ends;
  result["outside_fraction"] = quality.outside_length / whole;
  result["thin_outside_fraction"] = quality.thin_outside / whole;
  result["farthest_over_radius"] = quality.farthest_ratio;
  result["farthest_over_diameter"] = quality.farthest / diameter;
  result["off_centre"] = quality.off_centre;
  result["seen_fraction"] = quality.seen_fraction;
  return result;
}

py::dict skeleton(const py::object& model, const py::object& F, const py::object& levels,
                  const py::object& measure, const py::dict& options, const py::object& progress,
                  const py::object& threads) {
  const Subject subject(model, F);
  const Settings settings = subject.settings(options);
  const bool wants_levels = switch_of(levels, "levels");
  const bool wants_quality = switch_of(measure, "measure");
  double diameter = 1.0;
  SkeletonParts parts = released({progress, threads}, [&](const RunContext& run) {
    const auto analysis = subject.analysed(settings, with_skeleton, run.part(0.0, 0.9));
    diameter = analysis->shape.sphere.diameter;
    return skeleton_parts(*analysis, wants_levels, wants_quality, run.part(0.9, 1.0));
  });
  py::dict result;
  result["components"] = component_count(parts.graph);
  result["cycles"] = cycle_count(parts.graph);
  result["length"] = total_length(parts.graph);
  result["nodes"] = owned_array(std::move(parts.graph.nodes));
  result["edges"] = owned_array(std::move(parts.graph.edges));
  result["radius"] = owned_array(std::move(parts.radius));
  result["shrinkage"] = owned_array(std::move(parts.shrinkage));
  py::list branches;
  for (std::vector<std::uint32_t>& branch : parts.branches) {
    branches.append(owned_array(std::move(branch)));
  }
  result["branches"] = py::tuple(branches);
  result["levels"] = py::none();
  if (wants_levels) {
    const Shape shape{extent(parts.level_count), extent(parts.vertex_node.size()), 3};
    result["levels"] = owned_array<double>(std::move(parts.levels), shape);
  }
  result["vertex_node"] = owned_array(std::move(parts.vertex_node));
  result["quality"] =
      parts.quality ? py::object(quality_dict(*parts.quality, diameter)) : py::none();
  result["warnings"] = messages_of(parts.warnings);
  return result;
}

/// What kssm() gives, before Python sees it.
struct MapParts {
  std::vector<double> of_vertex{};
  std::vector<double> thickness{};
  std::vector<double> level_factor{};
  std::vector<double> displacement{};
  std::size_t level_count = 0;
  std::vector<std::string> warnings{};
};

py::dict kssm(const py::object& model, const py::object& F, const py::object& levels,
              const py::dict& options, const py::object& progress, const py::object& threads) {
  const Subject subject(model, F);
  const Settings settings = subject.settings(options);
  const bool wants_levels = switch_of(levels, "levels");
  MapParts parts = released({progress, threads}, [&](const RunContext& run) {
    const auto analysis = subject.analysed(settings, with_map, run);
    const ShapeAnalysis& shape = analysis->shape;
    return MapParts{.of_vertex = on_input_vertices(shape, shape.significance),
                    .thickness = on_input_vertices(shape, shape.kssm.thickness()),
                    .level_factor = shape.kssm.level_factor,
                    .displacement = wants_levels ? stacked_levels(shape, shape.kssm.displacement)
                                                 : std::vector<double>{},
                    .level_count = shape.kssm.displacement.size(),
                    .warnings = shape.warnings};
  });
  py::dict result;
  result["displacement"] = py::none();
  if (wants_levels) {
    const Shape shape{extent(parts.level_count), extent(parts.of_vertex.size())};
    result["displacement"] = owned_array<double>(std::move(parts.displacement), shape);
  }
  result["of_vertex"] = owned_array(std::move(parts.of_vertex));
  result["thickness"] = owned_array(std::move(parts.thickness));
  result["level_factor"] = owned_array(std::move(parts.level_factor));
  result["warnings"] = messages_of(parts.warnings);
  return result;
}

py::array map_of(const py::object& model, const py::object& F, const py::object& map,
                 const py::dict& options, const py::object& progress, const py::object& threads) {
  const Subject subject(model, F);
  const std::string method = word_of(map, "method");
  constexpr std::array kMaps{"kssm", "thickness", "mesh-saliency", "pmi-saliency"};
  if (std::find(kMaps.begin(), kMaps.end(), method) == kMaps.end()) {
    throw InvalidInput("there is no map '" + method +
                       "'; there are kssm, thickness, mesh-saliency, pmi-saliency");
  }
  const Settings settings =
      subject.settings(options, [&](const Settings&) { return idle_in_map(method); });
  const bool by_skeleton = method == "kssm" || method == "thickness";
  return owned_array(released({progress, threads}, [&](const RunContext& run) {
    const auto analysis = subject.analysed(settings, by_skeleton ? with_map : surface_only,
                                           run.part(0.0, by_skeleton ? 0.95 : 0.05));
    const ShapeAnalysis& shape = analysis->shape;
    return on_input_vertices(shape, method == "thickness"
                                        ? shape.kssm.thickness()
                                        : vertex_map(shape, settings.view, method,
                                                     run.part(by_skeleton ? 0.95 : 0.05, 1.0)));
  }));
}

}  // namespace

void define_shape_functions(py::module_& module) {
  module.def("skeleton", &skeleton, py::arg("model"), py::arg("F"), py::arg("levels"),
             py::arg("measure"), py::arg("options"), py::arg("progress"), py::arg("threads"));
  module.def("kssm", &kssm, py::arg("model"), py::arg("F"), py::arg("levels"), py::arg("options"),
             py::arg("progress"), py::arg("threads"));
  module.def("vertex_map", &map_of, py::arg("model"), py::arg("F"), py::arg("method"),
             py::arg("options"), py::arg("progress"), py::arg("threads"));
}

}  // namespace vantage::python
