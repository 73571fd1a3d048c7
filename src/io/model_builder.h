// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "vantage/core/run_context.h"
#include "vantage/io/model.h"

#include "io/place.h"

namespace vantage {

class PolygonWork;
struct CopiedPolygon;

/// Collects what a reader finds, checks it, and makes the Model. Memory grows with what was added,
/// never with what a header declares.
class ModelBuilder {
 public:
  /// \param first_index what the format calls its first vertex, for messages: 0 or 1.
  ModelBuilder(ModelFormat format, std::string_view name, const RunContext& run,
               std::uint64_t first_index);

  /// Adds a vertex. \throw FormatError if it is not finite or beyond kLargestCoordinate.
  void add_point(const Vec3& point, Place place);

  /// The same of a point of a cloud; one that a sensor marked as missing with NaN is counted instead.
  /// \return whether it was added
  bool add_point_unless_missing(const Vec3& point, Place place);

  /// Adds a corner (vertex counted from 0) to the polygon being built.
  void add_corner(std::uint64_t vertex, Place place);

  /// Ends the polygon; one with fewer than three corners is left out and counted.
  void end_polygon();

  void add_triangle(std::uint64_t a, std::uint64_t b, std::uint64_t c, Place place);

  /// Adds the triangles of a strip of vertices (odd ones turned, those that name a vertex twice
  /// left out: they only join strips).
  void add_strip(const std::vector<std::uint64_t>& strip, Place place);

  /// Adds a colour, 0..1 or 0..255 for each channel: which, is settled by all of them.
  void add_colour(double red, double green, double blue);

  /// What follows belongs to a part of this name; a part without faces disappears.
  void begin_part(std::string_view part_name);

  /// Whether the next face begins a part that has a name.
  [[nodiscard]] bool has_name_for_next_face() const {
    return !part_starts_.empty() && part_starts_.back().first_polygon == corner_counts_.size() &&
           !part_starts_.back().name.empty();
  }

  /// From here on what faces look like is kept too. \param of_vertices the coordinates on textures
  /// are those of the vertices, one for each; else those of corners, see set_corner_uv().
  void keep_appearance(bool of_vertices);

  [[nodiscard]] bool keeps_appearance() const { return keeps_appearance_; }

  /// What follows is of this material, an index into those of set_materials() or Appearance::kNone.
  void begin_material(std::uint32_t material);

  /// Adds coordinates on textures; what is not finite becomes 0.
  void add_uv(double u, double v);

  /// The last corner that was added has these coordinates, counted from 0. Those that do not exist
  /// in the end count as none.
  void set_corner_uv(std::uint64_t uv);

  void set_materials(std::vector<Material> materials, std::vector<Texture> textures);

  [[nodiscard]] std::size_t uv_count() const { return model_.appearance.uvs.size(); }

  void note(std::string text) { model_.notes.push_back(std::move(text)); }

  void coordinates_need_double() { model_.double_precision = true; }

  [[nodiscard]] bool double_precision() const { return model_.double_precision; }

  [[nodiscard]] std::size_t point_count() const { return model_.mesh.positions.size(); }

  /// Of faces so far, those left out too.
  [[nodiscard]] std::size_t face_count() const {
    return corner_counts_.size() + model_.skipped_faces;
  }

  [[nodiscard]] std::size_t missing_points() const { return missing_points_; }

  [[nodiscard]] std::size_t colour_count() const { return colours_.size(); }

  [[nodiscard]] std::string_view name() const { return name_; }

  [[nodiscard]] const RunContext& run() const { return run_; }

  void reserve_points(std::size_t count) { model_.mesh.positions.reserve(count); }

  /// Reports progress now and then. \throw Cancelled
  void advance(std::size_t done_bytes, std::size_t all_bytes);

  /// From here on a model that has more faces is refused as soon as it has them. \param most see
  /// ReadOptions::max_faces.
  void limit_faces(std::size_t most) { most_faces_ = most; }

  /// \throw FormatError if a model of that many is refused; call before they are read.
  void check_counts(std::size_t faces, std::size_t points) const;

  [[noreturn]] void fail(Place place, std::string_view problem) const;
  [[noreturn]] void fail(std::string_view problem) const;

  /// The finished model. \throw FormatError if a face names a vertex that is not there, if nothing can
  /// be computed with the extent (extent_problem()), or if there are neither faces nor points.
  Model finish();

 private:
  struct ColourValue {
    float red, green, blue;
  };

  struct PartStart {
    std::string name;
    std::size_t first_polygon;
  };

  /// A vertex and where a face names it.
  struct NamedVertex {
    std::uint32_t vertex = 0;
    Place place{};
  };

  void check_indices() const;
  void check_extent() const;
  void triangulate();

  /// Into the triangles of the earlier polygon, so that its faces are known for copies.
  void triangulate_copy(std::span<const std::uint32_t> corners, const CopiedPolygon& copy,
                        PolygonWork& work);
  void finish_parts(const std::vector<std::size_t>& triangle_of_part_start);
  void triangulate_uvs(std::size_t first_corner, std::size_t count, std::size_t first_triangle);
  void finish_appearance();
  [[nodiscard]] bool colours_are_bytes() const;
  void finish_colours();
  void finish_notes();

  std::string name_;
  const RunContext& run_;
  std::uint64_t first_index_;
  Model model_{};
  std::vector<std::uint32_t> corners_{};        ///< Of all polygons, one after the other.
  std::vector<std::uint32_t> corner_counts_{};  ///< Of each polygon.
  std::uint32_t open_corners_ = 0;              ///< Of the polygon being built.
  NamedVertex highest_{};                       ///< The highest vertex of all polygons.
  NamedVertex open_highest_{};                  ///< Of the polygon being built.
  std::size_t missing_points_ = 0;
  std::vector<ColourValue> colours_{};
  std::vector<PartStart> part_starts_{};

  struct MaterialStart {
    std::uint32_t material;
    std::size_t first_polygon;
  };

  bool keeps_appearance_ = false;
  bool uvs_are_of_vertices_ = false;
  std::vector<MaterialStart> material_starts_{};
  std::vector<std::uint32_t> corner_uvs_{};  ///< Beside corners_, if they have their own.
  std::size_t ticks_ = 0;
  std::size_t most_faces_ = 0;  ///< 0: any number.
};

/// sRGB byte of a value in [0, 1]; outside values are clamped, NaN is 0.
std::uint8_t colour_byte(double value);

}  // namespace vantage
