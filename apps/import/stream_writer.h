// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <vector>

#include "vantage/io/import_stream.h"

/// \file
/// Writes the stream of vantage/io/import_stream.h.

namespace vantage::importing {

/// What a whole file says of itself.
struct StreamHead {
  double unit_m = 0.0;             ///< 0: unknown.
  std::uint32_t up = kImportNoUp;  ///< As in the stream.
  bool up_is_stated = false;       ///< By the file itself.
  bool double_precision = false;   ///< Coordinates need it.
};

struct StreamMaterial {
  std::array<double, 4> colour{1.0, 1.0, 1.0, 1.0};  ///< Linear, and opacity.
  std::uint32_t picture = kImportNone;
  std::uint32_t wrap_u = 0;  ///< As in the stream.
  std::uint32_t wrap_v = 0;
};

/// One mesh, before it is sent.
struct StreamMesh {
  std::string name{};
  std::uint32_t material = kImportNone;
  bool same_part = false;
  std::vector<double> positions{};     ///< 3 a vertex.
  std::vector<float> colours{};        ///< 3 a vertex, or empty.
  std::vector<float> places{};         ///< 2 a vertex, or empty.
  std::vector<std::uint32_t> faces{};  ///< Corners of a face, then its vertices.
  std::uint64_t face_count = 0;

  /// Faces once they are cut into triangles.
  [[nodiscard]] std::uint64_t triangle_count() const;

  void add_triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    faces.insert(faces.end(), {3, a, b, c});
    ++face_count;
  }
};

/// Thrown before a mesh is sent that would make more faces or points than are wanted.
struct TooMany {
  bool points = false;
};

/// Sends records to a descriptor. Throws std::runtime_error where nobody listens.
class StreamWriter {
 public:
  /// \param most_faces of all meshes together, of which none needs more than three points; 0: no limit.
  StreamWriter(int descriptor, std::uint64_t most_faces)
      : descriptor_(descriptor), most_faces_(most_faces) {
    put(kImportMagic);
  }

  void head(const StreamHead& head);
  void note(std::string_view text);
  void picture(bool inside, std::string_view content);
  void material(const StreamMaterial& material);
  void mesh(const StreamMesh& mesh);  ///< \throw TooMany

  /// The last record, and everything out.
  void fail(std::string_view text);
  void fail(TooMany problem);
  void done();

 private:
  void count(const StreamMesh& mesh);
  void put(std::string_view bytes);
  void record(std::string_view tag, std::uint64_t size);
  void flush();

  template <class T>
  void number(T value) {
    auto raw = std::bit_cast<std::array<char, sizeof(T)>>(value);
    if constexpr (std::endian::native == std::endian::big) {
      std::reverse(raw.begin(), raw.end());
    }
    put({raw.data(), raw.size()});
  }

  template <class T>
  void numbers(const std::vector<T>& values) {
    for (const T value : values) {
      number(value);
    }
  }

  int descriptor_;
  std::string waiting_{};
  std::uint64_t most_faces_;
  std::uint64_t meshes_ = 0;
  std::uint64_t faces_ = 0;
  std::uint64_t points_ = 0;
};

}  // namespace vantage::importing
