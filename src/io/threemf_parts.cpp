// SPDX-License-Identifier: MIT
#include "io/threemf_parts.h"

#include <algorithm>
#include <array>
#include <new>
#include <optional>
#include <utility>

#include <expat.h>

#include "core/srgb.h"
#include "io/number_parsing.h"
#include "io/text_cursor.h"
#include "io/threemf_package.h"
#include "io/xml_reader.h"
#include "mesh/extent.h"

namespace vantage {
namespace {

/// Of the elements and attributes that files hold in thousands.
constexpr std::array<std::string_view, 18> kUsualNames{
    "vertex", "x",    "y",     "z",        "triangle",  "v1",     "v2",   "v3",        "pid",
    "p1",     "item", "color", "objectid", "transform", "object", "base", "component", "id"};

constexpr std::size_t kMostUnread = 5;  // [ours] more would say nothing new

/// What tells an extension's namespace from others: "beamlattice/2017/02".
std::string_view extension_name(std::string_view space) {
  constexpr std::string_view kCommon = "/3dmanufacturing/";
  const std::size_t at = space.find(kCommon);
  return at == std::string_view::npos ? space : space.substr(at + kCommon.size());
}

/// Whether an extension of that name is read, or changes no shape.
bool is_read(std::string_view extension) {
  constexpr std::array<std::string_view, 4> kRead{"core/", "material/", "production/",
                                                  "trianglesets/"};
  return std::any_of(kRead.begin(), kRead.end(),
                     [&](std::string_view known) { return extension.starts_with(known); });
}

/// Half a byte, or 16.
unsigned hexadecimal(char c) {
  return c >= '0' && c <= '9'   ? static_cast<unsigned>(c - '0')
         : c >= 'a' && c <= 'f' ? static_cast<unsigned>(c - 'a' + 10)
         : c >= 'A' && c <= 'F' ? static_cast<unsigned>(c - 'A' + 10)
                                : 16U;
}

/// "#RRGGBB" or "#RRGGBBAA", sRGB; white for anything else.
Material material_of(std::string_view text) {
  Material material;
  std::array<std::uint8_t, 4> bytes{0, 0, 0, 255};
  const bool has_opacity = text.size() >= 9;
  for (std::size_t c = 0; c < (has_opacity ? 4U : 3U); ++c) {
    const bool is_there = text.size() >= 7 && text[0] == '#';
    const unsigned high = is_there ? hexadecimal(text[1 + 2 * c]) : 16U;
    const unsigned low = is_there ? hexadecimal(text[2 + 2 * c]) : 16U;
    if (high > 15 || low > 15) {
      return material;
    }
    bytes[c] = static_cast<std::uint8_t>(16 * high + low);
  }
  for (std::size_t c = 0; c < 3; ++c) {
    material.colour[c] = linear_of_srgb(bytes[c]);
  }
  material.opacity = bytes[3] / 255.0;
  material.alpha = bytes[3] < 255 ? AlphaMode::Blend : AlphaMode::Opaque;
  return material;
}

}  // namespace

/// Where the reader is in the document.
class ThreemfPartReader::State : public XmlReader {
 public:
  State(const std::string& name, const ModelBuilder& builder, std::size_t& records_left)
      : XmlReader(builder, "part " + in_quotes(name) + ", ", kUsualNames, records_left) {}

  PlatePart finish() {
    end();
    return std::move(part_);
  }

 private:
  void name_space(std::string_view prefix, std::string_view uri) override {
    namespaces_[std::string(prefix)] = uri;
  }

  void start_element(std::string_view element, const XmlAttributes& attributes) override {
    if (element == "vertex") {
      add_vertex(attributes);
    } else if (element == "triangle") {
      add_triangle(attributes);
    } else if (element == "object") {
      begin_object(attributes);
    } else if (element == "component") {
      if (object_ == nullptr) {
        fail("a component belongs to no object");
      }
      object_->components.push_back(use(attributes));
    } else if (element == "item") {
      part_.items.push_back(use(attributes));
      const std::string_view printable = trimmed(attributes.text("printable").value_or("1"));
      part_.unprinted += printable == "0" || printable == "false" ? 1 : 0;
    } else if (element == "model") {
      part_.unit = attributes.text("unit").value_or("millimeter");
      check_extensions(attributes.text("requiredextensions").value_or(""));
    } else {
      add_colour(element, attributes);
    }
  }

  void end_element(std::string_view element) override {
    if (element == "object") {
      object_ = nullptr;
    }
  }

  /// Slices, which are not read, have vertices, too.
  [[nodiscard]] bool reads(std::string_view space) const override {
    return is_read(extension_name(space));
  }

  /// \param prefixes of the namespaces that the part needs.
  void check_extensions(std::string_view prefixes) {
    TextCursor words(prefixes);
    for (std::string_view prefix = words.next_token(); !prefix.empty();
         prefix = words.next_token()) {
      const auto known = namespaces_.find(prefix);
      const std::string_view extension =
          known == namespaces_.end() ? prefix : extension_name(known->second);
      if (part_.unread_extensions.size() < kMostUnread && !is_read(extension)) {
        part_.unread_extensions.emplace_back(extension);
      }
    }
  }

  void add_colour(std::string_view element, const XmlAttributes& attributes) {
    if (element == "basematerials" || element == "colorgroup") {
      const auto id = attributes.index("id");
      spend();
      group_ = id ? &groups_[*id] : nullptr;
    } else if ((element == "base" || element == "color") && group_ != nullptr) {
      spend();
      group_->push_back(static_cast<std::uint32_t>(part_.materials.size()));
      part_.materials.push_back(
          material_of(attributes.text(element == "base" ? "displaycolor" : "color").value_or("")));
    } else if (element == "texture2dgroup" || element == "compositematerials" ||
               element == "multiproperties") {
      part_.has_unread_materials = true;
    }
  }

  void begin_object(const XmlAttributes& attributes) {
    const auto id = attributes.index("id");
    if (!id) {
      fail("an object has no id");
    }
    spend();
    const auto [place, is_new] = part_.objects.try_emplace(*id);
    if (!is_new) {
      fail("two objects have the id " + std::to_string(*id));
    }
    object_ = &place->second;
    object_->name = attributes.text("name").value_or("");
    const std::string_view type = attributes.text("type").value_or("model");
    object_->is_model = type == "model" || type == "surface";
    object_colours_ = attributes.index("pid");
    object_material_ = material_at(object_colours_, attributes.index("pindex"));
  }

  [[nodiscard]] std::uint32_t material_at(std::optional<std::uint32_t> group,
                                          std::optional<std::uint32_t> index) const {
    const auto found = group ? groups_.find(*group) : groups_.end();
    return found != groups_.end() && index && *index < found->second.size() ? found->second[*index]
                                                                            : Appearance::kNone;
  }

  double axis(const XmlAttributes& attributes, std::string_view name) {
    const std::optional<std::string_view> text = attributes.text(name);
    if (!text) {
      fail("a vertex has no " + std::string(name));
    }
    return coordinate(*text, part_.needs_double);
  }

  void add_vertex(const XmlAttributes& attributes) {
    if (object_ == nullptr) {
      fail("a vertex belongs to no object");
    }
    const double x = axis(attributes, "x");
    const double y = axis(attributes, "y");
    object_->points.emplace_back(x, y, axis(attributes, "z"));
  }

  void add_triangle(const XmlAttributes& attributes) {
    if (object_ == nullptr) {
      fail("a triangle belongs to no object");
    }
    Triangle triangle{};
    constexpr std::array<const char*, 3> kCorners{"v1", "v2", "v3"};
    for (std::size_t c = 0; c < 3; ++c) {
      const auto vertex = attributes.index(kCorners[c]);
      if (!vertex || *vertex >= object_->points.size()) {
        fail(std::string("a triangle's ") + kCorners[c] +
             " names no vertex: " + in_quotes(attributes.text(kCorners[c]).value_or("")) + " of " +
             std::to_string(object_->points.size()));
      }
      triangle[c] = *vertex;
    }
    object_->triangles.push_back(triangle);
    const auto colour = attributes.index("p1");
    const auto group = attributes.index("pid");
    object_->materials.push_back(colour ? material_at(group ? group : object_colours_, colour)
                                        : object_material_);
    if (colour && object_->materials.back() != Appearance::kNone) {
      part_.has_corner_colours = part_.has_corner_colours ||
                                 attributes.index("p2").value_or(*colour) != *colour ||
                                 attributes.index("p3").value_or(*colour) != *colour;
    }
  }

  PlateUse use(const XmlAttributes& attributes) {
    spend();
    const auto object = attributes.index("objectid");
    if (!object) {
      fail("something is shown that has no objectid");
    }
    PlateUse use;
    use.object = *object;
    use.part = part_name(attributes.text("path").value_or(""));
    use.transform = unmoved();
    if (const auto text = attributes.text("transform")) {
      TextCursor numbers(*text);
      bool is_sound = true;
      for (Eigen::Index i = 0; i < use.transform.size(); ++i) {
        const std::optional<double> value = number_from(numbers.next_token());
        is_sound = is_sound && value && std::abs(*value) <= kLargestCoordinate;
        use.transform(i / 3, i % 3) = value.value_or(0.0);
      }
      if (!is_sound || !numbers.next_token().empty()) {
        fail("a transform is not 12 finite numbers: " + in_quotes(*text));
      }
    }
    return use;
  }

  std::map<std::string, std::string, std::less<>> namespaces_{};  ///< Of the root, by prefix.
  PlatePart part_{};
  PlateObject* object_ = nullptr;  ///< Being read; a map keeps its place.
  std::map<std::uint32_t, std::vector<std::uint32_t>> groups_{};  ///< Materials of each group.
  std::vector<std::uint32_t>* group_ = nullptr;                   ///< Being read.
  std::optional<std::uint32_t> object_colours_{};
  std::uint32_t object_material_ = Appearance::kNone;
};

ThreemfPartReader::ThreemfPartReader(const std::string& name, const ModelBuilder& builder,
                                     std::size_t& records_left)
    : state_(std::make_unique<State>(name, builder, records_left)) {}

ThreemfPartReader::~ThreemfPartReader() = default;

void ThreemfPartReader::add(std::string_view piece) {
  state_->add(piece);
}

PlatePart ThreemfPartReader::finish() {
  return state_->finish();
}

std::string threemf_root(std::string_view relationships) {
  struct Found {
    std::string target{};
  } found;

  const XmlParser parser(XML_ParserCreateNS(nullptr, kXmlBetween));
  if (parser == nullptr) {
    throw std::bad_alloc();
  }
  XML_SetUserData(parser.get(), &found);
  XML_SetStartElementHandler(
      parser.get(), [](void* state, const XML_Char* name, const XML_Char** attributes) {
        const XmlAttributes list(attributes);
        const bool is_model = xml_local(name) == "Relationship" &&
                              list.text("Type").value_or("").ends_with("/3dmodel");
        if (is_model) {
          static_cast<Found*>(state)->target = part_name(list.text("Target").value_or(""));
        }
      });
  // What is not well formed names no root.
  XML_Parse(parser.get(), relationships.data(), static_cast<int>(relationships.size()), 1);
  return found.target;
}

}  // namespace vantage
