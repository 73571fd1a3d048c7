// SPDX-License-Identifier: MIT
#include "io/obj_lines.h"

namespace vantage {

bool goes_on(std::string_view line) {
  line = trimmed(line);
  for (std::size_t at = line.find('#'); at != std::string_view::npos; at = line.find('#', at + 1)) {
    if (at == 0 || is_blank(line[at - 1])) {
      return false;
    }
  }
  return line.ends_with('\\');
}

std::optional<std::string_view> ObjLines::next() {
  std::optional<std::string_view> line = cursor_.next_line();
  place_ = cursor_.place();
  if (!line || !goes_on(*line)) {
    return line;
  }
  joined_.clear();
  while (line && goes_on(*line)) {
    joined_.append(line->substr(0, line->rfind('\\'))).append(" ");
    line = cursor_.next_line();
  }
  joined_.append(line.value_or(""));
  return joined_;
}

}  // namespace vantage
