// SPDX-License-Identifier: MIT
#include <cmath>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "vantage/core/error.h"
#include "vantage/io/write.h"
#include "vantage/mesh/measures.h"
#include "vantage/mesh/mesh_check.h"
#include "vantage/pipeline/shape_analysis.h"

#include "core/counted.h"
#include "core/parallel.h"
#include "mesh/copied_faces.h"
#include "mesh/extent.h"
#include "mesh/specks.h"
#include "pipeline/prepare_points.h"

namespace vantage {
namespace {

void list_repairs(const WeldedMesh& welded, std::size_t copies, const OrientedMesh& oriented,
                  const MeshReport& check, std::vector<std::string>& warnings) {
  const auto add = [&](std::size_t count, std::string_view one, std::string_view many,
                       std::string_view rest) {
    if (count > 0) {
      warnings.push_back(counted(count, one, many, rest));
    }
  };
  add(welded.merged_vertices, "vertex", "vertices",
      " welded to an earlier one at the same position");
  add(welded.dropped_faces, "face", "faces", " left out for naming one position twice");
  add(copies, "face", "faces", " standing in the place of an earlier one left out");
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

void list_specks(const Specks& specks, std::vector<std::string>& warnings) {
  constexpr double kMuchLarger = 1.5;  // [ours]
  if (specks.enlargement >= kMuchLarger) {
    const double tenths = std::round(10.0 * specks.enlargement) / 10.0;
    warnings.push_back(counted(specks.count, "small component makes", "small components make",
                               " the box of the model " + number_text(tenths) +
                                   " times as large: if nothing is lost by it, remove " +
                                   (specks.count == 1 ? "it" : "them") +
                                   ", and pictures show the rest larger"));
  }
}

}  // namespace

void check_extent(std::span<const Vec3> points, const std::string& name) {
  if (const std::string problem = extent_problem(points); !problem.empty()) {
    throw InvalidInput(about_model(name, "the model " + problem));
  }
}

std::string about_model(const std::string& name, const std::string& problem) {
  return name.empty() ? problem : name + ": " + problem;
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
  if (const std::string problem = finite_problem(model.mesh.positions); !problem.empty()) {
    throw InvalidInput(about_model(model.name, problem));
  }
  if (model.mesh.triangles.empty()) {
    return prepare_points(model, run);
  }
  WeldedMesh welded = weld(model.mesh, run);
  const std::vector<Vec3> points = referenced_points(welded.mesh);
  check_extent(points, model.name);
  ShapeAnalysis shape;
  OrientedMesh oriented;
  const auto look = [&] {
    run_both(
        run, [&] { oriented = orient_shells(welded.mesh, run); },
        [&] { shape.check = check_mesh(welded.mesh, run); });
  };
  look();
  std::size_t copies = 0;
  if (shape.check.duplicate_faces > 0 && (copies = leave_out_copies(welded.mesh)) > 0) {
    look();
  }
  list_repairs(welded, copies, oriented, shape.check, shape.warnings);
  list_coarse_coordinates(points, shape.warnings);
  list_specks(find_specks(welded.mesh), shape.warnings);
  run.check();
  shape.sphere = enclosing_sphere(points);
  if (model.format == ModelFormat::Obj) {  // whose reader always keeps them
    shape.flow = texture_flow(model.mesh, model.appearance);
  }
  if (welded.mesh.triangles.empty() || !(shape.sphere.diameter > 0.0)) {
    throw InvalidInput(about_model(
        model.name,
        "all faces have collapsed to points or lines, so there is no shape to look at"));
  }
  shape.surface = std::move(oriented.mesh);
  shape.sides = std::move(oriented.sides);
  shape.surface_vertex = std::move(welded.welded_of_vertex);
  return shape;
}

}  // namespace vantage
