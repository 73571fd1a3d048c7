// SPDX-License-Identifier: MIT
#include <cmath>
#include <optional>
#include <string>

#include "io/byte_cursor.h"
#include "io/number_parsing.h"
#include "io/pcd_header.h"
#include "io/readers.h"
#include "io/text_cursor.h"

namespace vantage {
namespace {

double decode_field(const char* bytes, const PcdField& field) {
  const auto as = [bytes](auto zero) {
    return static_cast<double>(decode<decltype(zero)>(bytes, ByteOrder::Little));
  };
  if (field.type == 'F') {
    return field.size == 8 ? as(double{}) : as(float{});
  }
  const bool is_signed = field.type == 'I';
  switch (field.size) {
    case 1:
      return is_signed ? as(std::int8_t{}) : as(std::uint8_t{});
    case 2:
      return is_signed ? as(std::int16_t{}) : as(std::uint16_t{});
    case 4:
      return is_signed ? as(std::int32_t{}) : as(std::uint32_t{});
    default:
      return is_signed ? as(std::int64_t{}) : as(std::uint64_t{});
  }
}

/// Adds points and reports progress.
class PointSink {
 public:
  PointSink(ModelBuilder& builder, std::size_t all_bytes)
      : builder_(builder), all_bytes_(all_bytes) {}

  void add(const Vec3& point, Place place, std::size_t offset) {
    builder_.add_point_unless_missing(point, place);
    builder_.advance(offset, all_bytes_);
  }

 private:
  ModelBuilder& builder_;
  std::size_t all_bytes_;
};

double coordinate_from(std::string_view token, Place place, ModelBuilder& builder) {
  const std::optional<double> value = number_from(token);
  if (!value) {
    builder.fail(place, number_problem(token));
  }
  if (!builder.double_precision() && needs_double(token, *value)) {
    builder.coordinates_need_double();
  }
  return *value;
}

void read_ascii(std::string_view bytes, const PcdHeader& header, ModelBuilder& builder,
                PointSink& sink) {
  TextCursor cursor(bytes.substr(header.body), header.first_line);
  for (std::uint64_t p = 0; p < header.points; ++p) {
    Vec3 point = Vec3::Zero();
    for (std::size_t f = 0; f < header.fields.size(); ++f) {
      for (std::size_t c = 0; c < header.fields[f].count; ++c) {
        const std::string_view token = cursor.next_token();
        if (token.empty()) {
          builder.fail(cursor.place(), "the header declares " + std::to_string(header.points) +
                                           " points, the file ends after " + std::to_string(p));
        }
        for (int axis = 0; axis < 3; ++axis) {
          if (header.coordinate[axis] == f) {
            point[axis] = coordinate_from(token, cursor.place(), builder);
          }
        }
      }
    }
    sink.add(point, cursor.place(), header.body + cursor.offset());
  }
  if (!cursor.next_token().empty()) {
    builder.note("text after the last point left out, from " + cursor.place().text());
  }
}

void note_surplus(std::size_t bytes, ModelBuilder& builder) {
  if (bytes > 0) {
    builder.note("bytes after the last point left out: " + std::to_string(bytes));
  }
}

/// \param by_column the values of a field follow one another over all points, as compressed files
/// have them.
void read_binary(std::string_view body, std::size_t begin, bool by_column, const PcdHeader& header,
                 ModelBuilder& builder, PointSink& sink) {
  if (header.points > 0 && header.point_bytes > body.size() / header.points) {
    builder.fail({"byte", begin}, "the header declares " + std::to_string(header.points) +
                                      " points, more than the file holds; it may be cut short");
  }
  const auto count = static_cast<std::size_t>(header.points);
  for (const std::size_t of_axis : header.coordinate) {
    const PcdField& field = header.fields[of_axis];
    if (field.size == 8 || (field.type != 'F' && field.size == 4)) {
      builder.coordinates_need_double();
    }
  }
  for (std::size_t p = 0; p < count; ++p) {
    Vec3 point = Vec3::Zero();
    for (int axis = 0; axis < 3; ++axis) {
      const PcdField& field = header.fields[header.coordinate[axis]];
      const std::size_t at =
          by_column ? field.offset * count + p * field.size : p * header.point_bytes + field.offset;
      point[axis] = decode_field(body.data() + at, field);
    }
    const std::size_t at = by_column ? begin : begin + p * header.point_bytes;
    sink.add(point, {"byte", at}, at);
  }
}

}  // namespace

Model parse_pcd(std::string_view bytes, std::string_view name, const RunContext& run,
                std::size_t max_points) {
  bytes = without_bom(bytes);
  ModelBuilder builder(ModelFormat::Pcd, name, run, 0);
  builder.limit_faces(max_points);
  const PcdHeader header = read_pcd_header(bytes, builder);
  builder.check_counts(0, header.points);  // what marks missing ones is not known yet
  if (std::any_of(header.fields.begin(), header.fields.end(), [](const PcdField& field) {
        return field.name == "rgb" || field.name == "rgba";
      })) {
    builder.note("colours of points left out");
  }
  PointSink sink(builder, bytes.size());
  const std::string_view body = bytes.substr(header.body);
  if (header.data == PcdData::Ascii) {
    read_ascii(bytes, header, builder, sink);
  } else if (header.data == PcdData::Binary) {
    read_binary(body, header.body, false, header, builder, sink);
    note_surplus(body.size() - header.points * header.point_bytes, builder);
  } else {
    constexpr std::size_t kSizes = 8;  // of the packed and of the unpacked bytes
    std::string unpacked;
    const bool has_sizes = body.size() >= kSizes;
    const std::size_t packed =
        has_sizes ? decode<std::uint32_t>(body.data(), ByteOrder::Little) : 0;
    const std::size_t size =
        has_sizes ? decode<std::uint32_t>(body.data() + 4, ByteOrder::Little) : 0;
    if (!has_sizes || packed > body.size() - kSizes ||
        !unpack_lzf(body.substr(kSizes, packed), size, unpacked)) {
      builder.fail({"byte", header.body},
                   "the compressed points cannot be unpacked; the file may be damaged");
    }
    read_binary(unpacked, header.body, true, header, builder, sink);
    note_surplus(body.size() - kSizes - packed, builder);
  }
  return builder.finish();
}

}  // namespace vantage
