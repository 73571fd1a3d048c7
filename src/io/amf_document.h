// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "vantage/mesh/appearance.h"

#include "io/model_builder.h"
#include "io/plate.h"
#include "io/xml_reader.h"

namespace vantage {

/// Reads the XML of an AMF (ISO/ASTM 52915) piece by piece: objects and constellations, numbered from 1 in
/// their order. A triangle has its own colour, or those of its vertices, of its volume, its object, or
/// the volume's material: the first of these that is there.
class AmfDocument : public XmlReader {
 public:
  /// \param records_left see XmlReader. Both must outlive this.
  AmfDocument(const ModelBuilder& builder, std::size_t& records_left);

  /// Call once. Its items are the objects and constellations that no other shows, or all. \throw FormatError
  PlatePart finish();

  [[nodiscard]] bool has_curves() const { return has_curves_; }

  [[nodiscard]] bool has_sized_instances() const { return has_sized_instances_; }

 private:
  /// Triangles of one volume, to be coloured once all is read.
  struct Volume {
    std::uint32_t object = 0;
    std::size_t first = 0;
    std::size_t end = 0;
    std::uint32_t colour = Appearance::kNone;
    std::string material{};
  };

  /// What an instance names, which may come later.
  struct Instance {
    std::uint32_t object = 0;
    std::size_t component = 0;
    std::string wanted{};
  };

  void start_element(std::string_view element, const XmlAttributes& attributes) override;
  void end_element(std::string_view name) override;
  void add_text(std::string_view text) override;

  void begin_object(const XmlAttributes& attributes);
  void begin_instance(const XmlAttributes& attributes);
  void end_vertex();
  void end_triangle();
  void end_instance();
  void end_value(std::string_view element, std::string_view parent);
  void end_colour(std::string_view parent);
  void measure_instance(std::string_view element);
  PlateObject& object();
  [[nodiscard]] std::string_view parent() const;
  std::uint32_t material_of(const std::array<double, 4>& colour);
  void colour_volumes();
  void join_instances();

  PlatePart part_{};
  std::vector<std::string> path_{};  ///< Of the element being read.
  std::string text_{};
  std::map<std::string, std::uint32_t, std::less<>> objects_{};  ///< By their ids.
  std::uint32_t object_ = 0;                                     ///< Being read; 0: none.
  std::size_t first_point_ = 0;                                  ///< Of the mesh.
  std::vector<std::uint32_t> object_colours_{};                  ///< Of each object.
  std::vector<bool> has_colour_{};                               ///< Of each vertex of the object.
  std::vector<Volume> volumes_{};
  std::vector<Instance> instances_{};
  std::map<std::string, std::uint32_t, std::less<>> materials_{};  ///< Colours by ids.
  std::string material_id_{};
  std::map<std::array<double, 4>, std::uint32_t> colours_{};  ///< Each once.

  // Of what is being read.
  std::array<std::optional<double>, 3> point_{};
  std::array<std::optional<std::uint32_t>, 3> corners_{};
  std::array<std::optional<double>, 4> channels_{};
  std::optional<std::array<double, 4>> vertex_colour_{};
  std::uint32_t triangle_colour_ = Appearance::kNone;
  std::array<double, 6> moves_{};  ///< Shifts, and degrees around the axes.
  bool is_name_ = false;
  bool has_curves_ = false;
  bool has_sized_instances_ = false;
};

}  // namespace vantage
