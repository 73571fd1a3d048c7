// SPDX-License-Identifier: MIT
#include "io/threemf_parts.h"

#include <algorithm>
#include <array>
#include <exception>
#include <new>
#include <optional>
#include <unordered_set>
#include <utility>

#include <expat.h>

#include "vantage/core/error.h"

#include "core/srgb.h"
#include "io/number_parsing.h"
#include "io/text_cursor.h"
#include "io/threemf_package.h"
#include "mesh/extent.h"

namespace vantage {
namespace {

/// Between the namespace of an element and its name, as expat is told to write them.
constexpr XML_Char kBetween = '|';

/// The name without its namespace.
std::string_view local(std::string_view whole) {
  return whole.substr(whole.rfind(kBetween) + 1);
}

/// Attributes of an element, as expat hands them over.
class Attributes {
 public:
  explicit Attributes(const XML_Char** list) : list_(list) {}

  [[nodiscard]] std::optional<std::string_view> text(std::string_view name) const {
    for (const XML_Char** at = list_; *at != nullptr; at += 2) {
      if (local(at[0]) == name) {
        return at[1];
      }
    }
    return std::nullopt;
  }

  /// A number from 0 to 2³² − 2.
  [[nodiscard]] std::optional<std::uint32_t> index(std::string_view name) const {
    const auto value = integer_from(trimmed(text(name).value_or("")));
    return value && *value >= 0 && *value < std::int64_t{Appearance::kNone}
               ? std::optional(static_cast<std::uint32_t>(*value))
               : std::nullopt;
  }

 private:
  const XML_Char** list_;
};

/// Of the elements and attributes that files hold in thousands.
constexpr std::array<std::string_view, 18> kUsualNames{
    "vertex", "x",    "y",     "z",        "triangle",  "v1",     "v2",   "v3",        "pid",
    "p1",     "item", "color", "objectid", "transform", "object", "base", "component", "id"};

bool is_usual(std::string_view name) {
  return std::find(kUsualNames.begin(), kUsualNames.end(), name) != kUsualNames.end();
}

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

/// The name without its namespace; empty if that is an extension that is not read: slices have vertices, too.
std::string_view name_if_read(std::string_view whole) {
  const std::string_view space = whole.substr(0, whole.size() - local(whole).size());
  const std::string_view extension = extension_name(space);
  return extension.size() == space.size() || is_read(extension) ? local(whole) : "";
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

struct FreeParser {
  void operator()(XML_Parser parser) const { XML_ParserFree(parser); }
};

using Parser = std::unique_ptr<XML_ParserStruct, FreeParser>;

}  // namespace

/// Where the reader is in the document. expat is C: what is thrown inside its calls is kept and
/// thrown again outside.
class ThreemfPartReader::State {
 public:
  State(const std::string& name, const ModelBuilder& builder, std::size_t& records_left)
      : name_(name),
        builder_(builder),
        records_left_(records_left),
        parser_(XML_ParserCreateNS(nullptr, kBetween)) {
    if (parser_ == nullptr) {
      throw std::bad_alloc();
    }
    XML_SetUserData(parser_.get(), this);
    XML_SetElementHandler(parser_.get(), &on_start, &on_end);
    XML_SetStartNamespaceDeclHandler(parser_.get(), &on_namespace);
    XML_SetStartDoctypeDeclHandler(parser_.get(), &on_document_type);
  }

  void add(std::string_view piece, bool is_last) {
    const XML_Status status =
        XML_Parse(parser_.get(), piece.data(), static_cast<int>(piece.size()), is_last ? 1 : 0);
    if (failure_) {
      std::rethrow_exception(failure_);
    }
    if (status != XML_STATUS_OK) {
      fail(std::string("is not well-formed XML: ") +
           XML_ErrorString(XML_GetErrorCode(parser_.get())));
    }
    // expat keeps what is not whole yet, and begins it anew with each piece.
    added_ += static_cast<XML_Index>(piece.size());
    if (added_ - XML_GetCurrentByteIndex(parser_.get()) >
        static_cast<XML_Index>(kLongestThreemfElement + piece.size())) {
      fail("an element is longer than any of a 3D model");
    }
  }

  ThreemfPart finish() {
    add({}, true);
    return std::move(part_);
  }

 private:
  static void on_start(void* state, const XML_Char* name, const XML_Char** attributes) {
    static_cast<State*>(state)->guarded([&](State& self) {
      self.count_name(name);
      for (const XML_Char** at = attributes; *at != nullptr; at += 2) {
        self.count_name(at[0]);
      }
      self.start(name_if_read(name), Attributes(attributes));
    });
  }

  static void on_namespace(void* state, const XML_Char* prefix, const XML_Char* uri) {
    static_cast<State*>(state)->guarded([&](State& self) {
      for (const XML_Char* name : {prefix, uri}) {
        self.count_name(name == nullptr ? "" : name);
      }
      if (prefix != nullptr && uri != nullptr && self.depth_ == 0) {
        self.namespaces_[prefix] = uri;
      }
    });
  }

  static void on_end(void* state, const XML_Char* name) {
    static_cast<State*>(state)->guarded([&](State& self) { self.end(name_if_read(name)); });
  }

  static void on_document_type(void* state, const XML_Char* /*name*/, const XML_Char* /*system*/,
                               const XML_Char* /*publisher*/, int /*has_subset*/) {
    static_cast<State*>(state)->guarded(
        [](State& self) { self.fail("has a document type, which 3MF does not allow"); });
  }

  template <class Step>
  void guarded(const Step& step) {
    if (failure_) {
      return;
    }
    try {
      step(*this);
    } catch (...) {
      failure_ = std::current_exception();
      XML_StopParser(parser_.get(), XML_FALSE);
    }
  }

  [[noreturn]] void fail(const std::string& problem) const {
    throw FormatError(builder_.name(),
                      "part " + in_quotes(name_) + ", line " +
                          std::to_string(XML_GetCurrentLineNumber(parser_.get())),
                      problem);
  }

  /// Takes room for something that is kept.
  void spend() {
    if (records_left_ == 0) {
      fail("more objects, items and colours than the size of the file allows");
    }
    --records_left_;
  }

  /// expat keeps all that it meets.
  void count_name(std::string_view name) {
    if (!is_usual(local(name)) && names_.emplace(name).second &&
        names_.size() > kMostThreemfNames) {
      fail("has more kinds of elements and attributes than any 3D model");
    }
  }

  void start(std::string_view element, const Attributes& attributes) {
    if (++depth_ > kDeepestThreemfElement) {
      fail("its elements are nested deeper than any of a 3D model");
    }
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

  void end(std::string_view element) {
    --depth_;
    if (element == "object") {
      object_ = nullptr;
    }
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

  void add_colour(std::string_view element, const Attributes& attributes) {
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

  void begin_object(const Attributes& attributes) {
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

  double coordinate(const Attributes& attributes, std::string_view name) {
    const std::optional<std::string_view> text = attributes.text(name);
    if (!text) {
      fail("a vertex has no " + std::string(name));
    }
    const std::string_view token = trimmed(*text);
    const std::optional<double> value = number_from(token);
    if (!value || !(std::abs(*value) <= kLargestCoordinate)) {
      fail(value ? "a coordinate is not finite, or beyond 1e60" : number_problem(token));
    }
    part_.needs_double = part_.needs_double || needs_double(token, *value);
    return *value;
  }

  void add_vertex(const Attributes& attributes) {
    if (object_ == nullptr) {
      fail("a vertex belongs to no object");
    }
    const double x = coordinate(attributes, "x");
    const double y = coordinate(attributes, "y");
    object_->points.emplace_back(x, y, coordinate(attributes, "z"));
  }

  void add_triangle(const Attributes& attributes) {
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
  }

  ThreemfUse use(const Attributes& attributes) {
    spend();
    const auto object = attributes.index("objectid");
    if (!object) {
      fail("something is shown that has no objectid");
    }
    ThreemfUse use;
    use.object = *object;
    use.part = part_name(attributes.text("path").value_or(""));
    use.transform = unmoved();
    if (const auto text = attributes.text("transform")) {
      TextCursor numbers(*text);
      for (Eigen::Index i = 0; i < use.transform.size(); ++i) {
        const std::optional<double> value = number_from(numbers.next_token());
        if (!value || !(std::abs(*value) <= kLargestCoordinate)) {
          fail("a transform is not 12 finite numbers: " + in_quotes(*text));
        }
        use.transform(i / 3, i % 3) = *value;
      }
    }
    return use;
  }

  const std::string name_;
  const ModelBuilder& builder_;
  std::size_t& records_left_;
  Parser parser_;
  XML_Index added_ = 0;  ///< Bytes of the part.
  int depth_ = 0;
  std::map<std::string, std::string, std::less<>> namespaces_{};  ///< Of the root, by prefix.
  std::unordered_set<std::string> names_{};                       ///< But for the usual ones.
  std::exception_ptr failure_{};
  ThreemfPart part_{};
  ThreemfObject* object_ = nullptr;  ///< Being read; a map keeps its place.
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
  state_->add(piece, false);
}

ThreemfPart ThreemfPartReader::finish() {
  return state_->finish();
}

std::string threemf_root(std::string_view relationships) {
  struct Found {
    std::string target{};
  } found;

  const Parser parser(XML_ParserCreateNS(nullptr, kBetween));
  if (parser == nullptr) {
    throw std::bad_alloc();
  }
  XML_SetUserData(parser.get(), &found);
  XML_SetStartElementHandler(
      parser.get(), [](void* state, const XML_Char* name, const XML_Char** attributes) {
        const Attributes list(attributes);
        const bool is_model =
            local(name) == "Relationship" && list.text("Type").value_or("").ends_with("/3dmodel");
        if (is_model) {
          static_cast<Found*>(state)->target = part_name(list.text("Target").value_or(""));
        }
      });
  // What is not well formed names no root.
  XML_Parse(parser.get(), relationships.data(), static_cast<int>(relationships.size()), 1);
  return found.target;
}

}  // namespace vantage
