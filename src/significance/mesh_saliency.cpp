// SPDX-License-Identifier: MIT
#include "vantage/significance/mesh_saliency.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <nanoflann.hpp>

#include "vantage/mesh/curvature.h"
#include "vantage/mesh/measures.h"
#include "vantage/mesh/topology.h"

#include "core/parallel.h"
#include "significance/feature_map.h"

namespace vantage {
namespace {

/// Scales σ of the Gaussian means, in ε, ascending: the five of Lee 2005 and their doubles.
constexpr std::array<int, 8> kScales{2, 3, 4, 5, 6, 8, 10, 12};
/// Where in kScales the five σ and their 2σ stand.
constexpr std::array<std::array<std::size_t, 2>, 5> kPairs{
    {{0, 2}, {1, 4}, {2, 5}, {3, 6}, {4, 7}}};
/// A mean over scale σ reaches this many σ far (Lee 2005).
constexpr double kReach = 2.0;
/// A scale whose saliency spans less than this fraction of the largest |C| is flat: rounding.
constexpr double kFlat = 1e-6;
constexpr std::size_t kGrain = 256;  // vertices a task

/// The vertices that count, as nanoflann wants to see them; in units of ε, so that squares neither
/// overflow nor vanish.
struct Points {
  std::vector<Vec3> position{};
  std::vector<double> curvature{};
  std::vector<double> weight{};

  [[nodiscard]] std::size_t kdtree_get_point_count() const { return position.size(); }

  [[nodiscard]] double kdtree_get_pt(std::size_t i, std::size_t axis) const {
    return position[i][static_cast<Eigen::Index>(axis)];
  }

  template <class Bounds>
  bool kdtree_get_bbox(Bounds& /*bounds*/) const {
    return false;
  }
};

using Tree = nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<double, Points>,
                                                 Points, 3, std::uint32_t>;

/// Gathers the weighted sums of all scales while the tree is walked: a nanoflann result set.
class GaussianSums {
 public:
  using DistanceType = double;

  explicit GaussianSums(const Points& points) : points_(&points) {}

  // nanoflann calls a result set by these names.
  // NOLINTBEGIN(readability-identifier-naming)
  bool addPoint(double squared, std::uint32_t index) {
    const double weight = points_->weight[index];
    std::array<double, kScales.size()> g{};
    for (std::size_t s = kScales.size(); s-- > 0;) {
      const double sigma = kScales[s];
      if (squared > kReach * kReach * sigma * sigma) {
        break;
      }
      // The Gaussian of half a scale is the fourth power of the whole one's, and much cheaper so.
      if (s < kPairs.size()) {
        const double square = g[kPairs[s][1]] * g[kPairs[s][1]];
        g[s] = square * square;
      } else {
        g[s] = std::exp(-squared / (2.0 * sigma * sigma));
      }
      sums_[s] += weight * g[s] * points_->curvature[index];
      weights_[s] += weight * g[s];
    }
    return true;
  }

  [[nodiscard]] static bool full() { return true; }

  [[nodiscard]] static double worstDist() {
    const double reach = kReach * kScales.back();
    return std::nextafter(reach * reach, std::numeric_limits<double>::infinity());
  }

  // NOLINTEND(readability-identifier-naming)

  /// G(C, σ) of a scale; 0 if nothing near has a weight.
  [[nodiscard]] double mean(std::size_t scale) const {
    return weights_[scale] > 0.0 ? sums_[scale] / weights_[scale] : 0.0;
  }

 private:
  const Points* points_;
  std::array<double, kScales.size()> sums_{};
  std::array<double, kScales.size()> weights_{};
};

using Levels = std::array<std::vector<double>, kPairs.size()>;

/// |G(C, σ) − G(C, 2σ)| at each of the points.
Levels centre_minus_surround(const Points& points, const RunContext& run) {
  Levels levels;
  for (auto& level : levels) {
    level.resize(points.position.size());
  }
  const Tree tree(3, points, nanoflann::KDTreeSingleIndexAdaptorParams(16));
  // Blocks, so that a bar moves and a stop is seen.
  const std::size_t block = std::max<std::size_t>(kGrain, points.position.size() / 64);
  for (std::size_t first = 0; first < points.position.size(); first += block) {
    run.advance("saliency",
                static_cast<double>(first) / static_cast<double>(points.position.size()));
    const std::size_t count = std::min(block, points.position.size() - first);
    parallel_for(run, count, kGrain, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = first + begin; i < first + end; ++i) {
        GaussianSums sums(points);
        tree.findNeighbors(sums, points.position[i].data(), nanoflann::SearchParams());
        for (std::size_t l = 0; l < kPairs.size(); ++l) {
          levels[l][i] = std::abs(sums.mean(kPairs[l][0]) - sums.mean(kPairs[l][1]));
        }
      }
    });
  }
  return levels;
}

}  // namespace

MeshSaliency compute_mesh_saliency(const TriMesh& mesh, const MeshSaliencyOptions& options,
                                   const RunContext& run) {
  check_fields(options, kMeshSaliencyFields);
  const std::size_t vertex_count = mesh.positions.size();
  MeshSaliency result;
  result.curvature = mean_curvatures(mesh);
  if (!options.signed_curvature) {
    for (double& c : result.curvature) {
      c = std::abs(c);
    }
  }
  result.of_vertex.assign(vertex_count, 0.0);
  const IndexLists rings = vertex_neighbours(mesh);
  const Box box = bounding_box(referenced_points(mesh));
  const double epsilon = options.saliency_scale * box.size().norm();
  if (!(epsilon > 0.0)) {
    result.level_factor.assign(kPairs.size(), 0.0);
    return result;
  }
  const std::vector<double> areas = vertex_areas(mesh);
  Points points;
  std::vector<std::size_t> vertex_of_point;
  std::vector<bool> counted(vertex_count, false);
  double strongest = 0.0;
  for (std::size_t v = 0; v < vertex_count; ++v) {
    if (!rings[v].empty()) {
      counted[v] = true;
      vertex_of_point.push_back(v);
      points.position.emplace_back((mesh.positions[v] - box.low) / epsilon);
      points.curvature.push_back(result.curvature[v]);
      points.weight.push_back(options.area_kernel ? areas[v] : 1.0);
      strongest = std::max(strongest, std::abs(result.curvature[v]));
    }
  }
  const Levels levels = centre_minus_surround(points, run);
  const std::vector<double> alike(vertex_count, 1.0);
  std::vector<double> field(vertex_count, 0.0);
  for (const std::vector<double>& level : levels) {
    for (std::size_t i = 0; i < level.size(); ++i) {
      field[vertex_of_point[i]] = level[i];
    }
    const NormalisedField scaled = normalised(field, counted, kFlat * strongest);
    if (scaled.flat) {
      result.level_factor.push_back(0.0);
      continue;
    }
    const double mean = mean_of_local_maxima(scaled, rings, alike);
    const double factor = (1.0 - mean) * (1.0 - mean);
    result.level_factor.push_back(factor);
    for (std::size_t v = 0; v < vertex_count; ++v) {
      result.of_vertex[v] += factor * scaled.values[v];
    }
  }
  run.advance("saliency", 1.0);
  return result;
}

}  // namespace vantage
