// SPDX-License-Identifier: MIT
#include "core/loaded_code.h"

#include <cstdlib>

#include <gtest/gtest.h>

namespace vantage {
namespace {

TEST(LoadedCode, IsOneOfTheProgramAndAnotherOfALibrary) {
  static const int kHere = 0;
  const std::uint64_t mine = loaded_code(&kHere);
  const std::uint64_t of_c_library = loaded_code(reinterpret_cast<const void*>(&std::abort));
  EXPECT_NE(mine, 0U);
  EXPECT_NE(of_c_library, 0U);
  EXPECT_NE(mine, of_c_library);
}

TEST(LoadedCode, StaysWhatItIsWhileTheProgramRuns) {
  EXPECT_EQ(loaded_code(), loaded_code());
  static int written = 0;
  const std::uint64_t before = loaded_code(&written);
  ++written;
  EXPECT_EQ(loaded_code(&written), before);
}

TEST(LoadedCode, OfAnAddressThatNothingHoldsIsNone) {
  EXPECT_EQ(loaded_code(nullptr), 0U);
}

}  // namespace
}  // namespace vantage
