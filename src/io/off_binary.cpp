// SPDX-License-Identifier: MIT
#include <array>
#include <cstdint>
#include <string>

#include "io/byte_cursor.h"
#include "io/off.h"

namespace vantage {
namespace {

/// Numbers of a binary OFF file: four bytes each.
class Words {
 public:
  Words(std::string_view bytes, std::size_t at, ByteOrder order, const ModelBuilder& builder)
      : bytes_(bytes), at_(at), order_(order), builder_(builder) {}

  std::int64_t integer() { return decode<std::int32_t>(take(1), order_); }

  double real() { return static_cast<double>(decode<float>(take(1), order_)); }

  void skip(std::size_t words) { take(words); }

  [[nodiscard]] std::size_t remaining() const { return (bytes_.size() - at_) / kWordBytes; }

  [[nodiscard]] Place place() const { return {"byte", at_}; }

  [[nodiscard]] std::size_t offset() const { return at_; }

 private:
  static constexpr std::size_t kWordBytes = 4;

  const char* take(std::size_t words) {
    if (words > remaining()) {
      builder_.fail(place(), "the file ends early");
    }
    const char* here = bytes_.data() + at_;
    at_ += words * kWordBytes;
    return here;
  }

  std::string_view bytes_;
  std::size_t at_;
  ByteOrder order_;
  const ModelBuilder& builder_;
};

std::size_t read_count(Words& words, const ModelBuilder& builder, std::string_view what,
                       std::size_t words_each) {
  const Place place = words.place();
  const std::int64_t count = words.integer();
  if (count < 0) {
    builder.fail(place, "the number of " + std::string(what) + " is negative");
  }
  if (static_cast<std::size_t>(count) > words.remaining() / words_each) {
    builder.fail(place, "the file declares " + std::to_string(count) + " " + std::string(what) +
                            ", more than its size can hold");
  }
  return static_cast<std::size_t>(count);
}

/// The format says highest byte first. pmp writes the machine's order, and then no colours: such a
/// file is known by counts that make sense only that way.
bool is_little_endian(std::string_view bytes, std::size_t start, std::size_t point_words) {
  const auto fits = [&](ByteOrder order) {
    const std::size_t words = (bytes.size() - start) / 4;
    const std::uint64_t points = decode<std::uint32_t>(bytes.data() + start, order);
    const std::uint64_t faces = decode<std::uint32_t>(bytes.data() + start + 4, order);
    return 3 + points * point_words + faces <= words;
  };
  constexpr std::size_t kCountBytes = 12;
  return bytes.size() - start >= kCountBytes && !fits(ByteOrder::Big) && fits(ByteOrder::Little);
}

}  // namespace

void read_binary_off(std::string_view bytes, std::size_t start, const OffLayout& layout,
                     ModelBuilder& builder) {
  const std::size_t point_words =
      layout.coordinates() + layout.beside_colour() + (layout.colour ? 4 : 0);
  const std::size_t counts = start + (layout.any_dimension ? 4 : 0);
  const bool little_endian = is_little_endian(bytes, std::min(counts, bytes.size()), point_words);
  if (little_endian) {
    builder.note("the numbers stand lowest byte first, against the format's rule");
  }
  Words words(bytes, start, little_endian ? ByteOrder::Little : ByteOrder::Big, builder);
  if (layout.any_dimension) {
    require_three_dimensions(words.integer(), words.place(), builder);
  }
  const std::size_t points = read_count(words, builder, "vertices", point_words);
  const std::size_t faces = read_count(words, builder, "faces", 1);
  builder.check_counts(faces, points);
  words.skip(1);  // number of edges, which nobody uses
  for (std::size_t v = 0; v < points; ++v) {
    const Place place = words.place();
    std::array<double, 4> position{};
    for (std::size_t c = 0; c < layout.coordinates(); ++c) {
      position[c] = words.real();
    }
    add_off_point(builder, layout, position.data(), place);
    words.skip(layout.before_colour());
    if (layout.colour) {
      const double red = words.real();
      const double green = words.real();
      const double blue = words.real();
      builder.add_colour(red, green, blue);
      words.skip(1);
    }
    words.skip(layout.beside_colour() - layout.before_colour());
    builder.advance(words.offset(), bytes.size());
  }
  for (std::size_t f = 0; f < faces; ++f) {
    const std::size_t corners = read_count(words, builder, "corners of a face", 1);
    for (std::size_t c = 0; c < corners; ++c) {
      const Place place = words.place();
      const std::int64_t vertex = words.integer();
      if (vertex < 0) {
        builder.fail(place, "face names vertex " + std::to_string(vertex));
      }
      builder.add_corner(static_cast<std::uint64_t>(vertex), place);
    }
    builder.end_polygon();
    if (!little_endian) {
      words.skip(read_count(words, builder, "colour components", 1));
    }
    builder.advance(words.offset(), bytes.size());
  }
  if (const std::size_t rest = bytes.size() - words.offset(); rest > 0) {
    builder.note("bytes after the last face left out: " + std::to_string(rest));
  }
}

}  // namespace vantage
