// SPDX-License-Identifier: MIT
#include "orientation/height_fields.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include <Eigen/Geometry>

#include "vantage/mesh/measures.h"

#include "core/cross.h"
#include "mesh/copied_faces.h"

namespace vantage {
namespace {

// Cells along the longest side: a chair's leg is one or two of them. [ours]
constexpr double kCells = 64.0;
// cos of 80 degrees.
constexpr double kPerpendicular = 0.174;
// What is nearer to the border of two cells than this share of a cell belongs to both, so that a
// mirrored surface has the mirrored field.
constexpr double kBorder = 1e-6;
// Surfaces this near to each other are the two sides of a sheet, over the longest side.
constexpr float kSheet = 1e-5F;

struct CellRange {
  std::size_t first;
  std::size_t last;
};

CellRange cells_at(double place, std::size_t count) {
  const double most = static_cast<double>(count - 1);
  return {static_cast<std::size_t>(std::clamp(std::floor(place - kBorder), 0.0, most)),
          static_cast<std::size_t>(std::clamp(std::floor(place + kBorder), 0.0, most))};
}

/// Draws points, edges and faces into one field.
class FieldPainter {
 public:
  FieldPainter(HeightField& field, const std::array<double, 3>& extent)
      : field_(field),
        u_scale_(scale(field.columns, extent[field.u_axis])),
        v_scale_(scale(field.rows, extent[field.v_axis])),
        low_face_(field.low),
        high_face_(field.high) {}

  void point(const Vec3& p) {
    const CellRange u = cells_at(p[at(field_.u_axis)] * u_scale_, field_.columns);
    const CellRange v = cells_at(p[at(field_.v_axis)] * v_scale_, field_.rows);
    for (std::size_t row = v.first; row <= v.last; ++row) {
      for (std::size_t column = u.first; column <= u.last; ++column) {
        put(row, column, p[at(field_.axis)], std::nullopt);
      }
    }
  }

  /// Cells whose centre is in the face's projection.
  void face(const std::array<Vec3, 3>& corners) {
    std::array<Eigen::Vector2d, 3> flat;
    for (std::size_t i = 0; i < 3; ++i) {
      flat[i] = {corners[i][at(field_.u_axis)] * u_scale_ - 0.5,
                 corners[i][at(field_.v_axis)] * v_scale_ - 0.5};
    }
    const Eigen::Vector2d low = flat[0].cwiseMin(flat[1]).cwiseMin(flat[2]);
    const Eigen::Vector2d high = flat[0].cwiseMax(flat[1]).cwiseMax(flat[2]);
    const double twice = cross(flat[1] - flat[0], flat[2] - flat[0]);
    if (std::abs(twice) < 1e-9) {
      return;  // its edges show it
    }
    const Eigen::Vector2d last(static_cast<double>(field_.columns - 1),
                               static_cast<double>(field_.rows - 1));
    for (double row = std::max(0.0, std::ceil(low.y())); row <= std::min(last.y(), high.y());
         row += 1.0) {
      for (double column = std::max(0.0, std::ceil(low.x()));
           column <= std::min(last.x(), high.x()); column += 1.0) {
        const Eigen::Vector2d here(column, row);
        std::array<double, 3> share{};
        for (std::size_t i = 0; i < 3; ++i) {
          share[i] = cross(flat[(i + 1) % 3] - here, flat[(i + 2) % 3] - here) / twice;
        }
        if (std::min({share[0], share[1], share[2]}) < -1e-9) {
          continue;
        }
        double height = 0.0;
        for (std::size_t i = 0; i < 3; ++i) {
          height += share[i] * corners[i][at(field_.axis)];
        }
        put(static_cast<std::size_t>(row), static_cast<std::size_t>(column), height, twice < 0.0);
      }
    }
  }

 private:
  static Eigen::Index at(std::size_t axis) { return static_cast<Eigen::Index>(axis); }

  static double scale(std::size_t count, double extent) {
    return extent > 0.0 ? static_cast<double>(count) / extent : 0.0;
  }

  /// \param is_down whether the face there is turned to the lower side; nothing: no face.
  void put(std::size_t row, std::size_t column, double height, std::optional<bool> is_down) {
    const std::size_t cell = row * field_.columns + column;
    const auto value = static_cast<float>(std::clamp(height, 0.0, field_.extent));
    float& low = field_.low[cell];
    float& high = field_.high[cell];
    if (is_down) {
      look_at_face(cell, value, *is_down);
    }
    low = low < 0.0F ? value : std::min(low, value);
    high = std::max(high, value);
  }

  /// Which side of the lowest and of the highest face shows, whatever order they come in. Of the two
  /// sides of a sheet it is the one that is turned to the eye.
  void look_at_face(std::size_t cell, float value, bool is_down) {
    float& low = low_face_[cell];
    float& high = high_face_[cell];
    if (low < 0.0F || value < low - kSheet) {
      field_.low_is_back[cell] = is_down ? 0 : 1;
    } else if (is_down && value < low + kSheet) {
      field_.low_is_back[cell] = 0;
    }
    if (value > high + kSheet) {
      field_.high_is_back[cell] = is_down ? 1 : 0;
    } else if (!is_down && value > high - kSheet) {
      field_.high_is_back[cell] = 0;
    }
    low = low < 0.0F ? value : std::min(low, value);
    high = std::max(high, value);
  }

  HeightField& field_;
  double u_scale_;
  double v_scale_;
  std::vector<float> low_face_;  // of faces at cells' centres alone, without edges
  std::vector<float> high_face_;
};

std::size_t cells_of(double extent) {
  return static_cast<std::size_t>(std::clamp(std::ceil(extent * kCells - 1e-6), 1.0, kCells));
}

void paint(const std::vector<Vec3>& places, const std::vector<Triangle>& triangles,
           FieldPainter painter) {
  for (const Triangle& t : triangles) {
    const std::array<Vec3, 3> corners{places[t[0]], places[t[1]], places[t[2]]};
    painter.face(corners);
    for (std::size_t i = 0; i < 3; ++i) {
      // What is thinner than a cell has no cell's centre in its faces: rods and wires are edges.
      const Vec3 along = corners[(i + 1) % 3] - corners[i];
      const double steps = std::max(1.0, std::ceil(2.0 * kCells * along.norm()));
      for (double s = 0.0; s < steps; s += 1.0) {
        painter.point(corners[i] + (s / steps) * along);
      }
    }
  }
  if (triangles.empty()) {
    for (const Vec3& p : places) {
      painter.point(p);
    }
  }
}

/// Sums over the faces: the centroid, or nothing where they have no area, and what of HeightFields is
/// a share of the area.
std::optional<Vec3> measure_faces(const std::vector<Triangle>& triangles,
                                  const std::vector<Vec3>& places, HeightFields& fields) {
  Vec3 centre = Vec3::Zero();
  double area = 0.0;
  for (const Triangle& t : triangles) {
    const Vec3 twice = (places[t[1]] - places[t[0]]).cross(places[t[2]] - places[t[0]]);
    const double part = twice.norm();
    area += part;
    centre += part / 3.0 * (places[t[0]] + places[t[1]] + places[t[2]]);
    for (std::size_t k = 0; k < 3; ++k) {
      const double across = std::abs(twice[static_cast<Eigen::Index>(k)]);
      fields.net[k] += twice[static_cast<Eigen::Index>(k)];
      fields.parallel[k] += across > kParallel * part ? part : 0.0;
      fields.perpendicular[k] += across < kPerpendicular * part ? part : 0.0;
    }
  }
  for (auto* of_axes : {&fields.parallel, &fields.net, &fields.perpendicular}) {
    for (double& share : *of_axes) {
      share = area > 0.0 ? share / area : 0.0;
    }
  }
  return area > 0.0 ? std::optional<Vec3>(centre / area) : std::nullopt;
}

/// Shares of the vertices that lie at the ends of the box.
void measure_ends(const std::vector<Vec3>& used, const Box& box, double unit,
                  HeightFields& fields) {
  const double share = 1.0 / static_cast<double>(used.size());
  for (std::size_t k = 0; k < 3; ++k) {
    const auto i = static_cast<Eigen::Index>(k);
    for (const Vec3& p : used) {
      const double place = (p[i] - box.low[i]) * unit;
      fields.vertex_low[k] += place < kEnd * fields.extent[k] ? share : 0.0;
      fields.vertex_high[k] += place > (1.0 - kEnd) * fields.extent[k] ? share : 0.0;
    }
  }
}

/// The faces without those that lie in one place with too many others.
std::vector<Triangle> painted_faces(const TriMesh& surface) {
  const std::vector<std::uint32_t> beyond = faces_beyond_copies(surface);
  std::vector<Triangle> painted;
  for (std::uint32_t f = 0; f < surface.triangles.size(); ++f) {
    if (!std::binary_search(beyond.begin(), beyond.end(), f)) {
      painted.push_back(surface.triangles[f]);
    }
  }
  return painted;
}

/// A field along an axis with nothing in it.
HeightField empty_field(std::size_t axis, const std::array<double, 3>& extent) {
  HeightField field;
  field.axis = axis;
  field.u_axis = (axis + 1) % 3;
  field.v_axis = (axis + 2) % 3;
  field.columns = cells_of(extent[field.u_axis]);
  field.rows = cells_of(extent[field.v_axis]);
  field.extent = extent[axis];
  field.low.assign(field.columns * field.rows, HeightField::kNothing);
  field.high = field.low;
  field.low_is_back.assign(field.low.size(), 0);
  field.high_is_back = field.low_is_back;
  return field;
}

}  // namespace

HeightFields::HeightFields(const TriMesh& surface) {
  const std::vector<Vec3> used = referenced_points(surface);
  const Box box = bounding_box(used);
  const double longest = box.longest_side();
  const double unit = longest > 0.0 ? 1.0 / longest : 0.0;
  std::vector<Vec3> places;
  places.reserve(surface.positions.size());
  for (const Vec3& p : surface.positions) {
    places.emplace_back((p - box.low) * unit);
  }
  Vec3 mean = Vec3::Zero();
  for (const Vec3& p : used) {
    mean += (p - box.low) * (unit / static_cast<double>(used.size()));
  }
  const Vec3 centre = measure_faces(surface.triangles, places, *this).value_or(mean);
  for (std::size_t k = 0; k < 3; ++k) {
    const auto i = static_cast<Eigen::Index>(k);
    extent[k] = box.size()[i] * unit;
    if (extent[k] < static_cast<double>(std::numeric_limits<float>::min())) {
      extent[k] = 0.0;  // depths are floats
    }
    origin[k] = box.size()[i] > 0.0 ? -box.low[i] / box.size()[i] : 0.5;
    vertex_mean[k] = extent[k] > 0.0 ? mean[i] / extent[k] : 0.5;
    area_mean[k] = extent[k] > 0.0 ? centre[i] / extent[k] : 0.5;
  }
  measure_ends(used, box, unit, *this);
  const std::vector<Triangle> painted = painted_faces(surface);
  for (std::size_t k = 0; k < 3; ++k) {
    along[k] = empty_field(k, extent);
    paint(places, painted, FieldPainter(along[k], extent));
  }
}

}  // namespace vantage
