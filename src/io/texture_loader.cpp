// SPDX-License-Identifier: MIT
#include "io/texture_loader.h"

#include <algorithm>
#include <utility>

#include "io/number_parsing.h"
#include "io/picture_decoding.h"

namespace vantage {

std::optional<Image> TextureLoader::embedded(std::string_view bytes, const std::string& label) {
  DecodedPicture picture =
      decode_picture(bytes, std::min({pixels_left_, decoded_left_, kMostPicturePixels}),
                     surroundings_.options.texture_side);
  decoded_left_ -= std::min(picture.pixels, decoded_left_);
  if (!picture.image) {
    complain(label, picture.problem);
    return std::nullopt;
  }
  pixels_left_ -= picture.image->rgba.size() / 4;
  return std::move(picture.image);
}

std::optional<Image> TextureLoader::beside(const std::string& path) {
  const std::string label = in_quotes(path);
  if (!surroundings_.side_files) {
    complain(label, "cannot be found without the model's folder; name the model by its path");
    return std::nullopt;
  }
  if (useless_.count(path) > 0) {
    return std::nullopt;
  }
  const SideFile file = surroundings_.side_files(path);
  std::optional<Image> image;
  if (file.bytes) {
    image = embedded(*file.bytes, label);
  } else {
    complain(label, file.problem);
  }
  if (!image) {
    useless_.insert(path);
  }
  return image;
}

bool TextureLoader::may_keep_again(std::size_t pixels) {
  if (pixels <= pixels_left_) {
    pixels_left_ -= pixels;
    return true;
  }
  if (!std::exchange(has_noted_copies_, true)) {
    builder_.note(
        "a texture that is wrapped in several ways is shown wrapped in some of them alone: it is "
        "too "
        "large for more; make it smaller");
  }
  return false;
}

std::optional<std::uint32_t> TextureList::add(std::size_t picture, Texture way,
                                              const std::function<std::optional<Image>()>& decode) {
  const auto [of_picture, is_new] = of_picture_.try_emplace(picture);
  std::map<Way, std::uint32_t>& known = of_picture->second;
  const Way key{way.wrap_u, way.wrap_v, way.nearest};
  if (is_new) {
    std::optional<Image> image = decode();
    if (!image) {
      return std::nullopt;
    }
    way.image = std::move(*image);
  } else if (known.empty()) {
    return std::nullopt;
  } else if (const auto same = known.find(key); same != known.end()) {
    return same->second;
  } else {
    const std::uint32_t earlier = known.begin()->second;
    const Image& image = textures_[earlier].image;
    if (!loader_.may_keep_again(image.rgba.size() / 4)) {
      known.emplace(key, earlier);
      return earlier;
    }
    way.image = image;
  }
  const auto index = static_cast<std::uint32_t>(textures_.size());
  textures_.push_back(std::move(way));
  known.emplace(key, index);
  return index;
}

void TextureLoader::complain(const std::string& label, const std::string& problem) {
  if (complaints_++ < kMostTextureNotes) {
    builder_.note("the texture " + label + " was left out: it " + problem);
  }
}

void TextureLoader::finish() {
  if (complaints_ > kMostTextureNotes) {
    builder_.note("more textures were left out: " +
                  std::to_string(complaints_ - kMostTextureNotes));
  }
}

}  // namespace vantage
