// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "vantage/core/error.h"

#include "io/model_builder.h"
#include "io/ply_header.h"
#include "io/ply_source.h"
#include "io/ply_textures.h"
#include "io/readers.h"
#include "io/text_cursor.h"

namespace vantage {
namespace {

/// Value of a full colour channel of this type. \param largest of all that there are.
double full_colour(PlyScalar type, double largest) {
  constexpr double kFullByte = 255.0;  // programs put bytes into wider numbers too
  switch (type) {
    case PlyScalar::U16:
      return largest > kFullByte ? 65535.0 : kFullByte;
    case PlyScalar::I16:
      return largest > kFullByte ? 32767.0 : kFullByte;
    case PlyScalar::F32:
    case PlyScalar::F64:
      return 1.0;
    default:
      return kFullByte;
  }
}

/// Reads the elements of a PLY body from either source.
template <class Source>
class BodyReader {
 public:
  BodyReader(Source source, ModelBuilder& builder, PlyTextures& textures, std::size_t all_bytes)
      : source_(source), builder_(builder), textures_(textures), all_bytes_(all_bytes) {}

  void read(const PlyHeader& header) {
    has_faces_ =
        std::any_of(header.elements.begin(), header.elements.end(), [](const auto& element) {
          return element.kind != PlyElement::Kind::Vertex &&
                 element.kind != PlyElement::Kind::Other && element.count > 0;
        });
    check_limit(header);
    for (const PlyElement& element : header.elements) {
      check_count(element);
      switch (element.properties.empty() ? PlyElement::Kind::Other : element.kind) {
        case PlyElement::Kind::Vertex:
          read_vertices(element);
          break;
        case PlyElement::Kind::Face:
        case PlyElement::Kind::Strips:
          read_faces(element);
          break;
        case PlyElement::Kind::Other:
          skip_element(element);
          break;
      }
    }
    textures_.finish();
    if (const std::string rest = source_.rest_left_out(); !rest.empty()) {
      builder_.note(rest);
    }
  }

  /// Values that rows hold and the header does not declare.
  [[nodiscard]] std::size_t surplus() const { return source_.surplus(); }

 private:
  /// Ends the reading before it begins if the header declares more than may be read.
  void check_limit(const PlyHeader& header) const {
    std::size_t faces = 0;
    std::size_t points = 0;
    for (const PlyElement& element : header.elements) {
      check_count(element);
      const auto count = static_cast<std::size_t>(element.count);
      faces += element.kind == PlyElement::Kind::Face ? count : 0;
      points += element.kind == PlyElement::Kind::Vertex ? count : 0;
    }
    builder_.check_counts(faces, points);
  }

  void check_count(const PlyElement& element) const {
    std::size_t least = 0;
    for (const PlyProperty& property : element.properties) {
      least += Source::least_bytes(property.is_list ? property.count_type : property.type);
    }
    if (least > 0 && element.count > source_.remaining() / least) {
      builder_.fail("the header declares " + std::to_string(element.count) + " of element " +
                    element.name + ", more than the size of the file can hold");
    }
  }

  void read_vertices(const PlyElement& element) {
    builder_.reserve_points(static_cast<std::size_t>(element.count));
    std::array<std::optional<PlyScalar>, 3> types{};
    for (const PlyProperty& property : element.properties) {
      if (property.role >= PlyRole::Red && property.role <= PlyRole::Blue) {
        types[channel(property)] = property.type;
      }
    }
    const bool has_colours = types[0] && types[1] && types[2];
    const bool coloured = has_colours && textures_.places() == PlyTextures::Places::None;
    if (has_colours && !coloured) {
      builder_.note("colours of vertices left out: the textures are shown");
    }
    for (std::uint64_t v = 0; v < element.count; ++v) {
      read_vertex(element, coloured);
      builder_.advance(source_.offset(), all_bytes_);
    }
    if (coloured) {
      add_colours({*types[0], *types[1], *types[2]});
    }
    if (coloured && has_clear_) {
      builder_.note("the opacity of vertices was left out; their colours are read");
    }
  }

  static std::size_t channel(const PlyProperty& property) {
    return static_cast<std::size_t>(property.role) - static_cast<std::size_t>(PlyRole::Red);
  }

  void add_colours(const std::array<PlyScalar, 3>& types) {
    double largest = 0.0;
    for (const std::array<float, 3>& colour : colours_) {
      largest = std::max({largest, static_cast<double>(colour[0]), static_cast<double>(colour[1]),
                          static_cast<double>(colour[2])});
    }
    for (const std::array<float, 3>& colour : colours_) {
      builder_.add_colour(static_cast<double>(colour[0]) / full_colour(types[0], largest),
                          static_cast<double>(colour[1]) / full_colour(types[1], largest),
                          static_cast<double>(colour[2]) / full_colour(types[2], largest));
    }
  }

  void read_vertex(const PlyElement& element, bool coloured) {
    Vec3 point = Vec3::Zero();
    std::array<float, 3> colour{};
    std::array<double, 2> on_picture{};
    const bool lies_on_vertices = textures_.places() == PlyTextures::Places::OfVertices;
    const Place binary_place = source_.place();
    source_.begin_row();
    for (const PlyProperty& property : element.properties) {
      switch (property.role) {
        case PlyRole::X:
        case PlyRole::Y:
        case PlyRole::Z:
          point[static_cast<int>(property.role) - static_cast<int>(PlyRole::X)] =
              source_.next_coordinate(property.type);
          break;
        case PlyRole::Red:
        case PlyRole::Green:
        case PlyRole::Blue:
          colour[channel(property)] = static_cast<float>(source_.next(property.type));
          break;
        case PlyRole::Alpha:
          has_clear_ |= source_.next(property.type) < full_colour(property.type, 0.0);
          break;
        case PlyRole::U:
        case PlyRole::V:
          if (lies_on_vertices) {
            on_picture[property.role == PlyRole::U ? 0 : 1] = source_.next(property.type);
            break;
          }
          [[fallthrough]];
        default:
          skip_property(property);
      }
    }
    source_.end_row();
    const Place place = binary_place.unit[0] == 'b' ? binary_place : source_.place();
    if (has_faces_) {
      builder_.add_point(point, place);
    } else if (!builder_.add_point_unless_missing(point, place)) {
      return;
    }
    if (coloured) {
      colours_.push_back(colour);
    }
    if (lies_on_vertices) {
      builder_.add_uv(on_picture[0], on_picture[1]);
    }
  }

  void read_faces(const PlyElement& element) {
    if (element.count > 0 &&
        std::any_of(element.properties.begin(), element.properties.end(),
                    [](const PlyProperty& property) { return property.role == PlyRole::Red; })) {
      builder_.note("colours of faces left out; those of vertices are read");
    }
    const bool is_textured =
        textures_.places() != PlyTextures::Places::None && element.kind == PlyElement::Kind::Face;
    for (std::uint64_t f = 0; f < element.count; ++f) {
      source_.begin_row();
      if (is_textured) {
        read_textured_face(element);
      } else {
        read_face(element);
      }
      source_.end_row();
      builder_.advance(source_.offset(), all_bytes_);
    }
  }

  void read_face(const PlyElement& element) {
    for (const PlyProperty& property : element.properties) {
      if (property.role != PlyRole::Indices) {
        skip_property(property);
      } else if (element.kind == PlyElement::Kind::Face) {
        read_polygon(property);
      } else {
        read_strips(property);
      }
    }
  }

  /// What lies on the face may stand before its corners or after them.
  void read_textured_face(const PlyElement& element) {
    corners_.clear();
    places_.clear();
    double picture = 0.0;
    for (const PlyProperty& property : element.properties) {
      if (property.role == PlyRole::Indices) {
        read_list(property, [&] {
          const Place place = source_.place();
          corners_.emplace_back(static_cast<std::uint64_t>(index(property.type, false)), place);
        });
      } else if (property.role == PlyRole::CornerPlaces) {
        read_list(property, [&] { places_.push_back(source_.next(property.type)); });
      } else if (property.role == PlyRole::TextureNumber) {
        picture = source_.next(property.type);
      } else {
        skip_property(property);
      }
    }
    const bool of_corners = textures_.places() == PlyTextures::Places::OfCorners;
    const bool has_places = !of_corners || places_.size() == 2 * corners_.size();
    builder_.begin_material(has_places ? textures_.material(picture) : Appearance::kNone);
    for (std::size_t k = 0; k < corners_.size(); ++k) {
      builder_.add_corner(corners_[k].first, corners_[k].second);
      if (of_corners && has_places) {
        builder_.add_uv(places_[2 * k], places_[2 * k + 1]);
        builder_.set_corner_uv(builder_.uv_count() - 1);
      }
    }
    builder_.end_polygon();
  }

  template <class Read>
  void read_list(const PlyProperty& property, const Read& read) {
    const std::size_t length = list_length(property);
    for (std::size_t i = 0; i < length; ++i) {
      read();
    }
  }

  std::size_t list_length(const PlyProperty& property) {
    const Place place = source_.place();
    const double length = source_.next(property.count_type);
    const std::size_t most = source_.remaining() / Source::least_bytes(property.type);
    if (!(length >= 0.0) || length != std::floor(length)) {
      builder_.fail(place, "the length of a list is not a whole number from 0");
    }
    if (length > static_cast<double>(most)) {
      builder_.fail(place, "a list is longer than the rest of the file");
    }
    return static_cast<std::size_t>(length);
  }

  /// A vertex index, or −1 where `separator` allows it.
  double index(PlyScalar type, bool separator) {
    const Place before = source_.place();
    const double value = source_.next(type);
    const double least = separator ? -1.0 : 0.0;
    constexpr double kMostIndex = 4294967295.0;  // what a uint holds
    if (!(value >= least) || value > kMostIndex || value != std::floor(value)) {
      builder_.fail(before.unit[0] == 'b' ? before : source_.place(),
                    "a face names a vertex that is not a whole number from 0");
    }
    return value;
  }

  void read_polygon(const PlyProperty& property) {
    read_list(property, [&] {
      const Place place = source_.place();
      builder_.add_corner(static_cast<std::uint64_t>(index(property.type, false)), place);
    });
    builder_.end_polygon();
  }

  void read_strips(const PlyProperty& property) {
    const std::size_t length = list_length(property);
    std::vector<std::uint64_t> strip;
    for (std::size_t i = 0; i < length; ++i) {
      const double vertex = index(property.type, true);
      if (vertex < 0.0) {
        builder_.add_strip(strip, source_.place());
        strip.clear();
      } else {
        strip.push_back(static_cast<std::uint64_t>(vertex));
      }
      builder_.advance(source_.offset(), all_bytes_);
    }
    builder_.add_strip(strip, source_.place());
  }

  void skip_element(const PlyElement& element) {
    if (element.count > 0 && !has_faces_ && names_vertices(element)) {
      builder_.note("elements " + in_quotes(element.name) +
                    " left out: " + std::to_string(element.count));
    }
    for (std::uint64_t i = 0; !element.properties.empty() && i < element.count; ++i) {
      source_.begin_row();
      for (const PlyProperty& property : element.properties) {
        skip_property(property);
      }
      source_.end_row();
      builder_.advance(source_.offset(), all_bytes_);
    }
  }

  /// Edges have vertex1 and vertex2, grids of scanners vertex_indices.
  static bool names_vertices(const PlyElement& element) {
    return std::any_of(
        element.properties.begin(), element.properties.end(),
        [](const PlyProperty& property) { return property.name.starts_with("vertex"); });
  }

  void skip_property(const PlyProperty& property) {
    const std::size_t length = property.is_list ? list_length(property) : 1;
    for (std::size_t i = 0; i < length; ++i) {
      source_.skip(property.type);
    }
  }

  Source source_;
  ModelBuilder& builder_;
  PlyTextures& textures_;
  std::size_t all_bytes_;
  bool has_faces_ = false;
  bool has_clear_ = false;                                  ///< A vertex is not opaque.
  std::vector<std::array<float, 3>> colours_{};             ///< As they stand there.
  std::vector<std::pair<std::uint64_t, Place>> corners_{};  ///< Of a textured face.
  std::vector<double> places_{};                            ///< u, v of each of these.
};

/// Reads text, and says how many values the header does not declare. \throw FormatError
Model read_text(std::string_view bytes, std::string_view name, const RunContext& run,
                const Surroundings& surroundings, PlyTextSource::Rows rows, std::size_t& surplus) {
  ModelBuilder builder(ModelFormat::Ply, name, run, 0);
  builder.limit_faces(surroundings.options.max_faces);
  const PlyHeader header = read_ply_header(bytes, builder);
  PlyTextures textures(header, surroundings, builder);
  BodyReader reader(PlyTextSource(bytes, header, builder, rows), builder, textures, bytes.size());
  reader.read(header);
  surplus = reader.surplus();
  return builder.finish();
}

/// A model whose rows hold more values than the header says, or nothing if that is not what is wrong.
std::optional<Model> read_by_lines(std::string_view bytes, std::string_view name,
                                   const RunContext& run, const Surroundings& surroundings) {
  try {
    const RunContext quiet = run.quiet();  // progress has been reported already
    std::size_t surplus = 0;
    Model model = read_text(bytes, name, quiet, surroundings, PlyTextSource::Rows::Lines, surplus);
    if (surplus == 0) {
      return std::nullopt;
    }
    model.notes.push_back("its rows hold " + std::to_string(surplus) +
                          " values more than the header declares; each line was read as one row");
    return model;
  } catch (const FormatError&) {
    return std::nullopt;
  }
}

Model read_text(std::string_view bytes, std::string_view name, const RunContext& run,
                const Surroundings& surroundings) {
  try {
    std::size_t surplus = 0;
    Model model = read_text(bytes, name, run, surroundings, PlyTextSource::Rows::Counted, surplus);
    std::optional<Model> by_lines =
        surplus > 0 ? read_by_lines(bytes, name, run, surroundings) : std::optional<Model>();
    return by_lines ? std::move(*by_lines) : std::move(model);
  } catch (const FormatError&) {
    if (std::optional<Model> by_lines = read_by_lines(bytes, name, run, surroundings)) {
      return std::move(*by_lines);
    }
    throw;
  }
}

}  // namespace

Model parse_ply(std::string_view bytes, std::string_view name, const RunContext& run,
                const Surroundings& surroundings) {
  bytes = without_bom(bytes);
  ModelBuilder builder(ModelFormat::Ply, name, run, 0);
  builder.limit_faces(surroundings.options.max_faces);
  const PlyHeader header = read_ply_header(bytes, builder);
  if (header.encoding == PlyEncoding::Ascii) {
    return read_text(bytes, name, run, surroundings);
  }
  PlyTextures textures(header, surroundings, builder);
  BodyReader(PlyBinarySource(bytes, header, builder), builder, textures, bytes.size()).read(header);
  return builder.finish();
}

}  // namespace vantage
