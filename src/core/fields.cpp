// SPDX-License-Identifier: MIT
#include "vantage/core/fields.h"

#include <array>
#include <charconv>

namespace vantage {
namespace {

/// The shortest text that reads back as the number.
std::string text_of(double number) {
  std::array<char, 32> text{};
  const auto written = std::to_chars(text.data(), text.data() + text.size(), number);
  return {text.data(), written.ptr};
}

}  // namespace

std::string_view word_at(std::string_view words, std::size_t index) {
  for (; index > 0 && words.find('|') != std::string_view::npos; --index) {
    words.remove_prefix(words.find('|') + 1);
  }
  return words.substr(0, words.find('|'));
}

std::optional<std::size_t> index_of_word(std::string_view words, std::string_view word) {
  for (std::size_t index = 0;; ++index) {
    const std::size_t end = words.find('|');
    if (words.substr(0, end) == word) {
      return index;
    }
    if (end == std::string_view::npos) {
      return std::nullopt;
    }
    words.remove_prefix(end + 1);
  }
}

void refuse_number(std::string_view name, double value, double low, double high) {
  throw InvalidInput("option " + std::string(name) + " is " + text_of(value) +
                     " but must be between " + text_of(low) + " and " + text_of(high));
}

}  // namespace vantage
