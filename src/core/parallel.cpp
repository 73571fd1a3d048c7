// SPDX-License-Identifier: MIT
#include "core/parallel.h"

#include <algorithm>
#include <chrono>
#include <exception>
#include <future>
#include <thread>
#include <utility>
#include <vector>

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

namespace vantage {
namespace {

constexpr std::chrono::milliseconds kStopPoll{50};

}  // namespace

void with_threads(const RunContext& run, const std::function<void()>& work) {
  if (run.max_threads <= 0) {
    work();
    return;
  }
  tbb::task_arena arena(run.max_threads);
  arena.execute(work);
}

void parallel_for(const RunContext& run, std::size_t count, std::size_t grain,
                  const std::function<void(std::size_t, std::size_t)>& body) {
  run.check();
  if (count == 0) {
    return;
  }
  if (run.max_threads == 1 || count <= grain) {
    for (std::size_t begin = 0; begin < count; begin += grain) {
      run.check();
      body(begin, std::min(count, begin + grain));
    }
    return;
  }
  const std::size_t chunks = (count + grain - 1) / grain;
  with_threads(run, [&] {
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, chunks, 1),
                      [&](const tbb::blocked_range<std::size_t>& range) {
                        for (std::size_t chunk = range.begin(); chunk < range.end(); ++chunk) {
                          run.check();
                          body(chunk * grain, std::min(count, (chunk + 1) * grain));
                        }
                      });
  });
}

void interruptible(const RunContext& run, std::function<void()> work) {
  if (!run.stop.stop_possible()) {
    work();
    return;
  }
  std::promise<void> promise;
  std::future<void> done = promise.get_future();
  std::thread thread([work = std::move(work), promise = std::move(promise)]() mutable {
    try {
      work();
      promise.set_value();
    } catch (...) {
      promise.set_exception(std::current_exception());
    }
  });
  while (done.wait_for(kStopPoll) != std::future_status::ready) {
    if (run.stop.stop_requested()) {
      thread.detach();
      run.check();
    }
  }
  thread.join();
  done.get();
}

double parallel_sum(const RunContext& run, std::size_t count, std::size_t grain,
                    const std::function<double(std::size_t, std::size_t)>& body) {
  std::vector<double> sums((count + grain - 1) / grain, 0.0);
  parallel_for(run, count, grain,
               [&](std::size_t begin, std::size_t end) { sums[begin / grain] = body(begin, end); });
  double total = 0.0;
  for (const double sum : sums) {
    total += sum;
  }
  return total;
}

}  // namespace vantage
