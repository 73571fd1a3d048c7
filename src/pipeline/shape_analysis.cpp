// SPDX-License-Identifier: MIT
#include "vantage/pipeline/shape_analysis.h"

#include <array>
#include <chrono>
#include <memory>
#include <optional>
#include <utility>

#include "vantage/mesh/measures.h"
#include "vantage/mesh/mesh_check.h"
#include "vantage/pipeline/find_views.h"
#include "vantage/pipeline/measured_shape.h"

#include "core/parallel.h"
#include "core/sizes.h"
#include "mesh/extent.h"
#include "pipeline/prepare_points.h"
#include "pipeline/required_steps.h"
#include "pipeline/view_preparation.h"

namespace vantage {
namespace {

/// Seconds since `mark`, which is set to now.
double lap(std::chrono::steady_clock::time_point& mark) {
  const auto now = std::chrono::steady_clock::now();
  const double seconds = std::chrono::duration<double>(now - mark).count();
  mark = now;
  return seconds;
}

/// Sets to 0 what is not in the shape's focus, if it has one.
void keep_focus(const ShapeAnalysis& shape, std::vector<double>& significance) {
  if (shape.focus.empty()) {
    return;
  }
  std::vector<double> kept(significance.size(), 0.0);
  for (const std::uint32_t v : shape.focus) {
    kept[v] = significance[v];
  }
  significance = std::move(kept);
}

/// Carries the skeleton's warnings to those of the analysis.
void note_skeleton(ShapeAnalysis& shape) {
  shape.warnings.insert(shape.warnings.end(), shape.skeleton.warnings.begin(),
                        shape.skeleton.warnings.end());
}

}  // namespace

void add_history(ShapeAnalysis& shape, const ViewOptions& options, const RunContext& run) {
  if (shape.cloud) {
    add_point_history(shape, options, run);
  } else {
    ContractionOptions contraction = options.contraction;
    // Nothing else than a fitted curve and its map asks for it.
    contraction.second_mesh &= options.skeleton.fit && !options.kssm_to_finished_graph;
    shape.history = contract(shape.surface, contraction, run);
  }
  shape.warnings.insert(shape.warnings.end(), shape.history.warnings.begin(),
                        shape.history.warnings.end());
}

void add_skeleton(ShapeAnalysis& shape, const ViewOptions& options, const RunContext& run) {
  if (shape.cloud) {
    add_point_skeleton(shape, options, run);
  } else {
    shape.skeleton = extract_skeleton(shape.surface, shape.history, options.skeleton, run);
  }
  note_skeleton(shape);
}

void add_curve(ShapeAnalysis& shape, const ViewOptions& options, const RunContext& run) {
  if (shape.cloud || options.kssm_to_finished_graph || !sums_a_map(options.method)) {
    add_skeleton(shape, options, run);
  } else {
    shape.skeleton = extract_curve(shape.surface, shape.history, options.skeleton, run);
    note_skeleton(shape);
  }
}

void add_map(ShapeAnalysis& shape, const ViewOptions& options, const RunContext& run) {
  const Skeleton& skeleton = shape.skeleton;
  KssmOptions kssm = options.kssm;
  kssm.area_weighted_mean |= options.weight == Weight::Area;
  shape.kssm = options.kssm_to_finished_graph
                   ? compute_kssm(shape.surface, shape.history, skeleton.graph, kssm, run)
                   : compute_kssm(shape.surface, shape.history, skeleton, kssm, run);
  shape.significance = shape.kssm.of_vertex;
  if (options.method == "mesh-saliency") {
    shape.significance = compute_mesh_saliency(shape.surface, options.saliency, run).of_vertex;
  } else if (options.method == "pmi-saliency" && surface_area(shape.surface) > 0.0) {
    shape.significance = vertex_map(shape, options, options.method, run);
  }
  keep_focus(shape, shape.significance);
}

namespace {

/// What the search by the options' method will ask.
PreparedFor use_of(const ShapeAnalysis& shape, const ViewOptions& options) {
  PreparedFor use;
  if (sums_a_map(options.method)) {
    if (options.search.strategy == SearchStrategy::Global) {
      use.survey = scoring_camera(shape, options);
    }
  } else if (const Measure& measure = find_measure(options.method);
             measure.is_of_set() && surface_area(shape.surface) > 0.0) {
    use.measures = scoring_camera(shape, options);
    use.channel = measure.needs.channel;
  }
  return use;
}

}  // namespace

ShapeAnalysis analyse_surface(ShapeAnalysis shape, const ViewOptions& options,
                              const RunContext& run, StageSeconds* seconds, AnalysisUse use) {
  auto mark = std::chrono::steady_clock::now();
  StageSeconds ignored;
  StageSeconds& took = seconds != nullptr ? *seconds : ignored;
  if (!sums_a_map(options.method)) {
    require_memory(std::array{find_measure(options.method)}, shape.surface.triangles.size());
  }
  // The contraction leaves most of a second core idle.
  std::shared_ptr<const ViewPreparation> views;
  run_both(
      run,
      [&] {
        add_history(shape, options, run.part(0.0, 0.8));
        took.contract = lap(mark);
        const auto add = use == AnalysisUse::Picture ? add_curve : add_skeleton;
        add(shape, options, run.part(0.8, 0.95));
        took.skeleton = lap(mark);
      },
      [&] {
        if (use != AnalysisUse::Map) {
          views = std::make_shared<ViewPreparation>(shape, run, use_of(shape, options));
        }
      });
  shape.views = std::move(views);
  took.search += lap(mark);  // what of the preparation the contraction did not cover
  add_map(shape, options, run.part(0.95, 1.0));
  took.map = lap(mark);
  return shape;
}

ShapeAnalysis analyse_shape(const Model& model, const ViewOptions& options, const RunContext& run,
                            StageSeconds* seconds, AnalysisUse use) {
  auto mark = std::chrono::steady_clock::now();
  ShapeAnalysis prepared = prepare_surface(model, options, run);
  if (use != AnalysisUse::Map && sums_a_map(options.method)) {
    require_view(prepared, model.name);
  }
  if (seconds != nullptr) {
    seconds->load += lap(mark);
  }
  ShapeAnalysis shape = analyse_surface(std::move(prepared), options, run, seconds, use);
  run.advance("map", 1.0);
  return shape;
}

std::vector<double> on_input_vertices(const ShapeAnalysis& shape, std::span<const double> field) {
  require_count(field.size(), "values of the field", shape.surface.positions.size(),
                "vertices of the surface");
  std::vector<double> values;
  values.reserve(shape.surface_vertex.size());
  for (const std::uint32_t v : shape.surface_vertex) {
    values.push_back(field[v]);
  }
  return values;
}

std::vector<std::int64_t> nodes_of_input_vertices(const ShapeAnalysis& shape) {
  std::vector<std::int64_t> nodes;
  nodes.reserve(shape.surface_vertex.size());
  for (const std::uint32_t v : shape.surface_vertex) {
    const std::uint32_t node = shape.skeleton.node_of_vertex[v];
    nodes.push_back(node == Skeleton::kNone ? -1 : static_cast<std::int64_t>(node));
  }
  return nodes;
}

}  // namespace vantage
