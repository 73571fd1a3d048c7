// SPDX-License-Identifier: MIT
#pragma once

#include <cstdlib>
#include <filesystem>

#include <gtest/gtest.h>

namespace vantage::test {

/// A test of the real models in the folder that VANTAGE_DATA names; skipped, and loudly, where that
/// is not set.
template <class Base = testing::Test>
class DataPackTest : public Base {
 protected:
  void SetUp() override {
    const char* folder = std::getenv("VANTAGE_DATA");
    if (folder == nullptr) {
      GTEST_SKIP() << "NOTHING WAS TESTED: set VANTAGE_DATA to the folder of the data pack";
    }
    root_ = folder;
  }

  [[nodiscard]] const std::filesystem::path& root() const { return root_; }

 private:
  std::filesystem::path root_{};
};

}  // namespace vantage::test
