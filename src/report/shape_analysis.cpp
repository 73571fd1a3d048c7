// SPDX-License-Identifier: MIT
#include <chrono>
#include <memory>
#include <optional>
#include <utility>

#include "vantage/mesh/extent.h"
#include "vantage/mesh/measures.h"
#include "vantage/mesh/weld.h"
#include "vantage/report/focus.h"
#include "vantage/report/measured_shape.h"
#include "vantage/report/view_report.h"

#include "core/parallel.h"
#include "report/point_preparation.h"
#include "report/view_preparation.h"

namespace vantage {
namespace {

/// Seconds since `mark`, which is set to now.
double lap(std::chrono::steady_clock::time_point& mark) {
  const auto now = std::chrono::steady_clock::now();
  const double seconds = std::chrono::duration<double>(now - mark).count();
  mark = now;
  return seconds;
}

std::string counted(std::size_t count, std::string_view one, std::string_view many,
                    std::string_view rest) {
  std::string text = std::to_string(count);
  text += ' ';
  text += count == 1 ? one : many;
  text += rest;
  return text;
}

void list_repairs(const WeldedMesh& welded, const OrientedMesh& oriented, const MeshReport& check,
                  std::vector<std::string>& warnings) {
  const auto add = [&](std::size_t count, std::string_view one, std::string_view many,
                       std::string_view rest) {
    if (count > 0) {
      warnings.push_back(counted(count, one, many, rest));
    }
  };
  add(welded.merged_vertices, "vertex", "vertices",
      " welded to an earlier one at the same position");
  add(welded.dropped_faces, "face", "faces", " left out for naming one position twice");
  add(check.isolated_vertices, "vertex", "vertices", " belonging to no face left out");
  add(check.zero_area_faces, "face", "faces", " without area");
  add(check.duplicate_faces, "face", "faces", " standing there twice");
  add(check.non_manifold_edges, "edge", "edges", " with three or more faces");
  add(check.inconsistent_edges, "edge", "edges", " whose faces are wound against each other");
  add(oriented.turned_shells, "closed shell", "closed shells", " wound inside out and turned");
  std::size_t both = 0;
  for (const FaceSides sides : oriented.sides) {
    both += sides == FaceSides::Both ? 1 : 0;
  }
  if (both > 0) {
    warnings.push_back(
        "the surface is open or wound inconsistently: both sides of its faces count as visible");
  }
}

}  // namespace

void check_extent(std::span<const Vec3> points, const std::string& name) {
  if (const std::string problem = extent_problem(points); !problem.empty()) {
    throw InvalidInput(name + ": the model " + problem);
  }
}

void list_coarse_coordinates(std::span<const Vec3> points, std::vector<std::string>& warnings) {
  constexpr double kManySteps = 1e6;  // as single precision has across a model at the origin [ours]
  if (steps_across(points) < kManySteps) {
    warnings.emplace_back(
        "the model is so far from the origin that its coordinates are coarse: move it nearer and "
        "write it again");
  }
}

ShapeAnalysis prepare_surface(const Model& model, const RunContext& run) {
  if (model.mesh.triangles.empty()) {
    return prepare_points(model, run);
  }
  WeldedMesh welded = weld(model.mesh, run);
  const std::vector<Vec3> points = referenced_points(welded.mesh);
  check_extent(points, model.name);
  ShapeAnalysis shape;
  OrientedMesh oriented;
  run_both(
      run, [&] { oriented = orient_shells(welded.mesh, run); },
      [&] { shape.check = check_mesh(welded.mesh, run); });
  list_repairs(welded, oriented, shape.check, shape.warnings);
  list_coarse_coordinates(points, shape.warnings);
  run.check();
  shape.sphere = enclosing_sphere(points);
  if (welded.mesh.triangles.empty() || !(shape.sphere.diameter > 0.0)) {
    throw InvalidInput(
        model.name +
        ": all faces have collapsed to points or lines, so there is no shape to look at");
  }
  shape.surface = std::move(oriented.mesh);
  shape.sides = std::move(oriented.sides);
  shape.surface_vertex = std::move(welded.welded_of_vertex);
  return shape;
}

void add_history(ShapeAnalysis& shape, const ViewOptions& options, const RunContext& run) {
  if (shape.cloud) {
    add_point_history(shape, options, run);
  } else {
    shape.history = contract(shape.surface, options.contraction, run);
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
  shape.warnings.insert(shape.warnings.end(), shape.skeleton.warnings.begin(),
                        shape.skeleton.warnings.end());
}

void add_map(ShapeAnalysis& shape, const ViewOptions& options, const RunContext& run) {
  const Skeleton& skeleton = shape.skeleton;
  shape.map = options.kssm_to_finished_graph
                  ? compute_kssm(shape.surface, shape.history, skeleton.graph, options.kssm, run)
                  : compute_kssm(shape.surface, shape.history, skeleton.curve, options.kssm, run,
                                 skeleton.other_curve);
  if (options.method == "mesh-saliency") {
    shape.map.of_vertex = compute_mesh_saliency(shape.surface, options.saliency, run).of_vertex;
  } else if (options.method == "pmi-saliency" && surface_area(shape.surface) > 0.0) {
    shape.map.of_vertex = vertex_map(shape, options, options.method, run);
  }
}

ShapeAnalysis analyse_surface(ShapeAnalysis shape, const ViewOptions& options,
                              const RunContext& run, StageSeconds* seconds, AnalysisUse use) {
  auto mark = std::chrono::steady_clock::now();
  StageSeconds ignored;
  StageSeconds& took = seconds != nullptr ? *seconds : ignored;
  // The contraction leaves most of a second core idle.
  std::shared_ptr<const ViewPreparation> views;
  run_both(
      run,
      [&] {
        add_history(shape, options, run.part(0.0, 0.8));
        took.contract = lap(mark);
        add_skeleton(shape, options, run.part(0.8, 0.95));
        took.skeleton = lap(mark);
      },
      [&] {
        if (use == AnalysisUse::Views) {
          views = std::make_shared<ViewPreparation>(shape, run);
        }
      });
  shape.views = std::move(views);
  took.skeleton += lap(mark);
  add_map(shape, options, run.part(0.95, 1.0));
  took.map = lap(mark);
  return shape;
}

ShapeAnalysis analyse_shape(const Model& model, const ViewOptions& options, const RunContext& run,
                            StageSeconds* seconds, AnalysisUse use) {
  auto mark = std::chrono::steady_clock::now();
  ShapeAnalysis prepared = prepare_surface(model, run);
  std::optional<SceneObject> focus;  // found before the work, lest a wrong name costs minutes
  if (!options.focus.empty()) {
    focus = find_object(list_objects(model, prepared), options.focus);
  }
  if (seconds != nullptr) {
    seconds->load += lap(mark);
  }
  ShapeAnalysis shape = analyse_surface(std::move(prepared), options, run, seconds, use);
  if (focus) {
    focus_on(shape, *focus);
  }
  run.advance("map", 1.0);
  return shape;
}

std::vector<double> on_input_vertices(const ShapeAnalysis& shape, std::span<const double> field) {
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
