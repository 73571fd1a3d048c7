// SPDX-License-Identifier: MIT
#include "io/gltf_materials.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <set>
#include <utility>

#include "io/gltf_json.h"
#include "io/gltf_uri.h"
#include "io/number_parsing.h"
#include "io/texture_loader.h"

namespace vantage {
namespace {

using Json = nlohmann::json;

/// An item of a list in the root; nothing if there is none.
const Json& item(const Json& root, const char* list, const Json& index) {
  const Json& items = member(root, list);
  return items.is_array() && index.is_number_unsigned() && index.get<std::size_t>() < items.size()
             ? items[index.get<std::size_t>()]
             : kNoJson;
}

double number(const Json& value, double otherwise) {
  return value.is_number() && std::isfinite(value.get<double>()) ? value.get<double>() : otherwise;
}

double share(const Json& list, std::size_t index, double otherwise) {
  return list.is_array() && index < list.size()
             ? std::clamp(number(list[index], otherwise), 0.0, 1.0)
             : otherwise;
}

/// Where a material says its colour: its factor and its texture have other names in the extension of
/// specular and glossiness, which counts if there is no metal and roughness.
struct ColourSource {
  const Json& factor;
  const Json& texture;
};

ColourSource colour_source(const Json& material) {
  const Json& metal = member(material, "pbrMetallicRoughness");
  const Json& gloss = extension(material, "KHR_materials_pbrSpecularGlossiness");
  const bool has_metal = metal.contains("baseColorFactor") || metal.contains("baseColorTexture");
  return has_metal || !gloss.is_object()
             ? ColourSource{member(metal, "baseColorFactor"), member(metal, "baseColorTexture")}
             : ColourSource{member(gloss, "diffuseFactor"), member(gloss, "diffuseTexture")};
}

/// The texture by which a material's coordinates are chosen: that of its colour, or of its emission alone.
const Json& leading_texture(const Json& material) {
  const Json& of_colour = colour_source(material).texture;
  return of_colour.is_object() ? of_colour : member(material, "emissiveTexture");
}

/// KHR_texture_transform: scale, then turn counter-clockwise in the picture, then shift.
std::array<double, 6> uv_transform(const Json& texture_info) {
  const Json& transform = extension(texture_info, "KHR_texture_transform");
  const auto pair = [&](const char* name, std::size_t index, double otherwise) {
    const Json& list = member(transform, name);
    return list.is_array() && index < list.size() ? number(list[index], otherwise) : otherwise;
  };
  const double turn = number(member(transform, "rotation"), 0.0);
  const double su = pair("scale", 0, 1.0);
  const double sv = pair("scale", 1, 1.0);
  return {su * std::cos(turn),  sv * std::sin(turn), pair("offset", 0, 0.0),
          -su * std::sin(turn), sv * std::cos(turn), pair("offset", 1, 0.0)};
}

int texcoord_set(const Json& texture_info) {
  const Json& moved = member(extension(texture_info, "KHR_texture_transform"), "texCoord");
  const Json& set = moved.is_number_unsigned() ? moved : member(texture_info, "texCoord");
  constexpr unsigned kMostSets = 1000;
  return set.is_number_unsigned() && set.get<std::size_t>() < kMostSets ? set.get<int>() : 0;
}

AlphaMode alpha_mode(const Json& material) {
  const Json& mode = member(material, "alphaMode");
  return mode == "MASK" ? AlphaMode::Mask : mode == "BLEND" ? AlphaMode::Blend : AlphaMode::Opaque;
}

TextureWrap wrap_of(const Json& sampler, const char* name) {
  const double mode = number(member(sampler, name), 0.0);
  constexpr double kClampToEdge = 33071.0;
  constexpr double kMirroredRepeat = 33648.0;
  return mode == kClampToEdge      ? TextureWrap::Clamp
         : mode == kMirroredRepeat ? TextureWrap::Mirror
                                   : TextureWrap::Repeat;
}

/// The bytes of a buffer view; nothing if it leaves its buffer.
std::optional<std::string_view> view_bytes(const Json& root, const Json& index,
                                           const GltfDocument& document) {
  const Json& view = item(root, "bufferViews", index);
  const Json& buffer = member(view, "buffer");
  if (!buffer.is_number_unsigned() || buffer.get<std::size_t>() >= document.buffers.size()) {
    return std::nullopt;
  }
  const std::string_view bytes = *document.buffers[buffer.get<std::size_t>()];
  const Json& offset = member(view, "byteOffset");
  const Json& length = member(view, "byteLength");
  const std::size_t from = offset.is_number_unsigned() ? offset.get<std::size_t>() : 0;
  const std::size_t size = length.is_number_unsigned() ? length.get<std::size_t>() : 0;
  if (from > bytes.size() || size > bytes.size() - from) {
    return std::nullopt;
  }
  return bytes.substr(from, size);
}

class MaterialReader {
 public:
  MaterialReader(const Json& root, const GltfDocument& document, const Surroundings& surroundings,
                 ModelBuilder& builder)
      : root_(root), document_(document), loader_(surroundings, builder), textures_(loader_) {}

  void read(ModelBuilder& builder) {
    std::vector<Material> materials;
    const Json& list = member(root_, "materials");
    for (std::size_t m = 0; list.is_array() && m < list.size(); ++m) {
      materials.push_back(material(list[m]));
    }
    loader_.finish();
    builder.set_materials(std::move(materials), textures_.take());
  }

 private:
  Material material(const Json& source) {
    const ColourSource colour = colour_source(source);
    Material result;
    result.alpha = alpha_mode(source);
    result.opacity = share(colour.factor, 3, 1.0);
    result.alpha_cutoff = std::clamp(number(member(source, "alphaCutoff"), 0.5), 0.0, 1.0);
    result.unlit = extension(source, "KHR_materials_unlit").is_object();
    if (colour.texture.is_object()) {
      result.texture = texture(member(colour.texture, "index"));
    }
    result.uv_transform = uv_transform(leading_texture(source));
    if (!result.unlit) {
      set_emission(source, result);
    }
    return result;
  }

  /// Emission whose picture is missing, or lies otherwise than that of the colour, is left out: by its factor
  /// alone all would be bright. \pre result.uv_transform
  void set_emission(const Json& source, Material& result) {
    const Json& strengthened = extension(source, "KHR_materials_emissive_strength");
    const double strength = std::max(0.0, number(member(strengthened, "emissiveStrength"), 1.0));
    const Json& factor = member(source, "emissiveFactor");
    std::array<double, 3> emission{};
    for (std::size_t channel = 0; channel < 3; ++channel) {
      emission[channel] = std::min(1.0, strength * share(factor, channel, 0.0));
    }
    const Json& laid_on = member(source, "emissiveTexture");
    if (emission == std::array<double, 3>{}) {
      return;
    }
    if (laid_on.is_object()) {
      const bool lies_alike = texcoord_set(laid_on) == texcoord_set(leading_texture(source)) &&
                              uv_transform(laid_on) == result.uv_transform;
      if (!lies_alike) {
        loader_.complain("of an emission", "lies otherwise than that of the colour");
        return;
      }
      result.emission_texture = texture(member(laid_on, "index"));
      if (!result.emission_texture) {
        return;
      }
    }
    result.emission = emission;
  }

  /// Index among the textures that were read.
  std::optional<std::uint32_t> texture(const Json& index) {
    const Json& source = item(root_, "textures", index);
    if (!source.is_object()) {
      return std::nullopt;
    }
    const Json& plain = member(source, "source");
    const Json& webp = member(extension(source, "EXT_texture_webp"), "source");
    const Json& image_index = plain.is_number_unsigned() ? plain : webp;
    if (!image_index.is_number_unsigned() && complains_of_extension(source)) {
      return std::nullopt;
    }
    const Json& sampler = item(root_, "samplers", member(source, "sampler"));
    constexpr double kNearest = 9728.0;
    Texture way;
    way.wrap_u = wrap_of(sampler, "wrapS");
    way.wrap_v = wrap_of(sampler, "wrapT");
    way.nearest = number(member(sampler, "magFilter"), 0.0) == kNearest;
    const std::size_t number_of_image = item(root_, "images", image_index).is_object()
                                            ? image_index.get<std::size_t>()
                                            : std::numeric_limits<std::size_t>::max();
    return textures_.add(number_of_image, way, [&] { return picture(image_index); });
  }

  /// Whether the only image of a texture is one that an extension packs; if so, a note says it once.
  bool complains_of_extension(const Json& source) {
    const Json& extensions = member(source, "extensions");
    if (!extensions.is_object()) {
      return false;
    }
    for (const auto& [name, content] : extensions.items()) {
      const Json& index = member(content, "source");
      const Json& image = item(root_, "images", index);
      if (image.is_object()) {
        if (packed_.insert(&image).second) {
          loader_.complain("image " + std::to_string(index.get<std::size_t>()),
                           "is packed by " + in_quotes(name) +
                               ", which is not read; convert it to PNG or WebP, for example with "
                               "gltf-transform");
        }
        return true;
      }
    }
    return false;
  }

  std::optional<Image> picture(const Json& index) {
    const Json& image = item(root_, "images", index);
    if (!image.is_object()) {
      loader_.complain("of an unknown kind", "is not a PNG, JPEG or WebP");
      return std::nullopt;
    }
    const std::string label = "image " + std::to_string(index.get<std::size_t>());
    const Json& uri = member(image, "uri");
    if (!uri.is_string()) {
      const auto bytes = view_bytes(root_, member(image, "bufferView"), document_);
      if (!bytes) {
        loader_.complain(label, "is not in the file");
        return std::nullopt;
      }
      if (useless_.count(bytes->data()) > 0) {
        return std::nullopt;
      }
      std::optional<Image> image_there = loader_.embedded(*bytes, label);
      if (!image_there) {
        useless_.insert(bytes->data());
      }
      return image_there;
    }
    const auto& text = uri.get_ref<const std::string&>();
    if (is_data_uri(text)) {
      const std::optional<std::string> data = decode_data_uri(text);
      if (!data) {
        loader_.complain(label, "is not well formed base64 or percent-encoding");
        return std::nullopt;
      }
      return loader_.embedded(*data, label);
    }
    const std::optional<std::string> path = relative_path_of_uri(text);
    if (!path) {
      loader_.complain(label, "is not in the model's own folder");
      return std::nullopt;
    }
    return loader_.beside(*path);
  }

  const Json& root_;
  const GltfDocument& document_;
  TextureLoader loader_;
  TextureList textures_;
  std::set<const Json*> packed_{};   ///< Images that were complained of.
  std::set<const char*> useless_{};  ///< Where bytes of buffers begin that gave no picture.
};

}  // namespace

std::vector<std::array<double, 3>> gltf_base_colours(const Json& root) {
  std::vector<std::array<double, 3>> colours;
  const Json& list = member(root, "materials");
  for (std::size_t m = 0; list.is_array() && m < list.size(); ++m) {
    const Json& factor = colour_source(list[m]).factor;
    colours.push_back({share(factor, 0, 1.0), share(factor, 1, 1.0), share(factor, 2, 1.0)});
  }
  return colours;
}

std::vector<int> gltf_texcoord_sets(const Json& root) {
  std::vector<int> sets;
  const Json& list = member(root, "materials");
  for (std::size_t m = 0; list.is_array() && m < list.size(); ++m) {
    sets.push_back(texcoord_set(leading_texture(list[m])));
  }
  return sets;
}

std::vector<bool> gltf_counts_opacity(const Json& root) {
  std::vector<bool> counts;
  const Json& list = member(root, "materials");
  for (std::size_t m = 0; list.is_array() && m < list.size(); ++m) {
    counts.push_back(alpha_mode(list[m]) != AlphaMode::Opaque);
  }
  return counts;
}

void read_gltf_materials(const Json& root, const GltfDocument& document,
                         const Surroundings& surroundings, ModelBuilder& builder) {
  MaterialReader(root, document, surroundings, builder).read(builder);
}

}  // namespace vantage
