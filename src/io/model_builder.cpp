// SPDX-License-Identifier: MIT
#include "io/model_builder.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "vantage/core/error.h"

#include "io/readers.h"
#include "mesh/copied_polygons.h"
#include "mesh/extent.h"
#include "mesh/polygon.h"

namespace vantage {
namespace {

/// Vertex indices are 32 bits wide and the highest value is kept free.
constexpr std::uint64_t kMostVertices = std::numeric_limits<std::uint32_t>::max() - 1;
/// So are indices of the three sides of all triangles.
constexpr std::size_t kMostTriangles = std::numeric_limits<std::uint32_t>::max() / 3;

}  // namespace

std::uint8_t colour_byte(double value) {
  return static_cast<std::uint8_t>(std::lround(255.0 * (value > 0.0 ? std::min(value, 1.0) : 0.0)));
}

ModelBuilder::ModelBuilder(ModelFormat format, std::string_view name, const RunContext& run,
                           std::uint64_t first_index)
    : name_(name), run_(run), first_index_(first_index) {
  model_.format = format;
}

void ModelBuilder::fail(Place place, std::string_view problem) const {
  throw FormatError(name_, place.text(), problem);
}

void ModelBuilder::fail(std::string_view problem) const {
  throw FormatError(name_, "", problem);
}

void ModelBuilder::add_point(const Vec3& point, Place place) {
  if (!point.allFinite()) {
    fail(place, "a coordinate is not a finite number");
  }
  if (point.cwiseAbs().maxCoeff() > kLargestCoordinate) {
    fail(place, "a coordinate is beyond 1e60; rescale the model");
  }
  if (point_count() == kMostVertices) {
    fail(place, "more than 4294967294 vertices");
  }
  model_.mesh.positions.push_back(point);
}

bool ModelBuilder::add_point_unless_missing(const Vec3& point, Place place) {
  if (point.hasNaN()) {
    ++missing_points_;
    return false;
  }
  add_point(point, place);
  return true;
}

void ModelBuilder::add_corner(std::uint64_t vertex, Place place) {
  if (vertex >= kMostVertices) {
    fail(place,
         "face names vertex " + std::to_string(vertex + first_index_) + ", which no file can hold");
  }
  const auto index = static_cast<std::uint32_t>(vertex);
  if (open_corners_ == 0 || index > open_highest_.vertex) {
    open_highest_ = {index, place};
  }
  corners_.push_back(index);
  ++open_corners_;
}

void ModelBuilder::keep_appearance(bool of_vertices) {
  keeps_appearance_ = true;
  uvs_are_of_vertices_ = of_vertices;
}

void ModelBuilder::begin_material(std::uint32_t material) {
  if (!material_starts_.empty() && material_starts_.back().first_polygon == corner_counts_.size()) {
    material_starts_.back().material = material;
  } else {
    material_starts_.push_back({material, corner_counts_.size()});
  }
}

void ModelBuilder::add_uv(double u, double v) {
  const auto finite = [](double value) {
    const auto narrow = static_cast<float>(value);
    return std::isfinite(narrow) ? narrow : 0.0F;
  };
  model_.appearance.uvs.push_back({finite(u), finite(v)});
}

void ModelBuilder::set_corner_uv(std::uint64_t uv) {
  if (!corners_.empty() && uv < Appearance::kNone) {
    corner_uvs_.resize(corners_.size(), Appearance::kNone);
    corner_uvs_.back() = static_cast<std::uint32_t>(uv);
  }
}

void ModelBuilder::set_materials(std::vector<Material> materials, std::vector<Texture> textures) {
  model_.appearance.materials = std::move(materials);
  model_.appearance.textures = std::move(textures);
}

void ModelBuilder::end_polygon() {
  const std::uint32_t count = std::exchange(open_corners_, 0);
  if (count < 3) {
    corners_.resize(corners_.size() - count);
    corner_uvs_.resize(std::min(corner_uvs_.size(), corners_.size()));
    ++model_.skipped_faces;
    return;
  }
  if (corner_counts_.empty() || open_highest_.vertex > highest_.vertex) {
    highest_ = open_highest_;
  }
  corner_counts_.push_back(count);
  ++model_.polygons;
  model_.quads += count == 4 ? 1 : 0;
  model_.larger_polygons += count > 4 ? 1 : 0;
  check_counts(corners_.size() - 2 * corner_counts_.size(), 0);  // each polygon has two less
}

void ModelBuilder::add_triangle(std::uint64_t a, std::uint64_t b, std::uint64_t c, Place place) {
  add_corner(a, place);
  add_corner(b, place);
  add_corner(c, place);
  end_polygon();
}

void ModelBuilder::add_strip(const std::vector<std::uint64_t>& strip, Place place) {
  for (std::size_t i = 2; i < strip.size(); ++i) {
    const std::uint64_t a = strip[i - 2];
    const std::uint64_t b = strip[i - 1];
    const std::uint64_t c = strip[i];
    if (a == b || b == c || c == a) {
      continue;
    }
    i % 2 == 0 ? add_triangle(a, b, c, place) : add_triangle(b, a, c, place);
  }
}

void ModelBuilder::add_colour(double red, double green, double blue) {
  colours_.push_back(
      {static_cast<float>(red), static_cast<float>(green), static_cast<float>(blue)});
}

void ModelBuilder::begin_part(std::string_view part_name) {
  if (!part_starts_.empty() && part_starts_.back().first_polygon == corner_counts_.size()) {
    part_starts_.back().name = part_name;
  } else {
    part_starts_.push_back({std::string(part_name), corner_counts_.size()});
  }
}

void ModelBuilder::advance(std::size_t done_bytes, std::size_t all_bytes) {
  constexpr std::size_t kTicksPerReport = 1 << 14;
  constexpr double kShareOfParsing = 0.8;  // the rest is triangulation and checks
  if (++ticks_ % kTicksPerReport == 0) {
    run_.advance("read", kShareOfParsing * static_cast<double>(done_bytes) /
                             static_cast<double>(std::max<std::size_t>(all_bytes, 1)));
  }
}

void ModelBuilder::check_counts(std::size_t faces, std::size_t points) const {
  if (is_beyond_limit(faces, points, most_faces_)) {
    fail(too_many_faces(most_faces_, faces <= most_faces_));
  }
}

void ModelBuilder::check_indices() const {
  if (!corners_.empty() && highest_.vertex >= point_count()) {
    fail(highest_.place, "face names vertex " + std::to_string(highest_.vertex + first_index_) +
                             ", but the file has " + std::to_string(point_count()) +
                             " vertices, counted from " + std::to_string(first_index_));
  }
}

void ModelBuilder::check_extent() const {
  if (const std::string problem = extent_problem(model_.mesh.positions); !problem.empty()) {
    fail("the model " + problem);
  }
}

void ModelBuilder::triangulate() {
  std::vector<std::size_t> triangle_of_part_start;
  std::size_t next_part = 0;
  std::size_t next_material = 0;
  std::uint32_t material = Appearance::kNone;
  std::size_t first_corner = 0;
  std::vector<Triangle>& triangles = model_.mesh.triangles;
  const std::size_t count = corners_.size() - 2 * corner_counts_.size();
  if (count > kMostTriangles) {
    fail("more than " + std::to_string(kMostTriangles) + " triangles");
  }
  triangles.reserve(count);
  if (!corner_uvs_.empty()) {
    corner_uvs_.resize(corners_.size(), Appearance::kNone);
    model_.appearance.uv_of_triangle.reserve(triangles.capacity());
  }
  const auto mark_parts = [&](std::size_t polygon) {
    if (next_part < part_starts_.size() && part_starts_[next_part].first_polygon == polygon) {
      triangle_of_part_start.push_back(triangles.size());
      ++next_part;
    }
  };
  PolygonWork work(run_);
  const std::vector<CopiedPolygon> copies =
      copied_polygons(corners_, corner_counts_, model_.mesh.positions);
  std::size_t next_copy = 0;
  for (std::size_t p = 0; p < corner_counts_.size(); ++p) {
    mark_parts(p);
    const std::size_t first_triangle = triangles.size();
    const std::span<const std::uint32_t> corners{corners_.data() + first_corner, corner_counts_[p]};
    if (next_copy < copies.size() && copies[next_copy].polygon == p) {
      triangulate_copy(corners, copies[next_copy++], work);
    } else {
      triangulate_polygon(corners, model_.mesh.positions, work, triangles);
    }
    triangulate_uvs(first_corner, corner_counts_[p], first_triangle);
    if (keeps_appearance_) {
      const bool next = next_material < material_starts_.size() &&
                        material_starts_[next_material].first_polygon == p;
      material = next ? material_starts_[next_material++].material : material;
      model_.appearance.material_of_triangle.resize(triangles.size(), material);
    }
    first_corner += corner_counts_[p];
  }
  mark_parts(corner_counts_.size());
  finish_parts(triangle_of_part_start);
}

void ModelBuilder::triangulate_copy(std::span<const std::uint32_t> corners,
                                    const CopiedPolygon& copy, PolygonWork& work) {
  std::vector<std::uint32_t> as_earlier(corners.begin(), corners.end());
  std::rotate(as_earlier.begin(), as_earlier.begin() + copy.start, as_earlier.end());
  if (copy.is_reversed) {
    std::reverse(as_earlier.begin() + 1, as_earlier.end());
  }
  std::vector<Triangle>& triangles = model_.mesh.triangles;
  const auto first_triangle = static_cast<std::ptrdiff_t>(triangles.size());
  triangulate_polygon(as_earlier, model_.mesh.positions, work, triangles);
  if (copy.is_reversed) {
    std::for_each(triangles.begin() + first_triangle, triangles.end(),
                  [](Triangle& t) { std::swap(t[1], t[2]); });
  }
}

void ModelBuilder::triangulate_uvs(std::size_t first_corner, std::size_t count,
                                   std::size_t first_triangle) {
  if (corner_uvs_.empty()) {
    return;
  }
  // Triangles name vertices, not corners. A polygon that meets a vertex twice takes its first uv.
  std::vector<std::array<std::uint32_t, 2>> uv_of_vertex;
  for (std::size_t c = first_corner; c < first_corner + count; ++c) {
    const std::uint32_t uv = corner_uvs_[c];
    uv_of_vertex.push_back({corners_[c], uv < uv_count() ? uv : Appearance::kNone});
  }
  const auto by_vertex = [](const auto& a, const auto& b) { return a[0] < b[0]; };
  std::stable_sort(uv_of_vertex.begin(), uv_of_vertex.end(), by_vertex);
  const std::vector<Triangle>& triangles = model_.mesh.triangles;
  for (std::size_t t = first_triangle; t < triangles.size(); ++t) {
    Triangle uvs{};
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const std::array<std::uint32_t, 2> key{triangles[t][corner], 0};
      uvs[corner] =
          (*std::lower_bound(uv_of_vertex.begin(), uv_of_vertex.end(), key, by_vertex))[1];
    }
    model_.appearance.uv_of_triangle.push_back(uvs);
  }
}

void ModelBuilder::finish_appearance() {
  Appearance& appearance = model_.appearance;
  if (appearance.materials.empty()) {
    appearance.material_of_triangle.clear();
  }
  const bool complete = uvs_are_of_vertices_ && uv_count() == point_count();
  if (complete) {
    appearance.uv_of_triangle = model_.mesh.triangles;
  }
  if (appearance.uv_of_triangle.empty()) {
    appearance.uvs.clear();
  }
}

void ModelBuilder::finish_parts(const std::vector<std::size_t>& triangle_of_part_start) {
  for (std::size_t i = 0; i < part_starts_.size(); ++i) {
    const std::size_t first = triangle_of_part_start[i];
    const std::size_t end =
        i + 1 < part_starts_.size() ? triangle_of_part_start[i + 1] : model_.mesh.triangles.size();
    if (end > first) {
      model_.parts.push_back({std::move(part_starts_[i].name), first, end - first});
    }
  }
}

bool ModelBuilder::colours_are_bytes() const {
  // HDR colours may pass 1: few of these values are above 2. Bytes are whole, and where a scanner writes
  // fractions of them, most are above 2. Bytes whose largest is 2 are black anyway.
  constexpr float kLargestOfUnitRange = 2.0F;
  bool are_whole = true;
  std::size_t above = 0;
  std::size_t below = 0;
  for (const ColourValue& c : colours_) {
    for (const float value : {c.red, c.green, c.blue}) {
      are_whole = are_whole && !(value - std::floor(value) > 0.0F);  // NaN is 0
      above += value > kLargestOfUnitRange ? 1 : 0;
      below += value > 0.0F && value <= kLargestOfUnitRange ? 1 : 0;
    }
  }
  return above > 0 && (are_whole || above > below);
}

void ModelBuilder::finish_colours() {
  if (colours_.empty()) {
    return;
  }
  if (colours_.size() != point_count()) {
    note("only " + std::to_string(colours_.size()) + " of " + std::to_string(point_count()) +
         " vertices have a colour, so that colours were left out");
    return;
  }
  const double scale = colours_are_bytes() ? 1.0 / 255.0 : 1.0;
  model_.vertex_colours.reserve(colours_.size());
  for (const ColourValue& c : colours_) {
    model_.vertex_colours.push_back({colour_byte(scale * static_cast<double>(c.red)),
                                     colour_byte(scale * static_cast<double>(c.green)),
                                     colour_byte(scale * static_cast<double>(c.blue))});
  }
}

void ModelBuilder::finish_notes() {
  if (model_.skipped_faces > 0) {
    note("faces with fewer than three corners left out: " + std::to_string(model_.skipped_faces));
  }
}

Model ModelBuilder::finish() {
  if (missing_points_ > 0) {
    note("points without a position (NaN) left out: " + std::to_string(missing_points_));
  }
  check_indices();
  if (model_.mesh.positions.empty()) {
    // What was passed over may be why.
    fail("holds neither faces nor points" +
         (model_.notes.empty() ? "" : "; " + model_.notes.front()));
  }
  check_extent();
  triangulate();
  finish_appearance();
  finish_colours();
  finish_notes();
  run_.advance("read", 1.0);
  return std::move(model_);
}

}  // namespace vantage
