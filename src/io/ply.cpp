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
  BodyReader(Source source, ModelBuilder& builder, std::size_t all_bytes)
      : source_(source), builder_(builder), all_bytes_(all_bytes) {}

  void read(const PlyHeader& header) {
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
  }

  /// Values that the header does not declare.
  std::size_t surplus() { return source_.surplus(); }

 private:
  void check_count(const PlyElement& element) {
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
    const bool coloured = types[0] && types[1] && types[2];
    for (std::uint64_t v = 0; v < element.count; ++v) {
      read_vertex(element, coloured);
      builder_.advance(source_.offset(), all_bytes_);
    }
    if (coloured) {
      add_colours({*types[0], *types[1], *types[2]});
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
        default:
          skip_property(property);
      }
    }
    source_.end_row();
    builder_.add_point(point, binary_place.unit[0] == 'b' ? binary_place : source_.place());
    if (coloured) {
      colours_.push_back(colour);
    }
  }

  void read_faces(const PlyElement& element) {
    if (element.count > 0 && std::any_of(element.properties.begin(), element.properties.end(),
                                         [](const PlyProperty& property) {
                                           return lower_case(property.name) == "red";
                                         })) {
      builder_.note("colours of faces left out; those of vertices are read");
    }
    for (std::uint64_t f = 0; f < element.count; ++f) {
      source_.begin_row();
      for (const PlyProperty& property : element.properties) {
        if (property.role != PlyRole::Indices) {
          skip_property(property);
        } else if (element.kind == PlyElement::Kind::Face) {
          read_polygon(property);
        } else {
          read_strips(property);
        }
      }
      source_.end_row();
      builder_.advance(source_.offset(), all_bytes_);
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
    const std::size_t length = list_length(property);
    for (std::size_t i = 0; i < length; ++i) {
      const Place place = source_.place();
      builder_.add_corner(static_cast<std::uint64_t>(index(property.type, false)), place);
    }
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
    for (std::uint64_t i = 0; !element.properties.empty() && i < element.count; ++i) {
      source_.begin_row();
      for (const PlyProperty& property : element.properties) {
        skip_property(property);
      }
      source_.end_row();
      builder_.advance(source_.offset(), all_bytes_);
    }
  }

  void skip_property(const PlyProperty& property) {
    const std::size_t length = property.is_list ? list_length(property) : 1;
    for (std::size_t i = 0; i < length; ++i) {
      source_.skip(property.type);
    }
  }

  Source source_;
  ModelBuilder& builder_;
  std::size_t all_bytes_;
  std::vector<std::array<float, 3>> colours_{};  ///< As they stand there.
};

/// Reads text, and says how many values the header does not declare. \throw FormatError
Model read_text(std::string_view bytes, std::string_view name, const RunContext& run,
                PlyTextSource::Rows rows, std::size_t& surplus) {
  ModelBuilder builder(ModelFormat::Ply, name, run, 0);
  const PlyHeader header = read_ply_header(bytes, builder);
  BodyReader reader(PlyTextSource(bytes, header, builder, rows), builder, bytes.size());
  reader.read(header);
  surplus = reader.surplus();
  return builder.finish();
}

/// A model whose rows hold more values than the header says, or nothing if that is not what is wrong.
std::optional<Model> read_by_lines(std::string_view bytes, std::string_view name,
                                   const RunContext& run) {
  try {
    std::size_t surplus = 0;
    Model model = read_text(bytes, name, run, PlyTextSource::Rows::Lines, surplus);
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

Model read_text(std::string_view bytes, std::string_view name, const RunContext& run) {
  try {
    std::size_t surplus = 0;
    Model model = read_text(bytes, name, run, PlyTextSource::Rows::Counted, surplus);
    std::optional<Model> by_lines =
        surplus > 0 ? read_by_lines(bytes, name, run) : std::optional<Model>();
    return by_lines ? std::move(*by_lines) : std::move(model);
  } catch (const FormatError&) {
    if (std::optional<Model> by_lines = read_by_lines(bytes, name, run)) {
      return std::move(*by_lines);
    }
    throw;
  }
}

}  // namespace

Model parse_ply(std::string_view bytes, std::string_view name, const RunContext& run) {
  bytes = without_bom(bytes);
  ModelBuilder builder(ModelFormat::Ply, name, run, 0);
  const PlyHeader header = read_ply_header(bytes, builder);
  if (header.encoding == PlyEncoding::Ascii) {
    return read_text(bytes, name, run);
  }
  BodyReader(PlyBinarySource(bytes, header, builder), builder, bytes.size()).read(header);
  return builder.finish();
}

}  // namespace vantage
