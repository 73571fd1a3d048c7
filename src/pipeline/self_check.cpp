// SPDX-License-Identifier: MIT
#include "pipeline/self_check.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <utility>

#include "vantage/io/write.h"
#include "vantage/mesh/curve_graph.h"
#include "vantage/mesh/measures.h"
#include "vantage/pipeline/measured_shape.h"

#include "core/random.h"
#include "core/spearman.h"
#include "pipeline/percent.h"
#include "pipeline/view_preparation.h"

namespace vantage {
namespace {

/// What of the surface and of its significance such components may hold: more, and the views hang on
/// them. [ours]
constexpr double kMinorShare = 0.25;
/// Of the skeleton's length so much is outside on no sound model. [ours]
constexpr double kMostOutside = 0.02;
/// Maps of one surface should agree to this. [ours, docs/kssm.md]
constexpr double kLeastAgreement = 0.85;
/// The best view of all but 1 of 60 things of a catalogue shows more than this of what any view shows of
/// the significance; 0.448 that one. [ours]
constexpr double kLeastAttained = 0.5;
/// How far vertices are moved, of the diameter. [ours]
constexpr double kMoved = 1e-4;
/// A cloud's graph of more cycles than this, and of more than one for so many nodes, is a tangle: loops
/// that the points do not have. [ours; docs/lab]
constexpr std::size_t kMostCycles = 8;
constexpr std::size_t kNodesOfACycle = 4;
/// Vertices looked at again for each view, about. [ours]
constexpr std::size_t kAskedAgain = 4096;

/// Moves each vertex by `distance`, in a random direction of its own.
void move_vertices(TriMesh& mesh, double distance) {
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    Pcg32 random(1, v);
    Vec3 way;
    for (double& x : way) {
      x = 2.0 * random.uniform() - 1.0;
    }
    mesh.positions[v] += distance * way.normalized();
  }
}

/// The share of each component in what all faces hold, of a cloud in what all vertices do.
template <class Amount>
std::vector<double> component_shares(const ShapeAnalysis& shape, std::size_t count,
                                     const Amount& amount_of) {
  std::vector<double> shares(shape.history.components.size(), 0.0);
  double all = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    const auto [vertex, amount] = amount_of(i);
    const std::uint32_t component = shape.history.component_of_vertex[vertex];
    if (component != ContractionHistory::kIsolated) {
      shares[component] += amount;
      all += amount;
    }
  }
  for (double& share : shares) {
    share = all > 0.0 ? share / all : 0.0;
  }
  return shares;
}

std::vector<double> shares_of_surface(const ShapeAnalysis& shape) {
  using Part = std::pair<std::size_t, double>;
  if (shape.cloud) {
    return component_shares(shape, shape.surface.positions.size(),
                            [](std::size_t v) { return Part(v, 1.0); });
  }
  return component_shares(shape, shape.surface.triangles.size(), [&](std::size_t f) {
    const Triangle& t = shape.surface.triangles[f];
    return Part(t[0], area_vector(shape.surface, t).norm());
  });
}

std::vector<double> shares_of_significance(const ShapeAnalysis& shape) {
  return component_shares(shape, shape.significance.size(), [&](std::size_t v) {
    return std::pair<std::size_t, double>(v, shape.significance[v]);
  });
}

void look_at_contraction(const ShapeAnalysis& shape, std::vector<std::string>& warnings) {
  if (shape.history.components.empty()) {
    return;  // maps of other measures need no contraction
  }
  const std::vector<double> surface = shares_of_surface(shape);
  const std::vector<double> significance = shares_of_significance(shape);
  double thick = 0.0;
  double significant = 0.0;
  for (std::size_t c = 0; c < shape.history.components.size(); ++c) {
    const ComponentContraction& component = shape.history.components[c];
    if (!shape.focus.empty() && !(significance[c] > 0.0)) {
      continue;  // it only hides
    }
    const bool has_failed = component.stop == ContractionStop::SolverFailed;
    // Of clouds a_t is no area, and stays large where they have become curves.
    if ((!shape.cloud && is_plate(component.shrinkage)) || has_failed) {
      thick += surface[c];
      significant += significance[c];
    }
  }
  if (std::max(thick, significant) > kMinorShare) {
    const std::string whole = shape.cloud ? " of the points" : " of the area";
    warnings.push_back(
        "parts with " + percent(thick) + whole +
        (shape.significance.empty() ? ""
                                    : " and " + percent(significant) + " of the significance") +
        " could not be contracted to curves, so that map, skeleton and views are hardly more than "
        "a guess: flat discs and plates have none and need another --method, such as "
        "viewpoint-entropy; mend other meshes, or cut them into small even triangles");
  }
}

/// Whether something happened on the way to the map that may be the mesh's doing and not the shape's.
bool is_map_doubtful(const ShapeAnalysis& shape) {
  const auto is_odd = [](const ComponentContraction& component) {
    return component.regularised_steps > 0 || !component.remedies.empty() ||
           is_sheet(component.shrinkage);
  };
  return std::any_of(shape.history.components.begin(), shape.history.components.end(), is_odd) ||
         2 * shape.kssm.levels_used.size() <= shape.history.level_count() ||
         shape.check.non_manifold_edges + shape.check.inconsistent_edges > 0;
}

void look_at_map(const MovedMap& moved, std::vector<std::string>& warnings) {
  if (moved.is_unlike()) {
    warnings.push_back(
        unlike_map_text(moved) +
        ", so that other views may be as good: unless the shape is so even that all "
        "are, mend the mesh, cut it into small even triangles, or choose another --method");
  }
}

std::string outside_text(const ShapeAnalysis& shape) {
  return percent(shape.skeleton.outside_share) +
         " of the skeleton's length is outside the surface, so do not measure by it: look at its "
         "picture, and close or separate walls that touch, or fill or thicken thin ones";
}

void look_at_tangles(const ShapeAnalysis& shape, std::vector<std::string>& warnings) {
  const std::size_t nodes = shape.skeleton.graph.nodes.size();
  const std::size_t cycles = cycle_count(shape.skeleton.graph);
  if (shape.cloud && cycles > kMostCycles && kNodesOfACycle * cycles > nodes) {
    warnings.push_back(
        "the skeleton of the points is a tangle of " + std::to_string(cycles) + " cycles at " +
        std::to_string(nodes) +
        " nodes, so that map, skeleton and views are hardly more than a guess: thin the "
        "points out evenly, or mesh them");
  }
}

/// Vertices about which both ways to decide what a view sees disagree, of those asked again.
std::size_t disagreements(const ShapeAnalysis& shape, const VertexVisibility& visibility,
                          const Viewpoint& eye, const RunContext& run) {
  const std::size_t n = shape.surface.positions.size();
  const std::size_t stride = 1 + n / kAskedAgain;
  std::vector<std::uint8_t> asked(n, 0);
  for (std::size_t v = 0; v < n; v += stride) {
    asked[v] = 1;
  }
  const auto seen = visibility.visible_among(asked, eye, run);
  const auto again = visibility.visible_by_segments(asked, eye, run);
  std::size_t count = 0;
  for (std::size_t v = 0; v < n; ++v) {
    count += seen[v] != again[v] ? 1 : 0;
  }
  return count;
}

void look_at_views(const ShapeAnalysis& shape, const ViewReport& report, const ViewOptions& options,
                   const RunContext& run, std::vector<std::string>& warnings) {
  if (sums_a_map(options.method) && !(report.total > 0.0)) {
    warnings.emplace_back(
        "the significance map is zero everywhere, so every view is as good as any other: choose "
        "another --method");
    return;
  }
  if (!(report.best.visible_area_fraction > 0.0)) {
    warnings.emplace_back("nothing of the surface is seen from the best view: look at its picture");
  } else if (std::string blank = blank_view_warning(shape, report.best, options); !blank.empty()) {
    warnings.push_back(std::move(blank));
  }
  if (objective_of(options) == Objective::People && !options.best_view &&
      report.score_of_attainable.value_or(1.0) < kLeastAttained) {
    warnings.push_back("the best view shows " + percent(*report.score_of_attainable) +
                       " of what another shows of the significance: what tells most lies where "
                       "people seldom look from; --objective significance shows it, and another "
                       "--up turns the model");
  }
  const std::shared_ptr<const VertexVisibility> visibility = visibility_of(shape, 2);
  const std::pair<const char*, std::pair<const ReportedView*, const FoundView*>> views[] = {
      {"best", {&report.best, &report.best_search}},
      {"worst", {&report.worst, &report.worst_search}}};
  for (const auto& [name, view] : views) {
    const auto& [told, found] = view;
    const std::size_t wrong =
        disagreements(shape, *visibility, report.camera.viewpoint(told->direction), run);
    const bool same_score = !sums_a_map(options.method) ||
                            std::abs(told->score - found->score) <= 1e-9 * std::abs(report.total);
    if (wrong > 0 || !same_score) {
      warnings.push_back("what the " + std::string(name) +
                         " view sees was computed in two ways that disagree: this is an error of "
                         "the program, please report it with the model");
    }
  }
}

}  // namespace

bool MovedMap::is_unlike() const {
  return agreement < kLeastAgreement;
}

MovedMap moved_map(const ShapeAnalysis& shape, const ViewOptions& options, const RunContext& run) {
  const CoarseSurface proxy = proxy_of(shape, run.quiet());
  const bool is_small = proxy.of_vertex.empty();
  ShapeAnalysis moved;
  moved.surface = is_small ? shape.surface : proxy.mesh;
  move_vertices(moved.surface, kMoved * shape.sphere.diameter);
  const RunContext quiet = run.quiet();
  add_history(moved, options, quiet);
  add_curve(moved, options, quiet);
  add_map(moved, options, quiet);
  MovedMap map{.significance = std::vector<double>(shape.surface.positions.size(), 0.0)};
  std::vector<double> here;
  std::vector<double> there;
  for (std::size_t v = 0; v < shape.surface.positions.size(); ++v) {
    const std::uint32_t at = is_small ? static_cast<std::uint32_t>(v) : proxy.of_vertex[v];
    const bool is_focused = options.focus.empty() || shape.significance[v] > 0.0;
    if (shape.history.component_of_vertex[v] != ContractionHistory::kIsolated &&
        at != CoarseSurface::kNone && is_focused) {
      map.significance[v] = moved.significance[at];
      here.push_back(shape.significance[v]);
      there.push_back(moved.significance[at]);
    }
  }
  const double agreement = spearman(here, there);
  map.agreement = std::isnan(agreement) ? 1.0 : agreement;  // where nothing varies
  return map;
}

MovedMap checked_moved_map(const ShapeAnalysis& shape, const ViewOptions& options,
                           const RunContext& run) {
  const bool has_map = !shape.cloud && shape.views && options.method == "kssm";
  return has_map && is_map_doubtful(shape) ? moved_map(shape, options, run) : MovedMap{};
}

std::string unlike_map_text(const MovedMap& moved) {
  return "the significance map hangs on how the surface is cut into triangles: where vertices are "
         "moved by a ten-thousandth of its size its values are in another order (rank "
         "correlation " +
         number_text(std::round(100.0 * moved.agreement) / 100.0) + ")";
}

void note_a_skeleton_outside(const ShapeAnalysis& shape, std::vector<std::string>& notes) {
  const double share = shape.skeleton.outside_share;
  if (share > kMostOutside && share <= kMinorShare) {
    notes.push_back(outside_text(shape));
  }
}

void note_cycles_beyond_genus(const ShapeAnalysis& shape, std::vector<std::string>& notes) {
  const MeshReport& check = shape.check;
  const std::size_t cycles = cycle_count(shape.skeleton.graph);
  if (check.genus && cycles > *check.genus && check.non_manifold_vertices > 0) {
    notes.push_back("the skeleton has more cycles (" + std::to_string(cycles) +
                    ") than the genus says: sheets touch at " +
                    std::to_string(check.non_manifold_vertices) +
                    (check.non_manifold_vertices == 1 ? " vertex" : " vertices") +
                    ", where the skeleton goes on and the genus has them apart");
  }
}

std::vector<std::string> skeleton_warnings(const ShapeAnalysis& shape) {
  std::vector<std::string> warnings;
  look_at_contraction(shape, warnings);
  if (shape.skeleton.outside_share > kMostOutside) {
    warnings.push_back(outside_text(shape));
  }
  look_at_tangles(shape, warnings);
  return warnings;
}

std::vector<std::string> reliability_warnings(const ShapeAnalysis& shape, const ViewReport& report,
                                              const ViewOptions& options, const MovedMap& moved,
                                              const RunContext& run) {
  std::vector<std::string> warnings;
  look_at_views(shape, report, options, run, warnings);
  if (sums_a_map(options.method)) {
    look_at_contraction(shape, warnings);
    look_at_map(moved, warnings);
  }
  if (shape.skeleton.outside_share > kMinorShare) {
    warnings.push_back(outside_text(shape));
  }
  look_at_tangles(shape, warnings);
  return warnings;
}

}  // namespace vantage
