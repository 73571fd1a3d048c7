// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "io/model_builder.h"

namespace vantage {

enum class PlyEncoding { Ascii, BinaryLittleEndian, BinaryBigEndian };

enum class PlyScalar { I8, U8, I16, U16, I32, U32, F32, F64 };

/// Bytes of a scalar in a binary file.
std::size_t ply_scalar_bytes(PlyScalar type);

/// What a property means to us.
enum class PlyRole {
  Other,
  X,
  Y,
  Z,
  Red,
  Green,
  Blue,
  Alpha,
  U,
  V,
  Indices,
  CornerPlaces,   ///< u, v of each corner of a face, as MeshLab writes them.
  TextureNumber,  ///< Of a face.
};

struct PlyProperty {
  std::string name{};
  PlyScalar type = PlyScalar::F32;
  bool is_list = false;
  PlyScalar count_type = PlyScalar::U8;  ///< Of lists.
  PlyRole role = PlyRole::Other;
};

struct PlyElement {
  enum class Kind { Other, Vertex, Face, Strips };
  std::string name{};
  Kind kind = Kind::Other;
  std::uint64_t count = 0;  ///< As declared; checked against the bytes that remain by the reader.
  std::vector<PlyProperty> properties{};
};

struct PlyHeader {
  PlyEncoding encoding = PlyEncoding::Ascii;
  std::vector<PlyElement> elements{};
  std::vector<std::string> textures{};  ///< Pictures that comments name, as MeshLab writes them.
  std::size_t body_offset = 0;          ///< First byte after end_header and its line end.
  std::size_t body_line = 1;            ///< Line number of that byte.
};

/// Whether any element has such a property.
bool has_role(const PlyHeader& header, PlyRole role);

/// Reads and checks the header. \throw FormatError
PlyHeader read_ply_header(std::string_view bytes, const ModelBuilder& builder);

}  // namespace vantage
