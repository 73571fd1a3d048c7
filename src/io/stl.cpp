// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>

#include "vantage/mesh/mesh_check.h"

#include "io/byte_cursor.h"
#include "io/model_builder.h"
#include "io/number_parsing.h"
#include "io/readers.h"
#include "io/stl_layout.h"
#include "io/text_cursor.h"

namespace vantage {
namespace {

class TextReader {
 public:
  TextReader(std::string_view bytes, ModelBuilder& builder)
      : bytes_(without_bom(bytes)), cursor_(bytes_), builder_(builder) {}

  void read() {
    while (true) {
      const std::string_view word = cursor_.next_token();
      if (word.empty()) {
        break;
      }
      read_statement(word);
      builder_.advance(cursor_.offset(), bytes_.size());
    }
    if (in_facet_) {
      builder_.fail(cursor_.place(), "the file ends inside a facet");
    }
    if (unended_ > 0) {
      builder_.note(
          "facets that do not end before the next statement begins: " + std::to_string(unended_) +
          ", the first was ended in line " + std::to_string(first_unended_));
    }
    if (left_out_ > 0) {
      builder_.note("lines before facets left out: " + std::to_string(left_out_) +
                    ", the first is line " + std::to_string(first_left_out_));
    }
  }

 private:
  void read_statement(std::string_view word) {
    const auto is = [word](std::string_view known) { return equals_ignoring_case(word, known); };
    if (is("vertex")) {
      read_vertex();
    } else if (is("facet")) {
      end_unended_polygon();
      in_facet_ = true;
      is_before_facets_ = false;
      skip_to("outer");  // over the normal, which the corners imply
    } else if (is("endfacet") || is("endloop")) {
      in_facet_ = in_facet_ && !is("endfacet");
      end_open_polygon();
      line_of_end_ = cursor_.place().value;
    } else if (is("outer")) {
      end_unended_polygon();
      skip_to("vertex");
    } else if (is("solid")) {
      read_solid_name();
      is_before_facets_ = true;
    } else if (is("endsolid")) {
      in_facet_ = in_facet_ && !end_unended_polygon();
      cursor_.skip_line();
    } else if (is_before_facets_) {  // comments, colours and the like
      first_left_out_ = left_out_++ == 0 ? cursor_.place().value : first_left_out_;
      cursor_.skip_line();
    } else if (!is("loop") && cursor_.place().value != line_of_end_) {
      // Some writers put words of their own behind the end of a facet; elsewhere they are errors.
      builder_.fail(cursor_.place(),
                    "expected a statement such as facet or vertex, found " + in_quotes(word));
    }
  }

  /// Leaves out the rest of the line, or what stands on it before the word.
  void skip_to(std::string_view word) {
    for (TextCursor ahead = cursor_;; cursor_ = ahead) {
      const std::string_view token = ahead.token_on_line();
      if (token.empty()) {
        return cursor_.skip_line();
      }
      if (equals_ignoring_case(token, word)) {
        return;
      }
    }
  }

  void end_open_polygon() {
    if (std::exchange(has_open_polygon_, false)) {
      builder_.end_polygon();
    }
  }

  /// A polygon that a statement cuts off, for want of endloop. \return whether there was one.
  bool end_unended_polygon() {
    if (!has_open_polygon_) {
      return false;
    }
    first_unended_ = unended_++ == 0 ? cursor_.place().value : first_unended_;
    end_open_polygon();
    return true;
  }

  /// The name ends with its line, or before a facet on the same line.
  void read_solid_name() {
    std::string part;
    while (!is_facet_next()) {
      const std::string_view token = cursor_.token_on_line();
      if (token.empty()) {
        break;
      }
      part += (part.empty() ? "" : " ") + std::string(token);
    }
    builder_.begin_part(part);
  }

  [[nodiscard]] bool is_facet_next() const {
    TextCursor ahead = cursor_;
    return equals_ignoring_case(ahead.token_on_line(), "facet") &&
           equals_ignoring_case(ahead.token_on_line(), "normal");
  }

  void read_vertex() {
    Vec3 point;
    for (int c = 0; c < 3; ++c) {
      const std::string_view token = cursor_.token_on_line();
      if (token.empty()) {
        builder_.fail(cursor_.place(), "expected 3 coordinates, found " + std::to_string(c));
      }
      const std::optional<double> value = number_from(token);
      if (!value || !std::isfinite(*value)) {
        builder_.fail(cursor_.place(), number_problem(token));
      }
      point[c] = *value;
      if (!builder_.double_precision() && needs_double(token, *value)) {
        builder_.coordinates_need_double();
      }
    }
    if (!in_facet_) {
      builder_.fail(cursor_.place(), "a vertex stands outside a facet");
    }
    builder_.add_corner(builder_.point_count(), cursor_.place());
    builder_.add_point(point, cursor_.place());
    has_open_polygon_ = true;
  }

  std::string_view bytes_;
  TextCursor cursor_;
  ModelBuilder& builder_;
  bool in_facet_ = false;
  bool has_open_polygon_ = false;
  bool is_before_facets_ = true;
  std::size_t unended_ = 0;  ///< Polygons.
  std::size_t first_unended_ = 0;
  std::size_t left_out_ = 0;
  std::size_t first_left_out_ = 0;
  std::size_t line_of_end_ = 0;
};

void read_binary(std::string_view bytes, ModelBuilder& builder) {
  if (bytes.size() < kStlPreamble) {
    builder.fail(
        "is neither a text STL, which starts with the word solid, nor long enough for a "
        "binary one");
  }
  const std::uint64_t held = held_stl_triangles(bytes);
  const std::uint64_t declared = stl_triangle_count(bytes);
  if (declared > held && has_text_begin(bytes)) {  // of text, the count has four letters
    builder.fail("is text that does not start with the word solid, as a text STL does");
  }
  const std::string counts = "the file declares " + std::to_string(declared) +
                             " triangles but has room for " + std::to_string(held);
  if (declared > held) {
    builder.fail({"byte", kStlHeader}, counts + "; it may be cut short");
  }
  if (held == 0) {
    builder.fail(
        {"byte", kStlHeader},
        "holds neither faces nor points: the file declares 0 triangles and has room for 0");
  }
  const std::size_t triangles = stl_triangles_to_read(bytes);
  builder.check_counts(triangles, 0);
  if (triangles != declared) {
    builder.note(counts + ", all of which were read");
  }
  const std::size_t end = kStlPreamble + triangles * kStlTriangle;
  if (end < bytes.size()) {
    builder.note("bytes after the last triangle left out: " + std::to_string(bytes.size() - end));
  }
  builder.reserve_points(triangles * 3);
  bool has_colours =
      bytes.substr(0, kStlHeader).find("COLOR=") != std::string_view::npos;  // Magics
  for (std::size_t at = kStlPreamble; at < end; at += kStlTriangle) {
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const Place place{"byte", at + 12 * (corner + 1)};
      const char* here = bytes.data() + place.value;
      builder.add_corner(builder.point_count(), place);
      builder.add_point({static_cast<double>(decode<float>(here, ByteOrder::Little)),
                         static_cast<double>(decode<float>(here + 4, ByteOrder::Little)),
                         static_cast<double>(decode<float>(here + 8, ByteOrder::Little))},
                        place);
    }
    builder.end_polygon();
    constexpr std::uint16_t kIsColour = 0x8000;  // VisCAM
    const char* last = bytes.data() + at + kStlTriangle - sizeof(kIsColour);
    has_colours |= (decode<std::uint16_t>(last, ByteOrder::Little) & kIsColour) != 0;
    builder.advance(at, bytes.size());
  }
  if (has_colours) {
    builder.note("colours of faces left out: those of STL are not read");
  }
}

/// An STL file repeats each vertex in every triangle; make it one again.
void join_equal_positions(TriMesh& mesh, const RunContext& run) {
  WeldedMesh welded = weld(mesh, run.quiet());
  for (Triangle& triangle : mesh.triangles) {
    for (std::uint32_t& v : triangle) {
      v = welded.welded_of_vertex[v];
    }
  }
  mesh.positions = std::move(welded.mesh.positions);
}

}  // namespace

Model parse_stl(std::string_view bytes, std::string_view name, const RunContext& run,
                const Surroundings& surroundings) {
  ModelBuilder builder(ModelFormat::Stl, name, run, 0);
  builder.limit_faces(surroundings.options.max_faces);
  if (is_text_stl(bytes)) {
    TextReader(bytes, builder).read();
  } else {
    read_binary(bytes, builder);
  }
  Model model = builder.finish();
  join_equal_positions(model.mesh, run);
  return model;
}

}  // namespace vantage
