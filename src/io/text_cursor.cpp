// SPDX-License-Identifier: MIT
#include "io/text_cursor.h"

#include <algorithm>

namespace vantage {
namespace {

char small_letter(char c) {
  return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
}

}  // namespace

std::string lower_case(std::string_view text) {
  std::string result(text);
  std::transform(result.begin(), result.end(), result.begin(), small_letter);
  return result;
}

bool equals_ignoring_case(std::string_view word, std::string_view keyword) {
  return std::equal(word.begin(), word.end(), keyword.begin(), keyword.end(),
                    [](char a, char b) { return small_letter(a) == b; });
}

std::string_view without_quotes(std::string_view name) {
  const bool is_quoted = name.size() >= 2 && name.front() == '"' && name.back() == '"';
  return is_quoted ? name.substr(1, name.size() - 2) : name;
}

std::string_view trimmed(std::string_view line) {
  while (!line.empty() && is_blank(line.front())) {
    line.remove_prefix(1);
  }
  while (!line.empty() && is_blank(line.back())) {
    line.remove_suffix(1);
  }
  return line;
}

std::string_view without_bom(std::string_view bytes) {
  constexpr std::string_view kMark = "\xEF\xBB\xBF";
  return bytes.substr(0, kMark.size()) == kMark ? bytes.substr(kMark.size()) : bytes;
}

void TextCursor::pass_line_end() {
  if (bytes_[at_] == '\r' && at_ + 1 < bytes_.size() && bytes_[at_ + 1] == '\n') {
    ++at_;
  }
  ++at_;
  ++line_;
}

void TextCursor::pass_comment() {
  while (at_ < bytes_.size() && !is_line_end(bytes_[at_])) {
    ++at_;
  }
}

std::optional<std::string_view> TextCursor::next_line() {
  if (at_ == bytes_.size()) {
    return std::nullopt;
  }
  token_line_ = line_;
  const std::size_t begin = at_;
  pass_comment();
  const std::string_view line = bytes_.substr(begin, at_ - begin);
  if (at_ < bytes_.size()) {
    pass_line_end();
  }
  return line;
}

std::string_view TextCursor::token_on_line(char comment) {
  while (at_ < bytes_.size() && is_blank(bytes_[at_])) {
    ++at_;
  }
  token_line_ = line_;
  if (comment != 0 && at_ < bytes_.size() && bytes_[at_] == comment) {
    pass_comment();
  }
  const std::size_t begin = at_;
  while (at_ < bytes_.size() && !is_blank(bytes_[at_]) && !is_line_end(bytes_[at_]) &&
         !(comment != 0 && bytes_[at_] == comment)) {
    ++at_;
  }
  return bytes_.substr(begin, at_ - begin);
}

std::string_view TextCursor::next_token(char comment) {
  while (true) {
    const std::string_view token = token_on_line(comment);
    if (!token.empty() || at_ == bytes_.size()) {
      return token;
    }
    pass_line_end();
  }
}

void TextCursor::skip_line() {
  pass_comment();
  if (at_ < bytes_.size()) {
    pass_line_end();
  }
}

}  // namespace vantage
