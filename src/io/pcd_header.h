// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "io/model_builder.h"

namespace vantage {

/// A column of a PCD file.
struct PcdField {
  std::string name{};
  char type = 'F';         ///< F float, I signed, U unsigned.
  std::size_t size = 4;    ///< Bytes a value: 1, 2, 4, 8.
  std::size_t count = 1;   ///< Values a point.
  std::size_t offset = 0;  ///< Bytes before it in a point, or before the column if compressed: × n.
};

enum class PcdData { Ascii, Binary, Compressed };

/// What stands above the points.
struct PcdHeader {
  std::vector<PcdField> fields{};
  std::uint64_t points = 0;
  PcdData data = PcdData::Ascii;
  std::size_t point_bytes = 0;
  std::size_t body = 0;         ///< Where the points begin.
  std::size_t first_line = 0;   ///< The line they begin at.
  std::size_t coordinate[3]{};  ///< Fields named x, y, z.
};

/// Reads the header of PCD 0.5 to 0.7. \throw FormatError
PcdHeader read_pcd_header(std::string_view bytes, const ModelBuilder& builder);

/// Undoes LZF compression (Lehmann's LibLZF, the format that PCD uses).
/// \return false if the bytes do not unpack to exactly `size`, or `size` is more than they can hold.
bool unpack_lzf(std::string_view packed, std::size_t size, std::string& unpacked);

}  // namespace vantage
