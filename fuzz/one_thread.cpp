// SPDX-License-Identifier: MIT
// A fuzzer runs thousands of tiny inputs a second: on these, threads that wait for each other cost more than all else.
#include <cstddef>

#include <tbb/global_control.h>

extern "C" int LLVMFuzzerInitialize(int* /*count*/, char*** /*arguments*/) {
  static const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  return 0;
}
