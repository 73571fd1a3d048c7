// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

/// \file
/// How STL files are laid out, for what reads them and what turns them.

namespace vantage {

inline constexpr std::size_t kStlHeader = 80;    ///< bytes
inline constexpr std::size_t kStlPreamble = 84;  ///< bytes: header and number of triangles
inline constexpr std::size_t kStlTriangle = 50;  ///< bytes: normal, three corners, two more

/// The number of triangles that a binary STL says it has. \pre at least kStlPreamble bytes
std::uint64_t stl_triangle_count(std::string_view bytes);

/// The number of triangles that the bytes after the preamble have room for. \pre as above
std::size_t held_stl_triangles(std::string_view bytes);

/// The number of triangles to read: the declared one, or, if that is 0, as programs leave it that write
/// triangles as they come, what there is room for. \pre as above
std::size_t stl_triangles_to_read(std::string_view bytes);

/// Whether the bytes are a binary STL by their size: 84 bytes and 50 for each declared triangle.
bool has_binary_stl_size(std::string_view bytes);

/// Whether the first bytes are text: no zeros or other control characters.
bool has_text_begin(std::string_view bytes);

/// Whether the bytes are a text STL: the first word, behind comments, is `solid`, and what follows is
/// text. A binary header may begin with that word too, but zeros or other control characters follow
/// soon, also where the file is cut short.
bool is_text_stl(std::string_view bytes);

}  // namespace vantage
