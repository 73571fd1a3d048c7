// SPDX-License-Identifier: MIT
// The one place that compiles tinygltf, without pictures and without file access.
#include <fstream>  // tinygltf names its types even so

#define TINYGLTF_IMPLEMENTATION
#define TINYGLTF_NO_STB_IMAGE
#define TINYGLTF_NO_STB_IMAGE_WRITE
#define TINYGLTF_NO_EXTERNAL_IMAGE
#define TINYGLTF_NO_FS
#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <set>
#include <utility>

#include <nlohmann/json.hpp>

#include "io/byte_cursor.h"
#include "io/gltf_compression.h"
#include "io/gltf_document.h"
#include "io/gltf_json.h"
#include "io/gltf_materials.h"
#include "io/gltf_uri.h"
#include "io/number_parsing.h"
#include "io/text_cursor.h"

namespace vantage {
namespace {

using Json = nlohmann::json;

/// Containers nested deeper than this are not read: the format itself needs 7 levels.
constexpr int kDeepestNesting = 64;

struct Chunks {
  std::string_view json;
  std::string_view binary;
  bool has_binary = false;
};

/// What to do with a file of another version: gltf-pipeline breaks down on drafts before 1.0.
std::string only_two(std::string_view version) {
  const bool is_one = version == "1" || version.starts_with("1.");
  return std::string(", only 2 is read; ") +
         (is_one ? "convert it with gltf-pipeline" : "export the model anew, as glTF 2");
}

/// Splits a GLB file.
Chunks glb_chunks(std::string_view bytes, ModelBuilder& builder) {
  constexpr std::size_t kHeaderBytes = 12;
  constexpr std::size_t kChunkHeaderBytes = 8;
  constexpr std::uint32_t kJsonChunk = 0x4E4F534A;
  constexpr std::uint32_t kBinaryChunk = 0x004E4942;
  const auto word = [&](std::size_t at) {
    return decode<std::uint32_t>(bytes.data() + at, ByteOrder::Little);
  };
  if (bytes.size() < kHeaderBytes + kChunkHeaderBytes) {
    builder.fail("the file is too short for a GLB");
  }
  if (word(4) != 2) {
    const std::string version = std::to_string(word(4));
    builder.fail({"byte", 4}, "is GLB version " + version + only_two(version));
  }
  if (word(8) > bytes.size()) {
    builder.fail({"byte", 8}, "the file should have " + std::to_string(word(8)) +
                                  " bytes but has " + std::to_string(bytes.size()));
  }
  if (bytes.size() > word(8)) {
    builder.note("bytes after the last chunk left out: " + std::to_string(bytes.size() - word(8)));
  }
  bytes = bytes.substr(0, word(8));
  Chunks chunks;
  for (std::size_t at = kHeaderBytes; at + kChunkHeaderBytes <= bytes.size();) {
    const std::size_t length = word(at);
    const std::uint32_t type = word(at + 4);
    const std::size_t begin = at + kChunkHeaderBytes;
    if (length > bytes.size() - begin) {
      builder.fail({"byte", at}, "a chunk reaches beyond the end of the file");
    }
    if (at == kHeaderBytes && type != kJsonChunk) {
      builder.fail({"byte", at}, "the first chunk is not JSON");
    }
    if (at == kHeaderBytes) {
      chunks.json = bytes.substr(begin, length);
    } else if (type == kBinaryChunk && !chunks.has_binary) {
      chunks.binary = bytes.substr(begin, length);
      chunks.has_binary = true;
    }
    at = begin + length;
  }
  return chunks;
}

/// Refuses text whose brackets nest too deeply for recursive code.
void check_nesting(std::string_view json, const ModelBuilder& builder) {
  int depth = 0;
  bool in_string = false;
  for (std::size_t i = 0; i < json.size(); ++i) {
    const char c = json[i];
    if (in_string) {
      i += c == '\\' ? 1 : 0;
      in_string = c != '"';
    } else if (c == '"') {
      in_string = true;
    } else if (c == '[' || c == '{') {
      ++depth;
    } else if (c == ']' || c == '}') {
      --depth;
    }
    if (depth > kDeepestNesting) {
      builder.fail({"byte", i}, "the JSON is nested deeper than " +
                                    std::to_string(kDeepestNesting) +
                                    " levels, the most that are read");
    }
  }
}

Json parse_json(std::string_view text, const ModelBuilder& builder) {
  check_nesting(text, builder);
  try {
    Json json = Json::parse(text.begin(), text.end());
    if (json.is_object()) {
      return json;
    }
  } catch (const Json::parse_error& error) {
    builder.fail({"byte", error.byte}, "the JSON is not well formed");
  } catch (const Json::exception&) {
    builder.fail("the JSON holds a number that is too large");
  }
  builder.fail("the JSON is not an object");
}

bool names(const Json& root, const char* list, std::string_view extension) {
  const auto found = root.find(list);
  return found != root.end() && found->is_array() &&
         std::any_of(found->begin(), found->end(), [&](const Json& entry) {
           return entry.is_string() && entry.get_ref<const std::string&>() == extension;
         });
}

/// Whether the file is read as it should be in spite of an extension that it needs. Materials only look
/// otherwise without one.
bool is_read_extension(std::string_view extension) {
  constexpr std::array<std::string_view, 9> kRead{
      "KHR_draco_mesh_compression", "EXT_meshopt_compression", "KHR_mesh_quantization",
      "KHR_texture_transform",      "EXT_texture_webp",        "KHR_texture_basisu",
      "KHR_lights_punctual",        "KHR_node_visibility",     "EXT_mesh_gpu_instancing"};
  return extension.starts_with("KHR_materials_") ||
         std::find(kRead.begin(), kRead.end(), extension) != kRead.end();
}

void note_unread_extensions(const Json& root, ModelBuilder& builder) {
  const auto list = root.find("extensionsRequired");
  if (list == root.end() || !list->is_array()) {
    return;
  }
  std::set<std::string> unread;
  for (const Json& entry : *list) {
    if (entry.is_string() && !is_read_extension(entry.get_ref<const std::string&>())) {
      unread.insert(entry.get<std::string>());
    }
  }
  constexpr std::size_t kMostNotes = 5;  // [ours] the rest would say nothing new
  std::size_t told = 0;
  for (const std::string& extension : unread) {
    if (told++ < kMostNotes) {
      builder.note("needs the extension " + in_quotes(extension) +
                   ", which is not read: what it changes is not shown");
    }
  }
}

/// Nodes that KHR_node_visibility hides, with all below them.
std::vector<bool> hidden_nodes(const Json& root) {
  std::vector<bool> hidden;
  const auto nodes = root.find("nodes");
  if (nodes == root.end() || !nodes->is_array()) {
    return hidden;
  }
  for (const Json& node : *nodes) {
    const Json extension =
        node.is_object() && node.contains("extensions") && node["extensions"].is_object()
            ? node["extensions"].value("KHR_node_visibility", Json())
            : Json();
    hidden.push_back(extension.is_object() && extension.value("visible", Json(true)) == false);
  }
  return hidden;
}

/// Whether one of a list's entries weighs a morph target.
bool is_morphed(const Json& root, const char* list) {
  const auto found = root.find(list);
  return found != root.end() && found->is_array() &&
         std::any_of(found->begin(), found->end(), [](const Json& entry) {
           const auto weights = entry.is_object() ? entry.find("weights") : entry.end();
           return weights != entry.end() && weights->is_array() &&
                  std::any_of(weights->begin(), weights->end(), [](const Json& weight) {
                    return weight.is_number() && weight.get<double>() != 0.0;
                  });
         });
}

void check_extensions(const Json& root, ModelBuilder& builder) {
  if (names(root, "extensionsRequired", "KHR_meshopt_compression")) {
    builder.fail(
        "needs the extension KHR_meshopt_compression, which is not read; pack it again with "
        "EXT_meshopt_compression (gltfpack -c), or unpack it, with gltf-transform copy IN.glb "
        "OUT.glb");
  }
  if (names(root, "extensionsUsed", "EXT_mesh_gpu_instancing")) {
    builder.note("EXT_mesh_gpu_instancing is not read: one instance of each mesh is shown");
  }
  note_unread_extensions(root, builder);
  if (root.contains("skins")) {
    builder.note("skinned meshes are shown as their joints stand in the file, without animation");
  }
  if (is_morphed(root, "meshes") || is_morphed(root, "nodes")) {
    builder.note("morph targets are left out: meshes are shown as they are without them");
  }
}

void check_version(const Json& root, const ModelBuilder& builder) {
  const auto asset = root.find("asset");
  const bool has_asset = asset != root.end() && asset->is_object();
  const auto version = has_asset ? asset->find("version") : asset;
  if (has_asset && version != asset->end() && version->is_number()) {  // of drafts
    const std::string number = version->dump();
    builder.fail("is glTF version " + number + only_two(number));
  }
  if (!has_asset || version == asset->end() || !version->is_string()) {
    // Lists of 2.0 were objects in 1.0, keyed by names.
    if (root.contains("accessors") && root["accessors"].is_object()) {
      builder.fail("is glTF 1.0" + only_two("1.0"));
    }
    builder.fail("the JSON has no asset.version, which every glTF has");
  }
  const auto& text = version->get_ref<const std::string&>();
  if (text != "2" && !text.starts_with("2.")) {
    builder.fail("is glTF version " + in_quotes(text) + only_two(text));
  }
  const Json least = asset->value("minVersion", Json());
  if (least.is_string() && number_from(least.get_ref<const std::string&>()).value_or(2.0) > 2.0) {
    builder.fail("needs glTF version " + in_quotes(least.get_ref<const std::string&>()) +
                 ", only 2.0 is read");
  }
}

SharedBytes shared(std::string bytes) {
  return std::make_shared<const std::string>(std::move(bytes));
}

SharedBytes read_buffer(const Json& buffer, std::size_t index, const Chunks& chunks,
                        const BufferSource& source, const ModelBuilder& builder) {
  const std::string label = "buffer " + std::to_string(index);
  if (is_fallback_buffer(buffer)) {
    return shared({});
  }
  const auto entry = buffer.is_object() ? buffer.find("uri") : buffer.end();
  if (!buffer.is_object() || entry == buffer.end()) {
    return shared(index == 0 && chunks.has_binary ? std::string(chunks.binary) : std::string());
  }
  if (!entry->is_string()) {
    builder.fail("the URI of " + label + " is not text");
  }
  const auto& uri = entry->get_ref<const std::string&>();
  if (is_data_uri(uri)) {
    std::optional<std::string> data = decode_data_uri(uri);
    if (!data) {
      builder.fail("the data URI of " + label + " is not well formed base64 or percent-encoding");
    }
    return shared(std::move(*data));
  }
  const std::optional<std::string> path = relative_path_of_uri(uri);
  if (!path) {
    builder.fail(label + " is at " + in_quotes(uri) +
                 ", but only files in the model's own folder "
                 "are read");
  }
  if (!source) {
    builder.fail(label + " is the file " + in_quotes(uri) +
                 ", which cannot be found without the model's folder; name the model by its path");
  }
  return source(*path);
}

/// Reads the buffers. Those that are one file share its bytes, which count once.
void read_buffers(const Json& root, const Chunks& chunks, const BufferSource& source,
                  const ModelBuilder& builder, GltfDocument& document) {
  const auto list = root.find("buffers");
  if (list == root.end() || !list->is_array()) {
    return;
  }
  std::set<const std::string*> known;
  for (std::size_t i = 0; i < list->size(); ++i) {
    document.buffers.push_back(read_buffer((*list)[i], i, chunks, source, builder));
    const SharedBytes& bytes = document.buffers.back();
    document.total_bytes += known.insert(bytes.get()).second ? bytes->size() : 0;
  }
}

/// Whether tinygltf would take it as the index of something.
bool is_index(const Json& value) {
  return value.is_number_unsigned() &&
         value.get<std::uint64_t>() <= std::uint64_t{std::numeric_limits<std::int32_t>::max()};
}

/// What the extras of a primitive say besides its number.
constexpr const char* kPrimitiveIndices = "indices";
constexpr const char* kPrimitiveTargets = "targets";

/// Leaves their extensions out, but not which of them each one is. The accessor of the indices goes to the
/// extras: tinygltf takes one without a buffer view for invalid, which packed, sparse and zero ones may be.
void number_primitives(Json& primitives, std::size_t& number) {
  for (Json& primitive : primitives) {
    if (primitive.is_object()) {
      primitive["extras"] = {{kPrimitiveNumber, number}};
      const Json& targets = member(primitive, "targets");
      if (targets.is_array() && !targets.empty()) {
        primitive["extras"][kPrimitiveTargets] = 1;
      }
      const Json& indices = member(primitive, "indices");
      const bool is_packed = is_packed_primitive(primitive);
      if (is_packed || is_index(indices)) {
        if (!is_packed) {
          primitive["extras"][kPrimitiveIndices] = indices;
        }
        primitive.erase("indices");
      }
      primitive.erase("extensions");
      primitive.erase("targets");
    }
    ++number;
  }
}

/// Copies what describes geometry and leaves out what tinygltf would walk recursively or load.
Json geometry_only(const Json& root) {
  Json kept = Json::object();
  std::size_t primitives = 0;
  kept["asset"] = {{"version", "2.0"}};
  for (const char* const member :
       {"scene", "scenes", "nodes", "meshes", "skins", "accessors", "bufferViews"}) {
    const auto found = root.find(member);
    if (found == root.end()) {
      continue;
    }
    primitives = 0;  // a malformed file may have some outside its meshes
    Json value = *found;
    for (Json& item : value) {
      if (item.is_object()) {
        item.erase("extras");
        item.erase("extensions");
      }
      if (item.is_object() && item.contains("primitives")) {
        number_primitives(item["primitives"], primitives);
      }
    }
    kept[member] = std::move(value);
  }
  return kept;
}

tinygltf::Model parse_structure(const Json& root, const ModelBuilder& builder) {
  tinygltf::Model model;
  std::string error;
  std::string warning;
  bool done = false;
  try {
    const std::string text = geometry_only(root).dump();
    if (text.size() > std::numeric_limits<unsigned>::max()) {
      builder.fail("the JSON is larger than 4 GB");
    }
    tinygltf::TinyGLTF loader;
    done = loader.LoadASCIIFromString(&model, &error, &warning, text.data(),
                                      static_cast<unsigned>(text.size()), "");
  } catch (const Json::exception&) {
    done = false;
  }
  if (!done) {
    const std::string_view first = TextCursor(error).next_line().value_or("");
    builder.fail("is not valid glTF: " +
                 std::string(first.empty() ? "a value has a wrong type" : trimmed(first)));
  }
  for (tinygltf::Mesh& mesh : model.meshes) {
    for (tinygltf::Primitive& primitive : mesh.primitives) {
      const tinygltf::Value& indices = primitive.extras.Get(kPrimitiveIndices);
      primitive.indices = indices.IsInt() ? indices.GetNumberAsInt() : primitive.indices;
    }
  }
  return model;
}

}  // namespace

bool is_morphed_primitive(const tinygltf::Primitive& primitive) {
  return primitive.extras.Has(kPrimitiveTargets);
}

GltfDocument read_gltf_document(std::string_view bytes, const Surroundings& surroundings,
                                ModelBuilder& builder) {
  constexpr std::string_view kMagic = "glTF";
  const Chunks chunks = bytes.substr(0, kMagic.size()) == kMagic
                            ? glb_chunks(bytes, builder)
                            : Chunks{without_bom(bytes), {}, false};
  const Json root = parse_json(chunks.json, builder);
  check_version(root, builder);
  check_extensions(root, builder);
  GltfDocument document;
  document.structure = parse_structure(root, builder);
  document.hidden_nodes = hidden_nodes(root);
  document.base_colours = gltf_base_colours(root);
  document.texcoord_sets = gltf_texcoord_sets(root);
  document.counts_opacity = gltf_counts_opacity(root);
  document.total_bytes = bytes.size();
  read_buffers(root, chunks, surroundings.buffers, builder, document);
  unpack_gltf(root, document, builder);
  if (builder.keeps_appearance()) {
    read_gltf_materials(root, document, surroundings, builder);
  }
  return document;
}

}  // namespace vantage
