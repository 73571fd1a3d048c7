// SPDX-License-Identifier: MIT
#pragma once

#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/task_arena.h>

namespace vantage::test {

/// What `work` returns where eight threads may take part, however few cores there are. Work that asks for more threads
/// than the arena it is called in has is done by that arena's: without one of eight, on two cores, three threads are
/// two, whatever is allowed at most.
template <typename Work>
decltype(auto) with_many_threads(const Work& work) {
  const tbb::global_control allowed(tbb::global_control::max_allowed_parallelism, 8);
  tbb::task_arena arena(8);
  return arena.execute(work);
}

}  // namespace vantage::test
