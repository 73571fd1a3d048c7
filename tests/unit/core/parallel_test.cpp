// SPDX-License-Identifier: MIT
#include "core/parallel.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <functional>
#include <numeric>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "vantage/core/error.h"

#include "support/many_threads.h"

namespace vantage {
namespace {

using test::with_many_threads;

/// Terms whose sum depends on the order of addition.
double term(std::size_t i) {
  return std::sin(static_cast<double>(i)) * std::pow(10.0, static_cast<double>(i % 17));
}

/// Their sum over chunks, added in the order of these.
double sum_with(int threads) {
  constexpr std::size_t kCount = 10'007;
  constexpr std::size_t kGrain = 64;
  std::vector<double> sums((kCount + kGrain - 1) / kGrain, 0.0);
  parallel_for({.max_threads = threads}, kCount, kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      sums[begin / kGrain] += term(i);
    }
  });
  return std::accumulate(sums.begin(), sums.end(), 0.0);
}

class ForThreads : public ::testing::TestWithParam<int> {};

TEST_P(ForThreads, ChunksAreThoseOfOneThread) {
  with_many_threads([] {
    const double expected = sum_with(1);
    for (int repeat = 0; repeat < 20; ++repeat) {
      EXPECT_EQ(sum_with(GetParam()), expected);
    }
  });
}

TEST_P(ForThreads, ParallelForVisitsEveryIndexOnce) {
  with_many_threads([] {
    std::vector<std::atomic<int>> visits(1003);
    parallel_for({.max_threads = GetParam()}, visits.size(), 10,
                 [&](std::size_t begin, std::size_t end) {
                   EXPECT_LE(end - begin, 10U);
                   for (std::size_t i = begin; i < end; ++i) {
                     ++visits[i];
                   }
                 });
    for (const auto& count : visits) {
      EXPECT_EQ(count.load(), 1);
    }
  });
}

TEST_P(ForThreads, ParallelSortPutsAllInOrder) {
  with_many_threads([] {
    RunContext run;
    run.max_threads = GetParam();
    for (const std::size_t count : {0U, 1U, 99U, 100U, 101U, 350U, 1000U}) {
      std::vector<int> numbers(count);
      std::iota(numbers.begin(), numbers.end(), 0);
      std::vector<int> shuffled = numbers;
      std::shuffle(shuffled.begin(), shuffled.end(), std::mt19937(7));
      parallel_sort(run, shuffled, 100, std::less<>());
      EXPECT_EQ(shuffled, numbers);
    }
  });
}

TEST_P(ForThreads, ExceptionsReachTheCaller) {
  const auto fail = [](std::size_t begin, std::size_t) {
    if (begin >= 500) {
      throw std::runtime_error("from a chunk");
    }
  };
  const auto run = [&] { parallel_for({.max_threads = GetParam()}, 1000, 10, fail); };
  EXPECT_THROW(with_many_threads(run), std::runtime_error);
}

TEST_P(ForThreads, AStopRequestEndsTheLoop) {
  std::stop_source source;
  const RunContext run{.stop = source.get_token(), .max_threads = GetParam()};
  const auto stop = [&](std::size_t, std::size_t) { source.request_stop(); };
  EXPECT_THROW(with_many_threads([&] { parallel_for(run, 1000, 1, stop); }), Cancelled);
}

/// What parallel_items() called.
struct Calls {
  bool each_once = true;
  bool told_right = true;         // how many threads an item may take
  bool inner_loops_right = true;  // inside of items
  std::size_t together = 0;       // items that may take more than one
};

Calls calls_for(std::size_t count, int threads) {
  std::vector<std::atomic<int>> visits(count);
  std::atomic<std::size_t> together{0};
  std::atomic<int> wrong{0};
  std::atomic<int> wrong_loops{0};
  parallel_items({.max_threads = threads}, count, [&](std::size_t i, const RunContext& own) {
    ++visits[i];
    together += own.max_threads == 1 ? 0 : 1;
    wrong += own.max_threads == 1 || own.max_threads == threads ? 0 : 1;
    std::atomic<std::size_t> passed{0};
    parallel_for(own, 100, 10, [&](std::size_t begin, std::size_t end) { passed += end - begin; });
    wrong_loops += passed == 100 ? 0 : 1;
  });
  return {std::all_of(visits.begin(), visits.end(), [](const auto& n) { return n.load() == 1; }),
          wrong.load() == 0, wrong_loops.load() == 0, together.load()};
}

TEST_P(ForThreads, EveryItemIsDoneOnceAndToldWhatItMayTake) {
  with_many_threads([] {
    for (const std::size_t count : {0U, 1U, 3U, 8U, 11U, 50U}) {
      const Calls calls = calls_for(count, GetParam());
      EXPECT_TRUE(calls.each_once && calls.told_right && calls.inner_loops_right) << count;
      if (GetParam() > 0) {
        EXPECT_LT(calls.together, static_cast<std::size_t>(GetParam())) << "only what is left over";
      }
    }
  });
}

/// What a call throws: its words, or "nothing".
std::string thrown_by(const std::function<void()>& call) {
  try {
    call();
  } catch (const Cancelled&) {
    return "cancelled";
  } catch (const std::exception& error) {
    return error.what();
  }
  return "nothing";
}

TEST_P(ForThreads, AnItemsExceptionReachesTheCaller) {
  with_many_threads([] {
    const auto fail = [](std::size_t i, const RunContext&) {
      if (i == 6) {
        throw std::runtime_error("the odd one");
      }
    };
    EXPECT_EQ(thrown_by([&] { parallel_items({.max_threads = GetParam()}, 7, fail); }),
              "the odd one");
  });
}

TEST_P(ForThreads, AFailedItemLeavesNoLoopOfAnotherHalfDone) {
  with_many_threads([] {
    std::atomic<int> half_done{0};
    const auto work = [&](std::size_t i, const RunContext&) {
      if (i == 5) {
        throw std::runtime_error("one of them");
      }
      // A loop inside, told nothing of threads: it ends in full or throws.
      std::atomic<std::size_t> done{0};
      parallel_for({}, 4000, 1, [&](std::size_t begin, std::size_t end) { done += end - begin; });
      half_done += done.load() == 4000 ? 0 : 1;
    };
    for (int repeat = 0; repeat < 20; ++repeat) {
      EXPECT_EQ(thrown_by([&] { parallel_items({.max_threads = GetParam()}, 12, work); }),
                "one of them");
    }
    EXPECT_EQ(half_done.load(), 0);
  });
}

TEST_P(ForThreads, BothAreRunToTheirEnds) {
  with_many_threads([] {
    const RunContext run{.max_threads = GetParam()};
    for (int repeat = 0; repeat < 50; ++repeat) {
      double first = 0.0;
      double second = 0.0;
      run_both(
          run, [&] { first = sum_with(GetParam()); }, [&] { second = sum_with(GetParam()); });
      EXPECT_EQ(first, sum_with(1));
      EXPECT_EQ(second, first);
    }
  });
}

TEST_P(ForThreads, OfTwoFailuresTheFirstOnesIsTold) {
  const auto nothing = [] {};
  const auto first = [] { throw std::runtime_error("first"); };
  const auto second = [] { throw std::runtime_error("second"); };
  const auto told = [](const auto& a, const auto& b) {
    const auto both = [&] { run_both({.max_threads = GetParam()}, a, b); };
    return thrown_by([&] { with_many_threads(both); });
  };
  for (int repeat = 0; repeat < 20; ++repeat) {
    EXPECT_EQ(told(first, second), "first");
    EXPECT_EQ(told(nothing, second), "second");
    EXPECT_EQ(told(first, nothing), "first");
  }
}

TEST_P(ForThreads, AStopIsHeardBeforeEitherBegins) {
  std::stop_source source;
  source.request_stop();
  const RunContext run{.stop = source.get_token(), .max_threads = GetParam()};
  bool called = false;
  const auto call = [&] { called = true; };
  EXPECT_EQ(thrown_by([&] { run_both(run, call, call); }), "cancelled");
  EXPECT_FALSE(called);
}

INSTANTIATE_TEST_SUITE_P(Threads, ForThreads, ::testing::Values(0, 1, 2, 3, 8));

TEST(ParallelFor, DoesNothingForAnEmptyRange) {
  bool called = false;
  parallel_for({}, 0, 10, [&](std::size_t, std::size_t) { called = true; });
  EXPECT_FALSE(called);
}

}  // namespace
}  // namespace vantage
