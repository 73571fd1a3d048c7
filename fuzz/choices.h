// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

/// Choices that the bytes of a fuzzer make, one byte each. When they end, every choice is the first.
class Choices {
 public:
  Choices(const std::uint8_t* data, std::size_t size) : data_(data), left_(size) {}

  /// A number from 0 to `count` − 1. \pre count is from 1 to 256
  std::size_t below(std::size_t count) {
    if (left_ == 0) {
      return 0;
    }
    --left_;
    return *data_++ % count;
  }

  /// True once in about `count` times.
  bool once_in(std::size_t count) { return below(count) == count - 1; }

  template <class Value, std::size_t N>
  const Value& of(const std::array<Value, N>& values) {
    static_assert(N > 0 && N <= 256);
    return values[below(N)];
  }

  /// The number of something of which there are `count`; seldom one that is not there.
  std::string index(std::size_t count) {
    constexpr std::array<const char*, 6> kAbsent{"-1",         "255",  "4294967295",
                                                 "4294967296", "1e99", "-2147483649"};
    return count == 0 || once_in(64) ? of(kAbsent)
                                     : std::to_string(below(count < 256 ? count : 256));
  }

  /// A coordinate as text: most often a small whole number, seldom one that readers trip over.
  std::string number() {
    constexpr std::array<const char*, 18> kOdd{
        "0.1",   "-0",    "1e-3", "16777217", "1e30",   "1e60",   "1.1e60", "1e-60", "1e-320",
        "1e308", "1e999", "nan",  "-inf",     "1e+999", "0x1p-2", ".5",     "5.",    "+1"};
    return once_in(64) ? of(kOdd) : std::to_string(static_cast<int>(below(9)) - 4);
  }

  [[nodiscard]] bool is_over() const { return left_ == 0; }

 private:
  const std::uint8_t* data_;
  std::size_t left_;
};
