// SPDX-License-Identifier: MIT
// A PLY of any elements and properties, of all types and lists: the same model as text and as binary
// of either byte order, or refused as each of them.
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <sstream>
#include <string>
#include <vector>

#include "vantage/io/model.h"

#include "choices.h"
#include "io/byte_cursor.h"
#include "io/readers.h"
#include "sound_model.h"

namespace {

/// A PLY in its three encodings, value by value.
class PlyDraft {
 public:
  explicit PlyDraft(Choices& choices) : choices_(choices) {
    const std::size_t elements = 1 + choices_.below(4);
    const std::size_t vertices = choices_.below(elements);  // most often the first
    for (std::size_t e = 0; e < elements; ++e) {
      element(e == vertices ? "vertex" : choices_.of(kElements));
    }
  }

  [[nodiscard]] std::string text() const { return head("ascii") + text_; }

  [[nodiscard]] std::string little() const { return head("binary_little_endian") + little_; }

  [[nodiscard]] std::string big() const { return head("binary_big_endian") + big_; }

  /// Whether the body is what the header says; else values stand elsewhere in each encoding.
  [[nodiscard]] bool is_exact() const { return is_exact_; }

 private:
  enum class Number { I8, U8, I16, U16, I32, U32, F32, F64 };

  struct Property {
    Number type = Number::F32;
    bool is_list = false;
    Number count_type = Number::U8;
    bool is_index = false;
  };

  static constexpr std::array<const char*, 4> kElements{"face", "tristrips", "edge", "face"};

  [[nodiscard]] std::string head(const char* format) const {
    return std::string("ply\nformat ") + format + " 1.0\ncomment c\n" + header_ + "end_header\n";
  }

  std::string name_of(Number type) {
    constexpr std::array<std::array<const char*, 2>, 8> kNames{{{"char", "int8"},
                                                                {"uchar", "uint8"},
                                                                {"short", "int16"},
                                                                {"ushort", "uint16"},
                                                                {"int", "int32"},
                                                                {"uint", "uint32"},
                                                                {"float", "float32"},
                                                                {"double", "float64"}}};
    return choices_.of(kNames[static_cast<std::size_t>(type)]);
  }

  Number type() {
    constexpr std::array<Number, 9> kTypes{Number::F32, Number::U8,  Number::F64,
                                           Number::I8,  Number::I16, Number::U16,
                                           Number::I32, Number::U32, Number::F32};
    return choices_.of(kTypes);
  }

  void element(const std::string& name) {
    const std::size_t count = choices_.below(6);
    is_exact_ = is_exact_ && !choices_.once_in(64);
    header_ += "element " + name + " " +
               (is_exact_ ? std::to_string(count) : choices_.index(count + 4)) + "\n";
    std::vector<Property> properties;
    if (name == "vertex") {
      vertices_ = count;
      for (const char* const axis : {"x", "y", "z"}) {
        add_scalar(axis, properties);
      }
    }
    constexpr std::array<const char*, 6> kNames{"red", "green",       "blue", "vertex_indices",
                                                "q",   "vertex_index"};
    const bool has_corners = name == "face" || name == "tristrips";
    if (has_corners && !choices_.once_in(16)) {
      add_list("vertex_indices", properties);
    }
    for (std::size_t i = choices_.below(5); i > 0; --i) {
      choices_.below(2) == 0 ? add_scalar(choices_.of(kNames), properties)
                             : add_list(choices_.of(kNames), properties);
    }
    for (std::size_t row = 0; row < count; ++row) {
      for (const Property& property : properties) {
        write(property);
      }
      text_ += "\n";
    }
  }

  void add_scalar(const std::string& name, std::vector<Property>& properties) {
    properties.push_back({.type = type()});
    header_ += "property " + name_of(properties.back().type) + " " + name + "\n";
  }

  void add_list(const std::string& name, std::vector<Property>& properties) {
    const bool is_index = name.starts_with("vertex");
    properties.push_back(
        {.type = type(), .is_list = true, .count_type = type(), .is_index = is_index});
    const Property& property = properties.back();
    header_ += "property list " + name_of(property.count_type) + " " + name_of(property.type) +
               " " + name + "\n";
  }

  void write(const Property& property) {
    if (!property.is_list) {
      value(property.type, number(property.type));
      return;
    }
    const std::size_t length = property.is_index && !choices_.once_in(4) ? 3 : choices_.below(8);
    value(property.count_type, static_cast<double>(length));
    for (std::size_t i = 0; i < length; ++i) {
      value(property.type, property.is_index && vertices_ > 0 && !choices_.once_in(64)
                               ? static_cast<double>(choices_.below(vertices_))
                               : number(property.type));
    }
  }

  /// What the type holds exactly.
  double number(Number type) {
    constexpr std::array<double, 12> kValues{
        0.0,  1.0,  2.0,    3.0,      100.0,   0.5,
        -1.0, -2.5, 0x1p24, -0x1p-20, 0x1p100, std::numeric_limits<double>::quiet_NaN()};
    const double value = choices_.of(kValues);
    const bool is_float = type == Number::F32 || type == Number::F64;
    return is_float || (value >= 0.0 && value <= 100.0 && value != 0.5) ? value : 0.0;
  }

  template <class As>
  void append(double value) {
    std::string bytes;
    vantage::append_little_endian(bytes, static_cast<As>(value));
    little_ += bytes;
    std::reverse(bytes.begin(), bytes.end());
    big_ += bytes;
  }

  void value(Number type, double value) {
    std::ostringstream digits;
    digits.precision(17);
    digits << value << (choices_.once_in(16) ? "\n" : " ");
    text_ += digits.str();
    switch (type) {
      case Number::I8:
        return append<std::int8_t>(value);
      case Number::U8:
        return append<std::uint8_t>(value);
      case Number::I16:
        return append<std::int16_t>(value);
      case Number::U16:
        return append<std::uint16_t>(value);
      case Number::I32:
        return append<std::int32_t>(value);
      case Number::U32:
        return append<std::uint32_t>(value);
      case Number::F32:
        return append<float>(value);
      case Number::F64:
        return append<double>(value);
    }
  }

  Choices& choices_;
  std::string header_{};
  std::string text_{};
  std::string little_{};
  std::string big_{};
  std::size_t vertices_ = 0;
  bool is_exact_ = true;
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Choices choices(data, size);
  const PlyDraft draft(choices);
  const auto read = [](const std::string& bytes) {
    return sound_model([&] { return vantage::parse_ply(bytes, "fuzz.ply", {}, {}); });
  };
  const auto text = read(draft.text());
  const auto little = read(draft.little());
  const auto big = read(draft.big());
  if (draft.is_exact()) {
    expect_same(text, little);
    expect_same(text, big);
  }
  return 0;
}
