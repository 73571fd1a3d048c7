// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "vantage/core/run_context.h"
#include "vantage/io/model.h"

/// \file
/// One reader per format, from bytes. Each throws FormatError or Cancelled, parse_gltf() also what its
/// BufferSource throws.

namespace vantage {

/// Bytes of a buffer; names of one file share them.
using SharedBytes = std::shared_ptr<const std::string>;

/// Gives the bytes of an external buffer named by a relative path, or throws IoError.
using BufferSource = std::function<SharedBytes(const std::string& relative_path)>;

/// A file beside the model that it can do without: its bytes, or why there are none.
struct SideFile {
  std::optional<std::string> bytes{};
  std::string problem{};  ///< Continues "NAME …".
};

/// Gives a file named by a relative path; does not throw.
using SideFileSource = std::function<SideFile(const std::string& relative_path)>;

/// Says whether there is such a file, without reading it.
using SideFileCheck = std::function<bool(const std::string& relative_path)>;

/// What a reader may ask for besides the bytes of the model.
struct Surroundings {
  BufferSource buffers{};         ///< Empty: there are none.
  SideFileSource side_files{};    ///< Material libraries and textures; empty: there are none.
  ReadOptions options{};          ///< What is wanted.
  SideFileCheck has_side_file{};  ///< Empty: there are none.
};

/// Wavefront OBJ: v (with colours), vt, f, g, o, and if materials are wanted usemtl and mtllib; the
/// rest does not shape the surface and is passed over.
Model parse_obj(std::string_view bytes, std::string_view name, const RunContext& run,
                const Surroundings& surroundings);

/// Geomview OFF with any of the prefixes ST C N 4 n, text or binary.
Model parse_off(std::string_view bytes, std::string_view name, const RunContext& run,
                const Surroundings& surroundings);

/// Stanford PLY, ascii or binary of either byte order; textures as MeshLab names them, if wanted.
Model parse_ply(std::string_view bytes, std::string_view name, const RunContext& run,
                const Surroundings& surroundings);

/// STL, text or binary, told apart by size and content.
Model parse_stl(std::string_view bytes, std::string_view name, const RunContext& run,
                const Surroundings& surroundings);

/// Point Cloud Data 0.5 to 0.7: ascii, binary or binary_compressed; x, y, z of whatever fields.
/// \param max_points see ReadOptions::max_faces.
Model parse_pcd(std::string_view bytes, std::string_view name, const RunContext& run,
                std::size_t max_points);

/// Lists of points, one a line, for .xyz, .pts and .pwn: the first three columns, or two and z = 0;
/// the rest (normals, colours) is passed over, and so is a heading.
Model parse_point_list(std::string_view bytes, std::string_view name, ModelFormat format,
                       const RunContext& run);

/// glTF 2.0 as JSON or as GLB.
Model parse_gltf(std::string_view bytes, std::string_view name, const RunContext& run,
                 const Surroundings& surroundings);

/// 3D Manufacturing Format: what is to be built, in the file's unit, with colours of materials.
Model parse_threemf(std::string_view bytes, std::string_view name, const RunContext& run,
                    const Surroundings& surroundings);

/// Additive Manufacturing File Format, as XML or in a ZIP archive: objects and constellations, in the
/// file's unit, with colours.
Model parse_amf(std::string_view bytes, std::string_view name, const RunContext& run,
                const Surroundings& surroundings);

/// What a ReadOptions::importer gave, see vantage/io/import_stream.h.
Model parse_import_stream(std::string_view stream, const ImportFormat& format,
                          std::string_view name, const RunContext& run,
                          const Surroundings& surroundings);

/// Whether a model is larger than ReadOptions::max_faces allows; 0: any size. Faces that share no points
/// have three each.
inline bool is_beyond_limit(std::size_t faces, std::size_t points, std::size_t most) {
  return most > 0 && (faces > most || points / 3 > most);
}

/// What is wrong with such a model, for a message.
inline std::string too_many_faces(std::size_t most, bool of_points) {
  return "has more than " + std::to_string(most) + (of_points ? " points" : " faces") +
         ", the most that --max-faces allows; decimate it, or allow more if there is the memory";
}

/// Whether the text starts with a header word of the OFF family.
bool has_off_header(std::string_view bytes);

}  // namespace vantage
