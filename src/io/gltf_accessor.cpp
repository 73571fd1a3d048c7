// SPDX-License-Identifier: MIT
#include "io/gltf_accessor.h"

#include <algorithm>
#include <string>

#include "io/byte_cursor.h"

namespace vantage {
namespace {

/// Bytes of a component, 0 for a type the format does not have.
std::size_t component_bytes(int type) {
  switch (type) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return 1;
    case TINYGLTF_COMPONENT_TYPE_SHORT:
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return 2;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
    case TINYGLTF_COMPONENT_TYPE_FLOAT:
      return 4;
    default:
      return 0;
  }
}

template <class Integer>
double integer_value(const char* data, bool normalised) {
  const auto value = static_cast<double>(decode<Integer>(data, ByteOrder::Little));
  const auto full = static_cast<double>(std::numeric_limits<Integer>::max());
  return normalised ? std::max(value / full, -1.0) : value;
}

double component_value(const char* data, int type, bool normalised) {
  switch (type) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
      return integer_value<std::int8_t>(data, normalised);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return integer_value<std::uint8_t>(data, normalised);
    case TINYGLTF_COMPONENT_TYPE_SHORT:
      return integer_value<std::int16_t>(data, normalised);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return integer_value<std::uint16_t>(data, normalised);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
      return integer_value<std::uint32_t>(data, normalised);
    default:
      return static_cast<double>(decode<float>(data, ByteOrder::Little));
  }
}

}  // namespace

std::size_t gltf_component_count(int type) {
  switch (type) {
    case TINYGLTF_TYPE_SCALAR:
      return 1;
    case TINYGLTF_TYPE_VEC2:
      return 2;
    case TINYGLTF_TYPE_VEC3:
      return 3;
    case TINYGLTF_TYPE_VEC4:
      return 4;
    case TINYGLTF_TYPE_MAT4:
      return 16;
    default:
      return 0;
  }
}

GltfAccessor::GltfAccessor(const GltfDocument& document, int index, std::size_t most_elements,
                           const ModelBuilder& builder)
    : builder_(builder), index_(index) {
  const auto& accessors = document.structure.accessors;
  if (index < 0 || static_cast<std::size_t>(index) >= accessors.size()) {
    fail("does not exist");
  }
  const tinygltf::Accessor& accessor = accessors[static_cast<std::size_t>(index)];
  component_type_ = accessor.componentType;
  components_ = static_cast<int>(gltf_component_count(accessor.type));
  normalised_ = accessor.normalized;
  const std::size_t element_bytes =
      component_bytes(component_type_) * static_cast<std::size_t>(components_);
  if (element_bytes == 0) {
    fail("has a type that no vertex or index has");
  }
  if (accessor.count > most_elements) {
    fail("has more elements than the size of the file allows");
  }
  count_ = accessor.count;
  if (accessor.bufferView >= 0) {
    const Run run = view(document, accessor.bufferView);
    stride_ = run.stride == 0 ? element_bytes : run.stride;
    data_ = checked(run, accessor.byteOffset, stride_, count_, element_bytes);
  }
  if (accessor.sparse.isSparse) {
    read_sparse(document, accessor);
  }
}

bool GltfAccessor::is_integer() const {
  return !normalised_ && (component_type_ == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE ||
                          component_type_ == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT ||
                          component_type_ == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT);
}

double GltfAccessor::value(std::size_t i, int c) const {
  const char* element = data_ == nullptr ? nullptr : data_ + i * stride_;
  const auto replacement =
      std::lower_bound(sparse_.begin(), sparse_.end(), i,
                       [](const Replacement& entry, std::size_t key) { return entry.index < key; });
  if (replacement != sparse_.end() && replacement->index == i) {
    element = replacement->data;
  }
  if (element == nullptr) {
    return 0.0;
  }
  return component_value(element + static_cast<std::size_t>(c) * component_bytes(component_type_),
                         component_type_, normalised_);
}

GltfAccessor::Run GltfAccessor::view(const GltfDocument& document, std::int64_t index) const {
  const auto& views = document.structure.bufferViews;
  if (index < 0 || static_cast<std::size_t>(index) >= views.size()) {
    fail("names a buffer view that does not exist");
  }
  const tinygltf::BufferView& entry = views[static_cast<std::size_t>(index)];
  if (entry.buffer < 0 || static_cast<std::size_t>(entry.buffer) >= document.buffers.size()) {
    fail("lies in a buffer that does not exist");
  }
  const std::string& buffer = *document.buffers[static_cast<std::size_t>(entry.buffer)];
  if (entry.byteOffset > buffer.size() || entry.byteLength > buffer.size() - entry.byteOffset) {
    fail("lies in a buffer view that reaches beyond its buffer");
  }
  return {buffer.data() + entry.byteOffset, entry.byteLength, entry.byteStride};
}

const char* GltfAccessor::checked(const Run& run, std::uint64_t offset, std::size_t stride,
                                  std::size_t count, std::size_t element_bytes) const {
  if (count == 0) {
    return run.data;
  }
  if (offset > run.size || run.size - offset < element_bytes ||
      (run.size - offset - element_bytes) / stride < count - 1) {
    fail("reaches beyond its buffer view");
  }
  return run.data + offset;
}

void GltfAccessor::read_sparse(const GltfDocument& document, const tinygltf::Accessor& accessor) {
  const auto& sparse = accessor.sparse;
  if (sparse.count < 0 || static_cast<std::size_t>(sparse.count) > count_ ||
      sparse.indices.byteOffset < 0 || sparse.values.byteOffset < 0) {
    fail("has a sparse part with impossible numbers");
  }
  const auto count = static_cast<std::size_t>(sparse.count);
  const int type = sparse.indices.componentType;
  const std::size_t index_bytes = component_bytes(type);
  const std::size_t element_bytes =
      component_bytes(component_type_) * static_cast<std::size_t>(components_);
  if (type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE &&
      type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT &&
      type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT) {
    fail("has sparse indices that are not unsigned");
  }
  const char* indices = checked(view(document, sparse.indices.bufferView),
                                static_cast<std::uint64_t>(sparse.indices.byteOffset), index_bytes,
                                count, index_bytes);
  const char* values = checked(view(document, sparse.values.bufferView),
                               static_cast<std::uint64_t>(sparse.values.byteOffset), element_bytes,
                               count, element_bytes);
  sparse_.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    const auto target =
        static_cast<std::uint64_t>(component_value(indices + i * index_bytes, type, false));
    if (target >= count_ || (i > 0 && target <= sparse_.back().index)) {
      fail("has sparse indices that do not ascend below its length");
    }
    sparse_.push_back({target, values + i * element_bytes});
  }
}

void GltfAccessor::fail(const char* problem) const {
  builder_.fail("accessor " + std::to_string(index_) + " " + problem);
}

}  // namespace vantage
