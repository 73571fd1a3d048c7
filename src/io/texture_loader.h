// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include "vantage/mesh/appearance.h"

#include "io/model_builder.h"
#include "io/readers.h"

namespace vantage {

/// Most pixels of all pictures of a model together. [ours]: 512 MB, eight textures of 4096 × 4096.
inline constexpr std::size_t kMostTexturePixels = std::size_t{1} << 27U;
/// Most pixels that are decoded for them: pictures that turn out to be damaged count, and JPEGs of
/// which only an eighth is kept count whole. [ours]: some seconds.
inline constexpr std::size_t kMostDecodedPixels = 4 * kMostTexturePixels;
/// Most notes about pictures of one model; more are counted.
inline constexpr std::size_t kMostTextureNotes = 5;

/// Reads the pictures that a model names. Readers keep what they got of each. What goes wrong becomes a note.
class TextureLoader {
 public:
  /// Both must outlive this.
  TextureLoader(const Surroundings& surroundings, ModelBuilder& builder)
      : surroundings_(surroundings), builder_(builder) {}

  /// Decodes a picture that the file itself holds. \param label how a note calls it.
  std::optional<Image> embedded(std::string_view bytes, const std::string& label);

  /// Reads and decodes a file beside the model, named by a path as relative_path_of_uri() gives it. One
  /// that gave no picture is not tried again.
  std::optional<Image> beside(const std::string& path);

  /// Whether a picture that was read may be kept once more, to be wrapped otherwise; if so, its pixels count
  /// as those of another one.
  bool may_keep_again(std::size_t pixels);

  /// Pixels that may still be decoded.
  [[nodiscard]] std::size_t decoded_left() const { return decoded_left_; }

  /// A note about a picture that cannot be had.
  void complain(const std::string& label, const std::string& problem);

  /// Adds up the complaints that were too many. Call once at the end.
  void finish();

 private:
  const Surroundings& surroundings_;
  ModelBuilder& builder_;
  std::size_t pixels_left_ = kMostTexturePixels;
  std::size_t decoded_left_ = kMostDecodedPixels;
  std::set<std::string> useless_{};  ///< Files that gave no picture.
  bool has_noted_copies_ = false;
  std::size_t complaints_ = 0;
};

/// The textures of a model: each is a picture and how it is laid on. A picture is decoded once.
class TextureList {
 public:
  /// \param loader must outlive this.
  explicit TextureList(TextureLoader& loader) : loader_(loader) {}

  /// Index of the texture; nothing if there is no such picture. One that is too large to be kept in one more
  /// way has the way of an earlier one.
  /// \param picture a number of its own. \param way a texture without its image. \param decode gives that.
  std::optional<std::uint32_t> add(std::size_t picture, Texture way,
                                   const std::function<std::optional<Image>()>& decode);

  std::vector<Texture> take() { return std::move(textures_); }

 private:
  using Way = std::tuple<TextureWrap, TextureWrap, bool>;
  TextureLoader& loader_;
  std::vector<Texture> textures_{};
  /// By picture, indices of its textures; none: it cannot be had.
  std::map<std::size_t, std::map<Way, std::uint32_t>> of_picture_{};
};

}  // namespace vantage
