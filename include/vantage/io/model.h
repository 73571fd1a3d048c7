// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "vantage/core/image.h"
#include "vantage/core/run_context.h"
#include "vantage/core/vec3.h"
#include "vantage/io/import_stream.h"
#include "vantage/mesh/appearance.h"
#include "vantage/mesh/tri_mesh.h"

/// \file
/// Reading models. Vertex order is sacred: vertex i of the result is vertex i of the file (for
/// .stl the welded vertices in order of first appearance; for glTF the concatenated primitives in
/// world space, for 3MF and AMF the objects in the order in which they are built), because every per-vertex
/// result refers to it.
/// A model whose materials make every face invisible is read as opaque, with a note: older MeshLab
/// wrote `Tr 1.0` for what is opaque.

namespace vantage {

/// File formats that can be read. Imported: one of kImportFormats, by ReadOptions::importer.
enum class ModelFormat {
  Obj,
  Off,
  Ply,
  Stl,
  Gltf,
  Glb,
  Xyz,
  Pts,
  Pwn,
  Pcd,
  Threemf,
  Amf,
  Imported
};

/// How names of files end that are read without an importer: lower case, without the dot.
std::span<const std::string_view> model_endings();

/// Lower-case name as used in results, e.g. "obj".
std::string_view format_name(ModelFormat format);

/// A named run of triangles: an OBJ group or object, a solid of a text STL, a glTF node, an object of 3MF or AMF, a part
/// of an imported model.
struct ModelPart {
  std::string name{};              ///< As in the file.
  std::size_t first_triangle = 0;  ///< Index into the mesh's triangles.
  std::size_t triangle_count = 0;  ///< Triangles in a row.
};

/// What a file holds.
struct Model {
  std::string name{};                     ///< File name without folder and extension.
  std::string file_name{};                ///< With extension; empty if it is no file's.
  ModelFormat format = ModelFormat::Obj;  ///< What it was read as.
  TriMesh mesh{};                         ///< Polygons already triangulated. Faces may be absent.
  std::vector<Rgb8> vertex_colours{};     ///< |V| sRGB colours, or empty.
  bool colours_are_materials = false;     ///< `vertex_colours` are none but those of materials.
  std::vector<ModelPart> parts{};         ///< In file order; may be empty.
  Appearance appearance{};                ///< Materials, if asked for and there.
  bool double_precision = false;          ///< Coordinates carry more digits than float holds.
  std::size_t polygons = 0;               ///< Faces in the file before triangulation.
  std::size_t quads = 0;                  ///< Of these, with four corners.
  std::size_t larger_polygons = 0;        ///< Of these, with five or more corners.
  std::size_t skipped_faces = 0;          ///< Faces with fewer than three corners, left out.
  std::vector<std::string> notes{};       ///< What was read in an unusual way, one sentence each.
  std::string imported_as{};              ///< Of an imported one: "step", "fbx", …
  double unit_m = 0.0;                    ///< Metres of one unit, of an imported one; 0: unknown.
  std::optional<Vec3> usual_up{};         ///< Of this file; unset: that of its format.
  bool up_is_stated = false;  ///< `usual_up` is what the file says, or its format always is.
  /// By which `mesh` was turned after it was read: stand_along_axes().
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
};

/// Lower-case name of the format a model had.
std::string_view format_name(const Model& model);

/// What is wanted of a file besides its shape.
struct ReadOptions {
  /// Also materials and textures, which may be large. What cannot be had of them is left out, with a
  /// note: it is no reason to refuse the shape.
  bool appearance = false;
  /// Textures are looked at no closer than that many pixels on their longer side, so that large JPEGs
  /// may be read at a half, a quarter or an eighth; 0: always whole.
  int texture_side = 0;
  /// A model of more triangles, or thrice as many vertices, or without triangles of more points, is
  /// refused; 0: none is. Instances of a file are counted before they are made.
  std::size_t max_faces = 0;
  /// Reads formats that the library does not read itself; empty: they are refused.
  ModelImporter importer{};
};

/// Parses the bytes of a model.
/// \param bytes  the whole file. \param name shown in messages; its extension picks the format
///               unless the bytes plainly say otherwise (magic numbers win, with a note).
/// \throw FormatError with file, place, problem and remedy.
/// \throw Cancelled
Model parse_model(std::string_view bytes, std::string_view name, const RunContext& run = {},
                  const ReadOptions& options = {});

/// Reads a model from disk; it may name buffers, material libraries and textures in its own folder,
/// and nowhere else.
/// \param path a file, or "-" for standard input.
/// \throw IoError, FormatError, Cancelled
Model load_model(const std::string& path, const RunContext& run = {},
                 const ReadOptions& options = {});

/// A file beside a model that the model's reader opens.
struct FileBeside {
  std::string name{};  ///< Relative to the model's folder, as the reader understands the model.
  /// Where it is, links resolved: in the model's folder, or below. Empty: nowhere.
  std::string path{};
};

/// Finds the files that a model consists of besides its own, while its bytes pass by: buffers and
/// pictures of a glTF, material libraries of an OBJ and the pictures that these and a PLY name. They are
/// found as load_model() finds them, which goes by the bytes first and by the name's extension else.
class FilesBeside {
 public:
  explicit FilesBeside(std::string model_path);

  /// The model's next bytes.
  void pass(std::string_view bytes);

  /// Call once all bytes have passed. \return the format that a ReadOptions::importer has to read the model
  /// as; null if none has to.
  const ImportFormat* import_as();

  /// Names pictures of an imported model, see pictures_beside().
  void add_pictures(std::vector<std::string> names) { pictures_ = std::move(names); }

  /// Call once all bytes have passed. \return the files, each once, in an order that the files' contents
  /// say, and those that would be read if they were there.
  std::vector<FileBeside> find();

 private:
  void tell_format();
  void keep(std::string_view bytes);
  void keep_libraries(std::string_view bytes);
  void keep_json_of_glb(std::string_view bytes);

  std::string model_path_;
  std::string begin_{};  ///< What has passed while the format is not told.
  bool is_told_ = false;
  std::optional<ModelFormat> format_{};  ///< Nothing: none that is read.
  const ImportFormat* import_as_ = nullptr;
  std::vector<std::string> pictures_{};
  std::string text_{};    ///< A glTF's JSON, a PLY's start, an OBJ's lines that name libraries.
  std::string line_{};    ///< Of an OBJ: what has passed of the current line, as far as it matters.
  bool skips_ = false;    ///< The rest of the line does not matter.
  bool goes_on_ = false;  ///< The line before ends with \, so this one belongs to it.
};

/// Reads points or directions from CSV text: one a line, numbers with a decimal point, separated
/// by commas (blanks around them do not matter). Empty lines and lines that start with # are
/// passed over. If the first line is a header, `columns` are looked up in it and other columns
/// are ignored; without a header the first three columns count.
/// \param name shown in messages. \param columns e.g. {"dx", "dy", "dz"}.
/// \throw FormatError naming the line.
std::vector<Vec3> parse_points_csv(std::string_view bytes, std::string_view name,
                                   std::array<std::string_view, 3> columns);

/// The same of directions, made unit vectors: the zero vector is none.
std::vector<Vec3> parse_directions_csv(std::string_view bytes, std::string_view name,
                                       std::array<std::string_view, 3> columns);

/// The note of a model whose materials were made opaque.
inline constexpr const char* kMadeOpaque =
    "by its materials no face can be seen at all; it is shown as opaque";

/// Makes all materials opaque if every face is invisible by its own. \return whether it did.
/// \pre indices and textures fit each other.
/// \complexity linear in the faces before the first visible one.
bool make_visible(Appearance& appearance);

/// Memory that this process may use, bytes: of the machine, or what its control groups leave it.
std::uint64_t usable_memory_bytes();

/// Faces that so much memory has room for, with all that a view computes of them: two digits and
/// zeros, so that like machines say the same; at least 100 000.
std::size_t faces_that_fit(std::uint64_t memory_bytes);

}  // namespace vantage
