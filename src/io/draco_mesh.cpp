// SPDX-License-Identifier: MIT
// The one place that calls Draco.
#include "io/draco_mesh.h"

#include <array>
#include <memory>

#include <draco/compression/config/decoder_options.h>
#include <draco/compression/mesh/mesh_edgebreaker_decoder.h>
#include <draco/compression/mesh/mesh_sequential_decoder.h>
#include <draco/core/decoder_buffer.h>
#include <draco/core/varint_decoding.h>
#include <draco/mesh/mesh.h>

#include "io/byte_cursor.h"

namespace vantage {
namespace {

constexpr int kMajor = 2;  // of the bitstream, KHR_draco_mesh_compression
constexpr int kMinor = 2;
constexpr std::size_t kCornerBytes = sizeof(std::uint32_t);
/// Numbers while they are unpacked: 32 bits, whatever they become.
constexpr std::size_t kNumberBytes = 4;

/// Attributes of a mesh: position, normal, tangent, colour, eight sets of texture coordinates, two of
/// joints and weights. Each may keep Draco busy for seconds, however few its bytes. [ours]
constexpr std::int32_t kMostAttributes = 16;

/// Draco's decoder, which looks at what is announced before it makes room for it.
template <class Decoder>
class BoundedDecoder : public Decoder {
 public:
  explicit BoundedDecoder(std::size_t most_bytes) : most_bytes_(most_bytes) {}

  [[nodiscard]] bool is_out_of_proportion() const { return is_out_of_proportion_; }

 protected:
  /// Both kinds begin with two numbers, of which one counts the faces; the other never exceeds
  /// three times that.
  bool DecodeConnectivity() override {
    draco::DecoderBuffer ahead = *this->buffer();
    std::uint32_t first = 0;
    std::uint32_t second = 0;
    if (!draco::DecodeVarint(&first, &ahead) || !draco::DecodeVarint(&second, &ahead)) {
      return false;
    }
    return fits(std::size_t{3} * kCornerBytes * first) &&
           fits(std::size_t{3} * kCornerBytes * second) && Decoder::DecodeConnectivity();
  }

  bool DecodeAllAttributes() override {
    is_out_of_proportion_ = this->point_cloud()->num_attributes() > kMostAttributes;
    std::size_t numbers = 0;
    for (std::int32_t i = 0; i < this->point_cloud()->num_attributes(); ++i) {
      numbers += this->point_cloud()->attribute(i)->num_components();
    }
    return fits(numbers * kNumberBytes * this->point_cloud()->num_points()) &&
           Decoder::DecodeAllAttributes();
  }

 private:
  bool fits(std::size_t bytes) {
    is_out_of_proportion_ = is_out_of_proportion_ || bytes > most_bytes_;
    return !is_out_of_proportion_;
  }

  std::size_t most_bytes_;
  bool is_out_of_proportion_ = false;
};

template <class Decoder>
std::string decode_with(std::string_view bytes, std::size_t most_bytes, draco::Mesh& mesh) {
  draco::DecoderBuffer buffer;
  buffer.Init(bytes.data(), bytes.size());
  BoundedDecoder<Decoder> decoder(most_bytes);
  const draco::DecoderOptions options;
  if (decoder.Decode(options, &buffer, &mesh).ok()) {
    return {};
  }
  return decoder.is_out_of_proportion() ? "is out of proportion to the file" : "is damaged";
}

/// Draco does not look at them where they are packed as a plain list.
bool has_valid_corners(const draco::Mesh& mesh) {
  for (draco::FaceIndex f(0); f.value() < mesh.num_faces(); ++f) {
    for (const draco::PointIndex& corner : mesh.face(f)) {
      if (corner.value() >= mesh.num_points()) {
        return false;
      }
    }
  }
  return true;
}

template <class Number>
bool append_values(const draco::Mesh& mesh, const draco::PointAttribute& attribute,
                   std::size_t components, std::string& bytes) {
  std::array<Number, 4> values{};
  for (draco::PointIndex point(0); point.value() < mesh.num_points(); ++point) {
    const draco::AttributeValueIndex at = attribute.mapped_index(point);
    if (at.value() >= attribute.size() ||
        !attribute.ConvertValue(at, static_cast<std::int8_t>(components), values.data())) {
      return false;
    }
    for (std::size_t c = 0; c < components; ++c) {
      append_little_endian(bytes, values[c]);
    }
  }
  return true;
}

bool append_attribute(const draco::Mesh& mesh, const DracoAttribute& wish, std::string& bytes) {
  const draco::PointAttribute* attribute = mesh.GetAttributeByUniqueId(wish.id);
  if (attribute == nullptr || wish.components < 1 || wish.components > 4) {
    return false;
  }
  switch (wish.component_type) {
    case 5120:
      return append_values<std::int8_t>(mesh, *attribute, wish.components, bytes);
    case 5121:
      return append_values<std::uint8_t>(mesh, *attribute, wish.components, bytes);
    case 5122:
      return append_values<std::int16_t>(mesh, *attribute, wish.components, bytes);
    case 5123:
      return append_values<std::uint16_t>(mesh, *attribute, wish.components, bytes);
    case 5125:
      return append_values<std::uint32_t>(mesh, *attribute, wish.components, bytes);
    case 5126:
      return append_values<float>(mesh, *attribute, wish.components, bytes);
    default:
      return false;
  }
}

/// Decodes with the decoder that the header asks for. \return the problem, or nothing.
std::string decode_any(std::string_view bytes, std::size_t most_bytes, draco::Mesh& mesh) {
  draco::DecoderBuffer buffer;
  buffer.Init(bytes.data(), bytes.size());
  draco::DracoHeader header;
  if (!draco::PointCloudDecoder::DecodeHeader(&buffer, &header).ok()) {
    return "does not begin as Draco's meshes do";
  }
  if (header.version_major != kMajor || header.version_minor != kMinor) {
    return "has bitstream version " + std::to_string(header.version_major) + "." +
           std::to_string(header.version_minor) + ", but glTF has 2.2";
  }
  if (header.encoder_type != draco::TRIANGULAR_MESH) {
    return "is a cloud of points, which glTF does not allow";
  }
  return header.encoder_method == draco::MESH_EDGEBREAKER_ENCODING
             ? decode_with<draco::MeshEdgebreakerDecoder>(bytes, most_bytes, mesh)
             : decode_with<draco::MeshSequentialDecoder>(bytes, most_bytes, mesh);
}

}  // namespace

DracoMesh unpack_draco(std::string_view bytes, const std::vector<DracoAttribute>& wanted,
                       std::size_t most_bytes) {
  DracoMesh result;
  draco::Mesh mesh;
  result.problem = decode_any(bytes, most_bytes, mesh);
  if (!result.problem.empty()) {
    return result;
  }
  if (!has_valid_corners(mesh)) {
    result.problem = "is damaged";
    return result;
  }
  result.points = mesh.num_points();
  for (draco::FaceIndex f(0); f.value() < mesh.num_faces(); ++f) {
    for (const draco::PointIndex& corner : mesh.face(f)) {
      append_little_endian(result.corners, corner.value());
    }
  }
  for (const DracoAttribute& wish : wanted) {
    if (!append_attribute(mesh, wish, result.attributes.emplace_back())) {
      result.problem = "lacks attribute " + std::to_string(wish.id) + ", which the JSON names";
      return result;
    }
  }
  return result;
}

}  // namespace vantage
