// SPDX-License-Identifier: MIT
#include "vantage/report/quick_view.h"

#include <memory>
#include <utility>
#include <vector>

#include "vantage/mesh/measures.h"
#include "vantage/render/framing.h"

#include "core/parallel.h"
#include "mesh/decimation.h"
#include "report/twins.h"
#include "report/vertex_share.h"
#include "report/view_preparation.h"
#include "view/compact_surface.h"
#include "view/pruned_search.h"

namespace vantage {
namespace {

/// Vertices of the coarse copy; fewer lose fingers and tails. [ours]
constexpr std::size_t kCoarseVertices = 3000;
/// A surface of fewer vertices is taken as it is. [ours]
constexpr std::size_t kWorthwhile = 4000;

/// A shape to contract, and how many vertices of the model each of its vertices stands for.
struct CoarseShape {
  ShapeAnalysis shape{};
  std::vector<double> merged{};
};

CoarseShape coarse_copy(const ShapeAnalysis& fine, const RunContext& run) {
  if (fine.cloud) {  // its contraction takes samples of its own
    return {fine, std::vector<double>(fine.surface.positions.size(), 1.0)};
  }
  CompactSurface whole = compact_surface(fine.surface, fine.sides);
  CoarseShape coarse;
  coarse.shape.sphere = fine.sphere;
  coarse.shape.check = fine.check;
  // A collapse keeps components apart and their order, and so the sides.
  coarse.shape.sides = std::move(whole.sides);
  if (whole.mesh.positions.size() < kWorthwhile) {
    coarse.merged.assign(whole.mesh.positions.size(), 1.0);
    coarse.shape.surface = std::move(whole.mesh);
    return coarse;
  }
  Decimation decimated = decimate(whole.mesh, kCoarseVertices, run);
  coarse.merged.assign(decimated.mesh.positions.size(), 0.0);
  for (const std::uint32_t vertex : decimated.of_vertex) {
    coarse.merged[vertex] += 1.0;
  }
  coarse.shape.surface = std::move(decimated.mesh);
  return coarse;
}

}  // namespace

QuickView find_quick_view(const Model& model, const ShapeAnalysis& shape,
                          const ViewOptions& options, const RunContext& run) {
  CoarseShape coarse = coarse_copy(shape, run.part(0.0, 0.3));
  ShapeAnalysis& small = coarse.shape;
  std::shared_ptr<const ViewPreparation> views;
  run_both(
      run,
      [&] {
        add_history(small, options, run.part(0.3, 0.7));
        add_skeleton(small, options, run.part(0.7, 0.8));
      },
      [&] { views = std::make_shared<ViewPreparation>(small); });
  small.views = std::move(views);
  add_map(small, options, run.part(0.8, 0.85));
  for (std::size_t v = 0; v < coarse.merged.size(); ++v) {
    small.map.of_vertex[v] *= coarse.merged[v];
  }
  QuickView view;
  view.vertices = small.surface.positions.size();
  view.up = choose_up(model, small, options);
  const Vec3 up = up_vector(view.up.axis);
  const UprightFrame frame = upright_frame(up);
  const ScoringCamera camera = scoring_camera(shape, options);
  const ViewScorer scorer(small.views->visibility, small.map.of_vertex, camera);
  RunContext batch_run = run;
  batch_run.report = nullptr;
  const ScoreBatch score = [&](const std::vector<Vec3>& directions) {
    return scorer.score_all(directions, batch_run);
  };
  const DirectionFactor factor = [&](const Vec3& d) { return options.prior.factor(frame, d); };
  const FoundView found = pruned_search(score, scorer.total(), factor, run.part(0.85, 1.0));
  TwinView best{found.direction, found.score, found.score * factor(found.direction)};
  std::vector<TwinView> twins = twins_of(best.direction, small, scorer, options.prior, frame);
  settle_near_ties(best, twins, frame);
  view.direction = best.direction;
  view.evaluations = found.evaluations;
  view.picture = frame_points(
      referenced_points(shape.surface), camera.viewpoint(view.direction), camera.sphere.centre, up,
      static_cast<double>(options.width) / options.height, options.margin_percent / 100.0);
  run.advance("search", 1.0);
  return view;
}

}  // namespace vantage
