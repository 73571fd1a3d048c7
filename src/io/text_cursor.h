// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "io/place.h"

/// \file
/// Walking over text by lines or by tokens. Lines end in \n, \r\n or \r.

namespace vantage {

/// Space, tab and the like, but no line end.
inline bool is_blank(char c) {
  return c == ' ' || c == '\t' || c == '\v' || c == '\f';
}

inline bool is_line_end(char c) {
  return c == '\n' || c == '\r';
}

/// Takes the next run of non-blank characters off the front of `line`; empty at its end.
inline std::string_view take_token(std::string_view& line) {
  std::size_t begin = 0;
  while (begin < line.size() && is_blank(line[begin])) {
    ++begin;
  }
  std::size_t end = begin;
  while (end < line.size() && !is_blank(line[end])) {
    ++end;
  }
  const std::string_view token = line.substr(begin, end - begin);
  line.remove_prefix(end);
  return token;
}

/// `line` without blanks at both ends.
std::string_view trimmed(std::string_view line);

/// The same without quotes, if they stand around it.
std::string_view without_quotes(std::string_view name);

/// `text` with the letters A to Z small.
std::string lower_case(std::string_view text);

/// Whether `word` is `keyword`, which is in small letters, in any case of A to Z.
bool equals_ignoring_case(std::string_view word, std::string_view keyword);

/// `bytes` without a UTF-8 byte order mark.
std::string_view without_bom(std::string_view bytes);

/// Reads text forwards and counts lines from 1.
class TextCursor {
 public:
  explicit TextCursor(std::string_view bytes, std::size_t first_line = 1)
      : bytes_(bytes), line_(first_line) {}

  /// The next line without its end; nothing after the last.
  std::optional<std::string_view> next_line();

  /// The next token, across line ends; empty at the end of the text.
  /// \param comment character that starts a comment up to the line's end, or 0.
  std::string_view next_token(char comment = 0);

  /// The next token on the current line; empty at its end (the line end is not consumed).
  std::string_view token_on_line(char comment = 0);

  /// Gives back the last `count` characters of the token read last.
  void give_back(std::size_t count) { at_ -= count; }

  /// Skips what is left of the current line, and its end.
  void skip_line();

  /// Line of the token or line read last.
  [[nodiscard]] Place place() const { return {"line", token_line_}; }

  [[nodiscard]] std::size_t offset() const { return at_; }

  [[nodiscard]] std::size_t remaining() const { return bytes_.size() - at_; }

  [[nodiscard]] std::string_view rest() const { return bytes_.substr(at_); }

  [[nodiscard]] std::size_t line() const { return line_; }

 private:
  void pass_line_end();
  void pass_comment();

  std::string_view bytes_;
  std::size_t at_ = 0;
  std::size_t line_ = 1;
  std::size_t token_line_ = 1;
};

}  // namespace vantage
