// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "io/text_cursor.h"

namespace vantage {

/// Whether a line of an OBJ or MTL goes on in the next: a \ is at its end, before blanks that do not show in an
/// editor, and in no comment.
bool goes_on(std::string_view line);

/// Lines of an OBJ or MTL, each joined with those that it continues on.
class ObjLines {
 public:
  /// \param text must outlive this.
  explicit ObjLines(std::string_view text) : cursor_(without_bom(text)) {}

  /// Valid until the next call; nothing after the last line.
  std::optional<std::string_view> next();

  /// Of the beginning of the line given last.
  [[nodiscard]] Place place() const { return place_; }

  [[nodiscard]] std::size_t offset() const { return cursor_.offset(); }

 private:
  TextCursor cursor_;
  Place place_{};
  std::string joined_{};
};

}  // namespace vantage
