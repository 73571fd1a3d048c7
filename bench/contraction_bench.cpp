// SPDX-License-Identifier: MIT
#include <benchmark/benchmark.h>

#include "vantage/contraction/contraction.h"

#include "support/shapes.h"

namespace vantage {
namespace {

/// A torus of about n vertices, four times as long as around.
TriMesh torus_of(std::int64_t n) {
  std::int64_t around = 8;
  while (4 * around * around < n) {
    ++around;
  }
  return test::torus(1.0, 0.25, static_cast<int>(4 * around), static_cast<int>(around));
}

void BM_Contract(benchmark::State& state) {
  const TriMesh mesh = torus_of(state.range(0));
  const ContractionHistory first = contract(mesh);
  if (first.level_count() < 2 || first.shrinkage.back() > 0.1) {
    state.SkipWithError("the torus was not contracted");
    return;
  }
  for (auto _ : state) {
    benchmark::DoNotOptimize(contract(mesh));
  }
  state.counters["steps"] = static_cast<double>(first.level_count());
  state.counters["vertices/s"] = benchmark::Counter(static_cast<double>(mesh.positions.size()),
                                                    benchmark::Counter::kIsIterationInvariantRate);
}

BENCHMARK(BM_Contract)
    ->ArgName("vertices")
    ->RangeMultiplier(4)
    ->Range(1'000, 16'000)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

}  // namespace
}  // namespace vantage
