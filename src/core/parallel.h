// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <span>
#include <string_view>
#include <vector>

#include "vantage/core/run_context.h"

/// \file
/// The only place that makes threads. Work is cut into chunks of a fixed grain, so that what a
/// chunk computes never depends on the number of threads.

namespace vantage {

/// Runs `work` with at most run.max_threads threads available to the calls below and inside it.
void with_threads(const RunContext& run, const std::function<void()>& work);

/// Calls `body(begin, end)` for chunks of at most `grain` indices that together cover [0, count).
/// Chunks must write to disjoint places. Checks run.stop before every chunk.
/// \throw Cancelled, and whatever `body` throws.
void parallel_for(const RunContext& run, std::size_t count, std::size_t grain,
                  const std::function<void(std::size_t begin, std::size_t end)>& body);

/// Calls `body(i, own)` for every i in [0, count), for bodies that can use several threads
/// themselves: one each as long as that keeps all of them busy, all together for the few that are
/// left. `own` says how many the body may take. Bodies must write to disjoint places.
/// \throw Cancelled, and whatever `body` throws.
void parallel_items(const RunContext& run, std::size_t count,
                    const std::function<void(std::size_t i, const RunContext& own)>& body);

/// The same with progress of `stage`, by the sizes of the items; a single one reports its own.
void parallel_items(const RunContext& run, std::string_view stage,
                    std::span<const std::size_t> sizes,
                    const std::function<void(std::size_t i, const RunContext& own)>& body);

/// Runs both, the second beside the first where there is a thread to spare; both have ended when
/// this returns. They must not write to what the other reads.
/// \throw what `first` throws, or else what `second` does; Cancelled
void run_both(const RunContext& run, const std::function<void()>& first,
              const std::function<void()>& second);

/// Runs `work`, which cannot look at run.stop itself, and leaves it behind if a stop is requested:
/// it then runs to its end in the background, so it must own all that it touches.
/// \throw Cancelled within a tenth of a second, and whatever `work` throws.
void interruptible(const RunContext& run, std::function<void()> work);

/// Sorts in chunks that are then merged pair by pair. \pre less leaves no two items equal, so that
/// there is one answer.
template <typename T, typename Less>
void parallel_sort(const RunContext& run, std::vector<T>& items, std::size_t grain,
                   const Less& less) {
  parallel_for(run, items.size(), grain, [&](std::size_t begin, std::size_t end) {
    std::sort(items.data() + begin, items.data() + end, less);
  });
  for (std::size_t sorted = grain; sorted < items.size(); sorted *= 2) {
    parallel_for(run, items.size(), 2 * sorted, [&](std::size_t begin, std::size_t end) {
      std::inplace_merge(items.data() + begin, items.data() + std::min(begin + sorted, end),
                         items.data() + end, less);
    });
  }
}

}  // namespace vantage
