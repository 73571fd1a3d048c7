// SPDX-License-Identifier: MIT
#include "io/obj_lines.h"

namespace vantage {
namespace {

/// The line without the backslash that continues it; blanks behind that do not show in an editor.
std::optional<std::string_view> continued(const std::optional<std::string_view>& line) {
  std::string_view text = line.value_or("");
  while (!text.empty() && is_blank(text.back())) {
    text.remove_suffix(1);
  }
  return text.ends_with('\\') ? std::optional(text.substr(0, text.size() - 1)) : std::nullopt;
}

}  // namespace

std::optional<std::string_view> ObjLines::next() {
  std::optional<std::string_view> line = cursor_.next_line();
  place_ = cursor_.place();
  std::optional<std::string_view> part = continued(line);
  if (!part || trimmed(*line).front() == '#') {
    return line;
  }
  joined_.clear();
  while (part) {
    joined_.append(*part).append(" ");
    line = cursor_.next_line();
    part = continued(line);
  }
  joined_.append(line.value_or(""));
  return joined_;
}

}  // namespace vantage
