// SPDX-License-Identifier: MIT
#include "released_run.h"

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <stop_token>
#include <string>
#include <thread>
#include <vector>

#include <cxxabi.h>
#include <oneapi/tbb/global_control.h>
#include <unistd.h>

#include "vantage/core/error.h"

#include "arguments.h"

namespace vantage::python {
namespace {

namespace py = pybind11;

constexpr std::chrono::milliseconds kPoll{50};  // well below the second that Ctrl-C may take [ours]
constexpr int kMostThreads = 1024;              // as the program's --threads

/// Where a stage of the work has come to.
struct Progress {
  std::string stage{};
  double fraction = 0.0;
};

/// A thread that runs one job after another. They are kept for later calls: Embree remembers every
/// thread that ever built a search structure, a few hundred bytes each.
class Lane {
 public:
  Lane() {
    std::thread([this] { run_jobs(); }).detach();
  }

  void start(std::function<void()> job) {
    const std::scoped_lock lock(mutex_);
    job_ = std::move(job);
    has_job_.notify_one();
  }

 private:
  [[noreturn]] void run_jobs() {
    for (;;) {
      std::function<void()> job;
      {
        std::unique_lock lock(mutex_);
        has_job_.wait(lock, [this] { return static_cast<bool>(job_); });
        job = std::exchange(job_, nullptr);
      }
      job();
    }
  }

  std::mutex mutex_{};
  std::condition_variable has_job_{};
  std::function<void()> job_{};
};

/// What runs now, so that it can be stopped before the process ends. Never destroyed.
class RunningWork {
 public:
  static RunningWork& instance() {
    static auto* const kRunning = new RunningWork;
    return *kRunning;
  }

  /// \return whether work may start here: once the interpreter ends, on the thread that ends it only.
  bool add(std::stop_source& work) {
    const std::scoped_lock lock(mutex_);
    if (process_ != getpid()) {  // a forked child has none of its parent's threads
      works_.clear();
      process_ = getpid();
    }
    if (is_closed_here()) {
      return false;
    }
    works_.push_back(&work);
    return true;
  }

  void remove(const std::stop_source& work) {
    const std::scoped_lock lock(mutex_);
    works_.erase(std::find(works_.begin(), works_.end(), &work));
    removed_.notify_all();
  }

  /// Whether this thread's work is to end as the interpreter does.
  bool is_closed() {
    const std::scoped_lock lock(mutex_);
    return is_closed_here();
  }

  /// Stops all work and waits for its end.
  void close() {
    std::unique_lock lock(mutex_);
    closed_by_ = std::this_thread::get_id();
    if (process_ != getpid()) {
      return;
    }
    for (std::stop_source* work : works_) {
      work->request_stop();
    }
    removed_.wait(lock, [this] { return works_.empty(); });
  }

 private:
  bool is_closed_here() const {
    return closed_by_ != std::thread::id{} && closed_by_ != std::this_thread::get_id();
  }

  std::mutex mutex_{};
  std::condition_variable removed_{};
  std::vector<std::stop_source*> works_{};
  std::thread::id closed_by_{};
  pid_t process_ = getpid();
};

/// Calls what takes the interpreter's lock. Python before 3.14 ends a daemon thread that asks for the
/// lock too late by unwinding its stack, which destructors do not let pass: such a thread waits here
/// until the process ends, as later ones do.
template <class Call>
auto with_lock(const Call& call) {
  try {
    return call();
  } catch (const abi::__forced_unwind&) {
    for (;;) {
      pause();
    }
  }
}

/// Gives the interpreter's lock away while it lives.
class Unlocked {
 public:
  Unlocked() = default;
  Unlocked(const Unlocked&) = delete;
  Unlocked& operator=(const Unlocked&) = delete;

  ~Unlocked() {
    with_lock([this] { PyEval_RestoreThread(thread_); });
  }

 private:
  PyThreadState* thread_ = PyEval_SaveThread();
};

/// Calls progress(stage, fraction).
void tell(const py::object& progress, const std::string& stage, double fraction) {
  const py::tuple arguments = py::make_tuple(stage, fraction);
  PyObject* result =
      with_lock([&] { return PyObject_CallObject(progress.ptr(), arguments.ptr()); });
  if (result == nullptr) {
    throw py::error_already_set();
  }
  Py_DECREF(result);
}

/// Ends the calling thread as sys.exit() does: without a word.
[[noreturn]] void end_thread() {
  PyErr_SetNone(PyExc_SystemExit);
  throw py::error_already_set();
}

/// Lanes that wait for a job; as many as there ever were calls at once. Never destroyed, as its
/// threads are not: they end with the process.
class LanePool {
 public:
  static LanePool& instance() {
    static auto* const kPool = new LanePool;
    return *kPool;
  }

  Lane& take() {
    const std::scoped_lock lock(mutex_);
    if (process_ != getpid()) {  // a forked child has none of its parent's threads
      idle_.clear();
      process_ = getpid();
    }
    if (idle_.empty()) {
      return *new Lane;
    }
    Lane* lane = idle_.back();
    idle_.pop_back();
    return *lane;
  }

  void give_back(Lane& lane) {
    const std::scoped_lock lock(mutex_);
    idle_.push_back(&lane);
  }

 private:
  std::mutex mutex_{};
  std::vector<Lane*> idle_{};
  pid_t process_ = getpid();
};

/// The work on its own thread, and what the waiting thread gets to know of it.
class Worker {
 public:
  Worker(const std::function<void(const RunContext&)>& work, int threads, bool reports)
      : lane_(LanePool::instance().take()) {
    if (!RunningWork::instance().add(stop_)) {
      LanePool::instance().give_back(lane_);
      end_thread();
    }
    RunContext run;
    run.max_threads = threads;
    run.stop = stop_.get_token();
    if (reports) {
      run.report = [this](std::string_view stage, double fraction) { post(stage, fraction); };
    }
    lane_.start([this, &work, run = std::move(run)] { carry_out(work, run); });
  }

  Worker(const Worker&) = delete;
  Worker& operator=(const Worker&) = delete;

  // NOLINTNEXTLINE(bugprone-exception-escape): a mutex that fails, or no room for a pointer, may end it
  ~Worker() {
    const Unlocked unlocked;
    stop_.request_stop();
    {
      std::unique_lock lock(mutex_);
      ended_.wait(lock, [this] { return is_done_; });
    }
    LanePool::instance().give_back(lane_);
  }

  /// Waits for the end or for the next time to look up. \return whether the work has ended.
  bool wait() {
    const Unlocked unlocked;
    std::unique_lock lock(mutex_);
    return ended_.wait_for(lock, kPoll, [this] { return is_done_; });
  }

  /// The last progress since it was asked for.
  std::optional<Progress> news() {
    const std::scoped_lock lock(mutex_);
    return std::exchange(latest_, std::nullopt);
  }

  /// What the work threw, if it did. \pre wait() said that it has ended.
  std::exception_ptr failure() {
    const std::scoped_lock lock(mutex_);
    return failure_;
  }

 private:
  void post(std::string_view stage, double fraction) {
    const std::scoped_lock lock(mutex_);
    latest_ = Progress{std::string(stage), fraction};
  }

  void carry_out(const std::function<void(const RunContext&)>& work, const RunContext& run) {
    std::exception_ptr failure;
    try {
      // Libraries that start threads of their own (Embree) are held to the number as well.
      std::optional<tbb::global_control> limit;
      if (run.max_threads > 0) {
        limit.emplace(tbb::global_control::max_allowed_parallelism,
                      static_cast<std::size_t>(run.max_threads));
      }
      work(run);
    } catch (...) {
      failure = std::current_exception();
    }
    RunningWork::instance().remove(stop_);
    const std::scoped_lock lock(mutex_);
    failure_ = failure;
    is_done_ = true;
    ended_.notify_one();
  }

  std::stop_source stop_{};
  std::mutex mutex_{};
  std::condition_variable ended_{};
  std::optional<Progress> latest_{};
  bool is_done_ = false;
  std::exception_ptr failure_{};
  Lane& lane_;
};

}  // namespace

void run_released(const RunSettings& settings, const std::function<void(const RunContext&)>& work) {
  const auto threads =
      settings.threads.is_none()
          ? 0
          : static_cast<int>(whole_number_of(settings.threads, "threads", 0, kMostThreads));
  const bool reports = !settings.progress.is_none();
  if (reports && PyCallable_Check(settings.progress.ptr()) == 0) {
    throw py::type_error("progress must be a function of (stage, fraction), or None");
  }
  Worker worker(work, threads, reports);
  std::optional<Progress> last;
  bool ended = false;
  while (!ended) {
    ended = worker.wait();
    if (PyErr_CheckSignals() != 0) {
      throw py::error_already_set();  // the worker is stopped and waited for on the way out
    }
    if (auto news = worker.news()) {
      last = std::move(news);
      tell(settings.progress, last->stage, last->fraction);
    }
  }
  if (RunningWork::instance().is_closed()) {
    end_thread();
  }
  if (const std::exception_ptr failure = worker.failure()) {
    std::rethrow_exception(failure);
  }
  if (reports && !(last && last->fraction >= 1.0)) {
    tell(settings.progress, last ? last->stage : "done", 1.0);
  }
}

void stop_all_work() {
  const Unlocked unlocked;
  RunningWork::instance().close();
}

}  // namespace vantage::python
