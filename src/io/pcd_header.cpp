// SPDX-License-Identifier: MIT
#include "io/pcd_header.h"

#include <algorithm>
#include <optional>

#include "io/number_parsing.h"
#include "io/text_cursor.h"

namespace vantage {
namespace {

/// More fields, or values a field, than this are no point cloud but a damaged file.
constexpr std::int64_t kMostFields = 4096;
/// LZF can make this many bytes of one: a reference of three bytes stands for up to 264.
constexpr std::size_t kMostExpansion = 264;

std::vector<std::string_view> columns(std::string_view line) {
  std::vector<std::string_view> tokens;
  for (std::string_view t = take_token(line); !t.empty(); t = take_token(line)) {
    tokens.push_back(t);
  }
  return tokens;
}

std::uint64_t whole(std::string_view token, std::int64_t most, Place place,
                    const ModelBuilder& builder) {
  const std::optional<std::int64_t> value = integer_from(token);
  if (!value || *value < 0 || *value > most) {
    builder.fail(place, "expected a whole number from 0, found " + in_quotes(token));
  }
  return static_cast<std::uint64_t>(*value);
}

class PcdHeaderReader {
 public:
  explicit PcdHeaderReader(const ModelBuilder& builder) : builder_(builder) {}

  /// Takes one statement; true if it was the last.
  bool take(const std::vector<std::string_view>& words, Place place) {
    const std::string_view word = words[0];
    const std::size_t values = words.size() - 1;
    if (word == "FIELDS" || word == "COLUMNS") {
      for (std::size_t i = 1; i < words.size() && i <= kMostFields; ++i) {
        header.fields.push_back({.name = std::string(words[i])});
      }
    } else if (word == "SIZE" || word == "TYPE" || word == "COUNT") {
      if (values != header.fields.size()) {
        builder_.fail(place, std::string(word) + " must have one entry for each field");
      }
      for (std::size_t i = 0; i < values; ++i) {
        set(header.fields[i], word, words[i + 1], place);
      }
    } else if ((word == "POINTS" || word == "WIDTH" || word == "HEIGHT") && values == 1) {
      constexpr std::int64_t kMost = std::int64_t{1} << 31;
      const std::uint64_t value = whole(words[1], kMost, place, builder_);
      if (word == "POINTS") {
        points = value;
      } else {
        (word == "WIDTH" ? width : height) = value;
      }
    } else if (word == "DATA" && values == 1) {
      set_data(words[1], place);
      return true;
    } else if (word != "VERSION" && word != "VIEWPOINT") {
      builder_.fail(place, "expected a statement of a PCD header, found " + in_quotes(word));
    }
    return false;
  }

  PcdHeader header{};
  std::optional<std::uint64_t> points{};
  std::uint64_t width = 0;
  std::uint64_t height = 1;

 private:
  void set(PcdField& field, std::string_view word, std::string_view value, Place place) {
    if (word == "TYPE") {
      if (value != "F" && value != "I" && value != "U") {
        builder_.fail(place, "expected a type F, I or U, found " + in_quotes(value));
      }
      field.type = value[0];
      return;
    }
    const auto number = static_cast<std::size_t>(whole(value, kMostFields, place, builder_));
    if (word == "COUNT") {
      field.count = number;
    } else if (number == 1 || number == 2 || number == 4 || number == 8) {
      field.size = number;
    } else {
      builder_.fail(place, "expected a size of 1, 2, 4 or 8 bytes, found " + in_quotes(value));
    }
  }

  void set_data(std::string_view kind, Place place) {
    if (kind == "ascii") {
      header.data = PcdData::Ascii;
    } else if (kind == "binary") {
      header.data = PcdData::Binary;
    } else if (kind == "binary_compressed") {
      header.data = PcdData::Compressed;
    } else {
      builder_.fail(place,
                    "expected DATA ascii, binary or binary_compressed, found " + in_quotes(kind));
    }
  }

  const ModelBuilder& builder_;
};

}  // namespace

PcdHeader read_pcd_header(std::string_view bytes, const ModelBuilder& builder) {
  TextCursor cursor(bytes);
  PcdHeaderReader reader(builder);
  for (bool ended = false; !ended;) {
    const auto line = cursor.next_line();
    if (!line) {
      builder.fail("the header has no DATA statement; the file may be cut short");
    }
    const std::vector<std::string_view> words = columns(*line);
    if (!words.empty() && words[0].front() != '#') {
      ended = reader.take(words, cursor.place());
    }
  }
  PcdHeader& header = reader.header;
  header.body = cursor.offset();
  header.first_line = cursor.line();
  header.points = reader.points.value_or(reader.width * reader.height);
  for (PcdField& field : header.fields) {
    field.offset = header.point_bytes;
    header.point_bytes += field.size * field.count;
  }
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::string wanted(1, "xyz"[axis]);
    const auto at = std::find_if(header.fields.begin(), header.fields.end(),
                                 [&](const PcdField& f) { return f.name == wanted; });
    if (at == header.fields.end() || at->count != 1) {
      builder.fail("the header has no field " + wanted + ", so the points have no positions");
    }
    if (at->type == 'F' && at->size < 4) {
      builder.fail("the field " + wanted + " has a floating type of fewer than 4 bytes");
    }
    header.coordinate[axis] = static_cast<std::size_t>(at - header.fields.begin());
  }
  return std::move(header);
}

bool unpack_lzf(std::string_view packed, std::size_t size, std::string& unpacked) {
  unpacked.clear();
  if (size / kMostExpansion > packed.size()) {
    return false;
  }
  unpacked.reserve(size);
  std::size_t at = 0;
  const auto byte = [&] { return static_cast<unsigned char>(packed[at++]); };
  while (at < packed.size()) {
    const std::size_t control = byte();
    if (control < 32) {  // a run of literal bytes
      const std::size_t length = control + 1;
      if (length > packed.size() - at || length > size - unpacked.size()) {
        return false;
      }
      unpacked.append(packed.substr(at, length));
      at += length;
      continue;
    }
    std::size_t length = control >> 5U;
    if (length == 7) {
      if (at == packed.size()) {
        return false;
      }
      length += byte();
    }
    length += 2;
    if (at == packed.size()) {
      return false;
    }
    const std::size_t back = ((control & 31U) << 8U) + byte() + 1;
    if (back > unpacked.size() || length > size - unpacked.size()) {
      return false;
    }
    for (std::size_t i = 0; i < length; ++i) {  // may overlap what it writes
      unpacked.push_back(unpacked[unpacked.size() - back]);
    }
  }
  return unpacked.size() == size;
}

}  // namespace vantage
