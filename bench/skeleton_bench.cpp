// SPDX-License-Identifier: MIT
#include <benchmark/benchmark.h>

#include "vantage/skeleton/skeleton.h"

#include "support/shapes.h"
#include "support/voxel_surface.h"

namespace vantage {
namespace {

/// Surgery, sampling, centring and pruning of a contracted Y; the contraction is not timed.
void BM_ExtractSkeleton(benchmark::State& state) {
  const TriMesh mesh = test::y_of_tubes(0.25, static_cast<int>(state.range(0)));
  const ContractionHistory history = contract(mesh);
  const Skeleton first = extract_skeleton(mesh, history);
  if (cycle_count(first.graph) != 0 || component_count(first.graph) != 1) {
    state.SkipWithError("the skeleton of a Y is a tree");
    return;
  }
  for (auto _ : state) {
    benchmark::DoNotOptimize(extract_skeleton(mesh, history));
  }
  state.counters["vertices"] = static_cast<double>(mesh.positions.size());
  state.counters["vertices/s"] = benchmark::Counter(static_cast<double>(mesh.positions.size()),
                                                    benchmark::Counter::kIsIterationInvariantRate);
}

BENCHMARK(BM_ExtractSkeleton)
    ->ArgName("cells")
    ->RangeMultiplier(2)
    ->Range(16, 32)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

/// The same for a plate with that many holes: what guarding handles costs.
void BM_ExtractSkeletonOfAPlate(benchmark::State& state) {
  const TriMesh mesh = test::plate_with_holes(static_cast<int>(state.range(0)));
  const ContractionHistory history = contract(mesh);
  if (cycle_count(extract_skeleton(mesh, history).graph) !=
      static_cast<std::size_t>(state.range(0))) {
    state.SkipWithError("the skeleton of a plate has a cycle for each hole");
    return;
  }
  for (auto _ : state) {
    benchmark::DoNotOptimize(extract_skeleton(mesh, history));
  }
  state.counters["vertices"] = static_cast<double>(mesh.positions.size());
}

BENCHMARK(BM_ExtractSkeletonOfAPlate)
    ->ArgName("holes")
    ->RangeMultiplier(4)
    ->Range(4, 64)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

}  // namespace
}  // namespace vantage
