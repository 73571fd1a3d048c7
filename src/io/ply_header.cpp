// SPDX-License-Identifier: MIT
#include "io/ply_header.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <optional>
#include <set>
#include <utility>

#include "io/number_parsing.h"
#include "io/text_cursor.h"

namespace vantage {
namespace {

struct ScalarName {
  std::string_view name;
  PlyScalar type;
};

constexpr std::array<ScalarName, 16> kScalarNames = {{{"char", PlyScalar::I8},
                                                      {"int8", PlyScalar::I8},
                                                      {"uchar", PlyScalar::U8},
                                                      {"uint8", PlyScalar::U8},
                                                      {"short", PlyScalar::I16},
                                                      {"int16", PlyScalar::I16},
                                                      {"ushort", PlyScalar::U16},
                                                      {"uint16", PlyScalar::U16},
                                                      {"int", PlyScalar::I32},
                                                      {"int32", PlyScalar::I32},
                                                      {"uint", PlyScalar::U32},
                                                      {"uint32", PlyScalar::U32},
                                                      {"float", PlyScalar::F32},
                                                      {"float32", PlyScalar::F32},
                                                      {"double", PlyScalar::F64},
                                                      {"float64", PlyScalar::F64}}};

struct RoleName {
  std::string_view name;
  PlyRole role;
};

constexpr std::array<RoleName, 19> kVertexRoles = {{{"x", PlyRole::X},
                                                    {"y", PlyRole::Y},
                                                    {"z", PlyRole::Z},
                                                    {"red", PlyRole::Red},
                                                    {"green", PlyRole::Green},
                                                    {"blue", PlyRole::Blue},
                                                    {"r", PlyRole::Red},
                                                    {"g", PlyRole::Green},
                                                    {"b", PlyRole::Blue},
                                                    {"diffuse_red", PlyRole::Red},
                                                    {"diffuse_green", PlyRole::Green},
                                                    {"diffuse_blue", PlyRole::Blue},
                                                    {"alpha", PlyRole::Alpha},
                                                    {"u", PlyRole::U},
                                                    {"v", PlyRole::V},
                                                    {"s", PlyRole::U},
                                                    {"t", PlyRole::V},
                                                    {"texture_u", PlyRole::U},
                                                    {"texture_v", PlyRole::V}}};

/// What a property of this name is for.
PlyRole role_of(const PlyElement& element, const PlyProperty& property) {
  PlyRole role = PlyRole::Other;
  const std::string name = lower_case(property.name);
  const auto* const entry = std::find_if(kVertexRoles.begin(), kVertexRoles.end(),
                                         [&](const RoleName& known) { return known.name == name; });
  const bool is_known = entry != kVertexRoles.end() && !property.is_list;
  const bool is_colour = is_known && entry->role >= PlyRole::Red && entry->role <= PlyRole::Blue;
  if (is_colour || (is_known && element.kind == PlyElement::Kind::Vertex)) {
    role = entry->role;
  } else if ((element.kind == PlyElement::Kind::Face || element.kind == PlyElement::Kind::Strips) &&
             property.is_list &&
             (name == "vertex_indices" || name == "vertex_index" || name == "vertex_indexes")) {
    role = PlyRole::Indices;
  } else if (element.kind == PlyElement::Kind::Face) {
    role = property.is_list && name == "texcoord"     ? PlyRole::CornerPlaces
           : !property.is_list && name == "texnumber" ? PlyRole::TextureNumber
                                                      : PlyRole::Other;
  }
  return role;
}

bool has_property(const PlyElement& element, PlyRole role) {
  return std::any_of(element.properties.begin(), element.properties.end(),
                     [&](const PlyProperty& property) { return property.role == role; });
}

class PlyHeaderReader {
 public:
  PlyHeaderReader(std::string_view bytes, const ModelBuilder& builder)
      : bytes_(bytes), cursor_(bytes), builder_(builder) {}

  PlyHeader read() {
    if (trimmed(cursor_.next_line().value_or("")) != "ply") {
      builder_.fail(cursor_.place(), "expected the word ply, which starts every PLY file");
    }
    // In files of old Macs a line ends in \r alone, and a \n after end_header is data.
    const char last = bytes_[cursor_.offset() - 1];
    const bool lone_returns = last == '\r';
    while (std::optional<std::string_view> line = cursor_.next_line()) {
      if (trimmed(*line) == "end_header") {
        finish(lone_returns);
        return std::move(header_);
      }
      read_line(*line);
    }
    builder_.fail(cursor_.place(), "the file ends inside its header");
  }

 private:
  void read_line(std::string_view rest) {
    const std::string_view keyword = take_token(rest);
    if (keyword == "comment") {
      read_comment(rest);
    } else if (keyword.empty() || keyword == "obj_info" || keyword == "Created") {
      // "Created by Blender3D 247 …": Blender 2.4 left the word comment out.
      return;
    } else if (keyword == "format") {
      read_format(take_token(rest));
    } else if (keyword == "element") {
      read_element(rest);
    } else if (keyword == "property") {
      read_property(rest);
    } else {
      builder_.fail(cursor_.place(), "unknown word " + in_quotes(keyword) + " in the header");
    }
  }

  /// MeshLab's placeholder stands for the model's own name, without its ending.
  [[nodiscard]] std::string of_this_model(std::string texture) const {
    constexpr std::string_view kThis = "<this>";
    const std::size_t at = texture.find(kThis);
    const std::string stem = std::filesystem::path(builder_.name()).stem().string();
    return at == std::string::npos ? texture : texture.replace(at, kThis.size(), stem);
  }

  void read_comment(std::string_view rest) {
    if (lower_case(take_token(rest)) == "texturefile" && !trimmed(rest).empty()) {
      header_.textures.push_back(of_this_model(std::string(without_quotes(trimmed(rest)))));
    }
  }

  void read_format(std::string_view encoding) {
    has_format_ = true;
    if (encoding == "ascii") {
      header_.encoding = PlyEncoding::Ascii;
    } else if (encoding == "binary_little_endian") {
      header_.encoding = PlyEncoding::BinaryLittleEndian;
    } else if (encoding == "binary_big_endian") {
      header_.encoding = PlyEncoding::BinaryBigEndian;
    } else {
      builder_.fail(cursor_.place(), "unknown format " + in_quotes(encoding) +
                                         "; expected ascii, binary_little_endian or "
                                         "binary_big_endian");
    }
  }

  void read_element(std::string_view rest) {
    PlyElement element;
    element.name = take_token(rest);
    const std::string_view token = take_token(rest);
    const std::optional<std::int64_t> count = integer_from(token);
    if (element.name.empty() || !count || *count < 0) {
      builder_.fail(cursor_.place(), "expected a name and a number of elements, found " +
                                         in_quotes(element.name + " " + std::string(token)));
    }
    element.count = static_cast<std::uint64_t>(*count);
    if (element.name == "vertex") {
      element.kind = PlyElement::Kind::Vertex;
      if (std::exchange(has_vertices_, true)) {
        builder_.fail(cursor_.place(), "the element vertex is declared twice");
      }
    } else if (element.name == "face") {
      element.kind = PlyElement::Kind::Face;
    } else if (element.name == "tristrips") {
      element.kind = PlyElement::Kind::Strips;
    }
    header_.elements.push_back(std::move(element));
    roles_.clear();
  }

  void read_property(std::string_view rest) {
    if (header_.elements.empty()) {
      builder_.fail(cursor_.place(), "a property comes before any element");
    }
    PlyElement& element = header_.elements.back();
    PlyProperty property;
    std::string_view type = take_token(rest);
    if (type == "list") {
      property.is_list = true;
      property.count_type = scalar(take_token(rest));
      type = take_token(rest);
    }
    property.type = scalar(type);
    property.name = take_token(rest);
    if (property.name.empty()) {
      builder_.fail(cursor_.place(), "a property has no name");
    }
    property.role = role_of(element, property);
    if (!roles_.insert(property.role).second) {
      property.role = PlyRole::Other;  // the first of its kind counts
    }
    element.properties.push_back(std::move(property));
  }

  [[nodiscard]] PlyScalar scalar(std::string_view name) const {
    const auto* const entry =
        std::find_if(kScalarNames.begin(), kScalarNames.end(),
                     [&](const ScalarName& known) { return known.name == name; });
    if (entry == kScalarNames.end()) {
      builder_.fail(cursor_.place(), "unknown type " + in_quotes(name) + " of a property");
    }
    return entry->type;
  }

  void finish(bool lone_returns) {
    header_.body_offset = cursor_.offset();
    header_.body_line = cursor_.line();
    if (lone_returns && bytes_[header_.body_offset - 1] == '\n') {
      --header_.body_offset;
    }
    if (!has_format_) {
      builder_.fail("the header has no line that names the format");
    }
    if (!has_vertices_) {
      builder_.fail("the header declares no element vertex");
    }
    for (const PlyElement& element : header_.elements) {
      check(element);
    }
  }

  void check(const PlyElement& element) const {
    const auto has = [&](PlyRole role) { return has_property(element, role); };
    if (element.kind == PlyElement::Kind::Vertex &&
        !(has(PlyRole::X) && has(PlyRole::Y) && has(PlyRole::Z))) {
      builder_.fail("the element vertex lacks one of the properties x, y, z");
    }
    const bool has_corners =
        element.kind == PlyElement::Kind::Face || element.kind == PlyElement::Kind::Strips;
    if (has_corners && element.count > 0 && !has(PlyRole::Indices)) {
      builder_.fail("the element " + element.name + " lacks the list property vertex_indices" +
                    other_lists(element));
    }
  }

  /// What to rename, for a message.
  static std::string other_lists(const PlyElement& element) {
    std::string names;
    for (const PlyProperty& property : element.properties) {
      if (property.is_list) {
        names += (names.empty() ? "; if its corners are in " : " or ") + in_quotes(property.name);
      }
    }
    return names + (names.empty() ? "" : ", rename it");
  }

  std::string_view bytes_;
  TextCursor cursor_;
  const ModelBuilder& builder_;
  PlyHeader header_{};
  std::set<PlyRole> roles_{};  ///< Of the last element's properties.
  bool has_format_ = false;
  bool has_vertices_ = false;
};

}  // namespace

std::size_t ply_scalar_bytes(PlyScalar type) {
  constexpr std::array<std::size_t, 8> kBytes = {1, 1, 2, 2, 4, 4, 4, 8};
  return kBytes[static_cast<std::size_t>(type)];
}

bool has_role(const PlyHeader& header, PlyRole role) {
  return std::any_of(header.elements.begin(), header.elements.end(),
                     [&](const PlyElement& element) { return has_property(element, role); });
}

PlyHeader read_ply_header(std::string_view bytes, const ModelBuilder& builder) {
  return PlyHeaderReader(bytes, builder).read();
}

}  // namespace vantage
