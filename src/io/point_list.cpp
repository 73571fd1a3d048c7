// SPDX-License-Identifier: MIT
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "io/model_builder.h"
#include "io/number_parsing.h"
#include "io/readers.h"
#include "io/text_cursor.h"

namespace vantage {
namespace {

/// What parts two columns.
struct Separator {
  bool has_comma = false;
  bool has_semicolon = false;
  bool has_blank = false;
};

/// Columns of a line, parted by blanks, commas or semicolons.
class Columns {
 public:
  explicit Columns(std::string_view line) : rest_(line) { take_separator(); }

  /// The next column; empty at the end of the line.
  std::string_view take() {
    std::size_t end = 0;
    while (end < rest_.size() && !is_blank(rest_[end]) && rest_[end] != ',' && rest_[end] != ';') {
      ++end;
    }
    const std::string_view column = rest_.substr(0, end);
    rest_.remove_prefix(end);
    return column;
  }

  /// What comes before the next column.
  Separator take_separator() {
    Separator separator;
    std::size_t end = 0;
    for (; end < rest_.size(); ++end) {
      const char c = rest_[end];
      if (c != ',' && c != ';' && !is_blank(c)) {
        break;
      }
      separator.has_comma = separator.has_comma || c == ',';
      separator.has_semicolon = separator.has_semicolon || c == ';';
      separator.has_blank = separator.has_blank || is_blank(c);
    }
    rest_.remove_prefix(end);
    return separator;
  }

  [[nodiscard]] bool at_end() const { return rest_.empty(); }

 private:
  std::string_view rest_;
};

/// Tells lines in which a comma may belong to a number: "0,5 2,5 3,5".
class DecimalCommas {
 public:
  /// What comes before another of the three coordinates.
  void see(const Separator& separator) {
    has_comma_ = has_comma_ || separator.has_comma;
    has_tight_comma_ = has_tight_comma_ || is_tight_comma(separator);
    has_semicolon_ = has_semicolon_ || separator.has_semicolon;
    has_blanks_ = has_blanks_ || (!separator.has_comma && !separator.has_semicolon);
  }

  /// What comes behind the last one, as in "1 2 3,5".
  void see_end(const Separator& separator) {
    if (is_tight_comma(separator)) {
      see(separator);
    }
  }

  [[nodiscard]] bool are_possible() const {
    return (has_tight_comma_ && has_blanks_) || (has_comma_ && has_semicolon_);
  }

 private:
  static bool is_tight_comma(const Separator& separator) {
    return separator.has_comma && !separator.has_semicolon && !separator.has_blank;
  }

  bool has_comma_ = false;
  bool has_tight_comma_ = false;
  bool has_semicolon_ = false;
  bool has_blanks_ = false;
};

bool is_comment(std::string_view line) {
  return line.empty() || line.front() == '#' || line.substr(0, 2) == "//";
}

class PointListReader {
 public:
  PointListReader(std::string_view bytes, std::string_view name, ModelFormat format,
                  const RunContext& run)
      : cursor_(without_bom(bytes)),
        size_(bytes.size()),
        format_(format),
        builder_(format, name, run, 0) {}

  Model read() {
    for (auto text = cursor_.next_line(); text; text = cursor_.next_line()) {
      if (has_normals_below_ && rows() == scan_end_) {
        builder_.note("normals that follow the points left out: " + std::to_string(scan_end_));
        break;
      }
      const std::string_view line = trimmed(*text);
      if (!is_comment(line) && !is_heading(line)) {
        read_point(line);
        builder_.advance(cursor_.offset(), size_);
      }
    }
    compare_with_heading();
    if (is_flat_) {
      builder_.note("points of two coordinates were read with z = 0");
    }
    if (has_colours_) {
      builder_.note("colours or normals behind the coordinates left out");
    }
    if (scans_ > 1) {
      builder_.note("scans of the file, all read: " + std::to_string(scans_));
    }
    return builder_.finish();
  }

 private:
  /// Points that were read, also those without a position.
  [[nodiscard]] std::size_t rows() const {
    return builder_.point_count() + builder_.missing_points();
  }

  /// Whether a line stands above the points: a count, or names of columns. There is one of each at most,
  /// but in a .pts each scan has a count.
  bool is_heading(std::string_view line) {
    Columns columns(line);
    const std::string_view first = columns.take();
    columns.take_separator();
    const std::optional<std::int64_t> count = columns.at_end() ? integer_from(first) : std::nullopt;
    const bool is_first = rows() == 0;
    const bool ends_scan = format_ == ModelFormat::Pts && rows() == scan_end_;
    if (count && *count >= 0 && ((is_first && scans_ == 0) || ends_scan)) {
      scan_begin_ = rows();
      scan_end_ = scan_begin_ + static_cast<std::size_t>(*count);
      has_normals_below_ = format_ == ModelFormat::Pwn && normals_follow(scan_end_);
      ++scans_;
      return true;
    }
    if (!is_first || has_names_ || (number_from(first) && !columns.at_end())) {
      return false;
    }
    has_names_ = true;
    builder_.note(cursor_.place().text() + " left out as a heading: " + in_quotes(line));
    return true;
  }

  /// Whether twice as many rows follow as are declared, of three numbers each: points, then their normals.
  [[nodiscard]] bool normals_follow(std::size_t points) const {
    std::size_t rows = 0;
    TextCursor ahead = cursor_;
    for (auto text = ahead.next_line(); text; text = ahead.next_line()) {
      const std::string_view line = trimmed(*text);
      if (is_comment(line)) {
        continue;
      }
      Columns columns(line);
      int found = 0;
      for (; found <= 3 && !columns.at_end(); ++found) {
        columns.take();
        columns.take_separator();
      }
      if (found != 3) {
        return false;
      }
      ++rows;
    }
    return rows > 0 && rows % 2 == 0 && rows / 2 == points;
  }

  /// Of the last scan. In a .xyz a lone number may be another than that of the points.
  void compare_with_heading() {
    if (scans_ == 0 || format_ == ModelFormat::Xyz) {
      return;
    }
    const std::size_t points = rows();
    if (points < scan_end_) {
      builder_.fail(cursor_.place(),
                    "the heading declares " + std::to_string(scan_end_ - scan_begin_) +
                        " points, the file ends after " + std::to_string(points - scan_begin_) +
                        "; it may be cut short");
    }
    if (points > scan_end_) {
      builder_.note("points beyond those that the heading declares, read too: " +
                    std::to_string(points - scan_end_));
    }
  }

  void read_point(std::string_view line) {
    Columns columns(line);
    DecimalCommas commas;
    std::array<std::string_view, 3> column;
    int found = 0;
    while (found < 3 && !columns.at_end()) {
      column[static_cast<std::size_t>(found++)] = columns.take();
      const Separator separator = columns.take_separator();
      if (!columns.at_end()) {
        found < 3 ? commas.see(separator) : commas.see_end(separator);
      }
    }
    if (commas.are_possible()) {
      builder_.fail(cursor_.place(),
                    "a comma may part columns here or belong to a number; write numbers with a "
                    "point, or nothing but commas between columns");
    }
    add_point(std::span(column).first(static_cast<std::size_t>(found)));
    int further = 0;
    for (; further < 3 && !has_colours_ && !columns.at_end(); ++further) {
      columns.take();
      columns.take_separator();
    }
    has_colours_ |= further == 3;
  }

  void add_point(std::span<const std::string_view> column) {
    Vec3 point = Vec3::Zero();
    for (std::size_t c = 0; c < column.size(); ++c) {
      const std::optional<double> value = number_from(column[c]);
      if (!value || std::isinf(*value)) {
        builder_.fail(
            cursor_.place(),
            number_problem(column[c]) +
                (value ? "" : "; a line holds the coordinates of a point, such as 0.5 1 2"));
      }
      point[static_cast<Eigen::Index>(c)] = *value;
      if (!builder_.double_precision() && needs_double(column[c], *value)) {
        builder_.coordinates_need_double();
      }
    }
    if (column.size() < 2 || (column.size() == 2 && rows() > 0 && !is_flat_)) {
      builder_.fail(cursor_.place(),
                    "expected 3 coordinates, found " + std::to_string(column.size()));
    }
    is_flat_ = is_flat_ || column.size() == 2;
    builder_.add_point_unless_missing(point, cursor_.place());
  }

  TextCursor cursor_;
  std::size_t size_;
  ModelFormat format_;
  ModelBuilder builder_;
  bool is_flat_ = false;
  bool has_colours_ = false;  ///< Or normals: three columns and more behind a point's coordinates.
  bool has_names_ = false;    ///< A heading other than a count was seen.
  bool has_normals_below_ = false;
  std::size_t scan_begin_ = 0;
  std::size_t scan_end_ = 0;  ///< How many points there are after the scan, as the file says.
  std::size_t scans_ = 0;
};

}  // namespace

Model parse_point_list(std::string_view bytes, std::string_view name, ModelFormat format,
                       const RunContext& run) {
  return PointListReader(bytes, name, format, run).read();
}

}  // namespace vantage
