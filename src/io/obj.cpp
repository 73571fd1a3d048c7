// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>
#include <string>

#include "io/model_builder.h"
#include "io/number_parsing.h"
#include "io/obj_lines.h"
#include "io/obj_materials.h"
#include "io/readers.h"
#include "io/text_cursor.h"

namespace vantage {
namespace {

/// Keywords of the format that do not shape the polygons.
constexpr std::array<std::string_view, 35> kSilentKeywords = {
    "vn",     "vp",     "s",        "usemtl",   "mtllib", "usemap",     "maplib",
    "mg",     "bevel",  "c_interp", "d_interp", "lod",    "shadow_obj", "trace_obj",
    "cstype", "deg",    "bmat",     "step",     "parm",   "trim",       "hole",
    "scrv",   "sp",     "end",      "con",      "ctech",  "stech",      "csh",
    "res",    "newmtl", "Ka",       "Kd",       "Ks",     "illum",      "usemtllib"};

/// Free-form curves and surfaces; the last four are patches as the first version of the format wrote them.
constexpr std::array<std::string_view, 7> kCurveKeywords = {"curv", "curv2", "surf", "bsp",
                                                            "bzp",  "cdc",   "cdp"};

bool is_one_of(std::span<const std::string_view> keywords, std::string_view keyword) {
  return std::find(keywords.begin(), keywords.end(), keyword) != keywords.end();
}

class ObjReader {
 public:
  ObjReader(std::string_view bytes, std::string_view name, const RunContext& run,
            const Surroundings& surroundings)
      : lines_(bytes),
        size_(bytes.size()),
        builder_(ModelFormat::Obj, name, run, 1),
        materials_(surroundings, builder_) {
    builder_.limit_faces(surroundings.options.max_faces);
    if (surroundings.options.appearance) {
      builder_.keep_appearance(/*of_vertices=*/false);
    }
  }

  Model read() {
    while (std::optional<std::string_view> line = lines_.next()) {
      read_line(*line);
      builder_.advance(lines_.offset(), size_);
    }
    finish_notes();
    if (builder_.keeps_appearance()) {
      materials_.finish();
    }
    return builder_.finish();
  }

 private:
  void read_line(std::string_view rest) {
    const std::string_view keyword = take_token(rest);
    if (keyword.empty() || keyword.front() == '#') {
      return;
    }
    if (keyword == "v") {
      read_vertex(rest);
    } else if (keyword == "f" || keyword == "fo") {
      read_face(rest);
    } else if (keyword == "g" || keyword == "o") {
      begin_part(keyword, trimmed(rest));
    } else if (keyword == "vt") {
      read_uv(rest);
    } else if (builder_.keeps_appearance() && is_of_appearance(keyword)) {
      read_appearance(keyword, rest);
    } else if (keyword == "l" || keyword == "p") {
      ++lines_and_points_;
    } else if (is_one_of(kCurveKeywords, keyword)) {
      ++curves_;
    } else if (keyword == "call") {
      ++calls_;
    } else if (!is_one_of(kSilentKeywords, keyword)) {
      if (unknown_++ == 0) {
        first_unknown_ = in_quotes(keyword) + " in " + lines_.place().text();
      }
    }
  }

  /// A group without a name of its own leaves that of an object or group that has no faces yet.
  void begin_part(std::string_view keyword, std::string_view part_name) {
    const bool is_nameless = keyword == "g" && (part_name.empty() || part_name == "default");
    if (!is_nameless || !builder_.has_name_for_next_face()) {
      builder_.begin_part(part_name);
    }
  }

  static bool is_of_appearance(std::string_view keyword) {
    return keyword == "usemtl" || keyword == "mtllib";
  }

  /// Kept in any case: how pictures lie tells what is up.
  void read_uv(std::string_view rest) {
    // No reason to refuse a shape: what is no number is 0.
    const double u = number_from(take_token(rest)).value_or(0.0);
    builder_.add_uv(u, number_from(take_token(rest)).value_or(0.0));
  }

  void read_appearance(std::string_view keyword, std::string_view rest) {
    if (keyword == "usemtl") {
      materials_.use(trimmed(rest));
    } else {
      materials_.add_library(trimmed(rest));
    }
  }

  /// \param may_be_nan of a colour: no reason to refuse a shape.
  double number(std::string_view token, bool may_be_nan) {
    const std::optional<double> value = number_from(token);
    if (!value || !(std::isfinite(*value) || may_be_nan)) {
      builder_.fail(lines_.place(), number_problem(token));
    }
    return *value;
  }

  void read_vertex(std::string_view rest) {
    std::array<double, 7> values{};
    std::size_t count = 0;
    rest = rest.substr(0, rest.find('#'));
    for (std::string_view token = take_token(rest); !token.empty(); token = take_token(rest)) {
      if (count == values.size()) {
        builder_.fail(
            lines_.place(),
            "a vertex has more than 7 numbers; expected 3 coordinates, and a weight (1 number) "
            "or a colour (3 or 4), with normals in lines of their own (vn)");
      }
      values[count] = number(token, count >= 3);
      if (count < 3 && !builder_.double_precision() && needs_double(token, values[count])) {
        builder_.coordinates_need_double();
      }
      ++count;
    }
    if (count < 3) {
      builder_.fail(lines_.place(), "expected 3 coordinates, found " + std::to_string(count));
    }
    builder_.add_point({values[0], values[1], values[2]}, lines_.place());
    if (count >= 6) {
      builder_.add_colour(values[3], values[4], values[5]);
      has_clear_ |= count == 7 && values[6] < 1.0;
    } else if (count == 4) {
      weights_ += values[3] != 1.0 ? 1 : 0;
    } else if (count == 5) {
      builder_.fail(lines_.place(),
                    "a vertex has 3 coordinates and 2 more numbers; expected a weight (1 "
                    "number) or a colour (3 or 4)");
    }
  }

  void read_face(std::string_view rest) {
    rest = rest.substr(0, rest.find('#'));
    for (std::string_view token = take_token(rest); !token.empty(); token = take_token(rest)) {
      builder_.add_corner(corner_vertex(token), lines_.place());
      read_corner_uv(token);
    }
    builder_.end_polygon();
  }

  /// The second number of a corner such as "7/2/5"; what is not there or makes no sense is none.
  void read_corner_uv(std::string_view token) {
    const std::size_t slash = token.find('/');
    if (slash == std::string_view::npos) {
      return;
    }
    token.remove_prefix(slash + 1);
    const std::optional<std::int64_t> index = integer_from(token.substr(0, token.find('/')));
    if (!index || *index == 0) {
      return;
    }
    const auto seen = static_cast<std::int64_t>(builder_.uv_count());
    if (*index > 0) {
      builder_.set_corner_uv(static_cast<std::uint64_t>(*index) - 1);
    } else if (*index >= -seen) {
      builder_.set_corner_uv(static_cast<std::uint64_t>(seen + *index));
    }
  }

  /// The vertex, from 0, of a corner such as "7", "7/2", "7//5" or "-1/-1/-1".
  std::uint64_t corner_vertex(std::string_view token) {
    const std::size_t slash = std::min(token.find('/'), token.size());
    const std::optional<std::int64_t> index = integer_from(token.substr(0, slash));
    if (!index || token.find_first_not_of("+-0123456789/", slash) != std::string_view::npos) {
      builder_.fail(
          lines_.place(),
          "expected a corner such as 7 or 7/2/5, found " + in_quotes(token) +
              (token.find(',') == std::string_view::npos ? "" : "; separate corners by spaces"));
    }
    if (*index == 0) {
      builder_.fail(lines_.place(), "face names vertex 0, but vertices are counted from 1");
    }
    if (*index > 0) {
      return static_cast<std::uint64_t>(*index) - 1;
    }
    const auto seen = static_cast<std::int64_t>(builder_.point_count());
    if (*index < -seen) {
      builder_.fail(lines_.place(), "face names vertex " + std::to_string(*index) + ", but only " +
                                        std::to_string(seen) + " vertices come before it");
    }
    return static_cast<std::uint64_t>(seen + *index);
  }

  void finish_notes() {
    if (weights_ > 0) {
      builder_.note("weights of vertices (a fourth coordinate) left out: " +
                    std::to_string(weights_));
    }
    if (has_clear_) {
      builder_.note("the opacity of vertices was left out; their colours are read");
    }
    if (lines_and_points_ > 0) {
      builder_.note("line and point elements left out: " + std::to_string(lines_and_points_));
    }
    if (curves_ > 0) {
      builder_.note("free-form curves and surfaces left out: " + std::to_string(curves_));
    }
    if (calls_ > 0) {
      builder_.note("files whose content belongs here (call) left out: " + std::to_string(calls_));
    }
    if (unknown_ > 0) {
      builder_.note("lines with an unknown keyword left out: " + std::to_string(unknown_) +
                    ", the first is " + first_unknown_);
    }
    const bool has_elements = builder_.face_count() + lines_and_points_ + curves_ + calls_ > 0;
    if (!has_elements && builder_.point_count() > 0) {  // the file may have been cut off
      builder_.note("no faces: taken as a point cloud");
    }
  }

  ObjLines lines_;
  std::size_t size_;
  ModelBuilder builder_;
  ObjMaterials materials_;
  std::size_t weights_ = 0;
  bool has_clear_ = false;  // a vertex is not opaque
  std::size_t lines_and_points_ = 0;
  std::size_t curves_ = 0;
  std::size_t calls_ = 0;
  std::size_t unknown_ = 0;
  std::string first_unknown_{};
};

}  // namespace

Model parse_obj(std::string_view bytes, std::string_view name, const RunContext& run,
                const Surroundings& surroundings) {
  return ObjReader(bytes, name, run, surroundings).read();
}

}  // namespace vantage
