// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "io/gltf_document.h"
#include "io/model_builder.h"

namespace vantage {

/// Numbers an element of an accessor's type has; 0 for small matrices, which nothing of ours has.
std::size_t gltf_component_count(int type);

/// Numbers of one accessor, bounds checked at construction: no read can leave its buffer.
class GltfAccessor {
 public:
  /// \throw FormatError if any part of the accessor lies outside its buffer view or buffer, or if
  /// it has more elements than `most_elements`.
  GltfAccessor(const GltfDocument& document, int index, std::size_t most_elements,
               const ModelBuilder& builder);

  [[nodiscard]] std::size_t count() const { return count_; }

  [[nodiscard]] int components() const { return components_; }

  [[nodiscard]] bool is_integer() const;  ///< Unsigned and not normalised: may hold indices.

  [[nodiscard]] bool has_data() const { return data_ != nullptr || !sparse_.empty(); }

  /// Component `c` of element `i`, normalised integers as [0, 1] or [−1, 1].
  [[nodiscard]] double value(std::size_t i, int c) const;

 private:
  /// A run of bytes inside a buffer.
  struct Run {
    const char* data = nullptr;
    std::size_t size = 0;
    std::size_t stride = 0;  ///< 0: packed.
  };

  /// Element `index` is replaced by what stands at `data`.
  struct Replacement {
    std::uint64_t index;
    const char* data;
  };

  Run view(const GltfDocument& document, std::int64_t index) const;
  const char* checked(const Run& run, std::uint64_t offset, std::size_t stride, std::size_t count,
                      std::size_t element_bytes) const;
  void read_sparse(const GltfDocument& document, const tinygltf::Accessor& accessor);
  [[noreturn]] void fail(const char* problem) const;

  const ModelBuilder& builder_;
  int index_;
  std::size_t count_ = 0;
  int components_ = 0;
  int component_type_ = 0;
  bool normalised_ = false;
  const char* data_ = nullptr;  ///< Null: all zero.
  std::size_t stride_ = 0;
  std::vector<Replacement> sparse_{};  ///< Sorted by index.
};

}  // namespace vantage
