// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace vantage {

/// An attribute that is wanted of a packed mesh, and as which numbers.
struct DracoAttribute {
  std::uint32_t id = 0;        ///< As Draco knows it.
  int component_type = 0;      ///< One of glTF's: 5120 byte … 5126 float.
  std::size_t components = 0;  ///< Numbers an element, 1 to 4.
};

/// What Draco's bytes hold.
struct DracoMesh {
  std::size_t points = 0;                 ///< Elements of each attribute.
  std::string corners{};                  ///< Three 32-bit little-endian point numbers a face.
  std::vector<std::string> attributes{};  ///< Little-endian, packed, in the order of the wishes.
  std::string problem{};  ///< Why there is nothing, continuing "the packed mesh …"; else empty.
};

/// Unpacks a mesh of Draco's bitstream 2.2, which is glTF's. Memory is bounded before anything is
/// made: a few bytes can claim to hold billions of faces.
/// \param most_bytes of the corners, and of all attributes together.
DracoMesh unpack_draco(std::string_view bytes, const std::vector<DracoAttribute>& wanted,
                       std::size_t most_bytes);

}  // namespace vantage
