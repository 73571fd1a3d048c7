// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "io/byte_cursor.h"
#include "io/model_builder.h"
#include "io/number_parsing.h"
#include "io/ply_header.h"
#include "io/text_cursor.h"

/// \file
/// The two ways a PLY body is written, with one interface for the reader's template.

namespace vantage {

/// Body of numbers in text.
class PlyTextSource {
 public:
  /// How rows end.
  enum class Rows {
    Counted,  ///< After as many values as the header says, wherever lines break.
    Lines,    ///< With their line: values beyond what the header says are passed over.
  };

  PlyTextSource(std::string_view bytes, const PlyHeader& header, ModelBuilder& builder,
                Rows rows = Rows::Counted)
      : cursor_(bytes.substr(header.body_offset), header.body_line),
        start_(header.body_offset),
        builder_(builder),
        rows_(rows) {}

  void begin_row() { is_begun_ = false; }

  void end_row() {
    while (rows_ == Rows::Lines && !cursor_.token_on_line().empty()) {
      ++surplus_;
    }
  }

  /// What stands beyond the last row, for a note; empty if there is nothing.
  std::string rest_left_out() {
    if (cursor_.next_token().empty()) {
      return {};
    }
    surplus_ += rows_ == Rows::Counted ? 1 : 0;
    return "text after the last element left out, from " + place().text();
  }

  /// Values that were passed over, or that stand beyond the last row.
  [[nodiscard]] std::size_t surplus() const { return surplus_; }

  double next(PlyScalar /*type*/) {
    token_ = take();
    const std::optional<double> value = number_from(token_);
    if (!value) {
      builder_.fail(place(), number_problem(token_));
    }
    return *value;
  }

  double next_coordinate(PlyScalar type) {
    const double value = next(type);
    if (!builder_.double_precision() && needs_double(token_, value)) {
      builder_.coordinates_need_double();
    }
    return value;
  }

  void skip(PlyScalar /*type*/) { take(); }

  /// Bytes of the shortest value: a digit and a blank; the file's last one needs no blank.
  static std::size_t least_bytes(PlyScalar /*type*/) { return 2; }

  [[nodiscard]] std::size_t remaining() const { return cursor_.remaining() + 1; }

  [[nodiscard]] Place place() const { return cursor_.place(); }

  [[nodiscard]] std::size_t offset() const { return start_ + cursor_.offset(); }

 private:
  std::string_view take() {
    const bool within = rows_ == Rows::Lines && is_begun_;
    const std::string_view token = within ? cursor_.token_on_line() : cursor_.next_token();
    is_begun_ = true;
    if (token.empty()) {
      builder_.fail(place(), within ? "a row ends early" : "the file ends early");
    }
    return token;
  }

  TextCursor cursor_;
  std::size_t start_;
  ModelBuilder& builder_;
  Rows rows_;
  bool is_begun_ = false;  // a value of the row has been read
  std::size_t surplus_ = 0;
  std::string_view token_{};
};

/// Body of numbers in binary.
class PlyBinarySource {
 public:
  PlyBinarySource(std::string_view bytes, const PlyHeader& header, ModelBuilder& builder)
      : bytes_(bytes),
        at_(header.body_offset),
        order_(header.encoding == PlyEncoding::BinaryBigEndian ? ByteOrder::Big
                                                               : ByteOrder::Little),
        builder_(builder) {}

  static void begin_row() {}

  static void end_row() {}

  [[nodiscard]] std::string rest_left_out() const {
    return remaining() == 0
               ? ""
               : "bytes after the last element left out: " + std::to_string(remaining());
  }

  static std::size_t surplus() { return 0; }

  double next(PlyScalar type) {
    const char* here = take(ply_scalar_bytes(type));
    switch (type) {
      case PlyScalar::I8:
        return static_cast<double>(decode<std::int8_t>(here, order_));
      case PlyScalar::U8:
        return static_cast<double>(decode<std::uint8_t>(here, order_));
      case PlyScalar::I16:
        return static_cast<double>(decode<std::int16_t>(here, order_));
      case PlyScalar::U16:
        return static_cast<double>(decode<std::uint16_t>(here, order_));
      case PlyScalar::I32:
        return static_cast<double>(decode<std::int32_t>(here, order_));
      case PlyScalar::U32:
        return static_cast<double>(decode<std::uint32_t>(here, order_));
      case PlyScalar::F32:
        return static_cast<double>(decode<float>(here, order_));
      case PlyScalar::F64:
        return decode<double>(here, order_);
    }
    return 0.0;  // not reached: the switch names every type
  }

  double next_coordinate(PlyScalar type) {
    const double value = next(type);
    if (type == PlyScalar::F64 && value != static_cast<double>(static_cast<float>(value))) {
      builder_.coordinates_need_double();
    }
    return value;
  }

  void skip(PlyScalar type) { take(ply_scalar_bytes(type)); }

  static std::size_t least_bytes(PlyScalar type) { return ply_scalar_bytes(type); }

  [[nodiscard]] std::size_t remaining() const { return bytes_.size() - at_; }

  [[nodiscard]] Place place() const { return {"byte", at_}; }

  [[nodiscard]] std::size_t offset() const { return at_; }

 private:
  const char* take(std::size_t count) {
    if (count > remaining()) {
      builder_.fail(place(), "the file ends early");
    }
    const char* here = bytes_.data() + at_;
    at_ += count;
    return here;
  }

  std::string_view bytes_;
  std::size_t at_;
  ByteOrder order_;
  ModelBuilder& builder_;
};

}  // namespace vantage
