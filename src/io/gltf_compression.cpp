// SPDX-License-Identifier: MIT
#include "io/gltf_compression.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <meshoptimizer.h>
#include <nlohmann/json.hpp>

#include "core/parallel.h"
#include "io/draco_mesh.h"
#include "io/gltf_accessor.h"
#include "io/gltf_json.h"

namespace vantage {
namespace {

using Json = nlohmann::json;

constexpr const char* kMeshopt = "EXT_meshopt_compression";
constexpr const char* kDraco = "KHR_draco_mesh_compression";

/// Bytes that may be unpacked for each byte of the file: what meshopt's codec reaches on nothing but
/// zeros (256 vertices of a column in 4 bytes) …
constexpr std::size_t kMostBytesPerByte = 64;
/// … and in any case, room for a million corners. [ours]
constexpr std::size_t kMostBytesOfSmallFile = 16'000'000;

/// A member that counts something; `otherwise` if it is not there, nothing if it is no such number.
std::optional<std::size_t> count(const Json& object, const char* name,
                                 std::optional<std::size_t> otherwise = std::nullopt) {
  const Json& value = member(object, name);
  if (value.is_null()) {
    return otherwise;
  }
  return value.is_number_unsigned() ? std::optional(value.get<std::size_t>()) : std::nullopt;
}

std::string text(const Json& object, const char* name, const char* otherwise) {
  const Json& value = member(object, name);
  return value.is_string() ? value.get<std::string>() : otherwise;
}

/// A run of packed bytes and what becomes of it.
struct PackedView {
  std::string_view bytes{};
  std::size_t count = 0;
  std::size_t stride = 0;
};

/// What meshopt's decoders require of their arguments; they trust them.
bool decode_meshopt(const PackedView& packed, const std::string& mode, std::string& out) {
  const auto* const from = reinterpret_cast<const unsigned char*>(packed.bytes.data());
  const bool is_index = packed.stride == 2 || packed.stride == 4;
  constexpr std::size_t kLargestVertex = 256;
  if (mode == "ATTRIBUTES" && packed.stride % 4 == 0 && packed.stride > 0 &&
      packed.stride <= kLargestVertex) {
    out.resize(packed.count * packed.stride);
    return meshopt_decodeVertexBuffer(out.data(), packed.count, packed.stride, from,
                                      packed.bytes.size()) == 0;
  }
  if (mode == "TRIANGLES" && is_index && packed.count % 3 == 0) {
    out.resize(packed.count * packed.stride);
    return meshopt_decodeIndexBuffer(out.data(), packed.count, packed.stride, from,
                                     packed.bytes.size()) == 0;
  }
  if (mode == "INDICES" && is_index) {
    out.resize(packed.count * packed.stride);
    return meshopt_decodeIndexSequence(out.data(), packed.count, packed.stride, from,
                                       packed.bytes.size()) == 0;
  }
  return false;
}

/// Undoes what was done to the numbers before they were packed.
bool filter_meshopt(const PackedView& packed, const std::string& filter, std::string& out) {
  if (filter == "NONE") {
    return true;
  }
  if (filter == "OCTAHEDRAL" && (packed.stride == 4 || packed.stride == 8)) {
    meshopt_decodeFilterOct(out.data(), packed.count, packed.stride);
    return true;
  }
  if (filter == "QUATERNION" && packed.stride == 8) {
    meshopt_decodeFilterQuat(out.data(), packed.count, packed.stride);
    return true;
  }
  if (filter == "EXPONENTIAL" && packed.stride % 4 == 0) {
    meshopt_decodeFilterExp(out.data(), packed.count, packed.stride);
    return true;
  }
  return false;
}

class Unpacker {
 public:
  Unpacker(const Json& root, GltfDocument& document, const ModelBuilder& builder)
      : root_(root),
        document_(document),
        gltf_(document.structure),
        builder_(builder),
        bytes_left_(kMostBytesOfSmallFile + kMostBytesPerByte * document.total_bytes) {}

  void unpack_views() {
    const Json& views = member(root_, "bufferViews");
    const std::size_t in_json = views.is_array() ? views.size() : 0;
    for (std::size_t v = 0; v < std::min(gltf_.bufferViews.size(), in_json); ++v) {
      const Json& packed = extension(views[v], kMeshopt);
      if (!packed.is_null()) {
        unpack_view(v, packed);
      }
    }
  }

  void unpack_primitives() {
    const std::vector<const Json*> packs = packs_of_primitives();
    for (tinygltf::Mesh& mesh : gltf_.meshes) {
      for (tinygltf::Primitive& primitive : mesh.primitives) {
        const tinygltf::Value& number = primitive.extras.Get(kPrimitiveNumber);
        const auto p = static_cast<std::size_t>(number.IsInt() ? number.GetNumberAsInt() : -1);
        if (p < packs.size() && !packs[p]->is_null()) {
          unpack_primitive(primitive, *packs[p]);
        }
      }
    }
  }

 private:
  /// Of every primitive of the file what Draco packed, kNoJson where it is plain.
  [[nodiscard]] std::vector<const Json*> packs_of_primitives() const {
    std::vector<const Json*> packs;
    for (const Json& mesh : member(root_, "meshes")) {
      for (const Json& primitive : member(mesh, "primitives")) {
        packs.push_back(&extension(primitive, kDraco));
      }
    }
    return packs;
  }

  [[noreturn]] void fail(const std::string& who, const std::string& problem) const {
    builder_.fail(who + " " + problem + "; pack the model again, or unpack it with gltf-transform");
  }

  /// Takes room for what is unpacked next.
  void spend(std::size_t bytes, const std::string& who) {
    if (bytes > bytes_left_) {
      fail(who, "would unpack to more than the size of the file allows");
    }
    bytes_left_ -= bytes;
    document_.unpacked_bytes += bytes;
  }

  /// Bytes [offset, offset + length) of a buffer.
  [[nodiscard]] std::string_view bytes_of(std::optional<std::size_t> buffer,
                                          std::optional<std::size_t> offset,
                                          std::optional<std::size_t> length,
                                          const std::string& who) const {
    if (!buffer || !offset || !length || *buffer >= document_.buffers.size()) {
      fail(who, "does not say where its packed bytes are");
    }
    const std::string_view bytes = *document_.buffers[*buffer];
    if (*offset > bytes.size() || *length > bytes.size() - *offset) {
      fail(who, "has packed bytes that reach beyond their buffer");
    }
    return bytes.substr(*offset, *length);
  }

  void unpack_view(std::size_t v, const Json& json) {
    const std::string who = "buffer view " + std::to_string(v);
    PackedView packed;
    packed.bytes = bytes_of(count(json, "buffer"), count(json, "byteOffset", 0),
                            count(json, "byteLength"), who);
    packed.count = count(json, "count").value_or(0);
    packed.stride = count(json, "byteStride").value_or(0);
    constexpr std::size_t kLargestCount = std::size_t{1} << 40U;  // products stay in range
    if (packed.count > kLargestCount || packed.stride > kLargestCount) {
      fail(who, "would unpack to more than the size of the file allows");
    }
    spend(packed.count * packed.stride, who);
    std::string out;
    if (!decode_meshopt(packed, text(json, "mode", ""), out)) {
      fail(who, "is packed by EXT_meshopt_compression, but its packed bytes are damaged");
    }
    if (!filter_meshopt(packed, text(json, "filter", "NONE"), out)) {
      fail(who, "has a filter of EXT_meshopt_compression that is not known");
    }
    tinygltf::BufferView& view = gltf_.bufferViews[v];
    view.byteLength = out.size();
    view.byteOffset = 0;
    view.buffer = static_cast<int>(document_.buffers.size());
    document_.buffers.push_back(std::make_shared<const std::string>(std::move(out)));
  }

  void unpack_primitive(tinygltf::Primitive& primitive, const Json& json) {
    const std::string who = "a primitive packed by KHR_draco_mesh_compression";
    const auto index = count(json, "bufferView").value_or(gltf_.bufferViews.size());
    if (index >= gltf_.bufferViews.size()) {
      fail(who, "does not say where its packed bytes are");
    }
    const tinygltf::BufferView& view = gltf_.bufferViews[index];
    const std::string_view bytes =
        bytes_of(static_cast<std::size_t>(view.buffer), view.byteOffset, view.byteLength, who);
    std::vector<int*> places;
    std::vector<DracoAttribute> wanted;
    for (auto& [name, accessor] : primitive.attributes) {
      const auto id = count(member(json, "attributes"), name.c_str());
      const bool is_used = name == "POSITION" || name == "COLOR_0" ||
                           name.starts_with("TEXCOORD_") || name.starts_with("JOINTS_") ||
                           name.starts_with("WEIGHTS_");
      if (id && is_used) {
        wanted.push_back(wish(static_cast<std::uint32_t>(*id), accessor, who));
        places.push_back(&accessor);
      }
    }
    const Unpacked& mesh = unpacked(index, bytes, wanted, who);
    for (std::size_t i = 0; i < wanted.size(); ++i) {
      const tinygltf::Accessor declared = gltf_.accessors[static_cast<std::size_t>(*places[i])];
      *places[i] = append(mesh.attributes[i], declared, mesh.points);
    }
    tinygltf::Accessor corners;
    corners.componentType = TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
    corners.type = TINYGLTF_TYPE_SCALAR;
    primitive.indices = append(mesh.corners, corners, mesh.corner_count);
    primitive.mode = TINYGLTF_MODE_TRIANGLES;  // whatever it was before it was packed
  }

  /// What a stream holds, in buffers of the document.
  struct Unpacked {
    std::vector<std::size_t> attributes{};
    std::size_t points = 0;
    std::size_t corners = 0;
    std::size_t corner_count = 0;
  };

  /// Primitives may share a stream: it is unpacked once for each choice of what it holds.
  const Unpacked& unpacked(std::size_t view, std::string_view bytes,
                           const std::vector<DracoAttribute>& wanted, const std::string& who) {
    std::vector<std::size_t> key{view};
    for (const DracoAttribute& wish : wanted) {
      key.insert(key.end(), {wish.id, static_cast<std::size_t>(wish.component_type),
                             static_cast<std::size_t>(wish.components)});
    }
    const auto [place, is_new] = unpacked_.try_emplace(std::move(key));
    Unpacked& result = place->second;
    if (is_new) {
      // Many choices take their time, however little each gives.
      if (bytes.size() > bytes_left_) {
        fail(who, "would unpack to more than the size of the file allows");
      }
      bytes_left_ -= bytes.size();
      DracoMesh mesh = unpack(bytes, wanted);
      if (!mesh.problem.empty()) {
        fail(who, mesh.problem);
      }
      for (std::string& attribute : mesh.attributes) {
        result.attributes.push_back(keep(std::move(attribute), who));
      }
      result.points = mesh.points;
      result.corner_count = mesh.corners.size() / sizeof(std::uint32_t);
      result.corners = keep(std::move(mesh.corners), who);
    }
    return result;
  }

  /// Draco never asks whether to go on, so it works on a copy that it may be left behind with.
  [[nodiscard]] DracoMesh unpack(std::string_view bytes,
                                 const std::vector<DracoAttribute>& wanted) const {
    struct Job {
      std::string bytes;
      std::vector<DracoAttribute> wanted;
      std::size_t most_bytes;
      DracoMesh mesh{};
    };

    const auto job = std::make_shared<Job>(Job{std::string(bytes), wanted, bytes_left_});
    interruptible(builder_.run(),
                  [job] { job->mesh = unpack_draco(job->bytes, job->wanted, job->most_bytes); });
    return std::move(job->mesh);
  }

  [[nodiscard]] DracoAttribute wish(std::uint32_t id, int accessor, const std::string& who) const {
    if (accessor < 0 || static_cast<std::size_t>(accessor) >= gltf_.accessors.size()) {
      fail(who, "names an accessor that does not exist");
    }
    const tinygltf::Accessor& declared = gltf_.accessors[static_cast<std::size_t>(accessor)];
    return {id, declared.componentType, gltf_component_count(declared.type)};
  }

  /// \return the number of the buffer that the bytes become
  std::size_t keep(std::string bytes, const std::string& who) {
    spend(bytes.size(), who);
    document_.buffers.push_back(std::make_shared<const std::string>(std::move(bytes)));
    return document_.buffers.size() - 1;
  }

  /// Appends a view and an accessor of all numbers in a buffer. \return the accessor
  int append(std::size_t buffer, tinygltf::Accessor accessor, std::size_t elements) {
    tinygltf::BufferView view;
    view.buffer = static_cast<int>(buffer);
    view.byteOffset = 0;
    view.byteLength = document_.buffers[buffer]->size();
    view.byteStride = 0;
    accessor.bufferView = static_cast<int>(gltf_.bufferViews.size());
    accessor.byteOffset = 0;
    accessor.count = elements;
    accessor.sparse.isSparse = false;
    gltf_.bufferViews.push_back(view);
    gltf_.accessors.push_back(std::move(accessor));
    return static_cast<int>(gltf_.accessors.size()) - 1;
  }

  const Json& root_;
  GltfDocument& document_;
  tinygltf::Model& gltf_;
  const ModelBuilder& builder_;
  std::size_t bytes_left_;
  std::map<std::vector<std::size_t>, Unpacked> unpacked_{};  ///< By view and attributes.
};

}  // namespace

bool is_fallback_buffer(const Json& buffer) {
  const Json& fallback = member(extension(buffer, kMeshopt), "fallback");
  return fallback.is_boolean() && fallback.get<bool>();
}

bool is_packed_primitive(const Json& primitive) {
  return !extension(primitive, kDraco).is_null();
}

void unpack_gltf(const Json& root, GltfDocument& document, const ModelBuilder& builder) {
  Unpacker unpacker(root, document, builder);
  unpacker.unpack_views();
  unpacker.unpack_primitives();
}

}  // namespace vantage
