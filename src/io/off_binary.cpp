// SPDX-License-Identifier: MIT
#include <array>
#include <cstdint>
#include <string>

#include "io/byte_cursor.h"
#include "io/off.h"

namespace vantage {
namespace {

/// Numbers of a binary OFF file: four bytes each, highest first.
class Words {
 public:
  Words(std::string_view bytes, std::size_t at, const ModelBuilder& builder)
      : bytes_(bytes), at_(at), builder_(builder) {}

  std::int64_t integer() { return decode<std::int32_t>(take(1), ByteOrder::Big); }
  double real() { return static_cast<double>(decode<float>(take(1), ByteOrder::Big)); }
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

}  // namespace

void read_binary_off(std::string_view bytes, std::size_t start, const OffLayout& layout,
                     ModelBuilder& builder) {
  Words words(bytes, start, builder);
  const std::size_t point_words = layout.coordinates() + (layout.normal ? 3 : 0) +
                                  (layout.colour ? 4 : 0) + (layout.texture ? 2 : 0);
  const std::size_t points = read_count(words, builder, "vertices", point_words);
  const std::size_t faces = read_count(words, builder, "faces", 1);
  words.skip(1);  // number of edges, which nobody uses
  for (std::size_t v = 0; v < points; ++v) {
    const Place place = words.place();
    std::array<double, 4> position{};
    for (std::size_t c = 0; c < layout.coordinates(); ++c) {
      position[c] = words.real();
    }
    add_off_point(builder, layout, position.data(), place);
    words.skip(layout.normal ? 3 : 0);
    if (layout.colour) {
      const double red = words.real();
      const double green = words.real();
      const double blue = words.real();
      builder.add_colour(red, green, blue);
      words.skip(1);
    }
    words.skip(layout.texture ? 2 : 0);
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
    words.skip(read_count(words, builder, "colour components", 1));
    builder.advance(words.offset(), bytes.size());
  }
}

}  // namespace vantage
