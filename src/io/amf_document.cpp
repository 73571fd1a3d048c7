// SPDX-License-Identifier: MIT
#include "io/amf_document.h"

#include <algorithm>
#include <numbers>
#include <utility>

#include <Eigen/Geometry>

#include "core/srgb.h"
#include "io/number_parsing.h"

namespace vantage {
namespace {

constexpr std::array<std::string_view, 16> kUsualAmfNames{
    "vertex", "coordinates", "x", "y", "z", "triangle", "v1",     "v2",
    "v3",     "color",       "r", "g", "b", "a",        "volume", "id"};

/// Bytes that a number or a name may have; the rest is dropped. [ours]
constexpr std::size_t kLongestAmfText = 4096;
/// The colour of a triangle that has none of its own, while its volume is not known.
constexpr std::uint32_t kOfVolume = Appearance::kNone - 1;

/// The place of `name` among `names`, or their number.
template <std::size_t N>
std::size_t place_in(const std::array<std::string_view, N>& names, std::string_view name) {
  return static_cast<std::size_t>(std::find(names.begin(), names.end(), name) - names.begin());
}

constexpr std::array<std::string_view, 3> kAmfAxes{"x", "y", "z"};
constexpr std::array<std::string_view, 3> kAmfCorners{"v1", "v2", "v3"};
constexpr std::array<std::string_view, 4> kAmfChannels{"r", "g", "b", "a"};
constexpr std::array<std::string_view, 6> kAmfMoves{"deltax", "deltay", "deltaz", "rx", "ry", "rz"};

bool is_volume(std::string_view element) {
  return element == "volume" || element == "region";  // the latter in early files
}

std::string id_of(const XmlAttributes& attributes, std::string_view name) {
  return std::string(xml_trimmed(attributes.text(name).value_or("")));
}

}  // namespace

AmfDocument::AmfDocument(const ModelBuilder& builder, std::size_t& records_left)
    : XmlReader(builder, "", kUsualAmfNames, records_left) {}

PlatePart AmfDocument::finish() {
  end();
  colour_volumes();
  join_instances();
  return std::move(part_);
}

void AmfDocument::start_element(std::string_view element, const XmlAttributes& attributes) {
  const std::string_view above = parent();
  text_.clear();
  if (path_.empty()) {
    if (element != "amf") {
      fail("its first element is " + in_quotes(element) + ", not that of an AMF");
    }
    part_.unit = xml_trimmed(attributes.text("unit").value_or("millimeter"));
  } else if (element == "object" || element == "constellation") {
    begin_object(attributes);
  } else if (element == "mesh") {
    first_point_ = object().points.size();
  } else if (is_volume(element)) {
    spend();
    const std::size_t first = object().triangles.size();
    volumes_.push_back({object_, first, first, Appearance::kNone, id_of(attributes, "materialid")});
  } else if (element == "vertex") {
    point_ = {};
    vertex_colour_.reset();
  } else if (element == "triangle") {
    corners_ = {};
    triangle_colour_ = Appearance::kNone;
  } else if (element == "color") {
    channels_ = {};
  } else if (element == "instance") {
    begin_instance(attributes);
  } else if (element == "material") {
    material_id_ = id_of(attributes, "id");
  } else if (element == "metadata") {
    is_name_ = above == "object" && attributes.text("type").value_or("") == "name";
  }
  has_curves_ = has_curves_ || element == "edge" || element == "normal";
  part_.has_unread_materials =
      part_.has_unread_materials || element == "map" || element == "texmap";
  path_.emplace_back(element);
}

void AmfDocument::end_element(std::string_view /*name*/) {
  const std::string element = std::move(path_.back());
  path_.pop_back();
  if (element == "vertex") {
    end_vertex();
  } else if (element == "triangle") {
    end_triangle();
  } else if (element == "color") {
    end_colour(parent());
  } else if (is_volume(element)) {
    volumes_.back().end = object().triangles.size();
  } else if (element == "instance") {
    end_instance();
  } else if (element == "object" || element == "constellation") {
    object_ = 0;
  } else if (element == "metadata" && is_name_) {
    object().name = xml_trimmed(text_);
    is_name_ = false;
  } else {
    end_value(element, parent());
  }
  text_.clear();
}

void AmfDocument::add_text(std::string_view text) {
  text_ += text.substr(0, kLongestAmfText - std::min(kLongestAmfText, text_.size()));
}

std::string_view AmfDocument::parent() const {
  return path_.empty() ? std::string_view() : path_.back();
}

PlateObject& AmfDocument::object() {
  if (object_ == 0) {
    fail("a part of a mesh or an instance belongs to no object");
  }
  return part_.objects[object_];
}

void AmfDocument::begin_object(const XmlAttributes& attributes) {
  spend();
  object_ = static_cast<std::uint32_t>(part_.objects.size() + 1);
  part_.objects.try_emplace(object_);
  object_colours_.push_back(Appearance::kNone);
  has_colour_.clear();
  first_point_ = 0;
  const std::string id = id_of(attributes, "id");
  if (!id.empty() && !objects_.try_emplace(id, object_).second) {
    fail("two objects have the id " + in_quotes(id));
  }
}

void AmfDocument::begin_instance(const XmlAttributes& attributes) {
  spend();
  moves_ = {};
  instances_.push_back({object_, object().components.size(), id_of(attributes, "objectid")});
  object().components.push_back({{}, 0, unmoved()});
}

void AmfDocument::end_instance() {
  constexpr double kDegree = std::numbers::pi / 180.0;
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
  for (int axis = 0; axis < 3; ++axis) {  // around x first
    const double angle = moves_[3 + static_cast<std::size_t>(axis)] * kDegree;
    turn = Eigen::AngleAxisd(angle, Vec3::Unit(axis)).toRotationMatrix() * turn;
  }
  PlateTransform& transform = object().components.back().transform;
  transform.topRows<3>() = turn.transpose();
  transform.row(3) << moves_[0], moves_[1], moves_[2];
}

void AmfDocument::end_vertex() {
  if (!point_[0] || !point_[1] || !point_[2]) {
    fail("a vertex has not three coordinates");
  }
  PlateObject& owner = object();
  owner.points.emplace_back(*point_[0], *point_[1], *point_[2]);
  has_colour_.push_back(vertex_colour_.has_value());
  if (vertex_colour_ || !owner.colours.empty()) {
    owner.colours.resize(owner.points.size(), {1.0F, 1.0F, 1.0F});
  }
  if (vertex_colour_) {
    for (std::size_t c = 0; c < 3; ++c) {
      owner.colours.back()[c] = static_cast<float>((*vertex_colour_)[c]);
    }
  }
}

void AmfDocument::end_triangle() {
  PlateObject& owner = object();
  Triangle triangle{};
  bool is_coloured = true;
  for (std::size_t c = 0; c < 3; ++c) {
    if (!corners_[c] || *corners_[c] >= owner.points.size() - first_point_) {
      fail("a triangle's " + std::string(kAmfCorners[c]) + " names none of the " +
           std::to_string(owner.points.size() - first_point_) + " vertices before it");
    }
    triangle[c] = static_cast<std::uint32_t>(first_point_) + *corners_[c];
    is_coloured = is_coloured && has_colour_[triangle[c]];
  }
  owner.triangles.push_back(triangle);
  owner.materials.push_back(triangle_colour_ != Appearance::kNone ? triangle_colour_
                            : is_coloured                         ? Appearance::kNone
                                                                  : kOfVolume);
}

void AmfDocument::end_value(std::string_view element, std::string_view parent) {
  if (parent == "coordinates") {
    if (const std::size_t axis = place_in(kAmfAxes, element); axis < kAmfAxes.size()) {
      point_[axis] = coordinate(text_, part_.needs_double);
    }
  } else if (parent == "triangle") {
    if (const std::size_t corner = place_in(kAmfCorners, element); corner < kAmfCorners.size()) {
      corners_[corner] = xml_index(text_);
    }
  } else if (parent == "color") {
    if (const std::size_t c = place_in(kAmfChannels, element); c < kAmfChannels.size()) {
      channels_[c] = number_from(xml_trimmed(text_));
      // Formulas of the place.
      part_.has_unread_materials = part_.has_unread_materials || !channels_[c];
    }
  } else if (parent == "instance") {
    measure_instance(element);
  }
}

void AmfDocument::measure_instance(std::string_view element) {
  if (const std::size_t move = place_in(kAmfMoves, element); move < kAmfMoves.size()) {
    bool is_precise = false;
    moves_[move] = coordinate(text_, is_precise);
  } else if (element.starts_with("scale") || element.starts_with("mirror")) {
    const double plain = element.starts_with("scale") ? 1.0 : 0.0;
    has_sized_instances_ =
        has_sized_instances_ || number_from(xml_trimmed(text_)).value_or(plain) != plain;
  }
}

void AmfDocument::end_colour(std::string_view parent) {
  if (!channels_[0] || !channels_[1] || !channels_[2]) {
    return;
  }
  std::array<double, 4> colour{};
  for (std::size_t c = 0; c < colour.size(); ++c) {
    const double value = channels_[c].value_or(1.0);
    colour[c] = value > 0.0 ? std::min(value, 1.0) : 0.0;  // NaN is 0
  }
  if (parent == "vertex") {
    vertex_colour_ = colour;
  } else if (parent == "triangle") {
    triangle_colour_ = material_of(colour);
  } else if (is_volume(parent)) {
    volumes_.back().colour = material_of(colour);
  } else if (parent == "object" && object_ > 0) {
    object_colours_[object_ - 1] = material_of(colour);
  } else if (parent == "material") {
    spend();
    materials_[material_id_] = material_of(colour);
  }
}

std::uint32_t AmfDocument::material_of(const std::array<double, 4>& colour) {
  const auto next = static_cast<std::uint32_t>(part_.materials.size());
  const auto [known, is_new] = colours_.try_emplace(colour, next);
  if (is_new) {
    spend();
    Material material;
    for (std::size_t c = 0; c < 3; ++c) {
      material.colour[c] = linear_of_encoded(colour[c]);
    }
    material.opacity = colour[3];
    material.alpha = colour[3] < 1.0 ? AlphaMode::Blend : AlphaMode::Opaque;
    part_.materials.push_back(material);
  }
  return known->second;
}

void AmfDocument::colour_volumes() {
  for (const Volume& volume : volumes_) {
    std::uint32_t colour = volume.colour;
    if (colour == Appearance::kNone) {
      colour = object_colours_[volume.object - 1];
    }
    if (const auto material = materials_.find(volume.material);
        colour == Appearance::kNone && material != materials_.end()) {
      colour = material->second;
    }
    std::vector<std::uint32_t>& of_triangles = part_.objects[volume.object].materials;
    const auto first = of_triangles.begin();
    std::replace(first + static_cast<std::ptrdiff_t>(volume.first),
                 first + static_cast<std::ptrdiff_t>(volume.end), kOfVolume, colour);
  }
  for (auto& [number, object] : part_.objects) {  // what is in no volume
    std::replace(object.materials.begin(), object.materials.end(), kOfVolume,
                 object_colours_[number - 1]);
  }
}

void AmfDocument::join_instances() {
  for (const Instance& instance : instances_) {
    const auto found = objects_.find(instance.wanted);
    if (found == objects_.end()) {
      fail("an instance names object " + in_quotes(instance.wanted) + ", which does not exist");
    }
    part_.objects[instance.object].components[instance.component].object = found->second;
  }
  part_.items = uses_of_wholes(part_);
}

}  // namespace vantage
