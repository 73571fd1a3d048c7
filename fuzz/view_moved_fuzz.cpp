// SPDX-License-Identifier: MIT
// A small closed surface through the whole of view, and the same moved, scaled, renumbered and perhaps turned: up to
// rounding the same map, pieces and cycles of the skeleton, and scores of the same views. The same views are found
// too, but where it was turned: few vertices make plateaus of equal scores, on which the order of directions decides.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <numeric>
#include <utility>
#include <vector>

#include "vantage/io/model.h"
#include "vantage/mesh/curve_graph.h"
#include "vantage/report/view_report.h"
#include "vantage/view/scoring.h"
#include "vantage/visibility/vertex_visibility.h"

#include "choices.h"
#include "small_mesh.h"

namespace {

/// A model moved, and where each vertex of the first went.
struct MovedModel {
  vantage::Model model{};
  bool is_turned = false;
  std::vector<std::uint32_t> new_of_old{};
};

/// About (1, 1, 1), which takes the directions that are searched to themselves.
vantage::Vec3 turned(const vantage::Vec3& p) {
  return {p.z(), p.x(), p.y()};
}

MovedModel moved_model(const vantage::Model& model, Choices& choices) {
  constexpr std::array<double, 4> kScales{1.0, 1e-6, 1e6, 0.3};
  const double scale = choices.of(kScales);
  const vantage::Vec3 shift(static_cast<double>(choices.below(3)), 0.0,
                            static_cast<double>(choices.below(3)));
  const std::size_t vertices = model.mesh.positions.size();
  std::vector<std::uint32_t> old_of_new(vertices);
  std::iota(old_of_new.begin(), old_of_new.end(), 0U);
  for (std::size_t v = vertices; v > 1; --v) {
    std::swap(old_of_new[v - 1], old_of_new[choices.below(v)]);
  }
  MovedModel moved{model, choices.below(2) == 1, std::vector<std::uint32_t>(vertices)};
  for (std::uint32_t v = 0; v < vertices; ++v) {
    const vantage::Vec3& p = model.mesh.positions[old_of_new[v]];
    moved.model.mesh.positions[v] = scale * ((moved.is_turned ? turned(p) : p) + shift);
    moved.new_of_old[old_of_new[v]] = v;
  }
  for (vantage::Triangle& triangle : moved.model.mesh.triangles) {
    for (std::uint32_t& corner : triangle) {
      corner = moved.new_of_old[corner];
    }
  }
  return moved;
}

struct ViewOfModel {
  vantage::ShapeAnalysis shape{};
  vantage::ViewReport report{};
};

ViewOfModel view_of(const vantage::Model& model, vantage::ModelFrame frame) {
  vantage::ViewOptions options = quick_options();
  options.objective = vantage::Objective::Significance;
  const vantage::RunContext run{.report = {}, .stop = {}, .max_threads = 1};
  ViewOfModel view{.shape = vantage::analyse_shape(model, options, run)};
  view.report = vantage::find_views(view.shape, frame, options, run);
  return view;
}

double score_fraction(const ViewOfModel& view, const vantage::Vec3& direction) {
  const vantage::VertexVisibility visibility(view.shape.surface, view.shape.sides);
  const vantage::ViewScorer scorer(visibility, view.shape.significance, view.report.camera);
  return scorer.score(direction) / view.report.total;
}

/// \pre both are shares, of 1
void expect_near(double one, double other) {
  constexpr double kRounding = 1e-6;
  if (!(std::abs(one - other) <= kRounding)) {
    std::abort();
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size < kLeastMeshBytes) {
    return 0;
  }
  const vantage::Model model = small_star(data, size);
  const std::size_t used = std::min(size, model.mesh.positions.size());
  Choices choices(data + used, size - used);
  const MovedModel moved = moved_model(model, choices);
  const ViewOfModel one = view_of(model, {vantage::UpAxis::Y, vantage::UpAxis::Z});
  const ViewOfModel other = view_of(
      moved.model, moved.is_turned ? vantage::ModelFrame{vantage::UpAxis::Z, vantage::UpAxis::X}
                                   : vantage::ModelFrame{vantage::UpAxis::Y, vantage::UpAxis::Z});
  if (one.shape.warnings != other.shape.warnings) {
    return 0;  // rounding may decide whether a step of the contraction is taken as defined
  }
  const vantage::CurveGraph& graph = one.shape.skeleton.graph;
  const vantage::CurveGraph& other_graph = other.shape.skeleton.graph;
  if (vantage::component_count(graph) != vantage::component_count(other_graph) ||
      vantage::cycle_count(graph) != vantage::cycle_count(other_graph)) {
    std::abort();
  }
  const std::vector<double> map = vantage::on_input_vertices(one.shape, one.shape.significance);
  const std::vector<double> other_map =
      vantage::on_input_vertices(other.shape, other.shape.significance);
  const double largest = *std::max_element(map.begin(), map.end());
  const double other_largest = *std::max_element(other_map.begin(), other_map.end());
  for (std::size_t v = 0; v < map.size(); ++v) {
    expect_near(map[v] / largest, other_map[moved.new_of_old[v]] / other_largest);
  }
  const vantage::ReportedView& best = one.report.best;
  expect_near(best.score_fraction,
              score_fraction(other, moved.is_turned ? turned(best.direction) : best.direction));
  if (!moved.is_turned) {
    expect_near(best.score_fraction, other.report.best.score_fraction);
    expect_near(one.report.worst.score_fraction, other.report.worst.score_fraction);
  }
  return 0;
}
