// SPDX-License-Identifier: MIT
#include "io/off.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "vantage/core/error.h"

#include "io/number_parsing.h"
#include "io/readers.h"
#include "io/text_cursor.h"

namespace vantage {
namespace {

constexpr char kComment = '#';

bool take_prefix(std::string_view& word, std::string_view prefix) {
  if (word.substr(0, prefix.size()) != prefix) {
    return false;
  }
  word.remove_prefix(prefix.size());
  return true;
}

class OffReader {
 public:
  OffReader(std::string_view bytes, std::string_view name, const RunContext& run,
            const Surroundings& surroundings)
      : bytes_(without_bom(bytes)), cursor_(bytes_), builder_(ModelFormat::Off, name, run, 0) {
    builder_.limit_faces(surroundings.options.max_faces);
  }

  /// \param may_be_by_line false: numbers stand on any lines.
  Model read(bool may_be_by_line) {
    if (read_header()) {
      read_binary_off(bytes_, cursor_.offset(), layout_, builder_);
      return builder_.finish();
    }
    read_counts();
    // Numbers may stand on any lines. Where each vertex and face has one, there may be more of them than
    // the header word says.
    by_line_ = may_be_by_line && content_lines(cursor_.rest()) >= points_ + faces_ &&
               tokens_of_next_line() > 1;
    read_points();
    read_faces();
    finish_notes();
    return builder_.finish();
  }

  /// Whether each vertex and face was taken to have a line of its own.
  [[nodiscard]] bool is_by_line() const { return by_line_; }

  /// Whether text follows the last face.
  [[nodiscard]] bool has_rest() const { return has_rest_; }

 private:
  /// Reads the header word and what may stand beside it; true if the rest is binary.
  bool read_header() {
    const TextCursor before = cursor_;
    const std::string_view word = cursor_.next_token(kComment);
    if (const std::optional<OffLayout> layout = off_layout(word)) {
      layout_ = *layout;
    } else if (const std::size_t letters = word.find_last_not_of("0123456789") + 1;
               letters < word.size() && off_layout(word.substr(0, letters))) {
      layout_ = *off_layout(word.substr(0, letters));
      cursor_.give_back(word.size() - letters);
      builder_.note("the number of vertices follows the header word without a blank");
    } else if (integer_from(word)) {
      cursor_ = before;
      builder_.note("the header word OFF is missing");
    } else {
      builder_.fail(cursor_.place(), "expected the header word OFF, found " + in_quotes(word));
    }
    const TextCursor after_word = cursor_;
    if (cursor_.token_on_line(kComment) == "BINARY") {
      cursor_.skip_line();
      return true;
    }
    cursor_ = after_word;
    if (layout_.any_dimension) {
      require_three_dimensions(count("dimension"), cursor_.place(), builder_);
    }
    return false;
  }

  std::int64_t count(std::string_view what) {
    const std::string_view token = cursor_.next_token(kComment);
    const std::optional<std::int64_t> value = integer_from(token);
    if (!value || *value < 0) {
      builder_.fail(cursor_.place(),
                    "expected the number of " + std::string(what) + ", found " +
                        (token.empty() ? "the end of the file" : in_quotes(token)));
    }
    return *value;
  }

  void read_counts() {
    const auto points = static_cast<std::uint64_t>(count("vertices"));
    const std::uint64_t first_line = cursor_.place().value;
    const auto faces = static_cast<std::uint64_t>(count("faces"));
    const Place place = cursor_.place();
    if (place.value != first_line && tokens_of_next_line() == 1) {
      count("edges");  // a line for each number
    } else {
      pass_edges(place);
    }
    // The shortest vertex is "0 0 0 " and the shortest face "0 ".
    const std::uint64_t most = cursor_.remaining() + 1;
    if (points > most / 6 || faces > most / 2 || 6 * points + 2 * faces > most) {
      builder_.fail(place, "the file declares " + std::to_string(points) + " vertices and " +
                               std::to_string(faces) + " faces, more than its size can hold");
    }
    points_ = static_cast<std::size_t>(points);
    faces_ = static_cast<std::size_t>(faces);
    builder_.check_counts(faces_, points_);
    builder_.reserve_points(points_);
  }

  /// The number of edges, which some writers leave out.
  void pass_edges(Place place) {
    if (const std::string_view edges = cursor_.token_on_line(kComment);
        !edges.empty() && !integer_from(edges)) {
      builder_.fail(place, "expected the number of edges, found " + in_quotes(edges));
    }
  }

  /// Of the next line that has any.
  [[nodiscard]] std::size_t tokens_of_next_line() const {
    TextCursor ahead = cursor_;
    std::size_t tokens = ahead.next_token(kComment).empty() ? 0 : 1;
    while (tokens > 0 && !ahead.token_on_line(kComment).empty()) {
      ++tokens;
    }
    return tokens;
  }

  static std::size_t content_lines(std::string_view text) {
    std::size_t lines = 0;
    TextCursor cursor(text);
    while (std::optional<std::string_view> line = cursor.next_line()) {
      const std::string_view content = trimmed(*line);
      lines += !content.empty() && content.front() != kComment ? 1 : 0;
    }
    return lines;
  }

  double number(std::string_view token) {
    const std::optional<double> value = number_from(token);
    if (!value || !std::isfinite(*value)) {
      builder_.fail(cursor_.place(), token.empty() ? "the file ends early" : number_problem(token));
    }
    return *value;
  }

  void read_points() {
    for (std::size_t v = 0; v < points_; ++v) {
      std::array<double, 4> position{};
      Place place{};
      for (std::size_t c = 0; c < layout_.coordinates(); ++c) {
        const std::string_view token =
            c == 0 || !by_line_ ? cursor_.next_token(kComment) : cursor_.token_on_line(kComment);
        if (token.empty() && cursor_.remaining() > 0) {
          builder_.fail(cursor_.place(), "expected " + std::to_string(layout_.coordinates()) +
                                             " coordinates, found " + std::to_string(c));
        }
        position[c] = number(token);
        place = cursor_.place();
        if (!builder_.double_precision() && needs_double(token, position[c])) {
          builder_.coordinates_need_double();
        }
      }
      add_off_point(builder_, layout_, position.data(), place);
      by_line_ ? read_attributes_on_line() : read_attributes();
      builder_.advance(cursor_.offset(), bytes_.size());
    }
  }

  /// Free form: counts of numbers are as the header word says.
  void read_attributes() {
    pass_numbers(layout_.before_colour());
    if (layout_.colour) {
      std::array<double, 4> colour{};
      for (double& channel : colour) {
        channel = number(cursor_.next_token(kComment));
      }
      builder_.add_colour(colour[0], colour[1], colour[2]);
    }
    pass_numbers(layout_.beside_colour() - layout_.before_colour());
  }

  void pass_numbers(std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
      cursor_.next_token(kComment);
    }
  }

  /// Line by line: a colour may have three numbers or four, and plain OFF may have a surplus.
  void read_attributes_on_line() {
    std::array<std::string_view, 9> tokens{};
    std::size_t found = 0;
    for (std::string_view token = cursor_.token_on_line(kComment); !token.empty();
         token = cursor_.token_on_line(kComment)) {
      if (found < tokens.size()) {
        tokens[found] = token;
      }
      ++found;
    }
    const std::size_t without_colour = layout_.beside_colour();
    if (layout_.colour && found >= without_colour + 3) {
      const std::size_t first = layout_.before_colour();
      builder_.add_colour(number(tokens[first]), number(tokens[first + 1]),
                          number(tokens[first + 2]));
    } else if (!layout_.colour && found > without_colour) {
      ++lines_with_surplus_;
    }
  }

  void read_faces() {
    for (std::size_t f = 0; f < faces_; ++f) {
      const std::int64_t corners = count("corners of a face");
      if (static_cast<std::uint64_t>(corners) > cursor_.remaining()) {
        builder_.fail(cursor_.place(), "a face declares " + std::to_string(corners) +
                                           " corners, more than the rest of the file can hold");
      }
      for (std::int64_t c = 0; c < corners; ++c) {
        const std::string_view token = cursor_.next_token(kComment);
        const std::optional<std::int64_t> vertex = integer_from(token);
        if (!vertex || *vertex < 0) {
          builder_.fail(cursor_.place(),
                        token.empty() ? "the file ends inside a face"
                                      : "expected a vertex index, found " + in_quotes(token));
        }
        builder_.add_corner(static_cast<std::uint64_t>(*vertex), cursor_.place());
      }
      builder_.end_polygon();
      if (by_line_) {
        coloured_faces_ += cursor_.token_on_line(kComment).empty() ? 0 : 1;
        cursor_.skip_line();
      }
      builder_.advance(cursor_.offset(), bytes_.size());
    }
  }

  void finish_notes() {
    if (coloured_faces_ > 0) {
      builder_.note("colours of faces left out: " + std::to_string(coloured_faces_));
    }
    if (lines_with_surplus_ > 0) {
      builder_.note("vertices with more numbers than the header word says, left out: " +
                    std::to_string(lines_with_surplus_));
    }
    has_rest_ = !cursor_.next_token(kComment).empty();
    if (has_rest_) {
      builder_.note("text after the last face left out, from " + cursor_.place().text());
    }
  }

  std::string_view bytes_;
  TextCursor cursor_;
  ModelBuilder builder_;
  OffLayout layout_{};
  std::size_t points_ = 0;
  std::size_t faces_ = 0;
  bool by_line_ = false;
  bool has_rest_ = false;
  std::size_t lines_with_surplus_ = 0;
  std::size_t coloured_faces_ = 0;
};

/// The model if its numbers, wherever they stand, are just as many as declared.
std::optional<Model> read_in_free_form(std::string_view bytes, std::string_view name,
                                       const RunContext& run, const Surroundings& surroundings) {
  try {
    const RunContext quiet = run.quiet();  // progress has been reported already
    OffReader reader(bytes, name, quiet, surroundings);
    Model model = reader.read(/*may_be_by_line=*/false);
    return reader.has_rest() ? std::nullopt : std::optional(std::move(model));
  } catch (const FormatError&) {
    return std::nullopt;
  }
}

}  // namespace

std::optional<OffLayout> off_layout(std::string_view word) {
  OffLayout layout;
  if (word == "off") {
    return layout;
  }
  const std::array<std::pair<std::string_view, bool*>, 5> letters{{{"ST", &layout.texture},
                                                                   {"C", &layout.colour},
                                                                   {"N", &layout.normal},
                                                                   {"4", &layout.homogeneous},
                                                                   {"n", &layout.any_dimension}}};
  for (bool goes_on = true; goes_on;) {
    goes_on = false;
    layout.colour_first = layout.colour_first || (layout.normal && word.starts_with("C"));
    for (const auto& [prefix, said] : letters) {
      if (!*said && take_prefix(word, prefix)) {
        *said = goes_on = true;
        break;
      }
    }
  }
  return word == "OFF" ? std::optional(layout) : std::nullopt;
}

bool has_off_header(std::string_view bytes) {
  const std::string_view word = TextCursor(without_bom(bytes)).next_token(kComment);
  return off_layout(word.substr(0, word.find_last_not_of("0123456789") + 1)).has_value();
}

void require_three_dimensions(std::int64_t dimension, Place place, const ModelBuilder& builder) {
  if (dimension != 3) {
    builder.fail(
        place, "the points have " + std::to_string(dimension) + " dimensions, only 3 can be read");
  }
}

void add_off_point(ModelBuilder& builder, const OffLayout& layout, const double* numbers,
                   Place place) {
  const Vec3 point(numbers[0], numbers[1], numbers[2]);
  if (!layout.homogeneous) {
    builder.add_point(point, place);
    return;
  }
  if (numbers[3] == 0.0) {
    builder.fail(place, "the fourth coordinate is 0: the vertex lies at infinity");
  }
  builder.coordinates_need_double();
  builder.add_point(point / numbers[3], place);
}

Model parse_off(std::string_view bytes, std::string_view name, const RunContext& run,
                const Surroundings& surroundings) {
  // A vertex may be broken over lines though there are enough of them for all.
  OffReader reader(bytes, name, run, surroundings);
  try {
    Model model = reader.read(/*may_be_by_line=*/true);
    const bool fits = model.skipped_faces == 0 && !reader.has_rest();
    std::optional<Model> free_form = reader.is_by_line() && !fits
                                         ? read_in_free_form(bytes, name, run, surroundings)
                                         : std::optional<Model>();
    return free_form && free_form->skipped_faces == 0 ? std::move(*free_form) : std::move(model);
  } catch (const FormatError&) {
    std::optional<Model> model = reader.is_by_line()
                                     ? read_in_free_form(bytes, name, run, surroundings)
                                     : std::optional<Model>();
    if (!model) {
      throw;
    }
    return std::move(*model);
  }
}

}  // namespace vantage
