// SPDX-License-Identifier: MIT
#include "core/parallel.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <exception>
#include <future>
#include <numeric>
#include <thread>
#include <utility>

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>
#include <oneapi/tbb/task_group.h>

namespace vantage {
namespace {

constexpr std::chrono::milliseconds kStopPoll{50};

}  // namespace

void with_threads(const RunContext& run, const std::function<void()>& work) {
  // A loop inside of one that is bounded already stays in its arena: another would add threads.
  if (run.max_threads <= 0 || tbb::this_task_arena::max_concurrency() <= run.max_threads) {
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
    // Of its own: a failure of a loop around this one must not end it with chunks left out.
    tbb::task_group_context own(tbb::task_group_context::isolated);
    tbb::parallel_for(
        tbb::blocked_range<std::size_t>(0, chunks, 1),
        [&](const tbb::blocked_range<std::size_t>& range) {
          for (std::size_t chunk = range.begin(); chunk < range.end(); ++chunk) {
            run.check();
            body(chunk * grain, std::min(count, (chunk + 1) * grain));
          }
        },
        own);
  });
}

void parallel_items(const RunContext& run, std::size_t count,
                    const std::function<void(std::size_t, const RunContext&)>& body) {
  const int available = tbb::this_task_arena::max_concurrency();
  const auto threads = static_cast<std::size_t>(
      std::max(1, run.max_threads > 0 ? std::min(run.max_threads, available) : available));
  const std::size_t rounds = count - count % threads;
  const RunContext alone = run.alone();
  const RunContext together = run.quiet();
  const auto do_all = [&](std::size_t first, std::size_t last, const RunContext& own) {
    parallel_for(run, last - first, 1, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = first + begin; i < first + end; ++i) {
        body(i, own);
      }
    });
  };
  do_all(0, rounds, alone);
  do_all(rounds, count, together);
}

void parallel_items(const RunContext& run, std::string_view stage,
                    std::span<const std::size_t> sizes,
                    const std::function<void(std::size_t, const RunContext&)>& body) {
  if (sizes.size() == 1) {
    body(0, run);
    return;
  }
  const auto total =
      static_cast<double>(std::accumulate(sizes.begin(), sizes.end(), std::size_t{0}));
  std::atomic<std::size_t> done = 0;
  const std::thread::id caller = std::this_thread::get_id();
  parallel_items(run, sizes.size(), [&](std::size_t i, const RunContext& own) {
    body(i, own);
    done += sizes[i];
    if (std::this_thread::get_id() == caller) {  // who alone may report
      run.advance(stage, static_cast<double>(done) / total);
    }
  });
}

void run_both(const RunContext& run, const std::function<void()>& first,
              const std::function<void()>& second) {
  run.check();
  if (run.max_threads == 1) {
    first();
    second();
    return;
  }
  with_threads(run, [&] {
    tbb::task_group_context own(tbb::task_group_context::isolated);
    tbb::task_group beside(own);
    std::exception_ptr of_second;
    beside.run([&] {
      try {
        second();
      } catch (...) {
        of_second = std::current_exception();
      }
    });
    try {
      first();
    } catch (...) {
      beside.wait();
      throw;
    }
    beside.wait();
    if (of_second) {
      std::rethrow_exception(of_second);
    }
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

}  // namespace vantage
