// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include "vantage/mesh/measures.h"

#include "core/parallel.h"
#include "spatial/point_rings.h"
#include "spatial/point_tree.h"

namespace vantage {
namespace {

constexpr std::size_t kPointsPerTask = 2048;
/// Tries to meet the wanted number of samples.
constexpr int kTries = 8;
/// A sample this much smaller than wanted is good enough.
constexpr double kShare = 0.75;
/// Samples checked between two looks at the stop token.
constexpr std::size_t kPoll = 1024;

/// Takes points in order of their index unless a sample lies nearer than `radius`; stops, one too
/// many, when there are more than `most`.
std::vector<std::uint32_t> thin_out(std::span<const Vec3> points, const PointTree& tree,
                                    double radius, std::size_t most, const RunContext& run) {
  std::vector<std::uint8_t> covered(points.size(), 0);
  std::vector<std::uint32_t> sample;
  std::vector<PointTree::Match> near;
  for (std::uint32_t i = 0; i < points.size() && sample.size() <= most; ++i) {
    if (covered[i] != 0) {
      continue;
    }
    sample.push_back(i);
    tree.within(points[i], radius, near);
    for (const auto& match : near) {
      covered[match.first] = 1;
    }
    if (sample.size() % kPoll == 0) {
      run.check();
    }
  }
  return sample;
}

}  // namespace

std::vector<std::uint32_t> spread_sample(std::span<const Vec3> points, std::size_t count,
                                         const RunContext& run) {
  if (points.size() <= count) {
    std::vector<std::uint32_t> all(points.size());
    for (std::uint32_t i = 0; i < all.size(); ++i) {
      all[i] = i;
    }
    return all;
  }
  const PointTree tree(points);
  // Enough balls of the first radius cover a surface of the cloud's extent; the rest is bisection.
  const double extent = enclosing_sphere(points).diameter;
  double high = extent;
  double low = 0.0;
  double radius = extent / std::sqrt(static_cast<double>(count));
  std::vector<std::uint32_t> best;
  for (int attempt = 0; attempt < kTries || best.empty(); ++attempt) {
    std::vector<std::uint32_t> sample = thin_out(points, tree, radius, count, run);
    if (sample.size() > count) {
      low = radius;
      radius = std::min(1.4 * radius, 0.5 * (radius + high));
      continue;
    }
    const double share = static_cast<double>(sample.size()) / static_cast<double>(count);
    best = sample.size() > best.size() ? std::move(sample) : std::move(best);
    if (share > kShare) {
      break;
    }
    high = radius;
    radius = std::max(radius * std::sqrt(std::max(share, 0.01)) * 1.05, 0.5 * (low + high));
    radius = low > 0.0 ? std::min(radius, 0.5 * (low + high)) : std::min(radius, 0.95 * high);
  }
  return best;
}

NeighbourDistances neighbour_distances(std::span<const Vec3> points, std::size_t k,
                                       const RunContext& run) {
  NeighbourDistances result;
  result.mean.assign(points.size(), 0.0);
  result.median_of_neighbours.assign(points.size(), 0.0);
  const PointTree tree(points);
  const std::size_t wanted = std::min(k + 1, points.size());
  std::vector<std::uint32_t> near(points.size() * wanted);
  parallel_for(run, points.size(), kPointsPerTask, [&](std::size_t begin, std::size_t end) {
    std::vector<std::size_t> found(wanted);
    std::vector<double> squared(wanted);
    for (std::size_t i = begin; i < end; ++i) {
      static_cast<void>(tree.nearest(points[i], found, squared));
      for (std::size_t j = 0; j < wanted; ++j) {
        near[i * wanted + j] = static_cast<std::uint32_t>(found[j]);
        result.mean[i] += std::sqrt(squared[j]) / static_cast<double>(wanted - 1);
      }
    }
  });
  parallel_for(run, points.size(), kPointsPerTask, [&](std::size_t begin, std::size_t end) {
    std::vector<double> values;
    for (std::size_t i = begin; i < end; ++i) {
      values.clear();
      for (std::size_t j = 0; j < wanted; ++j) {
        values.push_back(result.mean[near[i * wanted + j]]);
      }
      const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
      std::nth_element(values.begin(), middle, values.end());
      result.median_of_neighbours[i] = *middle;
    }
  });
  return result;
}

std::vector<NearestThree> nearest_three(std::span<const Vec3> points, std::span<const Vec3> targets,
                                        const RunContext& run) {
  std::vector<NearestThree> result(points.size());
  const PointTree tree(targets);
  parallel_for(run, points.size(), kPointsPerTask, [&](std::size_t begin, std::size_t end) {
    std::array<std::size_t, 3> found{};
    std::array<double, 3> squared{};
    for (std::size_t i = begin; i < end; ++i) {
      const std::size_t count = tree.nearest(points[i], found, squared);
      NearestThree& three = result[i];
      three.index.fill(static_cast<std::uint32_t>(found[0]));
      three.weight = {1.0, 0.0, 0.0};
      if (!(squared[0] > 0.0)) {
        continue;
      }
      double sum = 0.0;
      for (std::size_t j = 0; j < count; ++j) {
        three.index[j] = static_cast<std::uint32_t>(found[j]);
        three.weight[j] = squared[0] / squared[j];
        sum += three.weight[j];
      }
      for (double& w : three.weight) {
        w /= sum;
      }
    }
  });
  return result;
}

}  // namespace vantage
