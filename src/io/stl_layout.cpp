// SPDX-License-Identifier: MIT
#include "io/stl_layout.h"

#include <algorithm>
#include <optional>

#include "io/byte_cursor.h"
#include "io/text_cursor.h"

namespace vantage {
namespace {

// [ours] Where the first triangles' normals are in a binary file: rarely without a control character.
constexpr std::size_t kTold = 512;

bool is_control(char c) {
  const auto code = static_cast<unsigned char>(c);
  return (code < 0x20 && !is_blank(c) && !is_line_end(c)) || code == 0x7F;
}

/// A comment, which the format has none of, above the word solid.
bool is_foreword(std::string_view line) {
  return line.empty() || line.front() == '#' || line.front() == ';' || line.starts_with("//");
}

}  // namespace

std::uint64_t stl_triangle_count(std::string_view bytes) {
  return decode<std::uint32_t>(bytes.data() + kStlHeader, ByteOrder::Little);
}

std::size_t held_stl_triangles(std::string_view bytes) {
  return (bytes.size() - kStlPreamble) / kStlTriangle;
}

std::size_t stl_triangles_to_read(std::string_view bytes) {
  const std::uint64_t declared = stl_triangle_count(bytes);
  return declared == 0 ? held_stl_triangles(bytes) : static_cast<std::size_t>(declared);
}

bool has_binary_stl_size(std::string_view bytes) {
  return bytes.size() >= kStlPreamble &&
         bytes.size() - kStlPreamble == stl_triangle_count(bytes) * kStlTriangle;
}

bool has_text_begin(std::string_view bytes) {
  const std::string_view head = bytes.substr(0, kTold);
  return std::none_of(head.begin(), head.end(), is_control);
}

bool is_text_stl(std::string_view bytes) {
  if (has_binary_stl_size(bytes) || !has_text_begin(bytes)) {
    return false;
  }
  TextCursor cursor(without_bom(bytes));
  std::optional<std::string_view> line = cursor.next_line();
  while (line && is_foreword(trimmed(*line))) {
    line = cursor.next_line();
  }
  std::string_view rest = line.value_or("");
  return equals_ignoring_case(take_token(rest), "solid");
}

}  // namespace vantage
