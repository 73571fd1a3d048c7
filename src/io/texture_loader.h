// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "vantage/mesh/appearance.h"

#include "io/model_builder.h"
#include "io/readers.h"

namespace vantage {

/// Most pixels of all pictures of a model together. [ours]: 512 MB, eight textures of 4096 × 4096.
inline constexpr std::size_t kMostTexturePixels = std::size_t{1} << 27U;
/// Most notes about pictures of one model; more are counted.
inline constexpr std::size_t kMostTextureNotes = 5;

/// Reads the pictures that a model names, each once. What goes wrong becomes a note.
class TextureLoader {
 public:
  /// Both must outlive this.
  TextureLoader(const Surroundings& surroundings, ModelBuilder& builder)
      : surroundings_(surroundings), builder_(builder) {}

  /// Decodes a picture that the file itself holds. \param label how a note calls it.
  std::optional<Image> embedded(std::string_view bytes, const std::string& label);

  /// Reads and decodes a file beside the model, named by a path as relative_path_of_uri() gives it.
  std::optional<Image> beside(const std::string& path);

  /// A note about a picture that cannot be had.
  void complain(const std::string& label, const std::string& problem);

  /// Adds up the complaints that were too many. Call once at the end.
  void finish();

 private:
  const Surroundings& surroundings_;
  ModelBuilder& builder_;
  std::size_t pixels_left_ = kMostTexturePixels;
  std::size_t complaints_ = 0;
};

}  // namespace vantage
