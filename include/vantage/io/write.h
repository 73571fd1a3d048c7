// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "vantage/core/camera.h"
#include "vantage/core/image.h"
#include "vantage/core/vec3.h"
#include "vantage/io/model.h"
#include "vantage/mesh/curve_graph.h"
#include "vantage/mesh/tri_mesh.h"

/// \file
/// Writers give bytes; write_file() puts them on disk before they have a name, so that a failed run
/// leaves no half-written file.
/// Models turned by quarter turns about their axes, with all else as it is.

namespace vantage {

/// Writes all of `bytes` to `path` ("-": standard output), whole or not at all, in place of the file,
/// link or pipe that is there: a link is never written through. A device is written to.
/// \throw IoError
void write_file(const std::string& path, std::string_view bytes);

/// The same under a name that the user gave: links are followed and pipes written to. \throw IoError
void write_named_file(const std::string& path, std::string_view bytes);

/// The bytes in base64 (RFC 4648, section 4), padded, without line breaks.
std::string base64(std::string_view bytes);

/// Binary little-endian PLY of a map: x y z, quality (float), red green blue, triangles.
/// \param double_precision positions as double instead of float.
/// \param quality |V| finite values, or empty to leave the property out. \param colours |V|, or empty.
/// \throw InvalidInput if one is there in another number, or a value is not finite
std::string ply_bytes(const TriMesh& mesh, std::span<const double> quality,
                      std::span<const Rgb8> colours, bool double_precision);

/// A skeleton as written to files.
struct SkeletonFile {
  const CurveGraph* graph = nullptr;            ///< Required.
  std::span<const double> radius{};             ///< |N|; may be empty.
  std::span<const std::int64_t> vertex_node{};  ///< Node of each input vertex, −1 if isolated.
};

/// nodes, edges, radius, vertex_node, degree, branches, length.
std::string skeleton_json(const SkeletonFile& skeleton);
/// SWC: a forest of rows `id type x y z radius parent`, type 5 for junctions, 6 for ends, 0 else.
/// The format has no loops: each is cut at the edge where two shortest ways from the root meet, and
/// a comment names the edge.
std::string skeleton_swc(const SkeletonFile& skeleton);
/// GraphML: nodes with x, y, z and radius, edges with length.
std::string skeleton_graphml(const SkeletonFile& skeleton);
std::string skeleton_obj(const CurveGraph& graph);  ///< v and l lines.
std::string skeleton_ply(const CurveGraph& graph);  ///< vertices and edges, ASCII.

/// PNG, 8 bit RGBA. \throw InvalidInput unless there is a pixel and four values for each; IoError if libpng fails
std::string png_bytes(const Image& image);
/// PNG, 16 bit RGBA. \throw InvalidInput, IoError likewise
std::string png_bytes(const DeepImage& image);

/// WebP: colour at quality 90 of 100, alpha without loss; a third of the size of the PNG.
/// \throw InvalidInput for a side that the format cannot hold (16383 px). \throw IoError
std::string webp_bytes(const Image& image);

/// Formats of moving pictures.
enum class AnimationFormat {
  Apng,  ///< Lossless, 8 bit RGBA; programs that know no APNG show the first frame.
  WebP,  ///< Lossy colour, lossless alpha, a tenth of the size.
};

/// Encodes the frames of an endless loop one by one, so that only one need be kept.
class AnimationEncoder {
 public:
  /// \param frame_count of frames that will follow, ≥ 1. \param fps frames a second, 1–60.
  /// \throw InvalidInput also for sides that the format cannot hold (WebP: 16383 px).
  AnimationEncoder(AnimationFormat format, int width, int height, int frame_count, int fps);
  ~AnimationEncoder();
  AnimationEncoder(AnimationEncoder&&) noexcept;             ///< Leaves the other unusable.
  AnimationEncoder& operator=(AnimationEncoder&&) noexcept;  ///< The same.

  /// Adds the next frame. \throw InvalidInput if its size differs. \throw IoError
  void add(const Image& frame);

  /// The whole file. \pre all frames were added. \throw InvalidInput, IoError
  std::string finish();

  /// What an encoder of one format does; private to the library.
  class Implementation;

 private:
  std::unique_ptr<Implementation> implementation_;
};

/// Shortest decimal text that reads back as the same double; "null" if not finite (JSON).
std::string number_text(double value);

/// Bytes on the disk that have no name yet, so that several files can take their places in one short
/// moment. A process that is killed before leaves nothing behind where the file system knows files
/// without a name (O_TMPFILE), else one named ".NAME.part.PROCESS".
class StagedFile {
 public:
  /// Writes the bytes in the folder of `path`. \throw IoError
  StagedFile(std::string path, std::string_view bytes);
  /// Drops what was not placed.
  ~StagedFile();
  StagedFile(StagedFile&& other) noexcept;
  StagedFile& operator=(StagedFile&& other) noexcept;

  /// Gives it its name, in place of the file, link or pipe that has it. Call once. \throw IoError
  void place();

  [[nodiscard]] const std::string& path() const { return path_; }  ///< Where place() puts it.

 private:
  /// \return whether the file system knows files without a name. \throw IoError
  bool write_nameless(std::string_view bytes);
  /// \throw IoError
  void write_temporary(std::string_view bytes);
  void drop() noexcept;

  std::string path_;
  std::string temporary_{};  ///< Its name until it is placed; empty: it has none.
  int descriptor_ = -1;      ///< Of a file without a name.
};

/// A rotation that takes each coordinate axis to another, or to its opposite: exact.
struct AxisTurn {
  std::array<std::size_t, 3> from{0, 1, 2};          ///< Coordinate i of the result is this one …
  std::array<bool, 3> negated{false, false, false};  ///< … or its negative.

  /// The turn that takes the first pair of directions to the second. \pre each pair are two
  /// coordinate axes or their opposites, at right angles.
  AxisTurn(const Vec3& up, const Vec3& front, const Vec3& new_up, const Vec3& new_front);

  [[nodiscard]] bool is_none() const;                      ///< Nothing is turned.
  [[nodiscard]] Vec3 operator()(const Vec3& p) const;      ///< The turned point.
  [[nodiscard]] std::array<double, 4> quaternion() const;  ///< x, y, z, w; unit.
};

/// The bytes of an OBJ, STL, glTF or GLB with its shape turned; whatever else it holds stays. Numbers
/// of text files change their place and sign alone. A glTF gets a node above each node of its
/// scenes.
/// \param format as parse_model() found it. \param name shown in messages.
/// \throw FormatError; InvalidInput for other formats.
std::string turned_bytes(std::string_view bytes, std::string_view name, ModelFormat format,
                         const AxisTurn& turn);

}  // namespace vantage
