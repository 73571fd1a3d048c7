// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string_view>

namespace vantage {

/// FNV-1a, 64 bit (Fowler, Noll and Vo): tells things apart, seals nothing.
class Fingerprint {
 public:
  void add(unsigned char byte) { value_ = (value_ ^ byte) * 0x100000001b3ULL; }

  void add(std::string_view bytes) {
    for (const char c : bytes) {
      add(static_cast<unsigned char>(c));
    }
  }

  [[nodiscard]] std::uint64_t value() const { return value_; }

 private:
  std::uint64_t value_ = 0xcbf29ce484222325ULL;
};

}  // namespace vantage
