// SPDX-License-Identifier: MIT
// A glTF that is put together from its parts, which name each other, share, or are not there: the same
// model as JSON with files beside it and as GLB, faces that are counted before they are made, or a
// FormatError.
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>

#include "vantage/core/error.h"
#include "vantage/io/model.h"
#include "vantage/io/write.h"

#include "choices.h"
#include "io/byte_cursor.h"
#include "io/readers.h"
#include "sound_model.h"

namespace {

/// Parts of a document, made in the order in which they can name each other.
class GltfDraft {
 public:
  explicit GltfDraft(Choices& choices) : choices_(choices) {
    accessors_ = list(1 + choices_.below(4), [&] { return accessor(); });
    mesh_count_ = 1 + choices_.below(3);
    meshes_ = list(mesh_count_, [&] { return mesh(); });
    node_count_ = 1 + choices_.below(6);
    nodes_ = list(node_count_, [&] { return node(); });
    scene_ = choices_.once_in(4)
                 ? ""
                 : R"("scene":)" + choices_.index(1) + R"(,"scenes":[{"nodes":)" +
                       list(1 + choices_.below(3), [&] { return choices_.index(node_count_); }) +
                       "}],";
    materials_ = list(choices_.below(3), [&] { return material(); });
    for (std::string& bytes : buffers_) {
      bytes.resize((bytes.size() + 3) / 4 * 4);  // as a GLB has to
    }
  }

  /// \param buffers the list of them, as JSON
  [[nodiscard]] std::string json(const std::string& buffers) const {
    return R"({"asset":{"version":"2.0"},)" + scene_ + R"("nodes":)" + nodes_ + R"(,"meshes":)" +
           meshes_ + R"(,"accessors":)" + accessors_ + R"(,"bufferViews":[)" + views_ +
           R"(],"materials":)" + materials_ +
           R"(,"textures":[{"source":0}],"images":[{"bufferView":0,"mimeType":"image/png"}],"buffers":)" +
           buffers + "}";
  }

  /// The bytes of buffer 0 or 1.
  [[nodiscard]] const std::string& buffer(std::size_t b) const { return buffers_[b]; }

 private:
  static constexpr int kByte = 5120;
  static constexpr int kFloat = 5126;

  template <class Item>
  static std::string list(std::size_t count, const Item& item) {
    std::string text = "[";
    for (std::size_t i = 0; i < count; ++i) {
      text += (i == 0 ? "" : ",") + item();
    }
    return text + "]";
  }

  /// A member that is there once in `count` times.
  std::string seldom(std::size_t count, const std::string& member) {
    return choices_.once_in(count) ? "," + member : "";
  }

  /// Appends numbers to a buffer. \return the place of their bufferView
  std::string view(std::size_t numbers, int component_type) {
    const std::size_t b = choices_.below(2);
    const std::size_t begin = buffers_[b].size();
    for (std::size_t i = 0; i < numbers; ++i) {
      if (component_type == kFloat) {
        constexpr std::array<float, 8> kValues{0.0F, 1.0F, 2.0F, -1.0F, 0.5F, 1e30F, 1e-30F, -3.0F};
        vantage::append_little_endian(buffers_[b], choices_.of(kValues));
      } else {
        constexpr std::size_t kBytes[] = {1, 1, 2, 2, 4, 4};  // from 5120 on
        buffers_[b] += static_cast<char>(choices_.below(4));
        buffers_[b].append(kBytes[component_type - kByte] - 1, '\0');
      }
    }
    const std::size_t length = buffers_[b].size() - begin;
    views_ += (view_count_ == 0 ? "" : ",") + std::string(R"({"buffer":)") +
              (choices_.once_in(64) ? choices_.index(2) : std::to_string(b)) + R"(,"byteOffset":)" +
              (choices_.once_in(64) ? choices_.index(64) : std::to_string(begin)) +
              R"(,"byteLength":)" +
              (choices_.once_in(64) ? choices_.index(200) : std::to_string(length)) +
              (choices_.once_in(16) ? R"(,"byteStride":)" + choices_.index(256) : "") +
              (choices_.once_in(64) ? packed_view() : "") + "}";
    return std::to_string(view_count_++);
  }

  std::string packed_view() {
    constexpr std::array<const char*, 3> kModes{"ATTRIBUTES", "TRIANGLES", "INDICES"};
    return R"(,"extensions":{"EXT_meshopt_compression":{"buffer":)" + choices_.index(2) +
           R"(,"byteLength":)" + choices_.index(64) + R"(,"byteStride":)" + choices_.index(32) +
           R"(,"count":)" + choices_.index(16) + R"(,"mode":")" + choices_.of(kModes) + R"("}})";
  }

  std::string accessor() {
    struct Kind {
      const char* type;
      std::size_t components;
      int component_type;
    };

    constexpr std::array<Kind, 8> kKinds{{{"VEC3", 3, kFloat},
                                          {"SCALAR", 1, 5121},
                                          {"SCALAR", 1, 5123},
                                          {"SCALAR", 1, 5125},
                                          {"VEC4", 4, 5121},
                                          {"VEC2", 2, kFloat},
                                          {"VEC3", 3, 5122},
                                          {"MAT4", 16, kFloat}}};
    const Kind kind = choices_.of(kKinds);
    const std::size_t count = 3 * (1 + choices_.below(4));
    const std::string place = choices_.once_in(32) && view_count_ > 0
                                  ? choices_.index(view_count_)
                                  : view(count * kind.components, kind.component_type);
    ++accessor_count_;
    return R"({"bufferView":)" + place + R"(,"componentType":)" +
           std::to_string(kind.component_type) + R"(,"type":")" + kind.type + R"(","count":)" +
           (choices_.once_in(64) ? choices_.index(64) : std::to_string(count)) +
           seldom(8, R"("normalized":true)") + seldom(32, R"("byteOffset":)" + choices_.index(32)) +
           (choices_.once_in(16) ? sparse() : "") + "}";
  }

  std::string sparse() {
    const std::string indices = view(2, 5121);
    return R"(,"sparse":{"count":)" + choices_.index(4) + R"(,"indices":{"bufferView":)" + indices +
           R"(,"componentType":5121},"values":{"bufferView":)" + view(6, kFloat) + "}}";
  }

  std::string mesh() {
    return R"({"name":"m","primitives":)" +
           list(1 + choices_.below(2), [&] { return primitive(); }) + "}";
  }

  std::string primitive() {
    constexpr std::array<const char*, 9> kModes{"4", "4", "5", "6", "0", "1", "4", "7", "-1"};
    std::string text = R"({"attributes":{"POSITION":)" +
                       (choices_.once_in(16) ? choices_.index(accessor_count_) : "0");
    for (const char* const name : {"COLOR_0", "TEXCOORD_0"}) {
      text += choices_.once_in(6)
                  ? std::string(",\"") + name + "\":" + choices_.index(accessor_count_)
                  : "";
    }
    text += "}";
    text += choices_.below(3) == 1 ? R"(,"indices":)" + choices_.index(accessor_count_) : "";
    text += std::string(R"(,"mode":)") + choices_.of(kModes);
    text += choices_.once_in(4) ? R"(,"material":)" + choices_.index(2) : "";
    text += choices_.once_in(64)
                ? R"(,"extensions":{"KHR_draco_mesh_compression":{"bufferView":)" +
                      choices_.index(view_count_) + R"(,"attributes":{"POSITION":0}}})"
                : "";
    return text + "}";
  }

  std::string node() {
    std::string text = R"({"name":"n")";
    text += choices_.once_in(4) ? "" : R"(,"mesh":)" + choices_.index(mesh_count_);
    // A child of a later place mostly, so that few are their own ancestors.
    ++nodes_begun_;
    const std::size_t later = node_count_ - nodes_begun_;
    if (const std::size_t children = choices_.below(3); children > 0 && later > 0) {
      text += R"(,"children":)" + list(children, [&] {
                return choices_.once_in(64) ? choices_.index(node_count_)
                                            : std::to_string(nodes_begun_ + choices_.below(later));
              });
    }
    const auto numbers = [&](std::size_t count) {
      return list(count, [&] {
        return choices_.once_in(64) ? "1e200" : std::to_string(choices_.below(4)) + ".5";
      });
    };
    constexpr std::array<const char*, 6> kMoves{"",         "",      "translation",
                                                "rotation", "scale", "matrix"};
    constexpr std::array<std::size_t, 6> kCounts{0, 0, 3, 4, 3, 16};
    const std::size_t move = choices_.below(kMoves.size());
    if (kCounts[move] > 0) {
      text += std::string(",\"") + kMoves[move] +
              "\":" + numbers(kCounts[move] - (choices_.once_in(64) ? 1 : 0));
    }
    return text + "}";
  }

  std::string material() {
    constexpr std::array<const char*, 4> kModes{"OPAQUE", "MASK", "BLEND", "?"};
    return R"({"alphaMode":")" + std::string(choices_.of(kModes)) +
           R"(","pbrMetallicRoughness":{"baseColorFactor":[1,0.5,)" +
           std::to_string(choices_.below(3)) + R"(,1],"baseColorTexture":{"index":)" +
           choices_.index(1) + "}}}";
  }

  Choices& choices_;
  std::array<std::string, 2> buffers_{};
  std::string views_{};
  std::size_t view_count_ = 0;
  std::size_t accessor_count_ = 0;
  std::size_t mesh_count_ = 0;
  std::size_t node_count_ = 0;
  std::size_t nodes_begun_ = 0;
  std::string accessors_{};
  std::string meshes_{};
  std::string nodes_{};
  std::string scene_{};
  std::string materials_{};
};

std::string glb_of(const GltfDraft& draft) {
  const std::string second = vantage::base64(draft.buffer(1));
  std::string json =
      draft.json(R"([{"byteLength":1},{"byteLength":1,"uri":"data:;base64,)" + second + R"("}])");
  json.resize((json.size() + 3) / 4 * 4, ' ');
  const auto word = [](std::size_t number) {
    std::string bytes;
    vantage::append_little_endian(bytes, static_cast<std::uint32_t>(number));
    return bytes;
  };
  const std::string& binary = draft.buffer(0);
  return "glTF" + word(2) + word(28 + json.size() + binary.size()) + word(json.size()) + "JSON" +
         json + word(binary.size()) + std::string("BIN\0", 4) + binary;
}

vantage::SharedBytes gltf_buffer(const GltfDraft& draft, const std::string& path) {
  if (path != "0.bin" && path != "1.bin") {
    throw vantage::IoError(path, "is not there", 2);
  }
  return std::make_shared<const std::string>(draft.buffer(path == "0.bin" ? 0 : 1));
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Choices choices(data, size);
  const GltfDraft draft(choices);
  const auto read = [&](const std::string& bytes, std::size_t most_faces) {
    const vantage::ReadOptions options{.appearance = true, .max_faces = most_faces};
    const auto buffers = [&](const std::string& path) { return gltf_buffer(draft, path); };
    return vantage::parse_gltf(bytes, "fuzz.gltf", {}, {buffers, {}, options});
  };
  const std::string text = draft.json(R"([{"byteLength":1,"uri":"0.bin"},{"uri":"1.bin"}])");
  const auto model = sound_model([&] { return read(text, 0); });
  expect_same(model, sound_model([&] { return read(glb_of(draft), 0); }));
  if (model) {
    expect_limit(*model, [&](std::size_t most) { return read(text, most); });
  }
  return 0;
}
