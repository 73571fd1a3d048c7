// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "vantage/core/vec3.h"
#include "vantage/mesh/appearance.h"
#include "vantage/mesh/tri_mesh.h"

#include "io/model_builder.h"

/// \file
/// Objects that show each other, as files of 3D printers have them (3MF, AMF).

namespace vantage {

/// Objects, items, components and colours that may be read, and one for each byte of the file: each is
/// kept, and takes more than its text. [ours]
inline constexpr std::size_t kMostRecordsOfSmallFile = 100'000;

/// Rows as 3MF writes them: a point is a row in front of it, the last row shifts.
using PlateTransform = Eigen::Matrix<double, 4, 3>;

/// The transform that leaves everything where it is.
inline PlateTransform unmoved() {
  return (PlateTransform() << 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0)
      .finished();
}

/// An object shown somewhere.
struct PlateUse {
  std::string part{};  ///< Of the package; empty: the one that says so.
  std::uint32_t object = 0;
  PlateTransform transform{};
};

/// Either a mesh, or other objects put together.
struct PlateObject {
  std::string name{};
  bool is_model = true;  ///< Not a support or the like.
  std::vector<Vec3> points{};
  std::vector<std::array<float, 3>> colours{};  ///< One a point, sRGB from 0 to 1; or empty.
  std::vector<Triangle> triangles{};
  std::vector<std::uint32_t> materials{};  ///< One a triangle: index into PlatePart::materials.
  std::vector<PlateUse> components{};
};

/// What one XML file says: a part of the package of a 3MF, or an AMF.
struct PlatePart {
  std::string unit = "millimeter";
  std::map<std::uint32_t, PlateObject> objects{};
  std::vector<PlateUse> items{};      ///< What is to be built.
  std::vector<Material> materials{};  ///< Colours only.
  bool needs_double = false;          ///< Coordinates say more than a float holds.
  std::size_t unprinted = 0;          ///< Items that are not to be printed.
  bool has_unread_materials = false;  ///< Textures or mixtures.
  bool has_corner_colours = false;    ///< Triangles whose corners differ.
  /// Extensions that the part needs and nobody reads here: the ends of their namespaces.
  std::vector<std::string> unread_extensions{};
};

/// Each object of a part that is no component of another there. Of objects that only hold each other one, so that
/// they are refused as ever.
std::vector<PlateUse> uses_of_wholes(const PlatePart& part);

/// By name.
using PlateParts = std::map<std::string, PlatePart, std::less<>>;

/// Puts the items of the build plate where they stand.
class PlateReader {
 public:
  /// All must outlive this.
  PlateReader(const PlateParts& parts, std::size_t file_bytes, ModelBuilder& builder);

  /// \param root the part to begin with. \throw FormatError
  void read(const std::string& root);

  [[nodiscard]] bool shows_triangles() const { return faces_ > 0; }

  /// Of all parts, to which the builder's faces refer.
  [[nodiscard]] std::vector<Material> materials() const;

 private:
  /// Objects shown together, and which of them is next. A stack of these is no deeper than the file has
  /// objects, however often they show each other.
  struct Level {
    std::span<const PlateUse> uses;
    std::string_view part;
    Eigen::Affine3d outer;
    std::size_t next = 0;
  };

  struct Visit {
    std::string_view part;
    std::uint32_t object;
    Eigen::Affine3d transform;
  };

  /// Goes to every object that is shown.
  void walk(std::span<const PlateUse> uses, const std::string& root);
  void spend(std::size_t amount);
  [[nodiscard]] const PlateObject& object_of(const Visit& visit) const;
  void read_object(const Visit& visit, std::vector<Level>& levels);
  void add_mesh(const PlateObject& object, const Visit& visit);
  void add_points(const PlateObject& object, const Eigen::Affine3d& transform);

  const PlateParts& parts_;
  ModelBuilder& builder_;
  std::size_t file_bytes_;
  bool is_counting_ = false;
  std::size_t faces_ = 0;   // counted
  std::size_t points_ = 0;  // so too
  std::size_t budget_ = 0;
  std::size_t visits_left_ = 0;
  std::size_t objects_ = 0;
  std::size_t left_out_ = 0;
  std::map<std::string, std::uint32_t, std::less<>> first_material_{};
};

}  // namespace vantage
