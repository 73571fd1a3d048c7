// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <optional>
#include <utility>

#include <pybind11/pybind11.h>

#include "vantage/core/run_context.h"

/// \file
/// How a long call runs: the work on another thread, which never touches Python, while the
/// calling thread looks after Ctrl-C and the progress callback twenty times a second. Other Python
/// threads run all the while.

namespace vantage::python {

/// How to run, as given to every function.
struct RunSettings {
  pybind11::object progress = pybind11::none();  ///< progress(stage, fraction), or None.
  pybind11::object threads = pybind11::int_(0);  ///< At most this many; 0 or None: all cores.
};

/// Runs `work` without the interpreter's lock and waits for it. On Ctrl-C, or if the callback
/// raises, the work is stopped and that exception is thrown.
/// \pre the calling thread holds the lock. \throw InvalidInput for a bad number of threads, py::error_already_set,
/// whatever `work` throws.
void run_released(const RunSettings& settings, const std::function<void(const RunContext&)>& work);

/// Stops what other threads run and waits for its end; they start nothing any more. For the
/// interpreter's exit, which daemon threads do not keep from coming. \pre the calling thread holds the lock.
void stop_all_work();

/// run_released() with a result.
template <class Work>
auto released(const RunSettings& settings, const Work& work) {
  std::optional<decltype(work(RunContext{}))> result;
  run_released(settings, [&](const RunContext& run) { result.emplace(work(run)); });
  return std::move(*result);
}

}  // namespace vantage::python
